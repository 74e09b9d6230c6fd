import { gzipSync } from "node:zlib";
import type { OutputAsset, OutputChunk } from "rolldown";

/** The chunks of a bundle that its entries begin with; what is fetched only when it is needed is not among them. */
export function firstChunks(output: readonly (OutputChunk | OutputAsset)[]): OutputChunk[] {
  const chunks = new Map(
    output.flatMap((part) => (part.type === "chunk" ? [[part.fileName, part] as const] : [])),
  );
  const first = new Set<OutputChunk>();
  const load = (file: string): void => {
    const chunk = chunks.get(file);
    if (!chunk || first.has(chunk)) return;
    first.add(chunk);
    chunk.imports.forEach(load);
  };
  for (const { fileName, isEntry } of chunks.values()) if (isEntry) load(fileName);
  return [...first];
}

/** Bytes of files, each gzipped by itself. */
export function zippedBytes(files: readonly (string | Uint8Array)[]): number {
  return files.reduce((sum, file) => sum + gzipSync(file).length, 0);
}
