import { i18n } from "./i18n.js";

/** Remarks of the core and of the layer on what is not as it should be in a scan, and how each is said in the reader's language. */
export const SCAN_PATTERNS: readonly (readonly [RegExp, (...found: string[]) => string])[] = [
  [
    /^the header announces (\d+) points and, in the legacy field, (\d+); \1 is taken$/,
    (points, legacy) =>
      i18n.t("the header announces {points} points and, in the legacy field, {legacy}; {points} is taken", {
        points: i18n.number(Number(points)),
        legacy: i18n.number(Number(legacy)),
      }),
  ],
  [
    /^the header declares (\d+) points, the file has room for (\d+); the rest is skipped$/,
    (points, room) =>
      i18n.t("the header declares {points} points, the file has room for {room}; the rest is skipped", {
        points: i18n.number(Number(points)),
        room: i18n.number(Number(room)),
      }),
  ],
  [
    /^the file has several WKT records that differ \((.*); (.*)\); the first is used$/,
    (first, other) =>
      i18n.t("the file has several WKT records that differ ({first}; {other}); the first is used", {
        first,
        other,
      }),
  ],
  [
    /^(\d+) (?:extended )?variable length records are announced, (\d+) are there$/,
    (announced, found) =>
      i18n.t("{announced} variable length records are announced, {found} are there", { announced, found }),
  ],
  [
    /^the checksums of its nodes are those of another file, or of a newer program: they are not checked$/,
    () =>
      i18n.t(
        "the checksums of its nodes are those of another file, or of a newer program: they are not checked",
      ),
  ],
  [
    /^record (\d+) is left out: its user id is not text$/,
    (record) => i18n.t("record {record} is left out: its user id is not text", { record }),
  ],
  [
    /^the attribute (.*) is described as the extra bytes (\d+) to (\d+), and (\d+) are there; it and all described after it are left out$/,
    (name, first, last, room) =>
      i18n.t(
        "the attribute {name} is described as the extra bytes {first} to {last}, and {room} are there; it and all described after it are left out",
        { name, first, last, room },
      ),
  ],
  [
    /^the attribute (.*) has data type (\d+), which LAS 1\.4 does not define; it and all described after it are left out$/,
    (name, type) =>
      i18n.t(
        "the attribute {name} has data type {type}, which LAS 1.4 does not define; it and all described after it are left out",
        { name, type },
      ),
  ],
  [
    /^the declared bounds do not hold the points \((.*)\); the octree's cube is used$/,
    (bounds) =>
      i18n.t("the declared bounds do not hold the points ({bounds}); the octree's cube is used", {
        bounds: rangesIn(bounds),
      }),
  ],
  [
    /^the declared bounds reach beyond the octree \((.*)\); they are cut to its cube$/,
    (bounds) =>
      i18n.t("the declared bounds reach beyond the octree ({bounds}); they are cut to its cube", {
        bounds: rangesIn(bounds),
      }),
  ],
];

/** Ranges of coordinates, `x 1 to 2, y 3 to 4`, without the English word. */
function rangesIn(bounds: string): string {
  return bounds.replaceAll(" to ", " … ");
}
