import { encodeRecord, type GeoreferenceRecord, resolveCrs } from "@groma/georef";
import { pageBytes, type TinyCopc, tinyCopc } from "../sources/copc/tiny-copc.fixture.js";
import { BlobSource } from "../sources/index.js";
import { recordFields } from "../sources/las/record-fields.js";
import type {
  ChunkJob,
  DataSetSpec,
  NodeExecutor,
  NodeJob,
  NodeRecords,
  NodeVertices,
} from "../workers/index.js";
import type { PointCloudOptions } from "./cloud-options.js";
import { PointCloud } from "./point-cloud.js";

export const UTM = "+proj=utm +zone=32 +ellps=WGS84 +towgs84=0,0,0,0,0,0,0 +units=m";
export const FEET = { name: "foot", kind: "linear", size: 0.3048 } as const;
export const crs = resolveCrs({ file: "a", given: UTM, givenVertical: "ellipsoidal" });

export const record: GeoreferenceRecord = {
  version: 1,
  crs: { ...crs, name: "recorded", verticalUnit: { ...FEET, declared: true } },
  engine: { name: "proj4js", version: "2.22.0" },
  accuracy: [
    { name: "quantisation", metres: 0.005 },
    { name: "fit", metres: 0.001 },
  ],
};

/** Keeps jobs instead of doing them. */
export class Recorder implements NodeExecutor {
  readonly specs: DataSetSpec[] = [];
  readonly jobs: NodeJob[] = [];
  readonly pending = 0;
  readonly asked: ChunkJob[] = [];
  rgbBits: 8 | 16 = 16;
  extent = Float64Array.of(0, 0, 0, 100, 100, 50);

  addDataSet(spec: DataSetSpec): number {
    return this.specs.push(spec);
  }

  removeDataSet(): void {
    this.specs.length = 0;
  }

  async run(job: NodeJob): Promise<NodeVertices> {
    this.jobs.push(job);
    const ranges = new Map([["intensity", [3, 700] as const]]);
    const { rgbBits } = this;
    const seen = job.appearance ?? { rgbBits, rgbBitsKnown: false, ranges };
    const { extent } = this;
    const columns = new Map([["rgb", { constant: [1, 2, 3, 255] }]]) as unknown as NodeVertices["columns"];
    return {
      count: job.pointCount,
      buffer: new ArrayBuffer(0),
      bytes: 0,
      seen,
      extent,
      columns,
      rgbBits,
    } as NodeVertices;
  }

  /** Records whose x is their number, drawn last first. */
  async records(job: ChunkJob): Promise<NodeRecords> {
    this.asked.push(job);
    const count = job.pointCount;
    const bytes = new Uint8Array(36 * count);
    const view = new DataView(bytes.buffer);
    const xyz = new Int32Array(3 * count);
    for (let record = 0; record < count; record++) {
      xyz[3 * record] = record;
      view.setUint16(36 * record + 12, 7 * record, true);
      view.setFloat64(36 * record + 22, 1e9 / 3 + record, true);
      view.setUint16(36 * record + 32, 65535, true);
    }
    const order = Uint16Array.from({ length: count }, (_, drawn) => count - 1 - drawn);
    const attributes = recordFields(7, []).map((field) => ({ ...field, bytes, stride: 36 }));
    return { count, xyz, attributes, order };
  }

  destroy(): void {}
}

export async function open(file: TinyCopc = {}, options: PointCloudOptions = {}) {
  const executor = new Recorder();
  const source = new BlobSource(
    new Blob([tinyCopc(file).slice()]),
    "https://a.org/b%20c/tiny%20scan.copc.laz?x=1#y",
  );
  const cloud = await PointCloud.fromUrl(source, { executor, ...options });
  return { cloud, executor };
}

export const withRecord: TinyCopc = { records: [["groma", 1, encodeRecord(record)]] };
export const twoNodes: TinyCopc = {
  page: [
    [0, 0, 0, 0, 0, 100, 6],
    [1, 1, 0, 1, 0, 100, 4],
  ],
};

/** A root and two nodes behind further pages, each with one below it. */
export function pagedFile(): Uint8Array {
  const make = (end: number) =>
    tinyCopc({
      page: [
        [0, 0, 0, 0, 0, 100, 4],
        [1, 1, 0, 1, end, 64, -1],
        [1, 0, 0, 0, end + 64, 64, -1],
      ],
    });
  const { length } = make(1);
  const head = make(length);
  const chunk = new DataView(head.buffer).getUint32(96, true);
  const pages = pageBytes([
    [1, 1, 0, 1, chunk, 100, 2],
    [2, 2, 0, 2, chunk, 100, 1],
    [1, 0, 0, 0, chunk, 100, 2],
    [2, 0, 0, 0, chunk, 100, 1],
  ]);
  const file = new Uint8Array(length + pages.length);
  file.set(head);
  file.set(pages, length);
  return file;
}
