import { ComponentDatatype } from "cesium";
import { describe, expect, it } from "vitest";
import type { Buffer, Context } from "./cesium-private.js";
import { GpuObjects, vertexAttribute } from "./gpu-objects.js";

const input = { location: 2, components: 1, normalized: false, buffer: {} as Buffer };

describe("vertexAttribute", () => {
  it.each([
    ["uint8", ComponentDatatype.UNSIGNED_BYTE],
    ["int8", ComponentDatatype.BYTE],
    ["uint16", ComponentDatatype.UNSIGNED_SHORT],
    ["int16", ComponentDatatype.SHORT],
    ["uint32", ComponentDatatype.UNSIGNED_INT],
    ["int32", ComponentDatatype.INT],
    ["float32", ComponentDatatype.FLOAT],
  ] as const)("reads numbers as they are stored (%s)", (numbers, componentDatatype) => {
    const made = vertexAttribute({ ...input, numbers });
    expect(made).toMatchObject({ index: 2, componentDatatype, normalize: false, componentsPerAttribute: 1 });
  });

  it("is one value where there is no buffer", () => {
    expect(vertexAttribute({ location: 3, value: [1, 0.5] })).toEqual({ index: 3, value: [1, 0.5] });
  });
});

describe("GpuObjects", () => {
  it("counts once what Cesium gave twice, and frees it as often as it was given", () => {
    const objects = new GpuObjects({ _gl: { getSupportedExtensions: () => [] } } as unknown as Context, {});
    let destroyed = 0;
    const program = { destroy: () => destroyed++ };
    objects.own("programs", program);
    objects.own("programs", program);
    expect(objects.counts.programs).toBe(1);
    objects.free(program);
    expect([objects.counts.programs, destroyed]).toEqual([1, 1]);
    objects.free(program);
    objects.free(program);
    expect([objects.counts.programs, destroyed]).toEqual([0, 2]);
    objects.own("programs", program);
    objects.own("programs", program);
    objects.destroy();
    expect([objects.counts.programs, destroyed]).toEqual([0, 4]);
  });
});
