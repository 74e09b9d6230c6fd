import { eastNorthUp, geodeticToEcef, unit, type Vector } from "@groma/georef";
import { StyleError } from "../errors/index.js";
import { instead, shown } from "../options/index.js";
import type { BoxClip, Clip, ClipPlace, PlaneClip, PolygonClip } from "./clip.js";
import { ROLES } from "./clip-roles.js";
import { type HalfSpace, halfSpaces } from "./half-spaces.js";
import { prism } from "./prism.js";
import { geodeticShape, sourceShape } from "./prism-shapes.js";
import { capOf, FARTHEST, placed } from "./rings.js";
import { type Corner, extendedPlace } from "./source-space.js";
import type { Steps } from "./steps.js";
import { remembering, type SourceSpace, type Volume } from "./volume.js";

/** What a volume of each kind has. */
const PROPERTIES: ReadonlyMap<unknown, readonly string[]> = new Map<Clip["kind"], readonly string[]>([
  ["box", ["mode", "center", "size", "heading", "pitch", "roll"] satisfies Exclude<keyof BoxClip, "kind">[]],
  ["plane", ["mode", "through", "heading", "pitch"] satisfies Exclude<keyof PlaneClip, "kind">[]],
  [
    "polygon",
    ["mode", "coordinates", "ring", "bottom", "top"] satisfies Exclude<keyof PolygonClip, "kind">[],
  ],
]);

/**
 * Metres from a data set as far as which its map, carried on linearly, still tells a direction: what is farther has been
 * written in other coordinates more often than not.
 */
const REACH = 100_000;

/**
 * Checks what can be checked of a volume without a data set.
 * @throws StyleError STYLE_CLIP
 */
export function checkClip(clip: Clip): void {
  const names = PROPERTIES.get(clip?.kind);
  if (!names) fail("this is not a clip volume", "Use Clip.box, Clip.plane or Clip.polygon");
  const unknown = Object.keys(clip).find((name) => name !== "kind" && !names.includes(name));
  if (unknown !== undefined) fail(`a ${clip.kind} has no ${shown(unknown)}`, instead(unknown, names));
  if (!Object.hasOwn(ROLES, clip.mode)) {
    fail(`unknown mode ${shown(clip.mode)}`, instead(clip.mode, Object.keys(ROLES)));
  }
  if (clip.kind === "polygon") checkPolygon(clip);
  else if (clip.kind === "box") {
    const { size } = clip;
    if (!areNumbers(size, 3) || !size.every((edge) => edge > 0)) {
      fail(`a box cannot be ${[size].flat().join(" × ")} m large`, "Give three lengths greater than 0");
    }
    if (!areNumbers([clip.heading, clip.pitch, clip.roll], 3)) {
      fail("the angles of a box are not finite numbers", "Give finite angles");
    }
    checkPlace(clip.center);
  } else {
    if (!areNumbers([clip.heading, clip.pitch], 2)) fail("a plane needs a direction", "Give finite angles");
    checkPlace(clip.through);
  }
}

/**
 * A volume in float64, for one data set; it remembers the nodes that it was asked about.
 * @throws StyleError STYLE_CLIP; PlacementError where it is given in source coordinates that have no place
 */
export function* compileClip(clip: Clip, space: SourceSpace): Steps<Volume> {
  if (clip.kind === "polygon") return remembering(yield* polygonVolume(clip, space));
  return remembering(halfSpaces(clip.kind === "box" ? boxSides(clip, space) : [planeSide(clip, space)]));
}

function* polygonVolume({ coordinates, ring, bottom, top }: PolygonClip, space: SourceSpace): Steps<Volume> {
  if (coordinates === "source") return prism(yield* sourceShape(ring, { bottom, top }, space));
  return prism(yield* geodeticShape(ring, { bottom, top }));
}

