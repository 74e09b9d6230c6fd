import { expect, it } from "vitest";
import type { PdalReport } from "../pdal/report.js";
import type { Georeferenced } from "../place/georeference.js";
import { type DryRun, planForMachines, planInWords } from "./dry-run.js";

const crs: Georeferenced["crs"] = {
  ...{ name: "CH1903+ / LV95", code: "EPSG:2056", proj4: "+proj=somerc", height: { kind: "unknown" } },
  horizontalUnit: { name: "metre", kind: "linear", size: 1 },
  verticalUnit: { name: "metre", kind: "linear", size: 1, declared: false },
};
const core = {
  ...{
    inputs: 3,
    skipped: [],
    points: 10_653_336,
    recordLength: 36,
    levels: 6,
    cells: 64,
    memory: 512e6,
    tempBytes: 480e6,
  },
  ...{ tempDir: "/scratch", tempFree: 79e9, outputBytes: 66e6, sampling: "poisson" },
};
const planned: DryRun = {
  ...{
    output: "o.copc.laz",
    inputs: 3,
    skipped: [],
    points: 10_653_336,
    core,
    pdal: [],
    pdalTemp: undefined,
  },
  georeferenced: { crs, basis: "WKT", notes: [{ code: "CRS_OTHER_FORM", text: "said" }] },
  whereabouts: { centre: { longitude: 7.44, latitude: 46.95 }, notes: [{ code: "CRS_AREA", text: "far" }] },
};

it("tells people what a conversion takes", () => {
  expect(planInWords(planned)).toEqual([
    "inputs   3, 10,653,336 points",
    "place    EPSG:2056 CH1903+ / LV95 (WKT)",
    "height   unknown (shown as ellipsoidal)",
    "centre   longitude 7.4400°, latitude 46.9500°",
    "note     said",
    "note     far",
    "octree   about 6 levels, 36 bytes per point, sampling poisson",
    "memory   at most 512 MB",
    "temp     at most 480 MB in /scratch, 79 GB free",
    "output   o.copc.laz, about 66 MB",
  ]);
  expect(planInWords({ ...planned, core: { ...core, tempBytes: 0 } }).join("\n")).toMatch(/^temp +none, /m);
  expect(planInWords({ ...planned, core: { ...core, levels: 1 } })[6]).toMatch(/^octree {3}about 1 level, /);
});

it("tells machines the same in one object", () => {
  expect(planForMachines(planned)).toMatchObject({
    event: "plan",
    ...core,
    output: "o.copc.laz",
    crsFrom: "WKT",
  });
  const job: PdalReport = {
    ...{
      input: "a.e57",
      points: 6,
      version: "2.2.0",
      readers: ["readers.e57"],
      streamed: true,
      asStored: false,
    },
    ...{ scale: [0.001, 0.001, 0.001], offset: [0, 0, 0], keptAside: [], rounded: [], tempBytes: 1000 },
  };
  const pdalTemp = { folder: "/scratch", bytes: 1000, free: 1e9 };
  const first: DryRun = { ...planned, core: undefined, pdal: [job], pdalTemp };
  expect(planForMachines(first)).toMatchObject({ points: 10_653_336, memory: null, pdal: [job], pdalTemp });
  expect(planInWords(first).join("\n")).toMatch(
    /^pdal +a\.e57: 6 points by PDAL 2\.2\.0 .* rounded by at most 0\.0005$/m,
  );
  expect(planInWords(first).join("\n")).toMatch(/^temp +1 kB for PDAL in \/scratch, 1 GB free$/m);
});
