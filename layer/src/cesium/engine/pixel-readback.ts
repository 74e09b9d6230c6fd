import { WebGLConstants } from "cesium";
import type { Size } from "../../drawing/pick-window.js";
import { type Framebuffer, Sync } from "./cesium-private.js";
import type { GpuObjects } from "./gpu-objects.js";

/** Milliseconds between two looks at whether an answer is there. */
const PATIENCE = 2;

/** What is read, and until when. */
export interface Readback {
  /** Of the lower left of the framebuffer. */
  readonly size: Size;
  /** Whether nobody waits any more. */
  readonly gone: () => boolean;
  readonly signal?: AbortSignal | undefined;
}

/**
 * RGBA bytes of a framebuffer as it is when this is called, once the GPU has them: it is not waited for, and what is
 * drawn afterwards does not show.
 * @returns undefined where it is gone before the answer comes, or its context is lost
 * @throws the signal's reason when aborted
 */
export async function readPixels(
  objects: GpuObjects,
  framebuffer: Framebuffer,
  { size, gone, signal }: Readback,
): Promise<Uint8Array | undefined> {
  const { context } = objects;
  const pixels = objects.own("buffers", context.readPixelsToPBO({ x: 0, y: 0, ...size, framebuffer }));
  const fence = objects.own("fences", Sync.create({ context }));
  try {
    do {
      await new Promise((resolve) => setTimeout(resolve, PATIENCE));
      signal?.throwIfAborted();
      if (gone() || context._gl.isContextLost()) return undefined;
    } while (fence.getStatus() !== WebGLConstants.SIGNALED);
    const bytes = new Uint8Array(4 * size.width * size.height);
    pixels.getBufferData(bytes);
    return bytes;
  } finally {
    objects.free(pixels);
    objects.free(fence);
  }
}
