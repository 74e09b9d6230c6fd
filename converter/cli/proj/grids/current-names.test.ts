import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, describe, expect, it } from "vitest";
import type { Operation } from "../operation.js";
import { howToGet, withCurrentNames } from "./current-names.js";

const folder = mkdtempSync(join(tmpdir(), "groma-grids-"));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const german: Operation = {
  ...{ name: "ETRS89 to DHHN2016 height (1)", accuracy: 0.02, area: "Germany", ballpark: false },
  missingGrids: ["GCG2016.txt"],
  pipeline: "+proj=pipeline +step +proj=vgridshift +grids=GCG2016.txt +multiplier=1",
};

describe("grids under their publisher's name", () => {
  it("are named as PROJ-data names them where they are missing", async () => {
    expect(await withCurrentNames(german, [folder])).toEqual({
      ...german,
      missingGrids: ["de_bkg_gcg2016.tif"],
    });
  });

  it("are used where PROJ-data's file is there", async () => {
    writeFileSync(join(folder, "de_bkg_gcg2016.tif"), "");
    expect(await withCurrentNames(german, ["/nowhere", folder])).toEqual({
      ...german,
      missingGrids: [],
      pipeline: german.pipeline!.replace("GCG2016.txt", "de_bkg_gcg2016.tif"),
    });
  });

  it("stay as they are where there is no other name", async () => {
    const other = { ...german, missingGrids: ["nl_nsgi_nlgeo2018.tif", "own.gsb"] };
    expect(await withCurrentNames(other, [folder])).toEqual(other);
  });
});

it("missing grids are told with the way to get them", () => {
  expect(howToGet(["de_bkg_gcg2016.tif"])).toBe(
    "get it with `projsync --file de_bkg_gcg2016.tif`, or give its folder with --grids",
  );
  expect(howToGet(["own.gsb"])).toBe("give its folder with --grids");
  expect(howToGet(["a.tif", "b.tif"])).toBe(
    "get them with `projsync --file a.tif`, `projsync --file b.tif`, or give their folder with --grids",
  );
});
