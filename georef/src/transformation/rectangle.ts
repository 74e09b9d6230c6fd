import type { Patchwork, Rectangle, Transformation } from "./step.js";

export type { Rectangle };

/** The patchwork of a transformation, which is its first step. */
export function patchworkOf({ steps }: Transformation): Patchwork {
  const first = steps[0];
  if (first?.kind !== "projection")
    throw new TypeError("the first step of a transformation is its projection");
  return first.patchwork;
}

/** Where a transformation holds, in plan: what its patches cover. */
export function domainOf(transformation: Transformation): Rectangle {
  const { patches } = patchworkOf(transformation);
  return {
    minX: Math.min(...patches.map(({ minX }) => minX)),
    minY: Math.min(...patches.map(({ minY }) => minY)),
    maxX: Math.max(...patches.map(({ maxX }) => maxX)),
    maxY: Math.max(...patches.map(({ maxY }) => maxY)),
  };
}
