import { describe, expect, it } from "vitest";
import type { Column } from "../workers/index.js";
import { signatureOf, storedConstant } from "./vertex-attributes.js";

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

describe("storedConstant", () => {
  it("is the number that a buffer holds, not the value that it stands for", () => {
    const made = storedConstant(1, column({ scale: 0.006, offset: 30, constant: [36] }));
    expect(made).toEqual([expect.closeTo(1000, 9)]);
  });

  it("is 0 where the data set has no such attribute, and where no point has a value", () => {
    expect(storedConstant(2, undefined)).toEqual([0, 0]);
    expect(storedConstant(1, column({ constant: [Number.NaN] }))).toEqual([0]);
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
