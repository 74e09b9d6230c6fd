import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { lookup } from "../crs/epsg-table.fixture.js";
import {
  accuracyParts,
  decodeRecord,
  ENGINE,
  encodeRecord,
  type GeoreferenceRecord,
  RecordError,
  resolveCrs,
  statedAccuracy,
} from "../index.js";

const crs = resolveCrs({ file: "sample", given: "EPSG:2056+5728" }, lookup);
const record: GeoreferenceRecord = {
  version: 1,
  crs,
  engine: ENGINE,
  accuracy: accuracyParts(crs, [0.001, 0.001, 0.001], 0.001),
};

/** The code of the error that bytes lead to. */
function refusal(bytes: Uint8Array): string {
  try {
    decodeRecord(bytes, "scan.copc.laz");
  } catch (error) {
    return error instanceof RecordError ? error.code : `not a RecordError: ${error}`;
  }
  return "read";
}

const bytesOf = (value: unknown) =>
  new TextEncoder().encode(typeof value === "string" ? value : JSON.stringify(value));

/** The record with one member, named by its path, replaced or taken out. */
function changed(path: string, value?: unknown): unknown {
  const copy = structuredClone(record) as unknown as Record<string, unknown>;
  const keys = path.split(".");
  let owner = copy;
  for (const key of keys.slice(0, -1)) owner = owner[key] as Record<string, unknown>;
  const last = keys[keys.length - 1];
  if (value === undefined) delete owner[last];
  else owner[last] = value;
  return copy;
}

describe("georeference record", () => {
  it("comes back as it was written", () => {
    expect(decodeRecord(encodeRecord(record), "scan")).toEqual(record);
  });

  it("bears the padding of a VLR and members of later writers", () => {
    const padded = new Uint8Array([...encodeRecord(record), 0, 0, 0]);
    expect(decodeRecord(padded, "scan")).toEqual(record);
    expect(decodeRecord(bytesOf({ ...record, later: [1] }), "scan")).toEqual(record);
  });

  it("names file, cause and fix", () => {
    expect(() => decodeRecord(bytesOf("{"), "scan.copc.laz")).toThrow(
      /^RECORD_JSON: scan\.copc\.laz: the georeference record of Groma cannot be read: .+\. .+\.$/,
    );
  });

  it.each<[string, unknown, string]>([
    ["nothing", new Uint8Array(0), "RECORD_JSON"],
    ["no UTF-8", new Uint8Array([0x7b, 0xff, 0xfe, 0x7d]), "RECORD_JSON"],
    ["too long", new Uint8Array(65536).fill(0x20), "RECORD_SIZE"],
    ["a list", bytesOf([]), "RECORD_FIELD"],
    ["null", bytesOf(null), "RECORD_FIELD"],
    ["version 2", bytesOf(changed("version", 2)), "RECORD_VERSION"],
    ["no version", bytesOf(changed("version")), "RECORD_VERSION"],
    ["another engine", bytesOf(changed("engine.name", "guess")), "RECORD_FIELD"],
    ["no CRS", bytesOf(changed("crs")), "RECORD_FIELD"],
    ["a number for a PROJ string", bytesOf(changed("crs.proj4", 4326)), "RECORD_FIELD"],
    ["no PROJ string", bytesOf(changed("crs.proj4", "EPSG:2056")), "RECORD_FIELD"],
    ["a unit of no size", bytesOf(changed("crs.horizontalUnit.size", 0)), "RECORD_FIELD"],
    ["a unit of null size", bytesOf(changed("crs.horizontalUnit.size", null)), "RECORD_FIELD"],
    ["heights in degrees", bytesOf(changed("crs.verticalUnit.kind", "angular")), "RECORD_FIELD"],
    [
      "heights above whose ellipsoid",
      bytesOf(changed("crs.height", { kind: "ellipsoidal", ellipsoid: "my" })),
      "RECORD_FIELD",
    ],
    ["heights over nothing known", bytesOf(changed("crs.height.kind", "moon")), "RECORD_FIELD"],
    ["a geoid without a name", bytesOf(changed("crs.height.model")), "RECORD_FIELD"],
    ["a fractional EPSG code", bytesOf(changed("crs.height.epsg", 5728.5)), "RECORD_FIELD"],
    ["a negative accuracy", bytesOf(changed("accuracy", [{ name: "fit", metres: -1 }])), "RECORD_FIELD"],
    ["accuracy as text", bytesOf(changed("accuracy", "good")), "RECORD_FIELD"],
  ])("refuses %s by name", (_, bytes, code) => {
    expect(refusal(bytes as Uint8Array)).toBe(code);
  });

  it("refuses any damaged bytes with an error of its own, or reads a record", () => {
    const whole = encodeRecord(record);
    const damage = fc.tuple(fc.nat(whole.length - 1), fc.nat(255), fc.nat(whole.length));
    fc.assert(
      fc.property(damage, ([at, value, length]) => {
        const bytes = whole.slice(0, length);
        if (at < length) bytes[at] = value;
        return /^(RECORD_[A-Z]+|read)$/.test(refusal(bytes));
      }),
      { numRuns: 2000 },
    );
    fc.assert(
      fc.property(fc.json(), (text) => refusal(bytesOf(text)).startsWith("RECORD_")),
      { numRuns: 500 },
    );
  });
});

describe("stated accuracy", () => {
  it("is the sum of its parts", () => {
    const parts = [
      { name: "a", metres: 0.25 },
      { name: "b", metres: 0.5 },
    ];
    expect(statedAccuracy(parts)).toEqual({ total: 0.75, parts });
    expect(statedAccuracy([]), "nothing is promised of what has no place").toEqual({
      total: null,
      parts: [],
    });
  });

  it("is not known where a part is not", () => {
    expect(statedAccuracy([...record.accuracy]).total).toBeNull();
    expect(record.accuracy.find((part) => part.name === "height")?.metres).toBeNull();
  });

  it("counts half a step per axis, feet and degrees as lengths", () => {
    const quantisation = (given: string, scale: number[]) =>
      accuracyParts(resolveCrs({ file: given, given }, lookup), scale, 0).find(
        (part) => part.name === "quantisation",
      )?.metres;
    expect(quantisation("EPSG:2056", [0.01, 0.01, 0.01])).toBeCloseTo((0.01 * Math.sqrt(3)) / 2, 12);
    expect(quantisation("EPSG:2994", [0.01, 0.01, 0.01])).toBeCloseTo((0.003048 * Math.sqrt(3)) / 2, 12);
    expect(quantisation("EPSG:4326", [1e-7, 1e-7, 0.01])).toBeCloseTo(
      Math.hypot(0.01113, 0.01113, 0.01) / 2,
      5,
    );
  });
});
