import { createRequire } from "node:module";
import { gzipSync } from "node:zlib";
import {
  CrsError,
  type EpsgLookup,
  type EpsgRow,
  epsgLookup,
  packEpsg,
  resolveCrs,
  verticalLookup,
  verticalSystems,
} from "@groma/georef";
import { describe, expect, it } from "vitest";

const table = createRequire(import.meta.url)("epsg-index/all.json") as Record<string, EpsgRow>;
const rows = Object.values(table);
const packed = JSON.stringify(packEpsg(rows));
const lookup = epsgLookup(JSON.parse(packed), verticalLookup(verticalSystems(rows)));

/** What a table makes of a code. Which row of it a shift of zero stands in, and why a code is refused, may differ. */
function meaning(code: number, of: EpsgLookup) {
  try {
    const { datum, ...crs } = resolveCrs({ file: "scan", given: `EPSG:${code}` }, of);
    return JSON.stringify({ ...crs, accuracy: datum?.accuracy });
  } catch (error) {
    if (error instanceof CrsError) return "refused";
    throw error;
  }
}

describe("the packed table of EPSG", () => {
  it("means what the whole table means, for every code", () => {
    const codes = rows.map(({ code }) => Number(code)).filter((code) => code <= 65535);
    expect(codes.length).toBeGreaterThan(6000);
    const different = codes.filter(
      (code) => meaning(code, lookup) !== meaning(code, (asked) => table[asked]),
    );
    expect(different).toEqual([]);
  });

  it("knows no other codes", () => {
    expect(lookup(99999)).toBeUndefined();
    expect(lookup(Number.NaN)).toBeUndefined();
  });

  it("is small", () => {
    expect(packed.length).toBeLessThan(750_000);
    expect(gzipSync(packed).length).toBeLessThan(130_000);
  });
});