/** The box's own axes: turned by heading, pitch and roll, in this order. */
function boxSides({ center, size, heading, pitch, roll }: BoxClip, space: SourceSpace): HalfSpace[] {
  const place = placeOf(center, space);
  const { rotation } = eastNorthUp(place);
  const [sh, ch, sp, cp] = [Math.sin(heading), Math.cos(heading), Math.sin(pitch), Math.cos(pitch)];
  const [sr, cr] = [Math.sin(roll), Math.cos(roll)];
  const level: Vector = [ch, -sh, 0];
  const depth: Vector = [sh * cp, ch * cp, sp];
  const upright: Vector = [-sh * sp, -ch * sp, cp];
  const mix = (a: Vector, x: number, b: Vector, y: number): Vector => [
    a[0] * x + b[0] * y,
    a[1] * x + b[1] * y,
    a[2] * x + b[2] * y,
  ];
  const axes = [mix(level, cr, upright, -sr), depth, mix(level, sr, upright, cr)];
  return axes.flatMap((axis, index) => {
    const normal = inEcef(rotation, axis);
    return [1, -1].map((sign) => ({
      normal: normal.map((part) => sign * part) as unknown as Vector,
      through: normal.map((part, i) => place[i] - (sign * part * size[index]) / 2),
    }));
  });
}

function planeSide({ through, heading, pitch }: PlaneClip, space: SourceSpace): HalfSpace {
  const place = placeOf(through, space);
  const { rotation } = eastNorthUp(place);
  const level = Math.cos(pitch);
  const normal = inEcef(rotation, [level * Math.sin(heading), level * Math.cos(heading), Math.sin(pitch)]);
  return { normal, through: place };
}

function inEcef(rotation: Float64Array, [e, n, u]: Vector): Vector {
  return unit([0, 1, 2].map((axis) => rotation[axis] * e + rotation[axis + 3] * n + rotation[axis + 6] * u));
}

function placeOf(place: ClipPlace, space: SourceSpace): Vector {
  if ("source" in place) {
    const there = placed(extendedPlace(space), ...place.source);
    const { min, max } = space.boundingBox;
    const [low, high] = [min, max].map((corner) => placed(extendedPlace(space), ...corner)) as [
      Vector,
      Vector,
    ];
    // Not a number where the place is none either.
    if (distance(low, there) < REACH + distance(low, high)) return there;
    return fail(
      `(${place.source.join(", ")}) lies too far from the data set`,
      "Give source coordinates near its points",
    );
  }
  const ecef = new Float64Array(3);
  geodeticToEcef(place.longitude, place.latitude, place.height, ecef);
  return [ecef[0], ecef[1], ecef[2]];
}

function distance([ax, ay, az]: Vector, [bx, by, bz]: Vector): number {
  return Math.hypot(bx - ax, by - ay, bz - az);
}

function checkPlace(place: ClipPlace): void {
  const given: Partial<Record<"longitude" | "latitude" | "height" | "source", unknown>> = place ?? {};
  const { longitude, latitude, height, source } = given;
  const numbers = source === undefined ? [longitude, latitude, height] : source;
  const onEarth = source !== undefined || Math.abs(Number(latitude)) <= Math.PI / 2;
  if (areNumbers(numbers, 3) && onEarth) return;
  fail(
    `(${[numbers].flat().join(", ")}) is not a position`,
    "Give longitude and latitude in radians and height in metres, or source",
  );
}

function checkPolygon({ coordinates, ring, bottom, top }: PolygonClip): void {
  if (coordinates !== "geodetic" && coordinates !== "source") {
    fail(`unknown coordinates ${shown(coordinates)}`, "Use geodetic or source");
  }
  if (ring.length < 3) fail(`a polygon cannot have ${ring.length} corners`, "Give three corners or more");
  const fits = (corner: Corner) =>
    areNumbers(corner, 2) && (coordinates === "source" || Math.abs(corner[1]) <= Math.PI / 2);
  if (!ring.every(fits)) {
    fail(
      "a corner of a polygon is not a position",
      "Give longitude and latitude in radians, or x and y of the data set",
    );
  }
  if (coordinates === "geodetic" && !(capOf(ring).cosine > Math.cos(FARTHEST))) {
    fail("a polygon reaches farther than 85° from its middle", "Cut it into several polygons");
  }
  const ends = [bottom, top].filter((end) => end !== undefined);
  if (!areNumbers(ends, ends.length) || (ends.length === 2 && !(ends[0] < ends[1]))) {
    fail(`a polygon cannot stand from ${bottom} to ${top}`, "Give finite heights, the top above the bottom");
  }
}

function areNumbers(values: unknown, count: number): boolean {
  const listed = Array.isArray(values) ? values : values instanceof Float64Array ? [...values] : [];
  return listed.length === count && listed.every(Number.isFinite);
}

function fail(cause: string, fix: string): never {
  throw new StyleError({ code: "STYLE_CLIP", file: "clips", cause, fix });
}
