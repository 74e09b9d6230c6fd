import { describe, expect, it } from "vitest";
import type { Column } from "../workers/index.js";
import { constantValue, signatureOf } from "./vertex-attributes.js";

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

describe("constantValue", () => {
  it("is the number that a buffer would hold, not the value that it stands for", () => {
    const made = constantValue(attribute, column({ scale: 0.006, offset: 30, constant: [36] }));
    expect(made).toEqual([expect.closeTo(1000, 9)]);
  });

  it("is a share where bytes become shares", () => {
    const colour = { ...attribute, components: 4, normalized: true } as const;
    const made = constantValue(colour, column({ components: 4, constant: [255, 0, 51, 255] }));
    expect(made).toEqual([1, 0, 0.2, 1]);
  });

  it("is 0 where the data set has no such attribute, and where no point has a value", () => {
    expect(constantValue(attribute, undefined)).toEqual([0]);
    expect(constantValue(attribute, column({ constant: [Number.NaN] }))).toEqual([0]);
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
