import { printable } from "@groma/georef/printable";
import { type ByteSink, MemorySink } from "@groma/layer/export";
import { i18n } from "../language/i18n.js";
import { PageError } from "./page-error.js";

/** The part of the File System API that TypeScript's own types lack. */
interface SavePicker {
  showSaveFilePicker?(options: { suggestedName: string }): Promise<FileSystemFileHandle>;
}

/** Writes a file of the browser's, which stands whole or not at all: it takes its place when it is closed. */
class StreamSink implements ByteSink {
  readonly #stream: FileSystemWritableFileStream;

  constructor(stream: FileSystemWritableFileStream) {
    this.#stream = stream;
  }

  async write(bytes: Uint8Array): Promise<void> {
    await this.#stream.write(bytes as Uint8Array<ArrayBuffer>);
  }

  async overwrite(at: number, bytes: Uint8Array): Promise<void> {
    await this.#stream.write({ type: "write", position: at, data: bytes as Uint8Array<ArrayBuffer> });
  }
}

/**
 * Has a file written where the reader chooses, straight to disk; in a browser that cannot, it is held in memory and
 * downloaded. Nothing is left of what fails.
 *
 * @returns false where the reader chose no place
 * @throws PageError PAGE_STORAGE where there is no room, PAGE_SAVE where the browser may not write; what `fill` throws
 */
export async function saveFile(name: string, fill: (sink: ByteSink) => Promise<unknown>): Promise<boolean> {
  const { showSaveFilePicker } = window as SavePicker;
  const offered = fileName(name);
  if (!showSaveFilePicker) {
    const sink = new MemorySink();
    await fill(sink);
    download(offered, sink.blob());
    return true;
  }
  let handle: FileSystemFileHandle;
  try {
    handle = await showSaveFilePicker.call(window, { suggestedName: offered });
  } catch (thrown) {
    if (thrown instanceof Error && thrown.name === "AbortError") return false;
    throw thrown;
  }
  try {
    const stream = await handle.createWritable();
    try {
      await fill(new StreamSink(stream));
    } catch (thrown) {
      await stream.abort();
      throw thrown;
    }
    await stream.close();
  } catch (thrown) {
    throw unsaved(name, thrown);
  }
  return true;
}

/** A name as file systems take it: what comes from the name of a cloud may have signs that browsers refuse. */
function fileName(name: string): string {
  return printable(name).replace(/[\\/:*?"<>|]/g, "_");
}

/** What the browser says of a file that it cannot write, in words; anything else as it is. */
function unsaved(name: string, thrown: unknown): unknown {
  if (!(thrown instanceof DOMException)) return thrown;
  if (thrown.name === "QuotaExceededError") {
    const cause = i18n.t("there is no room left for it");
    return new PageError({
      code: "PAGE_STORAGE",
      file: name,
      cause,
      fix: i18n.t("Free space, or save on another disk"),
    });
  }
  if (["NotAllowedError", "NoModificationAllowedError", "InvalidStateError"].includes(thrown.name)) {
    const cause = i18n.t("the browser may not write it ({reason})", { reason: thrown.message });
    return new PageError({
      code: "PAGE_SAVE",
      file: name,
      cause,
      fix: i18n.t("Choose another name or folder"),
    });
  }
  return thrown;
}

/** Has the browser put a file where it puts downloads. */
export function download(name: string, blob: Blob): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  // The browser has taken the file by the next turn of the loop, some only a little later.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
