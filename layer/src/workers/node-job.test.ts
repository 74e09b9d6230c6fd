import { ecefToGeodetic, placePoint, pointIn, resolveCrs, WEB_MERCATOR_PLANE } from "@groma/georef";
import { beforeAll, describe, expect, it } from "vitest";
import { recordFields } from "../sources/las/record-fields.js";
import type { Decoders } from "./decoders.js";
import { type PreparedDataSet, prepareDataSet, preparedOnce, runNodeJob, runRecordsJob } from "./node-job.js";
import type { Column, DataSetSpec, NodeJob, NodeVertices } from "./protocol.js";
import { extraBytes } from "./record.fixture.js";
import { transformationBytes } from "./transformation.fixture.js";

const FILE = "a.copc.laz";
const RECORD = 36;
const crs = resolveCrs({
  file: FILE,
  given: "+proj=utm +zone=32 +ellps=WGS84 +towgs84=0,0,0,0,0,0,0 +units=m",
  givenVertical: "ellipsoidal",
});
const DOMAIN = { minX: 500_000, minY: 5_500_000, maxX: 501_000, maxY: 5_501_000 };

const plain: DataSetSpec = {
  ...{ file: FILE, crs, tolerance: 0.001 },
  ...{ scale: [0.001, 0.001, 0.001], offset: [500_000, 5_500_000, 0], heights: [0, 50] },
  encoding: {
    kind: "laz",
    pointFormat: 7,
    recordLength: RECORD,
    extraLength: 0,
    fields: recordFields(7, []),
  },
  ...{ bytesPerPoint: RECORD, ellipsoidalOrigin: -3 },
};

/** Three points at corners of the domain and one inside, LAS integers. */
const XYZ = [0, 0, 0, 1_000_000, 1_000_000, 50_000, 0, 1_000_000, 25_000, 123_456, 654_321, 10_000];

/** Hands out points whose attributes are all 0 in place of a chunk. */
const decoders: Decoders = {
  laz: {
    decode: async (_, { fields, recordLength: stride }) => {
      const bytes = new Uint8Array((XYZ.length / 3) * stride);
      const attributes = fields.map((field) => ({ ...field, bytes, stride }));
      return { xyz: Int32Array.from(XYZ), attributes };
    },
  },
};

const job: NodeJob = {
  ...{ dataSet: 1, chunk: new ArrayBuffer(0), pointCount: 4, node: "0-0-0-0" },
  appearance: { rgbBits: 8, rgbBitsKnown: true, ranges: new Map() },
  cube: [500_000, 5_500_000, 0, 1000],
};

/** A drawn point's source coordinates. */
const sourceOf = ({ scale, offset }: DataSetSpec, { order }: NodeVertices, point: number) =>
  [0, 1, 2].map((axis) => XYZ[3 * order[point] + axis] * scale[axis] + offset[axis]);

const prepared = (spec: DataSetSpec) => prepareDataSet(spec, () => import("./projections.js"));

/** Exact place of a drawn point, ECEF. */
function placeOf(dataSet: PreparedDataSet, vertices: NodeVertices, point: number): Float64Array {
  const [x, y, z] = sourceOf(dataSet.spec, vertices, point);
  const exact = new Float64Array(3);
  placePoint(dataSet.truth, x, y, z, exact);
  return exact;
}

/** Greatest distance of a stored vertex from where the data set's own map has it, and the node's bound. */
async function worst(spec: DataSetSpec): Promise<{ distance: number; bound: number }> {
  const dataSet = await prepared(spec);
  const vertices = await runNodeJob(dataSet, job, decoders);
  const { positions, frame, bound, count } = vertices;
  let distance = 0;
  for (let point = 0; point < count; point++) {
    const exact = placeOf(dataSet, vertices, point);
    const away = [0, 1, 2].map((axis) => {
      let value = frame.origin[axis];
      for (let c = 0; c < 3; c++) value += frame.rotation[3 * c + axis] * positions[3 * point + c];
      return value - exact[axis];
    });
    distance = Math.max(distance, Math.hypot(...away));
  }
  return { distance, bound };
}

/** Value of a drawn point in a column of one component. */
const columnValue = ({ data, scale, offset, constant }: Column, point: number) =>
  constant ? constant[0] : data[point] * scale + offset;

