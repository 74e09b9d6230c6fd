import { ecefToGeodetic, GromaError, PlacementError } from "@groma/georef";
import type BaseEvent from "ol/events/Event.js";
import type { Extent } from "ol/extent.js";
import Feature from "ol/Feature.js";
import Polygon from "ol/geom/Polygon.js";
import type Projection from "ol/proj/Projection.js";
import { getTransform, type ProjectionLike, get as projectionOf } from "ol/proj.js";
import VectorSource from "ol/source/Vector.js";
import type { PointCloud } from "../cloud/index.js";
import { notRegistered } from "./projections.js";

/** Longitude and latitude, WGS 84, degrees. */
type Place = readonly [number, number];

/** Parts that a side of the outline is cut into, so that it bends as the ground does. */
const SIDE = 16;

/**
 * The outline of a data set: one feature for each projection in which a map shows it. The source holds the one of the
 * projection that was asked for last, since a vector layer asks for its own before it reads what is there. A change is told
 * when an outline is made, and not when one takes the other's place: else two maps would have each other drawn for ever.
 */
export class Footprint extends VectorSource<Feature<Polygon>> {
  /** By the code of the projection; undefined where the data set has no place in it. */
  readonly #features = new Map<string, Feature<Polygon> | undefined>();
  #cloud: PointCloud | undefined;
  #shown: Feature<Polygon> | undefined;
  #quiet = false;

  constructor(opened: Promise<PointCloud>) {
    super();
    // What keeps it from being opened is told by the source of the points.
    opened.then(
      (cloud) => {
        this.#cloud = cloud;
        this.changed();
      },
      () => undefined,
    );
  }

  override loadFeatures(extent: Extent, resolution: number, projection: Projection): void {
    if (this.#cloud) this.#show(this.#cloud, projection);
    super.loadFeatures(extent, resolution, projection);
  }

  override dispatchEvent(event: BaseEvent | string): boolean | undefined {
    return this.#quiet ? undefined : super.dispatchEvent(event);
  }

  #show(cloud: PointCloud, projection: Projection): void {
    const code = projection.getCode();
    this.#quiet = this.#features.has(code);
    if (!this.#quiet) this.#features.set(code, featureOf(cloud, projection));
    const feature = this.#features.get(code);
    if (feature !== this.#shown) {
      if (this.#shown) this.removeFeature(this.#shown);
      if (feature) this.addFeature(feature);
      this.#shown = feature;
    }
    this.#quiet = false;
  }
}

function featureOf(cloud: PointCloud, projection: Projection): Feature<Polygon> | undefined {
  try {
    const geometry = outlineOf(cloud, projection);
    return geometry && new Feature({ geometry, name: cloud.name });
  } catch (thrown) {
    // The layer of the points tells that it is not registered; other layers of the map are drawn.
    if (thrown instanceof GromaError) return undefined;
    throw thrown;
  }
}

/**
 * The sides of a data set's box on the ground, at its middle height, in a projection; across 180° in one piece, in the world
 * in which the points are placed. Around a pole, in a map that goes round the world, all longitudes up to the pole. Places
 * that either of the two systems does not have are left out; undefined where less than a triangle is left.
 * @throws CrsError CRS_PROJECTION where the projection is not registered
 */
export function outlineOf(cloud: PointCloud, projection: ProjectionLike): Polygon | undefined {
  const known = projectionOf(projection);
  const toMap = known && getTransform("EPSG:4326", known);
  if (!toMap) throw notRegistered(known?.getCode() ?? String(projection), cloud.name);
  const sides = sidesOf(cloud);
  const places = known.canWrapX() && turnsOf(sides) !== 0 ? upToThePole(sides) : sides;
  const ring = places
    .map((place) => toMap([...place], undefined, 2))
    .filter((at) => at.every(Number.isFinite));
  return ring.length < 3 ? undefined : new Polygon([[...ring, ring[0]]]);
}

/** Longitudes and latitudes along the sides of the box, degrees, on the turn nearest to its middle. */
function sidesOf(cloud: PointCloud): Place[] {
  const { min, max } = cloud.boundingBox;
  const [x, y, z] = [0, 1, 2].map((axis) => (min[axis] + max[axis]) / 2);
  const corners = [
    [min[0], min[1]],
    [max[0], min[1]],
    [max[0], max[1]],
    [min[0], max[1]],
  ];
  const [middle = 0] = placeOf(cloud, [x, y, z]) ?? [];
  return corners.flatMap(([fromX, fromY], side) => {
    const [toX, toY] = corners[(side + 1) % corners.length];
    return Array.from({ length: SIDE }, (_, step) => {
      const share = step / SIDE;
      return placeOf(cloud, [fromX + share * (toX - fromX), fromY + share * (toY - fromY), z]);
    }).flatMap((place) => (place ? [[nearest(place[0], middle), place[1]] as const] : []));
  });
}

/** Source coordinates → longitude and latitude, degrees; undefined where they have no place. */
function placeOf(cloud: PointCloud, [x, y, z]: readonly number[]): Place | undefined {
  const place = new Float64Array(3);
  try {
    cloud.place(x, y, z, place);
  } catch (thrown) {
    if (thrown instanceof PlacementError) return undefined;
    throw thrown;
  }
  ecefToGeodetic(place[0], place[1], place[2], place);
  return [(place[0] * 180) / Math.PI, (place[1] * 180) / Math.PI];
}

/** How many times a ring goes round the earth's axis. */
function turnsOf(ring: readonly Place[]): number {
  const along = ring.map(([longitude], at) => {
    const [next] = ring[(at + 1) % ring.length];
    return nearest(next, longitude) - longitude;
  });
  return Math.round(along.reduce((sum, step) => sum + step, 0) / 360);
}

/** A ring around a pole as what lies between it and the pole, from −180° to 180°. */
function upToThePole(ring: readonly Place[]): Place[] {
  const places = ring.map(([longitude, latitude]) => [nearest(longitude, 0), latitude] as const);
  places.sort(([a], [b]) => a - b);
  const [first, last] = [places[0], places[places.length - 1]];
  const share = (180 - last[0]) / (first[0] + 360 - last[0]);
  const edge = last[1] + share * (first[1] - last[1]);
  const pole = Math.sign(first[1]) * 90;
  return [[-180, edge], ...places, [180, edge], [180, pole], [-180, pole]];
}

/** A longitude on the turn nearest to another, degrees. */
function nearest(longitude: number, to: number): number {
  return longitude - 360 * Math.round((longitude - to) / 360);
}
