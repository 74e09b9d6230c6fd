import { describe, expect, it } from "vitest";
import { printable } from "./printable.js";

describe("printable", () => {
  it.each([
    ["escapes of terminals", "\x1b[31mred\x1b]0;title\x07", "\\u{1b}[31mred\\u{1b}]0;title\\u{7}"],
    ["the one-byte escape of C1", "\u009b2J", "\\u{9b}2J"],
    ["line breaks", "a\r\nb\u2028c\u0085d", "a\\u{d}\\u{a}b\\u{2028}c\\u{85}d"],
    ["direction marks", "\u202egnp.exe\u2066x\u200f", "\\u{202e}gnp.exe\\u{2066}x\\u{200f}"],
    ["characters without width", "a\u200bb\ufeffc\u00add\u3164", "a\\u{200b}b\\u{feff}c\\u{ad}d\\u{3164}"],
    ["tags beyond the first plane", "\u{e0041}", "\\u{e0041}"],
    ["half a pair", "a\ud83d", "a\\u{d83d}"],
  ])("shows %s", (_what, text, shown) => expect(printable(text)).toBe(shown));

  it("leaves what can be read as it is, whatever the language", () => {
    const text = "Höhe über NHN (m²) … → ≤ 東京 שלום 🛰 C:\\scans\\a b.laz";
    expect(printable(text)).toBe(text);
  });

  it("leaves out the middle of a long text and splits no pair", () => {
    const shown = printable(`begin ${"🛰".repeat(30_000)} end`);
    expect(shown).toMatch(/^begin 🛰+ … \([0-9,]+ more characters\) … 🛰+ end$/u);
    expect(shown.length).toBeLessThan(1000);
  });
});