describe("runNodeJob", () => {
  let transformation: Uint8Array;
  beforeAll(async () => {
    transformation = await transformationBytes(crs, DOMAIN, 40);
  });

  it.each<[string, () => DataSetSpec]>([
    ["proj4js", () => plain],
    ["the transformation in the file, to the edge of its domain", () => ({ ...plain, transformation })],
    [
      "a similarity",
      () => ({
        ...plain,
        similarity: { translation: [1e6, -5e6, 4e6], matrix: [0, 0, 1, 1, 0, 0, 0, 1, 0] },
      }),
    ],
  ])("places a node by %s within the tolerance", async (_, spec) => {
    const { distance, bound } = await worst(spec());
    expect(bound).toBeLessThanOrEqual(0.001);
    expect(distance).toBeLessThanOrEqual(bound);
  });

  it("moves positions to whole steps where the tolerance has room for that, and fits closer to make room", async () => {
    const at = async (tolerance: number) =>
      runNodeJob(await prepared({ ...plain, tolerance }), job, decoders);
    const [coarse, close, fine] = await Promise.all([0.1, 0.0005, 0.0001].map(at));
    // 500 m to each side are 2²⁰ steps of half a millimetre.
    expect([coarse.step, close.step, fine.step]).toEqual([2 ** -11, 2 ** -11, undefined]);
    const whole = (positions: Float32Array) => positions.every((value) => Number.isInteger(value * 2 ** 11));
    expect([coarse, close, fine].map(({ positions }) => whole(positions))).toEqual([true, true, false]);
    expect([coarse.scheme, close.scheme]).toEqual(["affine", "quadratic"]);
    for (const tolerance of [0.1, 0.0005, 0.0001]) {
      const { distance, bound } = await worst({ ...plain, tolerance });
      expect(bound).toBeLessThanOrEqual(tolerance);
      expect(distance).toBeLessThanOrEqual(bound);
    }
    // The box is that of the places as they are drawn.
    expect(whole(coarse.box)).toBe(true);
    const away = coarse.positions.map((value, index) => Math.abs(value - fine.positions[index]));
    expect(Math.max(...away)).toBeGreaterThan(1e-4);
  });

  it("draws points on both sides of 180° in a frame amid them", async () => {
    const given = { given: "+proj=longlat +datum=WGS84", givenVertical: "ellipsoidal" };
    const degrees = resolveCrs({ file: FILE, ...given });
    const [west, east] = [-1_799_990_000, 1_799_990_000];
    const xyz = [west, -170_000_000, 0, east, -169_990_000, 10, west, -169_995_000, 5, east, -170_000_000, 0];
    const sides: Decoders = {
      laz: {
        decode: async (...of) => ({ ...(await decoders.laz.decode(...of)), xyz: Int32Array.from(xyz) }),
      },
    };
    const spec: DataSetSpec = {
      ...plain,
      crs: degrees,
      scale: [1e-7, 1e-7, 0.001],
      offset: [0, 0, 0],
      heights: [0, 1],
    };
    const dataSet = await prepared(spec);
    const { frame, bound } = await runNodeJob(dataSet, { ...job, cube: [-180, -180, -180, 360] }, sides);
    const place = new Float64Array(3);
    placePoint(dataSet.truth, 179.999, -17, 0, place);
    expect(bound).toBeLessThanOrEqual(1e-3);
    expect(Math.hypot(...place.map((value, axis) => value - frame.origin[axis]))).toBeLessThan(1000);
  });

  it("puts heights above the geoid where the geoid is", async () => {
    const frames = [];
    for (const spec of [plain, { ...plain, transformation }]) {
      frames.push((await runNodeJob(await prepared(spec), job, decoders)).frame);
    }
    const [flat, lifted] = frames.map(({ origin }) => [...origin]);
    expect(Math.hypot(...lifted.map((value, axis) => value - flat[axis]))).toBeCloseTo(40, 3);
  });

  it("says how high each point is, by its source and above the ellipsoid", async () => {
    for (const spec of [plain, { ...plain, transformation }]) {
      const dataSet = await prepared(spec);
      const vertices = await runNodeJob(dataSet, job, decoders);
      const elevation = vertices.columns.get("elevation")!;
      const ellipsoidalHeight = vertices.columns.get("ellipsoidalHeight")!;
      expect([elevation.offset, ellipsoidalHeight.offset]).toEqual([0, -3]);
      const geodetic = new Float64Array(3);
      for (let point = 0; point < vertices.count; point++) {
        const [, , z] = sourceOf(spec, vertices, point);
        expect(Math.abs(columnValue(elevation, point) - z)).toBeLessThanOrEqual(elevation.bound);
        const [x, y, up] = placeOf(dataSet, vertices, point);
        ecefToGeodetic(x, y, up, geodetic);
        const off = Math.abs(columnValue(ellipsoidalHeight, point) - geodetic[2]);
        expect(off).toBeLessThanOrEqual(ellipsoidalHeight.bound);
      }
      expect(elevation.bound).toBeLessThan(1e-5);
      expect(ellipsoidalHeight.bound).toBeLessThan(0.0011);
    }
  });

  it("maps the node frame back into the node's cube within its error", async () => {
    for (const spec of [plain, { ...plain, transformation }]) {
      const vertices = await runNodeJob(await prepared(spec), job, decoders);
      const { toCube, toCubeError, positions } = vertices;
      let off = 0;
      for (let point = 0; point < vertices.count; point++) {
        const place = sourceOf(spec, vertices, point);
        for (let axis = 0; axis < 3; axis++) {
          const row = toCube.subarray(4 * axis, 4 * axis + 4);
          const local = positions.subarray(3 * point, 3 * point + 3);
          const cube = row[0] * local[0] + row[1] * local[1] + row[2] * local[2] + row[3];
          off = Math.max(off, Math.abs(cube - (place[axis] - job.cube[axis]) / job.cube[3]));
        }
      }
      expect(off).toBeLessThanOrEqual(toCubeError);
      // A kilometre's curvature in the height of the cube, and the 24 bits of the matrix.
      expect(toCubeError).toBeLessThan(2e-4);
    }
  });

  it("puts all arrays into the one buffer that is transferred, and measures what it was not told", async () => {
    const dataSet = await prepared(plain);
    const { buffer, bytes, positions, order, columns, seen } = await runNodeJob(dataSet, job, decoders);
    expect([positions.buffer, order.buffer, columns.get("elevation")?.data.buffer]).toEqual([
      buffer,
      buffer,
      buffer,
    ]);
    expect(bytes).toBe(buffer.byteLength);
    // 4 points: 12 + 2 + 4 + 4 bytes each; all else is the same for all of them.
    expect(bytes).toBe(88);
    expect(seen).toBeUndefined();
    expect(columns.get("rgb")?.constant).toEqual([0, 0, 0, 255]);
    const judged = await runNodeJob(dataSet, { ...job, appearance: undefined }, decoders);
    expect([judged.seen?.rgbBits, judged.seen?.ranges.get("intensity")]).toEqual([8, [0, 0]]);
    expect(judged.seen?.ranges.get("elevation")?.map((height) => Math.round(height * 1e3))).toEqual([
      0, 50_000,
    ]);
  });

  it("has a column for each attribute, also under names that objects inherit, and a range of it", async () => {
    const extra = extraBytes({ name: "__proto__", type: "uint8" }, { name: "toString", type: "uint8" });
    const encoding = { ...plain.encoding, recordLength: RECORD + 2, fields: recordFields(7, extra) };
    const dataSet = await prepared({ ...plain, encoding });
    const { columns, seen } = await runNodeJob(dataSet, { ...job, appearance: undefined }, decoders);
    for (const name of ["__proto__", "toString"]) {
      expect(columns.get(name)?.constant, name).toEqual([0]);
      expect(seen?.ranges.get(name), name).toEqual([0, 0]);
    }
    expect(columns.has("constructor")).toBe(false);
  });

  it("takes colours for 16 bits where a node needs them, unless it is known that all are of 8", async () => {
    const bright: Decoders = {
      laz: {
        decode: async (...given) => {
          const points = await decoders.laz.decode(...given);
          const red = points.attributes.find(({ name }) => name === "red")!;
          new DataView(red.bytes.buffer).setUint16(red.at + red.stride, 300, true);
          return points;
        },
      },
    };
    const dataSet = await prepared(plain);
    const bitsBy = async (appearance: NodeJob["appearance"], by = bright) => {
      const { rgbBits, columns, order } = await runNodeJob(dataSet, { ...job, appearance }, by);
      return [rgbBits, columns.get("rgb")?.data[4 * order.indexOf(1)]];
    };
    const judged = { rgbBits: 8, rgbBitsKnown: false, ranges: new Map() } as const;
    expect(await bitsBy(undefined)).toEqual([16, 1]);
    expect(await bitsBy(judged)).toEqual([16, 1]);
    expect(await bitsBy({ ...judged, rgbBitsKnown: true })).toEqual([8, 300 - 256]);
    expect(await bitsBy({ ...judged, rgbBits: 16 }, decoders)).toEqual([16, undefined]);
    expect(await bitsBy(judged, decoders)).toEqual([8, undefined]);
  });

  it("hands out the records themselves in the same drawing order", async () => {
    const dataSet = await prepared(plain);
    const { order } = await runNodeJob(dataSet, job, decoders);
    const records = await runRecordsJob(dataSet, job, decoders);
    expect(records.order).toEqual(order);
    expect([...records.xyz.subarray(9, 12)]).toEqual([123_456, 654_321, 10_000]);
  });

  it("DECODE_TOO_LARGE for a node of too many points, without decoding it", async () => {
    const bomb = { ...job, pointCount: 2 ** 24 };
    const never: Decoders = { laz: { decode: () => Promise.reject(new Error("decoded")) } };
    const dataSet = await prepared(plain);
    for (const work of [runNodeJob(dataSet, bomb, never), runRecordsJob(dataSet, bomb, never)]) {
      await expect(work).rejects.toThrow(expect.objectContaining({ code: "DECODE_TOO_LARGE" }));
    }
  });

  it("PLACE_DOMAIN for points beyond what the transformation covers", async () => {
    const smaller = await transformationBytes(crs, { ...DOMAIN, maxX: 500_900 }, 40);
    const dataSet = await prepared({ ...plain, transformation: smaller });
    await expect(runNodeJob(dataSet, job, decoders)).rejects.toThrow(
      expect.objectContaining({ code: "PLACE_DOMAIN" }),
    );
  });

  it("RECORD_TRUNCATED for a transformation that is cut", async () => {
    await expect(prepared({ ...plain, transformation: transformation.slice(0, 99) })).rejects.toThrow(
      expect.objectContaining({ code: "RECORD_TRUNCATED" }),
    );
  });

  it("asks for the projections only where the record does not say where the points are, and again after a failure", async () => {
    let asked = 0;
    const projections = async () => {
      if (++asked === 1) throw new Error("offline");
      return import("./projections.js");
    };
    const { transformation: _, ...foreign } = plain;
    const known = preparedOnce({ ...foreign, transformation }, projections);
    expect(await known()).toBe(await known());
    const inMercator = { ...WEB_MERCATOR_PLANE, middle: (9 * Math.PI) / 180, own: false };
    await preparedOnce({ ...plain, transformation, plane: inMercator }, projections)();
    expect(asked).toBe(0);
    const unknown = preparedOnce(foreign, projections);
    await expect(unknown()).rejects.toThrow("offline");
    expect(await unknown()).toBe(await unknown());
    expect(asked).toBe(2);
  });
});

