import { Bench } from "./bench.js";

declare global {
  interface Window {
    /** What the report's Node side works with. */
    readonly Bench: typeof Bench;
    bench: Bench;
  }
}

Object.assign(window, { Bench });
document.body.dataset.ready = "true";
