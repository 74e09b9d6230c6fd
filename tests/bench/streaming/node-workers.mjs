import { Worker } from "node:worker_threads";

/** Threads of Node that run the layer's worker, in the form in which its pool takes them. */
export class NodeWorkers {
  #entry;
  #workers = [];

  /** @param {string} entry address of `node.worker.js` */
  constructor(entry) {
    this.#entry = entry;
  }

  create() {
    const worker = new Worker(new URL("./worker-page.mjs", import.meta.url), {
      workerData: { entry: this.#entry },
    });
    const like = {
      postMessage: (message, transfer) => worker.postMessage(message, transfer),
      terminate: () => worker.terminate(),
      ...{ onmessage: null, onerror: null, onmessageerror: null },
    };
    worker.on("message", (data) => {
      if (data.kind) like.onmessage?.({ data });
    });
    worker.on("error", ({ message }) => like.onerror?.({ message, preventDefault() {} }));
    this.#workers.push(worker);
    return like;
  }

  /** Bytes of all threads together: their heaps, their buffers, and the decoder's WebAssembly memory. */
  async memory() {
    const all = await Promise.all(this.#workers.map(memoryOf));
    const sum = (name) => all.reduce((total, one) => total + one[name], 0);
    return { heapUsed: sum("heapUsed"), arrayBuffers: sum("arrayBuffers"), wasm: sum("wasm") };
  }
}

function memoryOf(worker) {
  return new Promise((resolve) => {
    const hear = (data) => {
      if (!data.memory) return;
      worker.off("message", hear);
      resolve(data.memory);
    };
    worker.on("message", hear);
    worker.postMessage("memory");
  });
}
