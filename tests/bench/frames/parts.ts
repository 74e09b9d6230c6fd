import { ClipSet, PointCloudLayer } from "@groma/layer/cesium";
import { OffscreenPass } from "../../../layer/dist/cesium/offscreen-pass.js";
import { NodeStream } from "../../../layer/dist/cloud/node-stream.js";
import { LayerContent } from "../../../layer/dist/drawing/layer-content.js";
import { Material } from "../../../layer/dist/drawing/material.js";
import { NodeUploads } from "../../../layer/dist/drawing/node-uploads.js";
import { wrap } from "./marks.js";

/** Marks what of the layer is told apart; the rest of `update` is facts, plan and ledger. */
export function markLayer(): void {
  wrap(PointCloudLayer.prototype, ["update"], "update");
  wrap(NodeStream.prototype, ["update"], "selection");
  wrap(LayerContent.prototype, ["prepare"], "content");
  wrap(NodeUploads.prototype, ["upload", "keep"], "uploads");
  wrap(ClipSet.prototype, ["over"], "clip volumes");
  wrap(Material.prototype, ["showOctree"], "octree");
  wrap(OffscreenPass.prototype, ["draw"], "own passes");
}

const DATA = ["bufferData", "bufferSubData", "texImage2D", "texSubImage2D", "texStorage2D"];
const PROGRAMS = ["compileShader", "linkProgram", "getProgramParameter", "getActiveUniform"];

/**
 * Marks calls of WebGL that may take long: in software they may wait for a raster that is none of ours. All others only
 * write down what the GPU is to do.
 */
export function markGl(gl: WebGL2RenderingContext): void {
  wrap(gl, DATA, "GL data");
  wrap(gl, PROGRAMS, "GL programs");
}

/** Rounds of microtasks that surely follow one message. */
const ROUNDS = 50;

/** Marks what each message of a worker sets off: its handler, and the promises that it fulfils. */
export function markMessages(): void {
  const handler = Object.getOwnPropertyDescriptor(Worker.prototype, "onmessage")!;
  Object.defineProperty(Worker.prototype, "onmessage", {
    ...handler,
    set(call: (this: Worker, event: MessageEvent) => void) {
      handler.set!.call(this, async function (this: Worker, event: MessageEvent) {
        performance.mark("> message");
        call.call(this, event);
        for (let round = 0; round < ROUNDS; round++) await undefined;
        performance.mark("<");
      });
    },
  });
}
