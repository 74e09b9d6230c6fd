import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { knows } from "../../demo/src/language/library-words.js";
import { sentenceOf } from "../../demo/src/panel/fault-words.js";
import { projectRoot } from "../project.js";

/** What a pattern finds in the sources of rooms, each once. */
function found(rooms: readonly string[], pattern: RegExp): string[] {
  const all = rooms.flatMap((room) =>
    readdirSync(join(projectRoot, room), { recursive: true, encoding: "utf8" })
      .filter((name) => /(?<!\.test|\.fixture)\.ts$/.test(name))
      .flatMap((name) => [...readFileSync(join(projectRoot, room, name), "utf8").matchAll(pattern)])
      .map(([, text]) => text!),
  );
  return [...new Set(all)];
}

/** What the libraries say, as the page shows it in the reader's language. */
describe("words of the libraries that the page shows", () => {
  it("are known for every value of a measurement, and every part of its uncertainty", () => {
    const room = ["layer/src/tools/measure"];
    const titles = [
      ...found(room, /(?:\bvalue|maybe|azimuthOf)\("\w+", "([^"]+)"/g),
      ...found(room, /\btitle: "([^"]+)"/g),
      ...found(room, /\bname: "([a-z][a-z ]*)",\s*(?:standard|known|horizontal|reach)/g),
    ];
    expect(titles.length).toBeGreaterThan(55);
    expect(titles.filter((title) => !knows(title))).toEqual([]);
  });

  it("tell what every error is about, by its code", () => {
    const codes = found(["georef/src", "layer/src", "demo/src"], /\bcode: "([A-Z0-9]+_[A-Z0-9_]+)"/g);
    expect(codes.length).toBeGreaterThan(80);
    expect(codes.filter((code) => sentenceOf(code) === undefined)).toEqual([]);
    expect(sentenceOf("COFFEE_EMPTY")).toBeUndefined();
  });
});
