import { type Crs, egm96Grid, encodeEgm96 } from "@groma/georef";
import { afterEach, describe, expect, it, vi } from "vitest";
import { guessHeights } from "./height-data.js";

const SYSTEM = {
  ...{ code: 5728, name: "LN02 height", unit: { name: "metre", size: 1 }, depth: false },
  ...{ area: [5.96, 45.82, 10.49, 47.81], partners: [2056] },
};

/** A fresh copy: what was fetched once is kept. */
async function fresh() {
  vi.resetModules();
  return (await import("./height-data.js")).packagedHeights;
}

afterEach(() => vi.unstubAllGlobals());

describe("the files of heights beside the library", () => {
  it("are fetched when first asked for, once", async () => {
    const grid = encodeEgm96(egm96Grid((row, column) => row / 100 - column / 50));
    const fetched = vi.fn(async (address: URL) =>
      address.href.endsWith(".json") ? Response.json([SYSTEM]) : new Response(grid.slice()),
    );
    vi.stubGlobal("fetch", fetched);
    const data = await fresh();
    expect(fetched).not.toHaveBeenCalled();
    expect(await data.systems()).toEqual([SYSTEM]);
    const [egm96] = await Promise.all([data.egm96(), data.egm96()]);
    expect(egm96.value(0, 720, 1439)).toBeCloseTo(7.2 - 28.78, 5);
    expect(egm96.value(0, 8, 0)).toBeCloseTo(0.08, 6);
    expect(fetched).toHaveBeenCalledTimes(2);
  });

  it("are told by name when they cannot be had, and asked for again", async () => {
    const answers = [() => new Response("", { status: 404 }), () => Response.json([SYSTEM])];
    vi.stubGlobal("fetch", async () => answers.shift()?.());
    const data = await fresh();
    await expect(data.systems()).rejects.toMatchObject({
      ...{ code: "SOURCE_HEIGHTS", cause: expect.stringContaining("404") },
      file: expect.stringContaining("vertical-systems.json"),
    });
    expect(await data.systems()).toHaveLength(1);
  });

  it("are refused when they are something else", async () => {
    vi.stubGlobal("fetch", async () => new Response("<!doctype html>"));
    const data = await fresh();
    await expect(data.egm96()).rejects.toMatchObject({ code: "SOURCE_HEIGHTS" });
    await expect(data.systems()).rejects.toMatchObject({ code: "SOURCE_HEIGHTS" });
  });
});

describe("guessHeights", () => {
  const unit = { name: "metre", kind: "linear", size: 1 } as const;
  const crs: Crs = {
    ...{ name: "LV95", code: "EPSG:2056", proj4: "", horizontalUnit: unit },
    verticalUnit: { ...unit, declared: false },
    height: { kind: "unknown" },
  };
  const data = { systems: async () => [SYSTEM as never], egm96: async () => egm96Grid(() => 47.4) };
  const boundingBox = { min: [0, 0, 0], max: [2, 2, 2] } as const;

  it("offers the system of the place, and how far off the points may be", async () => {
    // 46.95° north, 7.44° east.
    const place = () => Float64Array.of(4325080, 564813, 4638230);
    const guess = await guessHeights({ crs, boundingBox, place }, data);
    expect(guess).toMatchObject({ systems: [{ code: 5728 }] });
    expect(guess?.undulation).toBeCloseTo(47.4, 4);
    expect(guess?.note).toMatch(/LN02 height \(EPSG:5728\).* 47\.4 m higher/);
  });
});
