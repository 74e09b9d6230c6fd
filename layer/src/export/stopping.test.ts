import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { Corridor } from "../tools/profile/corridor.js";
import { CrossSections } from "../tools/sections/cross-sections.js";
import { type ByteSink, MemorySink } from "./byte-sink.js";
import { collectParts } from "./collect.js";
import { exportCsv } from "./csv.js";
import { exportLandXml, exportPicture } from "./documents.js";
import { exportDxf } from "./dxf.js";
import { exportGeoJson } from "./geojson.js";
import { exportLas } from "./las.js";
import { exportLaz } from "./laz.js";
import { scanOf } from "./scan.fixture.js";
import { exportSectionLandXml, exportSectionSheets, exportSections } from "./sections.js";
import type { ExportOptions } from "./selection.js";

const METRE = { text: "m", size: 1 };
const FACTS = { title: "dike", crs: "", epsg: undefined, heights: "", unit: METRE, heightUnit: METRE };
const LINE = new Corridor(
  [
    [0, 0],
    [200, 0],
  ],
  100,
);

/** A node with many points: 200 rows of 100, a metre apart. */
const large = scanOf(
  Array.from({ length: 20_000 }, (_, index) => ({
    xyz: [100 * (index % 200), 100 * Math.floor(index / 200), 0],
  })),
  20_000,
);
const selection = { origin: large, along: LINE };

/** Many sections of a few points each. */
const few = scanOf(
  Array.from({ length: 200 }, (_, index) => ({ xyz: [100 * index, 0, 0] })),
  200,
);
const stations = Array.from({ length: 199 }, (_, index) => index + 0.5);
const sections = new CrossSections(LINE, stations, { left: 100, right: 100, thickness: 1 });
const parted = { origin: few, volume: sections };

const documents = { facts: FACTS, scale: 1000 };
const createCompressor = () => ({ run: async () => new Uint8Array(4), close: () => undefined });
const store = {
  put: async (bytes: Uint8Array) => bytes.slice(),
  get: async (block: unknown) => block as Uint8Array,
};

const EXPORTS: Record<string, (sink: ByteSink, options: ExportOptions) => Promise<unknown>> = {
  LAS: (sink, options) => exportLas([selection], sink, options),
  LAZ: (sink, options) => exportLaz([selection], sink, { ...options, createCompressor }),
  CSV: (sink, options) => exportCsv([selection], sink, options),
  GeoJSON: (sink, options) => exportGeoJson([selection], sink, options),
  DXF: (sink, options) => exportDxf([selection], sink, options),
  "a filter that leaves nothing": (sink, options) =>
    exportCsv([{ ...selection, filter: { classes: [9] } }], sink, options),
  "a picture": (sink, options) =>
    exportPicture([selection], sink, { ...documents, ...options, format: "svg" }),
  LandXML: (sink, options) => exportLandXml([selection], sink, { ...documents, ...options }),
  "the parts of a scan": (_, options) => collectParts([{ origin: large, volume: sections }], store, options),
  "an archive of sections": (sink, options) =>
    exportSections([parted], sink, { ...documents, ...options, line: LINE, files: ["csv"] }),
  "a page for each section": (sink, options) =>
    exportSectionSheets([parted], sink, { ...documents, ...options, line: LINE }),
  "the ground of sections": (sink, options) =>
    exportSectionLandXml([parted], sink, { ...documents, ...options, line: LINE }),
};

describe("an export that is stopped while it writes", () => {
  // A machine on which a millisecond passes between two looks at the clock.
  beforeEach(() => {
    let now = 0;
    vi.spyOn(performance, "now").mockImplementation(() => ++now);
  });
  afterEach(() => vi.restoreAllMocks());

  it.each(Object.entries(EXPORTS))("gives the thread back and ends: %s", async (_, write) => {
    const controller = new AbortController();
    const reason = new Error("no longer");
    const writing = write(new MemorySink(), { signal: controller.signal });
    // Nothing here waits for anything but the thread.
    setImmediate(() => controller.abort(reason));
    await expect(writing).rejects.toBe(reason);
  });
});
