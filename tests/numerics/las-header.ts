import { closeSync, openSync, readSync } from "node:fs";
import type { Domain } from "@groma/georef";

/** What the numerics need of a LAS file. */
export interface LasHeader {
  readonly scale: readonly [number, number, number];
  readonly offset: readonly [number, number, number];
  readonly domain: Domain;
  readonly wkt: string | undefined;
}

/** Public header block and WKT VLR (LAS 1.4 R15, 2.4 and 2.6), read without the project's own readers. */
export function readLasHeader(path: string): LasHeader {
  const bytes = Buffer.alloc(1 << 16);
  const file = openSync(path, "r");
  readSync(file, bytes, 0, bytes.length, 0);
  closeSync(file);
  const double = (at: number) => bytes.readDoubleLE(at);
  const [maxX, minX, maxY, minY, maxZ, minZ] = [179, 187, 195, 203, 211, 219].map(double);
  return {
    scale: [double(131), double(139), double(147)],
    offset: [double(155), double(163), double(171)],
    domain: { minX, minY, minZ, maxX, maxY, maxZ },
    wkt: wktOf(bytes),
  };
}

function wktOf(bytes: Buffer): string | undefined {
  let at = bytes.readUInt16LE(94);
  for (let i = bytes.readUInt32LE(100); i > 0; i--) {
    const length = bytes.readUInt16LE(at + 20);
    if (bytes.readUInt16LE(at + 18) === 2112) return bytes.toString("utf8", at + 54, at + 54 + length);
    at += 54 + length;
  }
  return undefined;
}
