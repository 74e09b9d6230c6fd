import { describe, expect, it } from "vitest";
import { random } from "../cartesian/points.fixture.js";
import { lookup } from "../crs/epsg-table.fixture.js";
import {
  type Crs,
  exactTransform,
  fitPlacement,
  type Placement,
  place,
  placeIntegers,
  resolveCrs,
} from "../index.js";

/*
 * What is compared: the pixel at which the GPU draws a point, against the pixel of the same point computed in float64.
 * The first goes the layer's way: float32 vertices in the node frame, the matrix node frame → eye composed in float64
 * relative to the camera and rounded to float32 once, every product and sum of the vertex shader rounded to float32. The second
 * takes the same placement without any rounding. So the error has all that float32 costs (vertex storage, matrix,
 * arithmetic) and not the fit, which does not move with the camera and is certified by itself.
 *
 * From which distance on: float32 leaves a point of a node of edge L uncertain by a few 2⁻²⁴ L, whatever the camera
 * does, and that is a larger angle the nearer one looks. A node holds points one spacing apart, L / 128 or more. Who
 * stands nearer to one of its points than that stands between its points; what is then on the screen comes from deeper
 * nodes, with a smaller L, and of this node no more than the one point. So 0.05 px are asked for from L / 128 on. Nearer
 * than that the error is held as a length: it stays below 2⁻²² L (2.4 mm for a node of 10 km, 0.24 µm for one of 1 m).
 */
const PIXELS = 0.05;
const NEAREST = 1 / 128;
const LENGTH = 2 ** -22;

const WIDTH = 1920;
const HEIGHT = 1080;
/** Pixels per unit of tangent, vertical field of view 60°. */
const FOCAL = HEIGHT / 2 / Math.tan(Math.PI / 6);

const EDGES = [1, 10, 100, 1000, 10000];
const DISTANCES = [0.1, 1, 10, 100, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8];

const PLACES: readonly (readonly [name: string, given: string, x: number, y: number])[] = [
  ["Zurich", "EPSG:2056", 2683000, 1247000],
  ["north pole", "EPSG:5041", 2000000, 2000000],
  ["south pole", "EPSG:5042", 2000000, 2000000],
  ["equator", "EPSG:32633", 500000, 0],
  ["antimeridian", "EPSG:32660", 833978, 0],
  ["antimeridian off the equator", "EPSG:3857", 20037508, 5000000],
  ["Oregon, in feet", "EPSG:2994", 637000, 851000],
];

type Triple = [number, number, number];

/** A node of a given edge with random points, corners included: vertices as the GPU has them and as they should be. */
function nodeAt(crs: Crs, x: number, y: number, edge: number, next: () => number) {
  const half = edge / 2 / crs.horizontalUnit.size;
  const halfZ = edge / 2 / crs.verticalUnit.size;
  const domain = {
    minX: x - half,
    maxX: x + half,
    minY: y - half,
    maxY: y + half,
    minZ: -halfZ,
    maxZ: halfZ,
  };
  const placement = fitPlacement(exactTransform(crs), domain, 0.001);
  const count = 24;
  const offset = [x, y, 0];
  const scale = [half * 2 ** -24, half * 2 ** -24, halfZ * 2 ** -24];
  const xyz = Int32Array.from({ length: 3 * count }, (_, i) => {
    const corner = (Math.floor(i / 3) >> (i % 3)) & 1 ? 1 : -1;
    return Math.round((i < 24 ? corner : 2 * next() - 1) * 2 ** 24);
  });
  const vertices = new Float32Array(3 * count);
  placeIntegers(placement, xyz, count, scale, offset, vertices);
  const truth = Array.from({ length: count }, (_, i): Triple => {
    const [px, py, pz] = [0, 1, 2].map((axis) => xyz[3 * i + axis] * scale[axis] + offset[axis]);
    return localOf(placement, px, py, pz);
  });
  return { placement, vertices, truth, count };
}

/** `place` in the node frame, float64. */
function localOf(placement: Placement, x: number, y: number, z: number): Triple {
  const ecef = new Float64Array(3);
  place(placement, x, y, z, ecef);
  const { origin, rotation: r } = placement.frame;
  const d = [ecef[0] - origin[0], ecef[1] - origin[1], ecef[2] - origin[2]];
  return [0, 3, 6].map((c) => r[c] * d[0] + r[c + 1] * d[1] + r[c + 2] * d[2]) as Triple;
}

/** A random rotation, rows: the axes of the eye (right, up, back) in the node frame. */
function randomRotation(next: () => number): number[] {
  const q = Array.from({ length: 4 }, () => next() + next() + next() - 1.5);
  const norm = Math.hypot(...q);
  const [a, b, c, d] = q.map((value) => value / norm);
  return [
    ...[1 - 2 * (c * c + d * d), 2 * (b * c - a * d), 2 * (b * d + a * c)],
    ...[2 * (b * c + a * d), 1 - 2 * (b * b + d * d), 2 * (c * d - a * b)],
    ...[2 * (b * d - a * c), 2 * (c * d + a * b), 1 - 2 * (b * b + c * c)],
  ];
}

