import { MeasureError } from "../../../errors/index.js";
import { instead, shown } from "../../../options/index.js";
import type { VolumeBase } from "./base.js";

/** Bases that need no other surface. */
export const BASES = ["lowest", "highest", "plane", "ring", "height"];

/** @throws MeasureError MEASURE_OPTION where it is none of the bases of `cutAndFill` */
export function checkBase(base: VolumeBase): void {
  if (base?.kind === "surface" && (base.points as unknown) instanceof Float64Array) return;
  if (!isPlainBase(base)) throw noBase(base, [...BASES, "surface"]);
}

/** Whether it is a base that needs no other data set, with a height where it takes one. */
export function isPlainBase(base: unknown): boolean {
  if (typeof base !== "object" || base === null || !("kind" in base)) return false;
  if (base.kind === "height") return "height" in base && Number.isFinite(base.height);
  return BASES.includes(base.kind as string);
}

/** The error for what is no base. */
export function noBase(base: unknown, valid: readonly string[]): MeasureError {
  const kind = typeof base === "object" && base !== null && "kind" in base ? base.kind : base;
  const isHeight = kind === "height";
  return new MeasureError({
    code: "MEASURE_OPTION",
    file: "volume",
    cause: isHeight ? "its base has no height" : `its base cannot be ${shown(kind)}`,
    fix: isHeight ? "give height in metres" : instead(kind, valid),
  });
}
