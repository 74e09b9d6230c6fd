import { isInside, type Place } from "../crs/area-of-use.js";
import { requireKind } from "../errors/arguments.js";
import type { VerticalSystem } from "./systems.js";

/** Slips of the pen that still mean the word: two in a long one. */
const SLIPS = 2;
const MOST = 3;

/**
 * Height systems whose names or codes are close to a text that names none, the closest first; of equally close ones
 * those in use at the place come first, and of merely similar ones no others are named.
 *
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function similarSystems(
  systems: readonly VerticalSystem[],
  text: string,
  place: Place | undefined,
): VerticalSystem[] {
  requireKind(systems, "list", "similarSystems: systems");
  requireKind(text, "text", "similarSystems: text");
  const wanted = plain(text);
  if (wanted === "") return [];
  return systems
    .filter(({ depth }) => !depth)
    .map((system) => ({
      system,
      slips: slipsTo(system, wanted),
      elsewhere: place !== undefined && !isInside(system.area, place),
    }))
    .filter(({ slips, elsewhere }) => slips === 0 || (slips <= SLIPS && !elsewhere))
    .sort(
      (a, b) =>
        Number(a.elsewhere) - Number(b.elsewhere) || a.slips - b.slips || a.system.code - b.system.code,
    )
    .slice(0, MOST)
    .map(({ system }) => system);
}

/** How many letters are wrong; a half for the beginning of a word. */
function slipsTo({ code, name }: VerticalSystem, wanted: string): number {
  if (wanted === String(code) || wanted === plain(name)) return 0;
  const words = name.split(/[\s()/]+/).map(plain);
  if (words.includes(wanted)) return 0;
  if (wanted.length >= 3 && words.some((word) => word.startsWith(wanted))) return 0.5;
  if (wanted.length < 4) return Number.POSITIVE_INFINITY;
  return Math.min(...words.filter(({ length }) => length > 3).map((word) => editDistance(word, wanted)));
}

/** Levenshtein's distance: insertions, deletions and replacements, one each. Only the near ones are of interest. */
function editDistance(a: string, b: string): number {
  if (Math.abs(a.length - b.length) > SLIPS) return Number.POSITIVE_INFINITY;
  let row = Array.from({ length: b.length + 1 }, (_, i) => i);
  for (let i = 1; i <= a.length; i++) {
    const next = [i];
    for (let j = 1; j <= b.length; j++) {
      const replaced = row[j - 1] + (a[i - 1] === b[j - 1] ? 0 : 1);
      next.push(Math.min(replaced, row[j] + 1, next[j - 1] + 1));
    }
    row = next;
  }
  return row[b.length];
}

function plain(text: string): string {
  return text
    .toLowerCase()
    .replace(/^\s*epsg:/, "")
    .replace(/[^a-z0-9]/g, "");
}
