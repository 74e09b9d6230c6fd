/** Magic number of a WebAssembly module: `\0asm`. */
const WASM_MAGIC = [0x00, 0x61, 0x73, 0x6d];

/**
 * Fetches a module of WebAssembly.
 * @throws Error whose message says, for the cause of an error, why it is not to be had
 */
export async function fetchModule(url: string): Promise<Uint8Array<ArrayBuffer>> {
  const response = await fetch(url).catch(() => undefined);
  if (!response) throw new Error("it cannot be fetched");
  if (!response.ok) throw new Error(`the server answered HTTP ${response.status}`);
  const bytes = await response.arrayBuffer().catch(() => {
    throw new Error("it cannot be fetched");
  });
  const module = new Uint8Array(bytes);
  if (WASM_MAGIC.some((byte, index) => module[index] !== byte)) throw new Error("this is not WebAssembly");
  return module;
}
