import { CrsError, PlacementError, type Truth } from "@groma/georef";
import { type NodeBounds, ROOT_KEY, type VoxelKey } from "../octree/index.js";
import type { SourceBox } from "../sources/contract/point-source.js";
import type { Appearance, NodeVertices } from "../workers/index.js";
import { type PlaceableData, type PlaneOfMap, truthInWebMercator } from "./map-truth.js";
import { NodeGeometry } from "./node-geometry.js";
import { packagedModule } from "./packaged-file.js";
import { type OctreeParts, PlacedOctree, SHARED_PAGES } from "./placed-octree.js";

/** A projection that a map is shown in. */
export interface MapProjection extends PlaneOfMap {
  /** Greatest distance of a drawn point from its exact place, nominal metres. */
  readonly tolerance: number;
}

let loaded: typeof import("./projected-truth.js") | undefined;

/** What knows the planes of maps other than Web Mercator: proj4js and what uses it. */
async function projections(): Promise<typeof import("./projected-truth.js")> {
  loaded ??= await packagedModule(() => import("./projected-truth.js"));
  return loaded;
}

/**
 * Fetches what knows the projections of maps, for those who call `sourceOf` with one before a map has shown points.
 * @throws SourceError SOURCE_MODULE
 */
export async function loadProjections(): Promise<void> {
  await projections();
}

/** What is known of a data set that is placed on maps. */
export interface MapParts extends PlaceableData {
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

  /** Source coordinates → the plane of a projection. @throws CrsError CRS_UNSUPPORTED, CRS_NOT_LOADED */
  truthIn(projection: PlaneOfMap): Truth {
    const { name } = this.#parts.source;
    const { boundingBox } = this.#map.now();
    const known = truthInWebMercator(projection, this.#map, boundingBox, name);
    if (known) return known.onMap;
    if (!loaded) throw notLoaded(projection.code);
    return loaded.truthInPlane(projection, this.#map, boundingBox, name).onMap;
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
    for (const { made, octree } of this.#entries.values()) {
      if (made) made.destroy();
      // One that is still being opened goes once it is there.
      else octree.then((late) => late.destroy()).catch(() => undefined);
    }
    this.#entries.clear();
  }

  *#made(): Generator<PlacedOctree> {
    for (const { made } of this.#entries.values()) if (made) yield made;
  }

  async #open(projection: MapProjection): Promise<PlacedOctree> {
    const { spec, crs, made, now, onGlobe } = this.#map;
    const { source } = this.#parts;
    const { plane, onMap } =
      truthInWebMercator(projection, this.#map, now().boundingBox, source.name) ??
      (await projections()).truthInPlane(projection, this.#map, now().boundingBox, source.name);
    const { boundingBox, appearance } = now();
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

function notLoaded(code: string): CrsError {
  return new CrsError({
    code: "CRS_NOT_LOADED",
    file: code,
    cause: "the projections of maps are loaded when a map first shows points, and none has",
    fix: "call and await loadProjections() before",
  });
}
