import type { Link } from "./link.js";
import type { ChoiceStep, Rectangle, ShiftStep, Step, Transformation, Way } from "./step.js";

/**
 * Compiles a projection and the choice after it: a point goes the first way that is for its place and has a place for it,
 * NaN where none has.
 */
export function choiceLink(projection: Link, { ways }: ChoiceStep, linkOf: (step: ShiftStep) => Link): Link {
  const compiled = ways.map(({ area, steps }) => ({ area, links: steps.map((step) => linkOf(step)) }));
  const projected = new Float64Array(3);
  const before = new Float64Array(9);
  const go = (x: number, y: number, state: Float64Array): readonly Link[] | undefined => {
    for (let i = 0; i < compiled.length; i++) {
      const { area, links } = compiled[i];
      if (!isWithin(area, x, y)) continue;
      state.set(projected);
      for (let j = 0; j < links.length; j++) links[j].apply(state);
      if (Number.isFinite(state[0] + state[1] + state[2])) return links;
    }
    state.fill(Number.NaN);
    return undefined;
  };
  return {
    apply(state) {
      const [x, y] = [state[0], state[1]];
      projection.apply(state);
      projected.set(state);
      go(x, y, state);
    },
    differentiate(state, jacobian) {
      const [x, y] = [state[0], state[1]];
      projection.differentiate(state, jacobian);
      projected.set(state);
      before.set(jacobian);
      const links = go(x, y, state);
      if (!links) return;
      state.set(projected);
      jacobian.set(before);
      for (let j = 0; j < links.length; j++) links[j].differentiate(state, jacobian);
    },
  };
}

function isWithin({ minX, minY, maxX, maxY }: Rectangle, x: number, y: number): boolean {
  return x >= minX && x <= maxX && y >= minY && y <= maxY;
}

/** The choice of a transformation that has one: its second step. */
export function choiceOf({ steps }: Pick<Transformation, "steps">): ChoiceStep | undefined {
  const second = steps[1];
  return second?.kind === "choice" ? second : undefined;
}

/** The transformation that goes one way of its choice, wherever a point lies. */
export function along({ steps }: Transformation, way: Way): Transformation {
  return { steps: steps.flatMap((step): readonly Step[] => (step.kind === "choice" ? way.steps : [step])) };
}

/** All steps, those of all ways of a choice in its place. */
export function everyStep({ steps }: Transformation): Step[] {
  return steps.flatMap((step): readonly Step[] =>
    step.kind === "choice" ? step.ways.flatMap((way) => way.steps) : [step],
  );
}
