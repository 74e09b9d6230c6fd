import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";

let bytes: Promise<Buffer<ArrayBuffer>> | undefined;

/** The decoder of LAZ as WebAssembly, read once. */
export function lazBytes(): Promise<Buffer<ArrayBuffer>> {
  bytes ??= readFile(createRequire(import.meta.url).resolve("@groma/layer/laz.wasm"));
  return bytes;
}
