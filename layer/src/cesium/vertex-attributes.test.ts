import { ComponentDatatype } from "cesium";
import { describe, expect, it } from "vitest";
import type { Column } from "../workers/index.js";
import type { Buffer } from "./engine/cesium-private.js";
import { bufferAttribute, constantAttribute, signatureOf } from "./vertex-attributes.js";

const column = (parts: Partial<Column>): Column => ({
  name: "intensity",
  components: 1,
  data: new Uint16Array(0),
  scale: 1,
  offset: 0,
  bound: 0,
  ...parts,
});
const attribute = { name: "a_x", column: "x", components: 1, normalized: false, location: 2 } as const;

describe("bufferAttribute", () => {
  it.each([
    [new Uint8Array(1), ComponentDatatype.UNSIGNED_BYTE],
    [new Int8Array(1), ComponentDatatype.BYTE],
    [new Uint16Array(1), ComponentDatatype.UNSIGNED_SHORT],
    [new Int16Array(1), ComponentDatatype.SHORT],
    [new Uint32Array(1), ComponentDatatype.UNSIGNED_INT],
    [new Int32Array(1), ComponentDatatype.INT],
    [new Float32Array(1), ComponentDatatype.FLOAT],
  ])("reads numbers as they are stored (%o)", (data, componentDatatype) => {
    const made = bufferAttribute(attribute, {} as Buffer, data);
    expect(made).toMatchObject({ index: 2, componentDatatype, normalize: false, componentsPerAttribute: 1 });
  });
});

describe("constantAttribute", () => {
  it("is the number that a buffer would hold, not the value that it stands for", () => {
    const made = constantAttribute(attribute, column({ scale: 0.006, offset: 30, constant: [36] }));
    expect(made).toEqual({ index: 2, value: [expect.closeTo(1000, 9)] });
  });

  it("is a share where bytes become shares", () => {
    const colour = { ...attribute, components: 4, normalized: true } as const;
    const made = constantAttribute(colour, column({ components: 4, constant: [255, 0, 51, 255] }));
    expect(made).toEqual({ index: 2, value: [1, 0, 0.2, 1] });
  });

  it("is 0 where the data set has no such attribute, and where no point has a value", () => {
    expect(constantAttribute(attribute, undefined)).toEqual({ index: 2, value: [0] });
    expect(constantAttribute(attribute, column({ constant: [Number.NaN] }))).toEqual({
      index: 2,
      value: [0],
    });
  });
});

describe("signatureOf", () => {
  it("tells apart what vertex arrays cannot share", () => {
    const base = signatureOf([attribute]);
    expect(signatureOf([{ ...attribute, name: "a_y" }])).toBe(base);
    expect(signatureOf([{ ...attribute, location: 1 }])).not.toBe(base);
    expect(signatureOf([{ ...attribute, column: "y" }])).not.toBe(base);
    expect(signatureOf([{ ...attribute, normalized: true }])).not.toBe(base);
  });
});
