import { everyStep, type Truth } from "@groma/georef";

/** Grids that the heights of a data set go through on their way to the ellipsoid; none where they are taken as they are. */
export function geoidsOf(truth: Truth): string[] {
  if (typeof truth === "function") return [];
  const grids = everyStep(truth.transformation).flatMap((step) =>
    step.kind === "verticalShift" ? [step.window.grid] : [],
  );
  return [...new Set(grids)];
}

/** Bound of the projection's fit, metres; nothing where no fit stands for it. */
export function fitBoundOf(truth: Truth): number | undefined {
  const first = typeof truth === "function" ? undefined : truth.transformation.steps[0];
  return first?.kind === "projection" ? first.patchwork.bound : undefined;
}
