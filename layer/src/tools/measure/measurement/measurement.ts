import { MeasureError } from "../../../errors/index.js";
import { measureAngle } from "../figures/angle.js";
import { measureArea, measureGroundArea } from "../figures/area.js";
import { measureCircle } from "../figures/circle.js";
import { measureDirection } from "../figures/direction.js";
import { measureDistance } from "../figures/distance.js";
import { measurePlane } from "../figures/plane.js";
import { measurePolyline } from "../figures/polyline.js";
import { readOut } from "../figures/read-out.js";
import { tooFew, tooMany } from "../figures/refusals.js";
import type { MeasureUnits, Words } from "../units/measure-units.js";
import { axesAt } from "../vertex/axes.js";
import type { Vertex } from "../vertex/vertex.js";
import type { WorthOptions } from "../worth/point-errors.js";
import { type Quantity, quantity } from "../worth/quantity.js";
import type { Note } from "./note.js";
import type { VolumeSettings } from "./volume-settings.js";

/** What can be measured by placing vertices. */
export type MeasurementKind =
  | "point"
  | "distance"
  | "height"
  | "polyline"
  | "area"
  | "angle"
  | "circle"
  | "plane"
  | "volume"
  | "aboveGround"
  | "annotation";

/** Vertices, and what is measured of them. Values are derived anew whenever they are asked for. */
export interface Measurement {
  /** Its own among all that are kept together. */
  readonly id: string;
  readonly kind: MeasurementKind;
  /** For people. */
  readonly name: string;
  readonly vertices: readonly Vertex[];
  /** Of a volume: how it is measured. */
  readonly volume?: VolumeSettings | undefined;
  /** Of an annotation: what is said there; its title is the name. */
  readonly note?: Note | undefined;
}

/** One value of a measurement. */
export interface NamedValue {
  /** Stable, camel case, as `gridDistance`. */
  readonly name: string;
  /** In English, as `grid distance`. */
  readonly title: string;
  readonly quantity: Quantity;
  /** Which of `MeasureUnits` writes it. */
  readonly writtenAs: "value" | "azimuth" | "slope" | "longitude" | "latitude";
}

/** What a kind of measurement is made of. */
export interface KindOfMeasurement {
  readonly title: string;
  readonly least: number;
  /** Infinity where any number of vertices will do. */
  readonly most: number;
  readonly shape: "points" | "line" | "ring";
  /** The first is the one that the measurement is for, but where that takes reading points: see `readValues`. */
  values(vertices: readonly Vertex[], options: WorthOptions): (NamedValue | undefined)[];
}

/** @internal */
export const value = (name: string, title: string, of: Quantity): NamedValue => ({
  ...{ name, title, quantity: of, writtenAs: "value" },
});

/** A value that need not be. */
const maybe = (name: string, title: string, of: Quantity | undefined) => of && value(name, title, of);

const azimuthOf = (name: string, title: string, of: Quantity<"rad"> | undefined): NamedValue | undefined =>
  of && { name, title, quantity: of, writtenAs: "azimuth" };

const slopeOf = (of: Quantity<"rad"> | undefined): NamedValue | undefined =>
  of && { name: "slope", title: "slope", quantity: of, writtenAs: "slope" };

/**
 * A number that a projection has at a place. How it changes with the place is bounded: by 1 / (R cos² φ) a metre, more than
 * that of any projection in its area of use; and lengths on the ellipsoid are right to 15 nm.
 */
function ofGrid<Unit extends "1" | "rad">(
  of: number,
  unit: Unit,
  vertex: Vertex,
  options: WorthOptions,
): Quantity<Unit> {
  const rate = 1 / (EARTH_RADIUS * Math.max(Math.cos(vertex.latitude), 1e-3) ** 2);
  const { east, north } = axesAt(vertex);
  const lists = [east, north].map(([x, y, z]) => [
    { vertex, gradient: [x * rate, y * rate, z * rate] as const },
  ]);
  const own = [{ name: "geodesic", standard: 1.5e-9, note: "15 nm of a length on the ellipsoid" }];
  return quantity(of, unit, lists, { ...options, ofRecords: true, own });
}

const EARTH_RADIUS = 6371008.8;

