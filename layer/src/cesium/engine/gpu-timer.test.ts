import { describe, expect, it } from "vitest";
import type { Context } from "./cesium-private.js";
import { GpuObjects } from "./gpu-objects.js";
import { GpuTimer } from "./gpu-timer.js";

/** A context whose queries are answered when a test says so. */
class TestGl {
  readonly QUERY_RESULT_AVAILABLE = 1;
  readonly QUERY_RESULT = 2;
  readonly extension = { TIME_ELAPSED_EXT: 3, GPU_DISJOINT_EXT: 4 };
  /** Nanoseconds of each answer to come. */
  nanoseconds = 2e6;
  answers = true;
  disjoint = false;
  begun = 0;
  queries = 0;

  getSupportedExtensions = () => [];
  getExtension = () => this.extension;
  createQuery = () => ({ number: ++this.queries });
  deleteQuery = () => this.queries--;
  beginQuery = () => this.begun++;
  endQuery = () => undefined;
  getParameter = () => this.disjoint;
  getQueryParameter = (_: unknown, what: number) =>
    what === this.QUERY_RESULT ? this.nanoseconds : this.answers;
}

function timed() {
  const gl = new TestGl();
  const context = { _gl: gl } as unknown as Context;
  const timer = new GpuTimer(context, new GpuObjects(context, {}));
  const frames = (count: number, stretches = 1) => {
    for (let frame = 0; frame < count; frame++) {
      timer.nextFrame();
      for (let stretch = 0; stretch < stretches; stretch++) timer.measure("points", () => undefined);
    }
  };
  return { gl, timer, frames };
}

describe("GpuTimer", () => {
  it("measures from the first frame on until there is a mean, then one frame of four", () => {
    const { gl, timer, frames } = timed();
    gl.answers = false;
    frames(3);
    expect([gl.begun, timer.milliseconds("points")]).toEqual([3, undefined]);
    gl.answers = true;
    frames(1);
    expect(timer.milliseconds("points")).toBe(2);
    gl.begun = 0;
    frames(40);
    expect(gl.begun).toBe(10);
  });

  it("adds up the stretches of a frame, all of them or none", () => {
    const { gl, timer, frames } = timed();
    frames(2, 3);
    expect(timer.milliseconds("points")).toBe(6);
    gl.begun = 0;
    frames(8, 3);
    expect(gl.begun).toBe(6);
    expect(timer.milliseconds("points")).toBe(6);
  });

  it("follows what changes, and keeps no query that was answered", () => {
    const { gl, timer, frames } = timed();
    frames(8);
    gl.nanoseconds = 4e6;
    frames(40);
    expect(timer.milliseconds("points")).toBeCloseTo(4, 1);
    expect(gl.queries).toBeLessThan(2);
  });

  it("takes no answer from when the GPU changed its clock", () => {
    const { gl, timer, frames } = timed();
    gl.disjoint = true;
    frames(8);
    expect(timer.milliseconds("points")).toBeUndefined();
  });
});
