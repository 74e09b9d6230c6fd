import { placePoint, resolveCrs } from "@groma/georef";
import { beforeAll, describe, expect, it } from "vitest";
import type { LazDecoder } from "./laz-decoder.js";
import { prepareDataSet, runNodeJob } from "./node-job.js";
import type { DataSetSpec, NodeJob } from "./protocol.js";
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
  ...{ file: FILE, crs, pointFormat: 7, recordLength: RECORD, tolerance: 0.001 },
  ...{ scale: [0.001, 0.001, 0.001], offset: [500_000, 5_500_000, 0], heights: [0, 50] },
};

/** Three points at corners of the domain and one inside, LAS integers. */
const XYZ = [0, 0, 0, 1_000_000, 1_000_000, 50_000, 0, 1_000_000, 25_000, 123_456, 654_321, 10_000];

/** Hands out plain records in place of a chunk. */
const decoder = {
  decode: async () => {
    const bytes = new Uint8Array((XYZ.length / 3) * RECORD);
    const view = new DataView(bytes.buffer);
    XYZ.forEach((value, i) => {
      view.setInt32(Math.floor(i / 3) * RECORD + 4 * (i % 3), value, true);
    });
    return bytes;
  },
} as unknown as LazDecoder;

const job: NodeJob = {
  ...{ dataSet: 1, chunk: new ArrayBuffer(0), pointCount: 4, node: "0-0-0-0", rgbBits: 8 },
  cube: [500_000, 5_500_000, 0, 1000],
};

/** Greatest distance of a stored vertex from where the data set's own map has it, and the node's bound. */
async function worst(spec: DataSetSpec): Promise<{ distance: number; bound: number }> {
  const dataSet = prepareDataSet(spec);
  const { vertices, frame, bound, count } = await runNodeJob(dataSet, job, decoder);
  const view = new DataView(vertices);
  const exact = new Float64Array(3);
  let distance = 0;
  for (let point = 0; point < count; point++) {
    const source = [0, 1, 2].map((axis) => XYZ[3 * point + axis] * spec.scale[axis] + spec.offset[axis]);
    placePoint(dataSet.truth, source[0], source[1], source[2], exact);
    const away = [0, 1, 2].map((axis) => {
      let value = frame.origin[axis];
      for (let c = 0; c < 3; c++)
        value += frame.rotation[3 * c + axis] * view.getFloat32(20 * point + 4 * c, true);
      return value - exact[axis];
    });
    distance = Math.max(distance, Math.hypot(...away));
  }
  return { distance, bound };
}

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

  it("puts heights above the geoid where the geoid is", async () => {
    const frames = [];
    for (const spec of [plain, { ...plain, transformation }]) {
      frames.push((await runNodeJob(prepareDataSet(spec), job, decoder)).frame);
    }
    const [flat, lifted] = frames.map(({ origin }) => [...origin]);
    expect(Math.hypot(...lifted.map((value, axis) => value - flat[axis]))).toBeCloseTo(40, 3);
  });

  it("PLACE_DOMAIN for points beyond what the transformation covers", async () => {
    const smaller = await transformationBytes(crs, { ...DOMAIN, maxX: 500_900 }, 40);
    const dataSet = prepareDataSet({ ...plain, transformation: smaller });
    await expect(runNodeJob(dataSet, job, decoder)).rejects.toThrow(
      expect.objectContaining({ code: "PLACE_DOMAIN" }),
    );
  });

  it("RECORD_TRUNCATED for a transformation that is cut", () => {
    expect(() => prepareDataSet({ ...plain, transformation: transformation.slice(0, 99) })).toThrow(
      expect.objectContaining({ code: "RECORD_TRUNCATED" }),
    );
  });
});
