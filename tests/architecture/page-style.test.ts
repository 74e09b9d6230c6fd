import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { projectRoot } from "../project.js";

/** Pictures, which have their sides whatever the direction of writing. */
const PICTURES = /^(body\.beside #(globe|map|split)|\.profile-picture canvas|\.width-handle)$/;

/** Declarations that say left or right where a language begins or ends its lines. */
function sidedIn(css: string): string[] {
  const plain = css.replace(/\/\*.*?\*\//gs, "");
  return [...plain.matchAll(/([^{};]+)\{([^{}]*)\}/g)].flatMap(([, selector, body]) =>
    PICTURES.test(selector!.trim())
      ? []
      : [...body!.matchAll(/([\w-]+)\s*:\s*([^;]+)/g)]
          .filter(([, property, value]) => isSided(property!, value!.trim()))
          .map(([declaration]) => `${selector!.trim()} { ${declaration.trim()} }`),
  );
}

function isSided(property: string, value: string): boolean {
  if (/(^|-)(left|right)(-|$)/.test(property)) return true;
  if (/^(text-align|float|clear)$/.test(property)) return /^(left|right)$/.test(value);
  if (!/^(margin|padding|inset|border-(width|style|color|radius))$/.test(property)) return false;
  // Of four values the second is the right side and the fourth the left one.
  const values = value.replace(/\([^()]*(\([^()]*\)[^()]*)*\)/g, "()").split(/\s+/);
  return values.length === 4 && values[1] !== values[3];
}

describe("the style of the page", () => {
  const page = join(projectRoot, "demo/src");
  const sheets = readdirSync(page, { recursive: true, encoding: "utf8" }).filter((name) =>
    name.endsWith(".css"),
  );

  it.each(sheets)("has beginnings and ends in place of left and right: %s", (sheet) => {
    expect(sidedIn(readFileSync(join(page, sheet), "utf8"))).toEqual([]);
  });

  it.each([
    ["margin-left: 4px", 1],
    ["left: 0", 1],
    ["border-right: 1px solid", 1],
    ["text-align: right", 1],
    ["padding: 1px 2px 3px 4px", 1],
    ["inset: 0 calc(100% - (2 * 4px)) 0 0", 1],
    ["padding: 1px 2px 3px", 0],
    ["margin-inline-start: 4px", 0],
    ["text-align: end", 0],
  ])("%s is found %i times", (declaration, count) => {
    expect(sidedIn(`@media print { .x { color: red; ${declaration}; } }`)).toHaveLength(count);
  });
});
