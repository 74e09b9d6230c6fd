import { existsSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { LazModule } from "@groma/layer/query";
import { create } from "laz-perf/lib/node/index.js";
import { converted } from "./converted.mjs";

/** Rounds in which both decoders take turns; the least time of each counts. */
const ROUNDS = 5;

/** Chunks that are decoded, the first of the hierarchy's page: a million points or so. */
const CHUNKS = 200;

/** The layer's LAZ decoder beside laz-perf, over the same chunks of a real scan and by processor time: bar 1. */
export async function bench(root) {
  const scan = join(root, "../shared/data/autzen.laz");
  if (!existsSync(scan)) return [{ note: "autzen.laz is not in ../shared/data: skipped" }];
  const { chunks, format } = firstChunks(readFileSync(converted(root, scan)));
  const laz = await LazModule.load(
    readFileSync(createRequire(import.meta.url).resolve("@groma/layer/laz.wasm")),
  );
  const lazPerf = await create();
  const decoders = {
    "groma, Rust as WebAssembly": ({ bytes, count }) => laz.decode(bytes, format, count),
    "laz-perf": (chunk) => decodeByLazPerf(lazPerf, format, chunk),
  };
  const least = Object.fromEntries(Object.keys(decoders).map((name) => [name, Number.POSITIVE_INFINITY]));
  for (let round = 0; round < ROUNDS; round++) {
    for (const [name, decode] of Object.entries(decoders)) {
      const before = process.cpuUsage();
      for (const chunk of chunks) decode(chunk);
      least[name] = Math.min(least[name], process.cpuUsage(before).user / 1e6);
    }
  }
  const points = chunks.reduce((sum, { count }) => sum + count, 0);
  return Object.entries(least).map(([decoder, seconds]) => ({
    decoder,
    points,
    "million points a second": Math.round(points / seconds / 1e4) / 100,
    ratio: Math.round((seconds / least["laz-perf"]) * 100) / 100,
  }));
}

/** Chunks of the root page of a COPC file's hierarchy (COPC 1.0, "Info VLR" and "Hierarchy VLR"). */
function firstChunks(file) {
  const page = Number(file.readBigUInt64LE(375 + 54 + 40));
  const end = page + Number(file.readBigUInt64LE(375 + 54 + 48));
  const chunks = [];
  for (let entry = page; entry < end && chunks.length < CHUNKS; entry += 32) {
    const [offset, size] = [Number(file.readBigUInt64LE(entry + 16)), file.readInt32LE(entry + 24)];
    const count = file.readInt32LE(entry + 28);
    if (count > 0) chunks.push({ bytes: file.subarray(offset, offset + size), count });
  }
  return { chunks, format: { pointFormat: file[104] & 0x3f, recordLength: file.readUInt16LE(105) } };
}

function decodeByLazPerf(lazPerf, { pointFormat, recordLength }, { bytes, count }) {
  const [input, output] = [lazPerf._malloc(bytes.length), lazPerf._malloc(count * recordLength)];
  lazPerf.HEAPU8.set(bytes, input);
  const decoder = new lazPerf.ChunkDecoder();
  decoder.open(pointFormat, recordLength, input);
  for (let index = 0; index < count; index++) decoder.getPoint(output + index * recordLength);
  decoder.delete();
  const decoded = lazPerf.HEAPU8.slice(output, output + count * recordLength);
  lazPerf._free(input);
  lazPerf._free(output);
  return decoded;
}
