// Runs the layer's worker in a thread of Node: gives it what a worker of a page has, and tells of its memory.
import { readFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { parentPort, workerData } from "node:worker_threads";
import { memoryInUse } from "./memory.mjs";

const memories = [];
const { instantiate } = WebAssembly;
WebAssembly.instantiate = async (...args) => {
  const made = await instantiate.apply(WebAssembly, args);
  for (const value of Object.values((made.instance ?? made).exports)) {
    if (value instanceof WebAssembly.Memory) memories.push(new WeakRef(value));
  }
  return made;
};

globalThis.fetch = async (url) => new Response(await readFile(fileURLToPath(url)));
globalThis.self = globalThis;
globalThis.location = { href: workerData.entry };
globalThis.importScripts = () => {};
globalThis.postMessage = (message, transfer) => parentPort.postMessage(message, transfer);
await import(workerData.entry);

parentPort.on("message", async (data) => {
  if (data !== "memory") {
    globalThis.onmessage({ data });
    return;
  }
  const { heapUsed, arrayBuffers } = await memoryInUse();
  const wasm = memories.reduce((sum, memory) => sum + (memory.deref()?.buffer.byteLength ?? 0), 0);
  parentPort.postMessage({ memory: { heapUsed, arrayBuffers, wasm } });
});
