import { ASPRS_CLASSES } from "@groma/layer/cesium";
import { NAVIGATION_KEYS } from "@groma/layer/navigation";
import { MEASUREMENT_KINDS } from "@groma/layer/tools";
import { describe, expect, it } from "vitest";
import { knows, libraryWords } from "./library-words.js";

const TITLES = Object.values(MEASUREMENT_KINDS).map(({ title }) => title);
const KEYS = NAVIGATION_KEYS.flatMap(({ keys, deed }) => [...keys.filter((key) => key.length > 1), deed]);
const CLASSES = Object.values(ASPRS_CLASSES).map(({ name }) => name);

describe("words of the libraries", () => {
  it.each([
    ["kinds of measurements", TITLES, 10],
    ["keys", KEYS, 15],
    ["classes", CLASSES, 20],
  ])("has a translation for %s", (_, words, least) => {
    expect(words.length).toBeGreaterThanOrEqual(least);
    expect(words.filter((word) => !knows(word))).toEqual([]);
  });

  it("leaves a name alone that is not theirs, whatever braces it has", () => {
    expect(libraryWords("{count, plural, one {x}}")).toBe("{count, plural, one {x}}");
  });
});
