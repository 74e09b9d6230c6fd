import { DecodeError, toWire } from "../errors/index.js";
import { fetchModule } from "../laz/index.js";
import { decodersWith } from "./decoders.js";
import { LazDecoder } from "./laz-decoder.js";
import {
  type LoadProjections,
  type PreparedDataSet,
  preparedOnce,
  runNodeJob,
  runRecordsJob,
} from "./node-job.js";
import type { ChunkJob, WorkerReply, WorkerRequest } from "./protocol.js";

/** The worker's side of the protocol. Bundled into one file, `node.worker.js`, by `scripts/copy-assets.mjs`. */
declare const self: DedicatedWorkerGlobalScope;

/** A request for work, which is answered. */
type JobRequest = Extract<WorkerRequest, { readonly job: ChunkJob }>;

const dataSets = new Map<number, () => Promise<PreparedDataSet>>();
let wasm: Promise<BufferSource> | undefined;

const laz = new LazDecoder(() => {
  wasm ??= fetchDecoder().catch((thrown: unknown) => {
    // What could not be fetched is asked for again with the next job.
    wasm = undefined;
    throw thrown;
  });
  return wasm;
});
const decoders = decodersWith(laz);

/** Fetches the LAZ decoder that lies beside this file. @throws DecodeError DECODE_WASM */
async function fetchDecoder(): Promise<BufferSource> {
  const file = new URL("./groma-laz.wasm", import.meta.url).href;
  return fetchModule(file).catch((thrown: Error) => {
    const fix = "Serve groma-laz.wasm beside node.worker.js";
    throw new DecodeError({ code: "DECODE_WASM", file, cause: thrown.message, fix });
  });
}

/** Fetches what places points by projections, which lies beside this file. @throws DecodeError DECODE_PROJECTIONS */
const projections: LoadProjections = async () => {
  const file = new URL("./node.projections.js", import.meta.url).href;
  try {
    return await import(/* @vite-ignore */ /* webpackIgnore: true */ file);
  } catch (thrown) {
    const cause = thrown instanceof Error ? thrown.message : String(thrown);
    const fix = "Serve node.projections.js beside node.worker.js";
    throw new DecodeError({ code: "DECODE_PROJECTIONS", file, cause, fix });
  }
};

/** Does what a request asks for and says which buffers go along with the answer. */
async function carryOut(request: JobRequest): Promise<[WorkerReply, ArrayBufferLike[]]> {
  const { id, job } = request;
  const prepared = dataSets.get(job.dataSet);
  if (!prepared) throw new Error(`data set ${job.dataSet} is not known to this worker`);
  const dataSet = await prepared();
  if (request.kind === "node") {
    const result = await runNodeJob(dataSet, request.job, decoders);
    return [{ kind: "vertices", id, result }, [result.buffer]];
  }
  const result = await runRecordsJob(dataSet, request.job, decoders);
  const { xyz, order, attributes } = result;
  const buffers = new Set([xyz, order, ...attributes.map(({ bytes }) => bytes)].map(({ buffer }) => buffer));
  return [{ kind: "records", id, result }, [...buffers]];
}

async function answer(request: JobRequest): Promise<void> {
  try {
    const [reply, buffers] = await carryOut(request);
    self.postMessage(reply, buffers as ArrayBuffer[]);
  } catch (thrown) {
    const fault = toWire(thrown, {
      code: "DECODE_FAILED",
      file: `node ${request.job.node}`,
      fix: "Open the file again",
    });
    const reply: WorkerReply = { kind: "failed", id: request.id, fault };
    self.postMessage(reply);
  }
}

self.onmessage = ({ data }: MessageEvent<WorkerRequest>) => {
  if (data.kind === "dataSet") dataSets.set(data.id, preparedOnce(data.spec, projections));
  else if (data.kind === "forget") dataSets.delete(data.id);
  else void answer(data);
};

// While the file is opened the decoder is fetched and compiled. Whether that fails is for the first job to say.
laz.prepare().catch(() => undefined);
