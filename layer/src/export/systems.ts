import { sameHeights, samePlane, sameSize } from "@groma/georef";
import { FormatError } from "../errors/index.js";
import { knownOf } from "./known.js";
import type { PointSelection } from "./selection.js";

/** Some of what a selection is: what tells of its coordinate system. */
type Placed = Pick<PointSelection, "origin" | "crs">;

/** The coordinate system of a selection; undefined where it is not known. */
export function crsOf({ origin, crs }: Placed): PointSelection["crs"] {
  return crs ?? knownOf(origin).crs;
}

/** Whether x, y and z mean the same in all selections, as far as is known. */
export function areInOneSystem(selections: readonly Placed[]): boolean {
  const systems = selections.flatMap((one) => crsOf(one) ?? []);
  return systems.every((one) => samePlane(one, systems[0]) && sameHeights(one, systems[0]));
}

/** @throws FormatError EXPORT_MIXED where x and y of selections lie in several planes */
export function requireOnePlane(selections: readonly Placed[]): void {
  refuse(selections, "x and y are of another system than", (a, b) => samePlane(a, b));
}

/** @throws FormatError EXPORT_MIXED where z of selections is in several units */
export function requireOneHeightUnit(selections: readonly Placed[]): void {
  refuse(selections, "heights are in another unit than", (a, b) =>
    sameSize(Math.abs(a.verticalUnit.size), Math.abs(b.verticalUnit.size)),
  );
}

type System = NonNullable<PointSelection["crs"]>;

function refuse(selections: readonly Placed[], differs: string, alike: (a: System, b: System) => boolean) {
  const [first, ...others] = selections.flatMap((one) => {
    const crs = crsOf(one);
    return crs ? [{ crs, file: one.origin.name }] : [];
  });
  const other = others.find(({ crs }) => !alike(first.crs, crs));
  if (!other) return;
  throw new FormatError({
    ...{ code: "EXPORT_MIXED", file: other.file },
    cause: `its ${differs} those of ${first.file}: ${other.crs.name}, ${first.crs.name}`,
    fix: "Write a file for each of them, or CSV, which names the system of each point",
  });
}