describe("a node job for a map", () => {
  const plane = {
    ...{
      code: "EPSG:3857",
      definition: "+proj=merc +a=6378137 +b=6378137 +nadgrids=@null",
      metresPerUnit: 1,
    },
    ...{ wraps: true, middle: (9 * Math.PI) / 180, own: false },
  };

  it("places in its plane, to the bound, with heights above the ellipsoid", async () => {
    const dataSet = await prepared({ ...plain, plane });
    const vertices = await runNodeJob(dataSet, job, decoders);
    const { frame, positions, columns, bound } = vertices;
    expect(bound).toBeLessThanOrEqual(0.001);
    for (let point = 0; point < vertices.count; point++) {
      const want = placeOf(dataSet, vertices, point);
      const got = [0, 1, 2].map((axis) => frame.origin[axis] + positions[3 * point + axis]);
      expect(Math.hypot(...got.map((value, axis) => value - want[axis]))).toBeLessThanOrEqual(bound);
      const { data, offset, bound: off } = columns.get("ellipsoidalHeight")!;
      expect(Math.abs(data[point] + offset - want[2])).toBeLessThanOrEqual(off);
    }
    // Web Mercator is 1.5 times as wide here, and begins at the equator.
    expect(frame.origin[1]).toBeGreaterThan(6.3e6);
    expect([...frame.rotation]).toEqual([1, 0, 0, 0, 1, 0, 0, 0, 1]);
  });

  it("tells where it lies on the globe, for volumes, to the error that it states", async () => {
    const dataSet = await prepared({ ...plain, plane });
    const vertices = await runNodeJob(dataSet, job, decoders);
    const { frame, box, fromMap, error } = vertices.onGlobe!;
    const globe = await prepared(plain);
    let worst = 0;
    for (let point = 0; point < vertices.count; point++) {
      const [x, y, z] = placeOf(globe, vertices, point);
      const want = pointIn(frame, x, y, z);
      const at = vertices.positions.subarray(3 * point, 3 * point + 3);
      const got = [0, 4, 8].map((row) =>
        at.reduce((sum, value, k) => sum + fromMap[row + k] * value, fromMap[row + 3]),
      );
      worst = Math.max(worst, Math.hypot(...got.map((value, axis) => value - want[axis])));
      for (let axis = 0; axis < 3; axis++) {
        expect(want[axis]).toBeGreaterThanOrEqual(box[axis]);
        expect(want[axis]).toBeLessThanOrEqual(box[axis + 3]);
      }
    }
    expect(worst).toBeLessThanOrEqual(error + 0.001);
    // A kilometre bends away by some centimetres; a wrong turn or scale would cost metres.
    expect(error).toBeGreaterThan(0.005);
    expect(error).toBeLessThan(0.2);
    expect((await runNodeJob(globe, job, decoders)).onGlobe).toBeUndefined();
  });
});
