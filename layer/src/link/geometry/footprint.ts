import { cross, difference, dot, unit, type Vector } from "@groma/georef";
import {
  type CameraPose,
  horizonBelow,
  limbBeside,
  meetSurface,
  type PictureHalves,
  type Ray,
} from "../../camera/index.js";
import { geodeticOf, type Plane, unwrapped } from "./plane-view.js";

/** Parts of an edge of the picture, at least, each of which is a side of the footprint. */
const PARTS = 12;
/** Halvings that find where an edge of the picture meets the horizon. */
const HALVINGS = 20;
/** Share of the picture by which a place of the horizon may lie outside of it and still count as within. */
const EDGE = 1e-6;

/** Where a ray of the picture's edge ends. */
type MeetGround = (ray: Ray) => Vector | undefined;

/**
 * The outline of the ground that a camera sees: where rays through the edge of its picture meet the ground; where they
 * pass above it, the horizon below them, as far as it is in the picture.
 * @param height metres above WGS 84 of the surface whose horizon that is
 * @param meet where a ray meets the ground; default: the surface of the height
 * @returns places of ECEF in order, without repeating the first; none where no ground is in the picture
 */
export function footprintOf(
  pose: CameraPose,
  halves: PictureHalves,
  height: number,
  meet: MeetGround = (ray) => meetSurface(ray, height),
): Vector[] {
  const right = cross(pose.direction, pose.up);
  const rayAt = (place: number): Ray => {
    const [x, y] = onEdge(place);
    const aside = (axis: number) => x * halves.right * right[axis] + y * halves.up * pose.up[axis];
    const beside = (from: Vector): Vector => [from[0] + aside(0), from[1] + aside(1), from[2] + aside(2)];
    if (halves.parallel) return { origin: beside(pose.position), direction: pose.direction };
    return { origin: pose.position, direction: unit(beside(pose.direction)) };
  };
  const horizonAt = (ray: Ray): Vector | undefined => {
    const place = halves.parallel ? limbBeside(ray, height) : horizonBelow(ray, height);
    return place && isSeen(pose, right, halves, place) ? place : undefined;
  };
  const isMet = (place: number) => meet(rayAt(place)) !== undefined;
  const outline: Vector[] = [];
  const add = (place: Vector | undefined) => {
    if (place) outline.push(place);
  };
  let before = isMet(-1 / PARTS);
  for (let index = 0; index < 4 * PARTS; index++) {
    const ray = rayAt(index / PARTS);
    const met = meet(ray);
    if ((met !== undefined) !== before) {
      add(meet(rayAt(crossingOf(isMet, (index - 1) / PARTS, index / PARTS))));
      before = !before;
    }
    add(met ?? horizonAt(ray));
  }
  return outline;
}

/** A place of the picture's edge, by its way round from the lower left, 0 to 4: x and y from −1 to 1. */
function onEdge(way: number): readonly [number, number] {
  const place = (way + 4) % 4;
  const share = 2 * (place % 1) - 1;
  switch (Math.floor(place)) {
    case 0:
      return [share, -1];
    case 1:
      return [1, share];
    case 2:
      return [-share, 1];
    default:
      return [-1, -share];
  }
}

/** The place nearest to where a test changes between two places, on the side where it holds. */
function crossingOf(holds: (place: number) => boolean, from: number, to: number): number {
  let [inside, outside] = holds(from) ? [from, to] : [to, from];
  for (let step = 0; step < HALVINGS; step++) {
    const middle = (inside + outside) / 2;
    if (holds(middle)) inside = middle;
    else outside = middle;
  }
  return inside;
}

function isSeen(pose: CameraPose, right: Vector, halves: PictureHalves, place: Vector): boolean {
  const away = difference(place, pose.position);
  const depth = dot(away, pose.direction);
  const scale = (1 + EDGE) * (halves.parallel ? 1 : depth);
  return (
    depth > 0 &&
    Math.abs(dot(away, right)) <= halves.right * scale &&
    Math.abs(dot(away, pose.up)) <= halves.up * scale
  );
}

/** Share of a degree that a ring round a pole keeps from it, radians: projections may not have the pole itself. */
const POLE = Math.PI / 2 - 1e-9;
/** How far a place may come back from the plane beside itself and still be one of it, radians. */
const STRAY = 1e-6;

/**
 * An outline on a map, as a ring in one piece: across 180° it goes on into the next world, and where it goes round a pole
 * of a map that repeats, along the edge of the map. Places that the map does not have are left out.
 * @param near x of a place in the world where it is to lie
 * @param edge greatest latitude that the map shows, radians
 * @returns at least three places, or none
 */
export function ringOnMap(
  outline: readonly Vector[],
  plane: Plane,
  near: number,
  edge = POLE,
): [number, number][] {
  const { worldWidth } = plane;
  const ring: [number, number][] = [];
  const pole = worldWidth === undefined ? 0 : poleWithin(outline);
  let x = near;
  const add = (longitude: number, latitude: number) => {
    const held = worldWidth === undefined ? latitude : Math.min(Math.max(latitude, -edge), edge);
    const place = plane.forward(longitude, held);
    if (!isOfPlane(plane, place, longitude, held)) return;
    x += unwrapped(place[0] - x, worldWidth);
    ring.push([x, place[1]]);
  };
  for (const place of outline) {
    const [longitude, latitude] = geodeticOf(place);
    add(longitude, latitude);
  }
  if (pole !== 0 && ring.length > 0) {
    // The way round comes back a world further on: there up to the pole, back along the edge, and down again.
    const [[firstX, firstY]] = ring;
    const turn = x + unwrapped(firstX - x, worldWidth) - firstX;
    const [, poleY] = plane.forward(0, pole * edge);
    ring.push([firstX + turn, firstY], [firstX + turn, poleY], [firstX, poleY]);
  }
  return ring.length < 3 ? [] : ring;
}

/** 1 or −1 where an outline goes round the north or the south pole, else 0. */
function poleWithin(outline: readonly Vector[]): number {
  let turn = 0;
  let sum = 0;
  for (const [at, place] of outline.entries()) {
    const [longitude] = geodeticOf(place);
    const [next] = geodeticOf(outline[(at + 1) % outline.length]);
    turn += unwrapped(next - longitude, 2 * Math.PI);
    sum += place[2];
  }
  return Math.abs(turn) < Math.PI ? 0 : Math.sign(sum);
}

/** Whether the plane has a place: from there it comes back. */
function isOfPlane(plane: Plane, place: readonly [number, number], longitude: number, latitude: number) {
  if (!place.every(Number.isFinite)) return false;
  const [back, up] = plane.inverse(...place);
  const aside = unwrapped(back - longitude, 2 * Math.PI) * Math.cos(latitude);
  return Math.abs(aside) < STRAY && Math.abs(up - latitude) < STRAY;
}
