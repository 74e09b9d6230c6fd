import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { lookup } from "../crs/epsg-table.fixture.js";
import {
  accuracyParts,
  type DataSetIdentity,
  decodeRecordFile,
  ENGINE,
  encodeRecordFile,
  type RecordFile,
  requireSame,
  resolveCrs,
} from "../index.js";

const crs = resolveCrs({ file: "sample", given: "EPSG:2056+5728" }, lookup);
const of: DataSetIdentity = {
  ...{ points: 12, scale: [0.001, 0.001, 0.01], offset: [0.5, 0, 0] },
  ...{ min: [2600000.001, 1200000, 400], max: [2600100, 1200100.25, 500] },
};
const accuracy = accuracyParts(crs, [0.001, 0.001, 0.001], 0.001);
const file: RecordFile = { of, record: { version: 1, crs, engine: ENGINE, accuracy } };
const code = (bytes: Uint8Array) => {
  try {
    decodeRecordFile(bytes, "site.georef");
  } catch (error) {
    return (error as { code?: string }).code;
  }
  return "read";
};
const changed = (members: object) =>
  new TextEncoder().encode(
    JSON.stringify({ ...JSON.parse(new TextDecoder().decode(encodeRecordFile(file))), ...members }),
  );

describe("a georeference beside its data set", () => {
  it("comes back as it was written, its transformation to the byte", () => {
    expect(decodeRecordFile(encodeRecordFile(file), "site")).toEqual(file);
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 300 }), (transformation) => {
        const bytes = encodeRecordFile({ ...file, transformation });
        expect(decodeRecordFile(bytes, "site").transformation).toEqual(transformation);
      }),
    );
    const long = Uint8Array.from({ length: 100_001 }, (_, i) => i);
    expect(
      decodeRecordFile(encodeRecordFile({ ...file, transformation: long }), "site").transformation,
    ).toEqual(long);
  });

  it.each<[string, object]>([
    ["RECORD_FIELD", { groma: "statistics" }],
    ["RECORD_VERSION", { version: 2 }],
    ["RECORD_FIELD", { of: { ...of, points: "many" } }],
    ["RECORD_FIELD", { of: { ...of, max: [1, 2] } }],
    ["RECORD_FIELD", { record: { version: 1 } }],
    ["RECORD_FIELD", { transformation: "no base64!" }],
    ["RECORD_FIELD", { transformation: [1, 2] }],
  ])("%s for %j", (expected, members) => {
    expect(code(changed(members))).toBe(expected);
  });

  it("RECORD_JSON for what is none", () => {
    expect(code(Uint8Array.of(1, 2, 3))).toBe("RECORD_JSON");
  });

  it.each<[string, Partial<DataSetIdentity>]>([
    ["number of points", { points: 13 }],
    ["scale", { scale: [0.001, 0.001, 0.001] }],
    ["offset", { offset: [0.5, 0, 1] }],
    ["bounds", { min: [2600000.002, 1200000, 400] }],
    ["bounds", { max: [2600100, 1200100.25, 501] }],
  ])("RECORD_OTHER where the %s differs", (what, members) => {
    requireSame(of, structuredClone(of), "scan");
    expect(() => requireSame(of, { ...of, ...members }, "scan")).toThrow(
      expect.objectContaining({
        code: "RECORD_OTHER",
        file: "scan",
        cause: expect.stringContaining(`the ${what}`),
      }),
    );
  });
});
