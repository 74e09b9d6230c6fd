import { byId } from "./elements.js";

/** Ways of choosing a cloud: a file by button or by dropping it, and an address. */
export interface Chosen {
  file(file: File): void;
  address(text: string): void;
}

/** Connects the part of the panel that asks for a cloud, and dropping on the whole page. */
export class Chooser {
  readonly #details = byId("chooser", HTMLDetailsElement);
  readonly #address = byId("address", HTMLInputElement);
  readonly #crs = byId("crs", HTMLInputElement);

  constructor(chosen: Chosen) {
    const file = byId("file", HTMLInputElement);
    file.addEventListener("change", () => {
      const [first] = file.files ?? [];
      // Without this the same file could not be chosen a second time, say after it was converted anew.
      file.value = "";
      if (first) chosen.file(first);
    });
    byId("by-address", HTMLFormElement).addEventListener("submit", (event) => {
      event.preventDefault();
      chosen.address(this.#address.value);
    });
    acceptDrops(chosen);
  }

  /** Coordinate system that the reader gave for clouds that name none. */
  get crs(): string | undefined {
    return this.#crs.value.trim() || undefined;
  }

  /** Shows the address that the page was opened with. */
  fill(address: string): void {
    this.#address.value = address;
  }

  /** Takes the reader to where a coordinate system can be given. */
  askForCrs(): void {
    this.#details.open = true;
    this.#crs.focus();
  }

  fold(): void {
    this.#details.open = false;
  }
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
    const [first] = event.dataTransfer?.files ?? [];
    if (first) chosen.file(first);
  });
}
