import { ConsoleStdout, Fd, PreopenDirectory, WASI } from "@bjorn3/browser_wasi_shim";
import type { Fault } from "@groma/georef";
import { type Bytes, BytesFile, GrowingBytes, GrowingFolder } from "./bytes-file.js";

/** What the core tells while it runs. */
export type CoreEvent =
  | { readonly event: "progress"; readonly stage: Stage; readonly done: number; readonly total: number }
  | { readonly event: "warning"; readonly text: string };

/** Reading distributes the points, building gives them their nodes; done and total are points. */
export type Stage = "read" | "build" | "write";

/** How a run of the core ended. */
export type CoreOutcome =
  | { readonly copc: GrowingBytes }
  /** The core's own error. */
  | { readonly fault: Fault }
  /** It broke off, and this is the last that it said. */
  | { readonly complaint: string };

type Line = CoreEvent | { readonly event: "done" } | ({ readonly event: "error" } & Fault);

/** Names within the core's own folder. */
const [INPUT, OUTPUT] = ["scan", "scan.copc.laz"];

/** Most memory that the core gives to points and work: what WebAssembly has, less what the allocator needs besides. */
const MEMORY = "3GB";

/** The program `groma-core` as a module of WebAssembly: it knows no page and no browser. */
export class CoreProgram {
  readonly #module: WebAssembly.Module;

  constructor(module: WebAssembly.Module) {
    this.#module = module;
  }

  /**
   * Converts a LAS or LAZ file to COPC, as `groma-core convert` does, and returns when that is done.
   * @param onEvent is called meanwhile
   */
  async convert(scan: Bytes, onEvent: (event: CoreEvent) => void): Promise<CoreOutcome> {
    let fault: Fault | undefined;
    let whole = false;
    let complaint = "";
    const onLine = (text: string) => {
      const line = JSON.parse(text) as Line;
      if (line.event === "error") fault ??= line;
      else if (line.event === "done") whole = true;
      else onEvent(line);
    };
    const folder = new GrowingFolder(new Map([[INPUT, new BytesFile(scan)]]));
    const place = new PreopenDirectory(".", folder.contents);
    place.dir = folder;
    const system = new WASI(
      ["groma-core", "convert", "--memory", MEMORY, INPUT, OUTPUT],
      [],
      [
        new Nothing(),
        ConsoleStdout.lineBuffered(onLine),
        ConsoleStdout.lineBuffered((text) => {
          complaint = text || complaint;
        }),
        place,
      ],
      { debug: false },
    );
    try {
      const instance = await WebAssembly.instantiate(this.#module, {
        wasi_snapshot_preview1: system.wasiImport,
      });
      system.start(instance as Parameters<WASI["start"]>[0]);
    } catch (thrown) {
      // A program that panics or has no memory left ends with a trap; it has said why.
      complaint ||= thrown instanceof Error ? thrown.message : String(thrown);
    }
    if (fault) return { fault };
    const made = folder.contents.get(OUTPUT);
    if (!(whole && made instanceof BytesFile && made.bytes instanceof GrowingBytes)) return { complaint };
    return { copc: made.bytes };
  }
}

/** A standard input that nothing comes from. */
class Nothing extends Fd {
  override fd_read() {
    return { ret: 0, data: new Uint8Array() };
  }
}
