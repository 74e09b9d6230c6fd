import { CHEBYSHEV_NODES, NODES } from "../approximation/chebyshev.js";
import type { Link } from "../transformation/link.js";
import type { Box } from "./expansion.js";

/** Heights of the samples: in the middle, at the bottom, at the top. */
export const MIDDLE = 0;
export const BOTTOM = 1;
export const TOP = 2;
const HEIGHTS = 3;
const COLUMN = NODES * NODES;

/** Source units: heights are told apart at least so far, or their differences would be rounding. */
const HALF_HEIGHT_MIN = 1;

/**
 * The states of points of a node on its way through the steps: 9 × 9 Chebyshev nodes at three heights, all at once,
 * so that each step can be looked at before the next is known.
 */
export class NodeSamples {
  /** Source units, from the middle to the top sample. */
  readonly halfHeight: number;
  /** w of the top sample, where w is 1 at the top of the node: 1, but in a node that is almost flat. */
  readonly top: number;
  private readonly states: Float64Array;

  constructor(box: Box) {
    this.halfHeight = Math.max(box.halfZ, HALF_HEIGHT_MIN);
    this.top = this.halfHeight / box.halfZ;
    this.states = new Float64Array(3 * COLUMN * HEIGHTS);
    for (let i = 0; i < NODES; i++) {
      for (let j = 0; j < NODES; j++) {
        const x = box.x + box.halfX * CHEBYSHEV_NODES[i];
        const y = box.y + box.halfY * CHEBYSHEV_NODES[j];
        this.states.set([x, y, box.z], this.at(i, j, MIDDLE));
        this.states.set([x, y, box.z - this.halfHeight], this.at(i, j, BOTTOM));
        this.states.set([x, y, box.z + this.halfHeight], this.at(i, j, TOP));
      }
    }
  }

  /** Index of a sample in the states. */
  private at(i: number, j: number, height: number): number {
    return 3 * (height * COLUMN + i * NODES + j);
  }

  /** Takes all samples through a step. */
  apply(link: Link): void {
    const state = new Float64Array(3);
    for (let at = 0; at < this.states.length; at += 3) {
      copy(this.states, at, state, 0);
      link.apply(state);
      copy(state, 0, this.states, at);
    }
  }

  /** The samples as they are now. */
  snapshot(): Float64Array {
    return this.states.slice();
  }

  finite(): boolean {
    return this.states.every(Number.isFinite);
  }

  /** Copies the state of a sample out of a snapshot. */
  read(snapshot: Float64Array, i: number, j: number, height: number, out: Float64Array): void {
    copy(snapshot, this.at(i, j, height), out, 0);
  }

  /** Greatest distance of the middle from the chord between bottom and top. */
  curvature(): number {
    let greatest = 0;
    for (let at = 0; at < 3 * COLUMN; at += 3) {
      let square = 0;
      for (let axis = at; axis < at + 3; axis++) {
        const chord = (this.states[axis + 3 * COLUMN] + this.states[axis + 6 * COLUMN]) / 2;
        square += (this.states[axis] - chord) ** 2;
      }
      greatest = Math.max(greatest, Math.sqrt(square));
    }
    return greatest;
  }
}

/** Three numbers; a subarray for each would cost more than the step. */
function copy(from: Float64Array, at: number, to: Float64Array, offset: number): void {
  to[offset] = from[at];
  to[offset + 1] = from[at + 1];
  to[offset + 2] = from[at + 2];
}
