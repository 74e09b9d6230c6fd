import {
  type Crs,
  ecefToGeodetic,
  isOwnPlane,
  type MapPlane,
  PlacementError,
  pointTransform,
  type Truth,
  truthOnMap,
} from "@groma/georef";
import { type NodeBounds, ROOT_KEY, type VoxelKey } from "../octree/index.js";
import type { SourceBox } from "../sources/contract/point-source.js";
import type { Appearance, DataSetSpec, NodeVertices } from "../workers/index.js";
import { NodeGeometry } from "./node-geometry.js";
import { type OctreeParts, PlacedOctree, SHARED_PAGES } from "./placed-octree.js";

/** The plane of a map, for any data set. */
export type PlaneOfMap = Pick<MapPlane, "code" | "definition" | "metresPerUnit" | "wraps">;

/** A projection that a map is shown in. */
export interface MapProjection extends PlaneOfMap {
  /** Greatest distance of a drawn point from its exact place, nominal metres. */
  readonly tolerance: number;
}

/** What is known of a data set that is placed on maps. */
export interface MapParts {
  /** Source coordinates → ECEF. */
  readonly truth: Truth;
  /** How it is placed on the globe. */
  readonly spec: DataSetSpec;
  readonly crs: Crs;
  readonly made: (vertices: NodeVertices) => void;
  /** What may have been found out since the data set was opened. */
  readonly now: () => { readonly boundingBox: SourceBox; readonly appearance: Appearance | undefined };
  /** Sphere of a node on the globe. */
  readonly onGlobe: (key: VoxelKey) => NodeBounds;
}

interface Entry {
  readonly octree: Promise<PlacedOctree>;
  made: PlacedOctree | undefined;
  uses: number;
}

/** The octrees of a data set in the planes of maps, one for each projection, as long as views use them. */
export class MapOctrees {
  readonly #parts: OctreeParts;
  readonly #map: MapParts;
  readonly #entries = new Map<string, Entry>();

  constructor(parts: OctreeParts, map: MapParts) {
    this.#parts = parts;
    this.#map = map;
  }

  /** How the points look, as judged by a node that was loaded for a map. */
  get appearance(): Appearance | undefined {
    for (const octree of this.#made()) if (octree.loader.appearance) return octree.loader.appearance;
    return undefined;
  }

  /**
   * The octree in the plane of a projection, placed to its tolerance or the data set's own, whichever is less; its first page
   * has been read. To be given back with {@link release}.
   * @throws CrsError CRS_UNSUPPORTED where proj4js does not know the projection
   * @throws PlacementError PLACE_MAP where the points have no place in it
   * @throws SourceError, FormatError
   */
  async acquire(asked: MapProjection): Promise<PlacedOctree> {
    const tolerance = Math.min(this.#map.spec.tolerance, asked.tolerance);
    const projection = { ...asked, tolerance };
    const key = keyOf(projection);
    let entry = this.#entries.get(key);
    if (!entry) {
      this.#parts.pages.limit(SHARED_PAGES);
      entry = { octree: this.#open(projection), made: undefined, uses: 0 };
      this.#entries.set(key, entry);
    }
    entry.uses++;
    try {
      entry.made = await entry.octree;
      return entry.made;
    } catch (thrown) {
      if (this.#entries.get(key) === entry) this.#entries.delete(key);
      throw thrown;
    }
  }

  /** Source coordinates → the plane of a projection. @throws CrsError CRS_UNSUPPORTED */
  truthIn(projection: PlaneOfMap): Truth {
    const { truth, spec, crs, now } = this.#map;
    const [low, high] = spec.heights;
    const plane = this.#planeOf(projection, now().boundingBox);
    return truthOnMap(truth, plane, (low + high) / 2, crs.verticalUnit.size, this.#parts.source.name);
  }

  /** A view ends; what only it used is given up. */
  release(octree: PlacedOctree): void {
    for (const [key, entry] of this.#entries) {
      if (entry.made !== octree) continue;
      entry.uses--;
      if (entry.uses > 0) return;
      this.#entries.delete(key);
      octree.destroy();
    }
  }

  /** Goes by another box of all points from now on. */
  widen(boundingBox: SourceBox): void {
    for (const octree of this.#made()) octree.widen(boundingBox);
  }

  destroy(): void {
    for (const octree of this.#made()) octree.destroy();
    this.#entries.clear();
  }

  *#made(): Generator<PlacedOctree> {
    for (const { made } of this.#entries.values()) if (made) yield made;
  }

  async #open(projection: MapProjection): Promise<PlacedOctree> {
    const { truth, spec, crs, made, now, onGlobe } = this.#map;
    const { source } = this.#parts;
    const { boundingBox, appearance } = now();
    const plane = this.#planeOf(projection, boundingBox);
    const [low, high] = spec.heights;
    const onMap = truthOnMap(truth, plane, (low + high) / 2, crs.verticalUnit.size, source.name);
    const { cube, spacing } = source;
    const geometry = new NodeGeometry({ cube, spacing, boundingBox }, onMap, crs);
    if (!geometry.bounds(ROOT_KEY)) throw noPlace(source.name, plane.code);
    const { tolerance } = projection;
    const octree = new PlacedOctree(this.#parts, {
      ...{ geometry, made, appearance, onGlobe, spec: { ...spec, plane, tolerance } },
    });
    try {
      await octree.access.openRoot();
      return octree;
    } catch (thrown) {
      octree.destroy();
      throw thrown;
    }
  }

  #planeOf({ code, definition, metresPerUnit, wraps }: PlaneOfMap, { min, max }: SourceBox): MapPlane {
    const [x, y, z] = [0, 1, 2].map((axis) => (min[axis] + max[axis]) / 2);
    const place = new Float64Array(3);
    pointTransform(this.#map.truth)(x, y, z, place, 0);
    ecefToGeodetic(place[0], place[1], place[2], place);
    const plane = {
      code,
      definition,
      metresPerUnit,
      wraps,
      middle: Number.isFinite(place[0]) ? place[0] : 0,
    };
    const box = { minX: min[0], minY: min[1], maxX: max[0], maxY: max[1] };
    const body = this.#map.spec.similarity !== undefined;
    return { ...plane, own: !body && isOwnPlane(this.#map.crs, plane, box) };
  }
}

function keyOf({ code, definition, tolerance }: MapProjection): string {
  return JSON.stringify([code, definition, tolerance]);
}

/** A data set, or a part of it, that a projection has no place for. */
export function noPlace(file: string, code: string): PlacementError {
  return new PlacementError({
    code: "PLACE_MAP",
    file,
    cause: `part of it has no place in the projection of the map, ${code}`,
    fix: "Show the map in a projection that covers it, for example that of its own coordinate system",
  });
}
