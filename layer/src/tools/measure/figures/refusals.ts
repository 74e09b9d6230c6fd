import { MeasureError } from "../../../errors/index.js";

/** @param figure with its article, as `a circle` */
export function tooFew(figure: string, needed: number, given: number): MeasureError {
  return new MeasureError({
    code: "MEASURE_VERTICES",
    file: figure,
    cause: `it needs ${needed} vertices and has ${given}`,
    fix: `add ${needed - given} more`,
  });
}

/** The error for a figure of more vertices than it has. */
export function tooMany(figure: string, most: number, given: number): MeasureError {
  return new MeasureError({
    code: "MEASURE_VERTICES",
    file: figure,
    cause: `it needs ${most} vertices and has ${given}`,
    fix: `leave ${given - most} out`,
  });
}

/** The error for vertices that stand on each other. */
export function coincident(figure: string, cause: string): MeasureError {
  return new MeasureError({
    code: "MEASURE_COINCIDENT",
    file: figure,
    cause,
    fix: "move one of the vertices that stand on each other",
  });
}

/** The error for vertices on a line. */
export function collinear(figure: string): MeasureError {
  return new MeasureError({
    code: "MEASURE_COLLINEAR",
    file: figure,
    cause: "its vertices lie on a line",
    fix: "move one of them off the line of the others",
  });
}

/** @param edges indices of the two edges that cross, each by its first vertex */
export function crossing([first, second]: readonly [number, number]): MeasureError {
  return new MeasureError({
    code: "MEASURE_CROSSING",
    file: "polygon",
    cause: `its edges after vertex ${first + 1} and after vertex ${second + 1} cross`,
    fix: "move one of these vertices, or take the vertices in another order",
  });
}