/** Every kind, in the order in which people look for them. */
export const MEASUREMENT_KINDS: Readonly<Record<MeasurementKind, KindOfMeasurement>> = {
  point: {
    ...{ title: "Point", least: 1, most: 1, shape: "points" },
    values([vertex], options) {
      const { height, longitude, latitude } = readOut(vertex, options);
      return [
        value("height", "height above the ellipsoid", height),
        { name: "longitude", title: "longitude", quantity: longitude, writtenAs: "longitude" },
        { name: "latitude", title: "latitude", quantity: latitude, writtenAs: "latitude" },
      ];
    },
  },
  distance: {
    ...{ title: "Distance", least: 2, most: 2, shape: "line" },
    values: ([a, b], options) => {
      const { space, horizontal, vertical, geodesic, grid } = measureDistance(a, b, options);
      const { forward, back, grid: inGrid, slope } = measureDirection(a, b, options);
      return [
        value("space", "straight", space),
        value("horizontal", "horizontal", horizontal),
        value("vertical", "vertical", vertical),
        value("geodesic", "geodesic", geodesic),
        maybe("grid", "grid", grid?.distance),
        grid && value("scaleFactor", "scale factor", ofGrid(grid.scaleFactor, "1", a, options)),
        azimuthOf("azimuth", "azimuth", forward),
        azimuthOf("backAzimuth", "azimuth back", back),
        azimuthOf("gridBearing", "grid bearing", inGrid?.bearing),
        inGrid && value("convergence", "convergence", ofGrid(inGrid.convergence, "rad", a, options)),
        slopeOf(slope),
      ];
    },
  },
  height: {
    ...{ title: "Height", least: 2, most: 2, shape: "line" },
    values: ([a, b], options) => {
      const { vertical, horizontal } = measureDistance(a, b, options);
      return [value("vertical", "vertical", vertical), value("horizontal", "horizontal", horizontal)];
    },
  },
  polyline: {
    ...{ title: "Line", least: 2, most: Number.POSITIVE_INFINITY, shape: "line" },
    values: (vertices, options) => {
      const { parts, space, horizontal, geodesic, grid, ascent, descent } = measurePolyline(
        vertices,
        options,
      );
      return [
        value("space", "straight", space),
        value("horizontal", "horizontal", horizontal),
        value("geodesic", "geodesic", geodesic),
        maybe("grid", "grid", grid?.distance),
        value("ascent", "ascent", ascent),
        value("descent", "descent", descent),
        ...(parts.length > 1 ? parts : []).map((part, i) =>
          value(`part${i + 1}`, `part ${i + 1}`, part.space),
        ),
      ];
    },
  },
  area: {
    ...{ title: "Area", least: 3, most: Number.POSITIVE_INFINITY, shape: "ring" },
    values: (vertices, options) => {
      const { geodesic, planar, grid, perimeter, plane } = measureArea(vertices, options);
      return [
        value("geodesic", "on the ellipsoid", geodesic),
        value("planar", "in its plane", planar),
        maybe("grid", "grid", grid?.area),
        value("perimeter", "perimeter", perimeter.space),
        slopeOf(plane?.slope),
      ];
    },
  },
  angle: {
    ...{ title: "Angle", least: 3, most: 3, shape: "line" },
    values: ([a, apex, b], options) => {
      const { space, horizontal } = measureAngle(a, apex, b, options);
      return [value("space", "in space", space), azimuthOf("horizontal", "between azimuths", horizontal)];
    },
  },
  circle: {
    ...{ title: "Circle", least: 3, most: 3, shape: "line" },
    values: ([a, b, c], options) => {
      const { radius, circumference, area, arc } = measureCircle(a, b, c, options);
      return [
        value("radius", "radius", radius),
        value("arc", "arc", arc.length),
        value("arcAngle", "angle of the arc", arc.angle),
        value("chord", "chord", arc.chord),
        value("sagitta", "sagitta", arc.sagitta),
        value("circumference", "circumference", circumference),
        value("area", "area", area),
      ];
    },
  },
  plane: {
    ...{ title: "Plane", least: 3, most: Number.POSITIVE_INFINITY, shape: "ring" },
    values: (vertices, options) => {
      const { slope, aspect, deviation } = measurePlane(vertices, options);
      return [
        slopeOf(slope),
        azimuthOf("aspect", "falls towards", aspect),
        value("deviation", "deviation", deviation),
      ];
    },
  },
  volume: {
    ...{ title: "Volume", least: 3, most: Number.POSITIVE_INFINITY, shape: "ring" },
    values: (vertices, options) => [value("area", "area", measureGroundArea(vertices, options))],
  },
  aboveGround: {
    ...{ title: "Above ground", least: 1, most: 1, shape: "points" },
    values: () => [],
  },
  annotation: {
    ...{ title: "Annotation", least: 1, most: 1, shape: "points" },
    values: () => [],
  },
};

/**
 * What a measurement comes to; the first value is what it is for.
 * @throws MeasureError where its vertices have no such value, MEASURE_VERTICES where they are not as many as the kind needs,
 *   MEASURE_OPTION for a kind that there is not
 */
export function valuesOf(
  { kind, vertices }: Pick<Measurement, "kind" | "vertices">,
  options: WorthOptions = {},
) {
  if (!Object.hasOwn(MEASUREMENT_KINDS, kind)) {
    throw new MeasureError({
      code: "MEASURE_OPTION",
      file: "measurement",
      cause: `there is no kind ${JSON.stringify(kind)}`,
      fix: `use one of ${Object.keys(MEASUREMENT_KINDS).join(", ")}`,
    });
  }
  const { title, least, most } = MEASUREMENT_KINDS[kind];
  if (vertices.length < least) throw tooFew(title.toLowerCase(), least, vertices.length);
  if (vertices.length > most) throw tooMany(title.toLowerCase(), most, vertices.length);
  return MEASUREMENT_KINDS[kind].values(vertices, options).filter((one) => one !== undefined);
}

/** A value as text. */
export function wordsOf({ quantity: of, writtenAs }: NamedValue, units: MeasureUnits): Words {
  if (of.unit !== "rad" || writtenAs === "value") return units.words(of);
  const angle = of as Quantity<"rad">;
  if (writtenAs === "azimuth") return units.azimuthWords(angle);
  if (writtenAs === "slope") return units.slopeWords(angle);
  return units.coordinateWords(angle, writtenAs === "longitude" ? "EW" : "NS");
}
