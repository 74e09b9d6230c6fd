import { geodesicBetween, geodesicFrom } from "@groma/georef";
import { placeVertex, type Vertex } from "../measure/index.js";

/** Metres up to which a line is drawn straight: half as far from its ends a geodesic lies half a metre off the chord. */
const STRAIGHT = 5000;
/** Metres between the places of a longer one, and how many there are at most. */
const STEP = 10_000;
const MOST = 128;

const known = new WeakMap<Vertex, WeakMap<Vertex, readonly Vertex[]>>();

/**
 * Places between two vertices, both left out, that a figure is drawn through: along the geodesic, heights evenly between
 * theirs. None where the line is short enough to be straight.
 */
export function courseOf(a: Vertex, b: Vertex): readonly Vertex[] {
  const ofA = known.get(a) ?? new WeakMap<Vertex, readonly Vertex[]>();
  known.set(a, ofA);
  const course = ofA.get(b) ?? made(a, b);
  ofA.set(b, course);
  return course;
}

function made(a: Vertex, b: Vertex): readonly Vertex[] {
  const { distance, azimuthFrom } = geodesicBetween(a.longitude, a.latitude, b.longitude, b.latitude);
  if (!(distance > STRAIGHT)) return [];
  const parts = Math.min(MOST, Math.max(2, Math.ceil(distance / STEP)));
  return Array.from({ length: parts - 1 }, (_, i) => {
    const share = (i + 1) / parts;
    const { longitude, latitude } = geodesicFrom(a.longitude, a.latitude, azimuthFrom, share * distance);
    return placeVertex(longitude, latitude, a.height + share * (b.height - a.height));
  });
}

/** The vertices of a figure, with what its edges are drawn through; the way is not closed. */
export function wayOf(vertices: readonly Vertex[]): readonly Vertex[] {
  return vertices.flatMap((vertex, i) =>
    i === 0 ? [vertex] : [...courseOf(vertices[i - 1], vertex), vertex],
  );
}