const f = Math.fround;

/** Pixel of a vertex, every operation rounded to float32 as highp GLSL does at worst. */
function pixel32(matrix: readonly number[], vertex: ArrayLike<number>): [number, number] {
  const m = matrix.map(f);
  const row = (i: number) =>
    f(
      f(f(f(m[4 * i] * f(vertex[0])) + f(m[4 * i + 1] * f(vertex[1]))) + f(m[4 * i + 2] * f(vertex[2]))) +
        m[4 * i + 3],
    );
  const [x, y, w] = [row(0), row(1), f(-row(2))];
  const ndcX = f(f(f((2 * FOCAL) / WIDTH) * x) / w);
  const ndcY = f(f(f((2 * FOCAL) / HEIGHT) * y) / w);
  return [f(f(f(ndcX * 0.5) + 0.5) * WIDTH), f(f(f(ndcY * 0.5) + 0.5) * HEIGHT)];
}

function pixel64(m: readonly number[], v: Triple): [number, number] {
  const row = (i: number) => m[4 * i] * v[0] + m[4 * i + 1] * v[1] + m[4 * i + 2] * v[2] + m[4 * i + 3];
  const w = -row(2);
  return [(FOCAL * row(0)) / w + WIDTH / 2, (FOCAL * row(1)) / w + HEIGHT / 2];
}

/** Node frame → eye for a camera from which a point is seen at a distance, somewhere on the screen. */
function view(point: Triple, distance: number, next: () => number): number[] {
  const r = randomRotation(next);
  const [tx, ty] = [((next() - 0.5) * WIDTH) / FOCAL, ((next() - 0.5) * HEIGHT) / FOCAL];
  const along = distance / Math.hypot(tx, ty, 1);
  // Where the point is to be in the eye frame, less where the rotation alone would put it.
  const eye = [tx * along, ty * along, -along];
  return [0, 1, 2].flatMap((i) => {
    const [a, b, c] = r.slice(3 * i, 3 * i + 3);
    return [a, b, c, eye[i] - (a * point[0] + b * point[1] + c * point[2])];
  });
}

/**
 * The matrix as the layer composes it: from the ECEF position of the camera, whose difference to the node's origin is
 * formed in float64.
 */
function composed({ origin, rotation: R }: Placement["frame"], m: readonly number[]): number[] {
  const toLocal = [0, 1, 2].map((c) => -(m[c] * m[3] + m[4 + c] * m[7] + m[8 + c] * m[11]));
  const camera = [0, 1, 2].map(
    (a) => origin[a] + R[a] * toLocal[0] + R[a + 3] * toLocal[1] + R[a + 6] * toLocal[2],
  );
  const d = [0, 1, 2].map((a) => origin[a] - camera[a]);
  const local = [0, 3, 6].map((c) => R[c] * d[0] + R[c + 1] * d[1] + R[c + 2] * d[2]);
  return [0, 1, 2].flatMap((i) => {
    const [a, b, c] = m.slice(4 * i, 4 * i + 3);
    return [a, b, c, a * local[0] + b * local[1] + c * local[2]];
  });
}

describe("jitter: float32 pipeline against float64, 1080p, 60°", () => {
  it.each(PLACES)("%s: ≤ 0.05 px from a spacing's distance to 10⁸ m", (_, given, x, y) => {
    const crs = resolveCrs({ file: given, given }, lookup);
    const next = random(4711);
    for (const edge of EDGES) {
      const { placement, vertices, truth, count } = nodeAt(crs, x, y, edge, next);
      expect(Math.hypot(...placement.frame.origin)).toBeGreaterThan(6.3e6);
      for (const distance of [...DISTANCES, edge * NEAREST]) {
        for (let i = 0; i < count; i++) {
          for (let repeat = 0; repeat < 8; repeat++) {
            const matrix = view(truth[i], distance, next);
            const [u, v] = pixel64(matrix, truth[i]);
            const [u32, v32] = pixel32(
              composed(placement.frame, matrix),
              vertices.subarray(3 * i, 3 * i + 3),
            );
            const error = Math.hypot(u32 - u, v32 - v);
            if (distance >= edge * NEAREST) expect(error).toBeLessThanOrEqual(PIXELS);
            else expect((error * distance) / FOCAL).toBeLessThanOrEqual(edge * LENGTH);
          }
        }
      }
    }
  });

  it("would be lost with ECEF in float32: the negative control", () => {
    const next = random(1);
    const point: Triple = [4.28e6, 6.4e5, 4.67e6];
    const matrix = view(point, 10, next);
    const [u, v] = pixel64(matrix, point);
    const [u32, v32] = pixel32(matrix, point);
    expect(Math.hypot(u32 - u, v32 - v)).toBeGreaterThan(1);
  });
});
