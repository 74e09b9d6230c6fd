import Delaunator from "delaunator";

/** A surface of triangles over the plane: Delaunay's, of points with one height each. */
export class Tin {
  /** x, y of each point, metres. */
  readonly xy: Float64Array;
  readonly z: Float64Array;
  /** Three indices of points for each triangle. */
  readonly triangles: Uint32Array;
  readonly #halfedges: Int32Array;
  /** 1 where triangles run counter-clockwise, −1 where they run clockwise; all run alike. */
  readonly #turn: number;
  #last = 0;

  /**
   * @param points x, y, z of each in turn, metres. Of several in one place of the plane the first counts
   */
  constructor(points: Float64Array) {
    const count = points.length / 3;
    this.xy = new Float64Array(2 * count);
    this.z = new Float64Array(count);
    for (let i = 0; i < count; i++) {
      this.xy[2 * i] = points[3 * i];
      this.xy[2 * i + 1] = points[3 * i + 1];
      this.z[i] = points[3 * i + 2];
    }
    const { triangles, halfedges } = new Delaunator(this.xy);
    this.triangles = triangles;
    this.#halfedges = halfedges;
    const [a = 0, b = 0, c = 0] = triangles;
    this.#turn = Math.sign(left(this.xy, a, b, this.xy[2 * c], this.xy[2 * c + 1]));
  }

  /** Which points the surface goes through, 1 or 0: of several in one place it is one. */
  corners(): Uint8Array {
    const corners = new Uint8Array(this.z.length);
    for (const corner of this.triangles) corners[corner] = 1;
    return corners;
  }

  /** Height of the surface at a place; NaN outside of it. Quick where places follow each other closely. */
  heightAt(x: number, y: number): number {
    const { triangles, xy, z } = this;
    let edge = this.#last;
    // A walk through a Delaunay triangulation meets no triangle twice.
    for (let steps = 0; steps <= triangles.length && triangles.length > 0; steps++) {
      const first = 3 * Math.floor(edge / 3);
      let next = -1;
      for (let side = 0; side < 3 && next < 0; side++) {
        const [a, b] = [triangles[first + side], triangles[first + ((side + 1) % 3)]];
        if (this.#turn * left(xy, a, b, x, y) < 0) next = first + side;
      }
      if (next < 0) {
        this.#last = first;
        return plane(xy, z, triangles[first], triangles[first + 1], triangles[first + 2], x, y);
      }
      edge = this.#halfedges[next];
      if (edge < 0) return Number.NaN;
    }
    return Number.NaN;
  }
}

/** Positive where a place lies left of the way from point a to point b. */
function left(xy: Float64Array, a: number, b: number, x: number, y: number): number {
  return (xy[2 * b] - xy[2 * a]) * (y - xy[2 * a + 1]) - (xy[2 * b + 1] - xy[2 * a + 1]) * (x - xy[2 * a]);
}

/** Height at a place of the plane through three points. */
function plane(xy: Float64Array, z: Float64Array, a: number, b: number, c: number, x: number, y: number) {
  const [ux, uy] = [xy[2 * b] - xy[2 * a], xy[2 * b + 1] - xy[2 * a + 1]];
  const [vx, vy] = [xy[2 * c] - xy[2 * a], xy[2 * c + 1] - xy[2 * a + 1]];
  const [wx, wy] = [x - xy[2 * a], y - xy[2 * a + 1]];
  const twice = ux * vy - uy * vx;
  const s = (wx * vy - wy * vx) / twice;
  const t = (ux * wy - uy * wx) / twice;
  // Weights, so that each corner has its own height to the last digit: a surface does not differ from itself.
  return (1 - s - t) * z[a] + s * z[b] + t * z[c];
}
