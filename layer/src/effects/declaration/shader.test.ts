import fc from "fast-check";
import { expect, it } from "vitest";
import { attributeName } from "./shader.js";

it("names attributes by what GLSL allows, each column in its own way", () => {
  expect(attributeName("gpsTime")).toBe("a_gpsTime");
  // As close as names come: what one is spelt like is what another means.
  const close = [
    "a b",
    "ax20xb",
    "eax20xb",
    "x20x b",
    "  b",
    "x",
    "0",
    "x0",
    " ",
    "x20x",
    "é",
    "__proto__",
    "a-b",
  ];
  const column = fc.oneof(fc.constantFrom(...close), fc.string({ unit: "grapheme", maxLength: 32 }));
  fc.assert(
    fc.property(fc.uniqueArray(column, { maxLength: 20 }), (columns) => {
      const names = columns.map(attributeName);
      expect(new Set(names).size).toBe(columns.length);
      for (const name of names) expect(name).toMatch(/^a_[A-Za-z0-9]*$/);
    }),
  );
  expect(new Set(close.map(attributeName)).size).toBe(close.length);
});
