import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { closest, instead, listed, shown } from "./words.js";

const STYLE = ["color", "gradient", "pointSize", "spacingFactor", "splats", "eyeDomeLighting", "opacity"];

describe("the closest valid word", () => {
  it.each([
    ["colour", "color"],
    ["pointsize", "pointSize"],
    ["pointSzie", "pointSize"],
    ["eyeDomeLightning", "eyeDomeLighting"],
    ["splat", "splats"],
  ])("for %s is %s", (word, near) => expect(closest(word, STYLE)).toBe(near));

  it.each(["heat", "x", "", "eyes", "a".repeat(5000)])("is none for %s", (word) =>
    expect(closest(word, STYLE)).toBeUndefined(),
  );

  it("finds each word with one letter wrong, left out, doubled or swapped", () => {
    const edit = fc.record({
      word: fc.constantFrom(...STYLE),
      at: fc.nat(),
      how: fc.constantFrom("replace", "leave", "double", "swap"),
    });
    fc.assert(
      fc.property(edit, ({ word, at, how }) => {
        const i = at % (word.length - 1);
        const [before, here, next, after] = [word.slice(0, i), word[i], word[i + 1], word.slice(i + 2)];
        const edited = {
          replace: `${before}#${next}${after}`,
          leave: `${before}${next}${after}`,
          double: `${before}${here}${here}${next}${after}`,
          swap: `${before}${next}${here}${after}`,
        }[how];
        expect(closest(edited, STYLE)).toBe(word);
      }),
    );
  });

  it("is as near as letters are wrong: swapped neighbours count once, others twice", () => {
    // A third of the letters may be wrong: one of three to five, two of six to eight.
    const near = (word: string, valid: string) => closest(word, [valid]) !== undefined;
    expect([near("abc", "bac"), near("abc", "cba"), near("abc", "bca")]).toEqual([true, false, false]);
    expect([near("abcdef", "badcef"), near("abcdef", "badcfe")]).toEqual([true, false]);
    expect([near("abcdef", "defabc"), near("abcdef", "abdcfe")]).toEqual([false, true]);
    expect([near("abcd", "abdc"), near("abcd", "adcb"), near("ab", "ba"), near("ab", "bc")]).toEqual([
      ...[true, false, true, false],
    ]);
  });

  it("is the first of several that are as near, and none for words beyond forty letters", () => {
    expect(closest("cat", ["bat", "rat"])).toBe("bat");
    const long = "a".repeat(40);
    expect(closest(long, [`${long.slice(1)}b`])).toBe(`${long.slice(1)}b`);
    expect(closest(`${long}a`, [long])).toBeUndefined();
    expect([shown(long), shown(`${long}b`)]).toEqual([`"${long}"`, `"${long}…"`]);
    expect([shown([]), shown([1])]).toEqual(["an empty array", "an array of 1"]);
  });

  it("stands before all that are valid", () => {
    expect(instead("colour", ["color", "size"])).toBe('did you mean "color"? Otherwise use color or size');
    expect(instead("heat", ["color", "size", "shape"])).toBe("use color, size or shape");
    expect(instead(7, ["4", "8"])).toBe("use 4 or 8");
    expect([listed([]), listed(["a"])]).toEqual(["", "a"]);
  });
});

describe("a value in a message", () => {
  it.each<[unknown, string]>([
    ["rgb", '"rgb"'],
    ["a".repeat(50), `"${"a".repeat(40)}…"`],
    ["\u001b[31m\nred\u202e\u0085\u200b", '"\\u001b[31m\\nred\\u202e\\u0085\\u200b"'],
    [Number.NaN, "NaN"],
    [null, "null"],
    [undefined, "undefined"],
    [true, "true"],
    [[1, 2], "an array of 2"],
    [{ toString: () => "x" }, "an object"],
    [() => 1, "a function"],
    [Symbol("s"), "Symbol(s)"],
  ])("%o is shown as %s", (value, words) => expect(shown(value)).toBe(words));
});
