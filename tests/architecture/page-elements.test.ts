import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { parseHTML } from "linkedom";
import { describe, expect, it } from "vitest";
import { projectRoot } from "../project.js";

const demo = join(projectRoot, "demo");
const { document } = parseHTML(readFileSync(join(demo, "index.html"), "utf8"));

describe("the elements of the page", () => {
  it("have names of their own", () => {
    const names = Array.from(document.querySelectorAll("[id]"), ({ id }) => id);
    expect(names.length).toBeGreaterThan(50);
    expect(names.filter((name, index) => names.indexOf(name) !== index)).toEqual([]);
  });

  it("are there when the page looks for them", () => {
    const sources = readdirSync(join(demo, "src"), { recursive: true, encoding: "utf8" })
      .filter((name) => /(?<!\.test)\.ts$/.test(name))
      .map((name) => readFileSync(join(demo, "src", name), "utf8"));
    const asked = sources.flatMap((text) => [
      ...text.matchAll(/byId\(\s*"([^"]+)",\s*(?:HTML)?(\w*?)(?:Element)?\b/g),
    ]);
    expect(asked.length).toBeGreaterThan(50);
    const tags = new Map([
      ...[
        ["Anchor", "a"],
        ["Div", "div"],
        ["Button", "button"],
        ["Input", "input"],
        ["Select", "select"],
      ],
      ...[
        ["Output", "output"],
        ["Canvas", "canvas"],
        ["TextArea", "textarea"],
        ["Dialog", "dialog"],
      ],
    ] as [string, string][]);
    const wrong = asked.filter(([, name, kind]) => {
      const found = document.getElementById(name!);
      const tag = tags.get(kind!);
      return !found || (tag !== undefined && found.tagName.toLowerCase() !== tag);
    });
    expect(wrong.map(([, name, kind]) => `${kind} #${name}`)).toEqual([]);
  });
});
