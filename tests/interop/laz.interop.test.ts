import { readFileSync, rmSync } from "node:fs";
import { join } from "node:path";
import { type ChunkFormat, LazModule } from "@groma/layer/query";
import { create } from "laz-perf/lib/node/index.js";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { projectRoot } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { makeFolder } from "./core.js";

const folder = makeFolder();
afterAll(() => rmSync(folder, { recursive: true, force: true }));

let laz: LazModule;
let lazPerf: Awaited<ReturnType<typeof create>>;
beforeAll(async () => {
  laz = await LazModule.load(readFileSync(join(projectRoot, "layer/dist/workers/groma-laz.wasm")));
  lazPerf = await create();
});

interface Case {
  readonly name: string;
  readonly las: string;
  readonly laz: string;
}

/** Header fields that say what the points are: LAS 1.4, table 3. */
function pointsOf(path: string) {
  const file = readFileSync(path);
  const recordLength = file.readUInt16LE(105);
  const count = file[25] === 4 ? Number(file.readBigUInt64LE(247)) : file.readUInt32LE(107);
  return { file, begin: file.readUInt32LE(96), pointFormat: file[104]! & 0x3f, recordLength, count };
}

/** The records of a file, as they stand in it. */
function records(path: string): Buffer {
  const { file, begin, recordLength, count } = pointsOf(path);
  return file.subarray(begin, begin + recordLength * count);
}

/** The only chunk of a file: from behind the place of the chunk table to there. */
function chunkOf(path: string): ChunkFormat & { readonly chunk: Buffer; readonly count: number } {
  const { file, begin, ...format } = pointsOf(path);
  return { ...format, chunk: file.subarray(begin + 8, Number(file.readBigUInt64LE(begin))) };
}

/** All records of a chunk by laz-perf. */
function byLazPerf({ chunk, count, pointFormat, recordLength }: ReturnType<typeof chunkOf>): Buffer {
  const [input, output] = [lazPerf._malloc(chunk.length), lazPerf._malloc(count * recordLength)];
  lazPerf.HEAPU8.set(chunk, input);
  const decoder = new lazPerf.ChunkDecoder();
  decoder.open(pointFormat, recordLength, input);
  for (let index = 0; index < count; index++) decoder.getPoint(output + index * recordLength);
  decoder.delete();
  const decoded = Buffer.from(lazPerf.HEAPU8.slice(output, output + count * recordLength));
  lazPerf._free(input);
  lazPerf._free(output);
  return decoded;
}

describe.skipIf(pythonMissing)(
  `the LAZ decoder${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`,
  () => {
    let cases: Case[];
    beforeAll(() => {
      cases = runPython<Case[]>("interop/chunks.py", [folder]);
    }, 120_000);

    it("gives back the records of every point format that LASzip compressed", () => {
      expect(cases).toHaveLength(22);
      for (const { name, las, laz: packed } of cases) {
        const { chunk, count, ...format } = chunkOf(packed);
        const decoded = laz.decode(chunk, format, count);
        expect([name, Buffer.compare(decoded, records(las))]).toEqual([name, 0]);
      }
    });

    it("agrees with laz-perf where that knows the format", () => {
      // The formats of waveforms are none of laz-perf's.
      const known = cases
        .map(({ laz: packed }) => chunkOf(packed))
        .filter(({ pointFormat }) => ![4, 5, 9, 10].includes(pointFormat));
      expect(known).toHaveLength(14);
      for (const chunk of known) {
        const decoded = laz.decode(chunk.chunk, chunk, chunk.count);
        expect([chunk.pointFormat, Buffer.compare(decoded, byLazPerf(chunk))]).toEqual([
          chunk.pointFormat,
          0,
        ]);
      }
    });

    it("says what is none of its chunks, and decodes on", () => {
      const { chunk, count, ...format } = chunkOf(
        cases.find(({ name }) => name.startsWith("format 7 with 0"))!.laz,
      );
      const whole = laz.decode(chunk, format, count);
      expect(() => laz.decode(chunk.subarray(0, chunk.length - 1000), format, count)).toThrow(RangeError);
      expect(() => laz.decode(chunk, { pointFormat: 11, recordLength: 36 }, 1)).toThrow(
        "there are no records of point format 11 with 36 bytes",
      );
      expect(() => laz.decode(chunk, { pointFormat: 7, recordLength: 35 }, 1)).toThrow(RangeError);
      expect(Buffer.compare(laz.decode(chunk, format, count), whole)).toBe(0);
    });
  },
);
