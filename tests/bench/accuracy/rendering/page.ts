import { Bench } from "./bench.js";

declare global {
  interface Window {
    /** What the report's Node side works with. */
    readonly Bench: typeof Bench;
    bench: Bench;
    /** Milliseconds that all processes of the browser took of the processor so far. */
    readonly processorTime: () => Promise<number>;
  }
}

Object.assign(window, { Bench });
document.body.dataset.ready = "true";
