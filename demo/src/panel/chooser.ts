import { CrsError } from "@groma/georef";
import { i18n } from "../language/i18n.js";
import { byId } from "./elements.js";
import { unfold } from "./fold.js";
import type { Action } from "./message.js";
import { PageError } from "./page-error.js";

/** A small scan that comes with the page, in `demo/public`: of the kind that `demo/sample` makes, converted. */
const SAMPLE = "sample.copc.laz";

/** Ways of choosing clouds: files by button or by dropping them, and an address. */
export interface Chosen {
  /** @param folders faults of folders that were dropped with them */
  files(files: readonly File[], folders: readonly PageError[]): void;
  address(text: string): void;
}

/** Connects the part of the panel that asks for a cloud, and dropping on the whole page. */
export class Chooser {
  readonly #details = byId("chooser", HTMLDetailsElement);
  readonly #address = byId("address", HTMLInputElement);

  constructor(chosen: Chosen) {
    const file = byId("file", HTMLInputElement);
    file.addEventListener("change", () => {
      const files = [...(file.files ?? [])];
      // Without this the same file could not be chosen a second time, say after it was converted anew.
      file.value = "";
      if (files.length > 0) chosen.files(files, []);
    });
    byId("by-address", HTMLFormElement).addEventListener("submit", (event) => {
      event.preventDefault();
      chosen.address(this.#address.value);
    });
    byId("sample", HTMLButtonElement).addEventListener("click", () => chosen.address(SAMPLE));
    acceptDrops(chosen);
  }

  /** Shows the address that the page was opened with. */
  fill(address: string): void {
    this.#address.value = address;
  }

  /** Whether the page has no cloud: it then begins with this, in the middle. */
  set alone(alone: boolean) {
    document.body.classList.toggle("empty", alone);
    if (alone) unfold(this.#details);
  }

  fold(): void {
    this.#details.open = false;
  }
}

/** Coordinate system that the reader gave for clouds and compared scans that name none. */
export function givenCrs(): string | undefined {
  return byId("crs", HTMLInputElement).value.trim() || undefined;
}

/**
 * What a reader can do where a cloud names no coordinate system, or has no place in the one that was given: be taken to where one
 * can be given. Undefined for other faults, which it would not mend.
 */
export function crsRemedy(thrown: unknown): Action | undefined {
  if (!(thrown instanceof CrsError)) return undefined;
  if (thrown.code !== "CRS_MISSING" && givenCrs() === undefined) return undefined;
  return {
    label: i18n.t("Give it here"),
    fix: i18n.t("Give the coordinate system here, and open the cloud again."),
    run: () => {
      const field = byId("crs", HTMLInputElement);
      unfold(field);
      field.focus();
    },
  };
}

function acceptDrops(chosen: Chosen): void {
  const veil = byId("drop", HTMLDivElement);
  const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
  addEventListener("dragover", (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    veil.hidden = false;
  });
  addEventListener("dragleave", (event) => {
    // Null once the pointer has left the window, not just an element of it.
    if (event.relatedTarget === null) veil.hidden = true;
  });
  addEventListener("drop", (event) => {
    veil.hidden = true;
    if (!hasFiles(event)) return;
    // Or the browser leaves the page to show the file.
    event.preventDefault();
    const items = [...(event.dataTransfer?.items ?? [])].filter(({ kind }) => kind === "file");
    const folderOf = (item: DataTransferItem) => {
      const entry = item.webkitGetAsEntry();
      return entry?.isDirectory ? [folder(entry.name)] : [];
    };
    const files = items.filter((item) => folderOf(item).length === 0);
    const folders = items.flatMap(folderOf);
    if (items.length > 0)
      chosen.files(
        files.flatMap((item) => item.getAsFile() ?? []),
        folders,
      );
  });
}

function folder(name: string): PageError {
  return new PageError({
    code: "PAGE_FOLDER",
    file: name,
    cause: i18n.t("this is a folder"),
    fix: i18n.t("Drop the files in it, or make one scan of them: groma convert FOLDER OUT.copc.laz"),
  });
}
