import { describe, expect, it } from "vitest";
import { ASPRS_CLASSES, type ClassTable, classTexture, hidesClasses, showsClass } from "./classes.js";

/** ASPRS, "LAS Specification 1.4 – R15", table 17: point formats 6 to 10. */
const R15 = [
  ...["Created, never classified", "Unclassified", "Ground", "Low vegetation", "Medium vegetation"],
  ...["High vegetation", "Building", "Low point (noise)", "Reserved", "Water", "Rail", "Road surface"],
  ...["Reserved", "Wire – guard (shield)", "Wire – conductor (phase)", "Transmission tower"],
  ...["Wire-structure connector", "Bridge deck", "High noise", "Overhead structure", "Ignored ground"],
  ...["Snow", "Temporal exclusion"],
];

const hidden = (...numbers: number[]): ClassTable => ({
  ...ASPRS_CLASSES,
  ...Object.fromEntries(numbers.map((number) => [number, { ...ASPRS_CLASSES[number], show: false }])),
});

describe("the classes of ASPRS", () => {
  it("are named as in the specification, reserved up to 63, the user's from 64 on", () => {
    const names = Array.from({ length: 256 }, (_, number) => ASPRS_CLASSES[number].name);
    expect(names.slice(0, 23)).toEqual(R15);
    expect(new Set(names.slice(23, 64))).toEqual(new Set(["Reserved"]));
    expect(new Set(names.slice(64))).toEqual(new Set(["User definable"]));
    expect(Object.keys(ASPRS_CLASSES)).toHaveLength(256);
  });

  it("are all shown, each named one in a colour of its own", () => {
    const all = Object.values(ASPRS_CLASSES);
    expect(all.every(({ show }) => show)).toBe(true);
    const colours = all.slice(0, 23).map(({ color }) => color.join());
    expect(new Set(colours).size).toBe(23);
    for (const { color } of all) {
      expect(color).toHaveLength(3);
      for (const part of color) expect(part >= 0 && part <= 1 && Number.isInteger(255 * part)).toBe(true);
    }
    // Ground is brown, high vegetation green, water blue, snow nearly white, and what has no name grey.
    const [ground, trees, water, snow, other] = [2, 5, 9, 21, 200].map(
      (number) => ASPRS_CLASSES[number].color,
    );
    expect(ground[0] > ground[1] && ground[1] > ground[2]).toBe(true);
    expect(trees[1] > 2 * trees[0] && trees[1] > 2 * trees[2]).toBe(true);
    expect(water[2] > water[1] && water[1] > water[0]).toBe(true);
    expect(Math.min(...snow)).toBeGreaterThan(0.85);
    expect(new Set(other).size).toBe(1);
  });
});

describe("which classes are shown", () => {
  it("is what the table shows and the filter lets pass", () => {
    const classes = hidden(7, 18);
    expect([2, 7, 18, 300].map((number) => showsClass({ classes }, undefined, number))).toEqual([
      ...[true, false, false, true],
    ]);
    expect([2, 6, 7].map((number) => showsClass({ classes }, { classes: [2, 7] }, number))).toEqual([
      ...[true, false, false],
    ]);
    expect(showsClass({ classes }, { classes: [] }, 2)).toBe(false);
    expect(showsClass({ classes }, {}, 2)).toBe(true);
  });

  it("hides some where the table or the filter says so", () => {
    const [all, some] = [{ classes: ASPRS_CLASSES }, { classes: hidden(255) }];
    expect([hidesClasses(all, undefined), hidesClasses(all, {}), hidesClasses(some, undefined)]).toEqual([
      ...[false, false, true],
    ]);
    expect([hidesClasses(all, { classes: [2] }), hidesClasses(all, { classes: [] })]).toEqual([true, true]);
  });

  it("stands in the alpha of a texture, with their colours", () => {
    const classes = { ...hidden(7), 9: { name: "Sea", color: [0.2, 0.501, 1], show: true } as const };
    const { name, width, height, data } = classTexture({ classes }, { classes: [2, 7, 9] });
    expect([name, width, height, data.length]).toEqual(["u_classes", 256, 1, 1024]);
    const texel = (number: number) => [...data.subarray(4 * number, 4 * number + 4)];
    expect(texel(2)).toEqual([...ASPRS_CLASSES[2].color.map((part) => 255 * part), 255]);
    expect(texel(9)).toEqual([51, 128, 255, 255]);
    expect([texel(7)[3], texel(6)[3], texel(255)[3]]).toEqual([0, 0, 0]);
  });
});
