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
 * The sides of a data set's box on the ground, at its middle height, in a projection; in one piece across 180°. Places that
 * either of the two systems does not have are left out; undefined where less than a triangle is left.
 * @throws CrsError CRS_PROJECTION where the projection is not registered
 */
export function outlineOf(cloud: PointCloud, projection: ProjectionLike): Polygon | undefined {
  const known = projectionOf(projection);
  const toMap = known && getTransform("EPSG:4326", known);
  if (!toMap) throw notRegistered(known?.getCode() ?? String(projection), cloud.name);
  const { min, max } = cloud.boundingBox;
  const z = (min[2] + max[2]) / 2;
  const corners = [
    [min[0], min[1]],
    [max[0], min[1]],
    [max[0], max[1]],
    [min[0], max[1]],
  ];
  const place = new Float64Array(3);
  let near: number | undefined;
  const ring: number[][] = [];
  for (const [side, [x, y]] of corners.entries()) {
    const [toX, toY] = corners[(side + 1) % corners.length];
    for (let step = 0; step < SIDE; step++) {
      const share = step / SIDE;
      if (!placeOf(cloud, [x + share * (toX - x), y + share * (toY - y), z], place)) continue;
      const [longitude, latitude] = [place[0], place[1]].map((angle) => (angle * 180) / Math.PI);
      near ??= longitude;
      const turns = Math.round((near - longitude) / 360);
      const at = toMap([longitude + 360 * turns, latitude], undefined, 2);
      if (at.every(Number.isFinite)) ring.push(at);
    }
  }
  return ring.length < 3 ? undefined : new Polygon([[...ring, ring[0]]]);
}

/** Source coordinates → longitude and latitude, radians; false where they have no place. */
function placeOf(cloud: PointCloud, [x, y, z]: readonly number[], place: Float64Array): boolean {
  try {
    cloud.place(x, y, z, place);
  } catch (thrown) {
    if (thrown instanceof PlacementError) return false;
    throw thrown;
  }
  ecefToGeodetic(place[0], place[1], place[2], place);
  return true;
}
