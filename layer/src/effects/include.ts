import { CHUNKS } from "./chunks/index.js";

const INCLUDE = /^[ \t]*#include +<([\w/]+)>[ \t]*\n?/gm;

/**
 * Resolves `#include <name>` over this project's chunks and three.js' (`three/name`), each once, nested ones first.
 * @throws Error where a text includes a chunk that does not exist
 */
export function includeChunks(text: string, seen: Set<string> = new Set()): string {
  return text.replace(INCLUDE, (_, name: string) => {
    if (seen.has(name)) return "";
    seen.add(name);
    const chunk = CHUNKS[name];
    if (chunk === undefined) throw new Error(`there is no shader chunk "${name}"`);
    return `${includeChunks(`${chunk.trim()}\n`, seen)}`;
  });
}
