import { difference, type Vector } from "@groma/georef";
import type { Coordinate } from "ol/coordinate.js";
import type { EventsKey } from "ol/events.js";
import type Feature from "ol/Feature.js";
import type Draw from "ol/interaction/Draw.js";
import type { DrawEvent } from "ol/interaction/Draw.js";
import { unByKey } from "ol/Observable.js";
import type VectorSource from "ol/source/Vector.js";
import type { VectorSourceEvent } from "ol/source/Vector.js";
import { heightOf, type ScreenPlace } from "../camera/index.js";
import { placeOn } from "./geometry/index.js";
import { type GlobeLine, GlobeLines } from "./globe-lines.js";
import type { GlobeSide } from "./globe-side.js";
import type { MapSide } from "./map-side.js";
import { insertVertex, moveVertex, removeVertex, rowsOf, type Vertex, type VertexRow } from "./vertices.js";

/** Metres that a line of the map may be cut into for the globe: a chord of that length is a millimetre from the ground. */
const CHORD = 226;
/** Parts of a side at most. */
const PARTS = 256;
/** CSS pixels around a vertex or a line in which a pointer takes hold of it. */
const REACH = 10;

/** A vertex of a shared feature, or the side that begins at it. */
export interface SharedVertex extends Vertex {
  readonly feature: Feature;
}

/**
 * The features of a source of the map, drawn on the globe as well: at the heights of their coordinates where they have any
 * (metres above WGS 84), else at that of the point which the map shows there, else at that of the ground. Whatever
 * changes on the map is drawn on the globe in the next frame.
 */
export class SharedFeatures {
  readonly source: VectorSource;
  readonly #globe: GlobeSide;
  readonly #map: MapSide;
  readonly #failed: (thrown: unknown) => void;
  readonly #lines: GlobeLines<Feature>;
  readonly #keys: EventsKey[];
  readonly #end = new AbortController();
  /** Features that are being drawn, and are not in the source yet. */
  readonly #sketches = new Set<Feature>();
  readonly #changed = new Set<Feature>();
  /** Heights that were read, by feature and coordinates. */
  readonly #heights = new WeakMap<Feature, Map<string, number>>();
  #plane: unknown;
  #frame: number | undefined;
  /** Features whose heights are to be looked at. */
  readonly #unread = new Set<Feature>();
  #reading = false;

  /** @param failed called with what kept a record from being read */
  constructor(globe: GlobeSide, map: MapSide, source: VectorSource, failed: (thrown: unknown) => void) {
    this.source = source;
    this.#globe = globe;
    this.#map = map;
    this.#failed = failed;
    this.#lines = new GlobeLines(globe.scene);
    this.#plane = map.plane;
    this.#keys = [
      source.on("addfeature", ({ feature }: VectorSourceEvent) => this.#touch(feature)),
      source.on("changefeature", ({ feature }: VectorSourceEvent) => this.#touch(feature)),
      source.on("removefeature", ({ feature }: VectorSourceEvent) => this.#touch(feature)),
      source.on("clear", () => {
        for (const feature of this.#lines.features) this.#touch(feature);
      }),
    ];
    for (const feature of source.getFeatures()) this.#touch(feature);
  }

  /** Shows what an interaction draws while it is drawn. @returns what ends that */
  follow(draw: Draw): () => void {
    const keys: EventsKey[] = [];
    let watched: EventsKey | undefined;
    const ended = ({ feature }: DrawEvent) => {
      if (watched) unByKey(watched);
      this.#sketches.delete(feature);
      this.#touch(feature);
    };
    keys.push(
      draw.on("drawstart", ({ feature }: DrawEvent) => {
        this.#sketches.add(feature);
        watched = feature.on("change", () => this.#touch(feature));
        this.#touch(feature);
      }),
      draw.on("drawend", ended),
      draw.on("drawabort", ended),
    );
    this.#keys.push(...keys);
    return () => unByKey(keys);
  }

  /** Where a feature is drawn on the globe, ECEF: its vertices, and the ways of its lines. */
  placesOf(feature: Feature): ReturnType<GlobeLines<Feature>["placesOf"]> {
    return this.#lines.placesOf(feature);
  }

  /** The vertex that the globe shows nearest to a place of its picture. */
  vertexAt({ x, y }: ScreenPlace): SharedVertex | undefined {
    let nearest: SharedVertex | undefined;
    let least = REACH;
    for (const feature of this.#lines.features) {
      for (const row of rowsOf(feature.getGeometry())) {
        for (const [index, vertex] of row.vertices.entries()) {
          const place = this.#placeOf(feature, vertex);
          const at = place && this.#globe.pixelOf(place);
          const away = at ? Math.hypot(at.x - x, at.y - y) : Number.POSITIVE_INFINITY;
          if (away < least) [nearest, least] = [{ feature, row, index }, away];
        }
      }
    }
    return nearest;
  }

  /** The side of a line or ring that the globe shows nearest to a place of its picture. */
  sideAt(at: ScreenPlace): SharedVertex | undefined {
    let nearest: SharedVertex | undefined;
    let least = REACH;
    for (const feature of this.#lines.features) {
      for (const row of rowsOf(feature.getGeometry())) {
        for (let index = 0; row.joined && index < row.vertices.length - 1; index++) {
          const shown = this.#sideOf(feature, row, index).map((place) => this.#globe.pixelOf(place));
          for (let part = 1; part < shown.length; part++) {
            const [from, to] = [shown[part - 1], shown[part]];
            const away = from && to ? awayFrom(at, from, to) : Number.POSITIVE_INFINITY;
            if (away < least) [nearest, least] = [{ feature, row, index }, away];
          }
        }
      }
    }
    return nearest;
  }

  /** Moves a vertex to a place of the globe, ECEF. */
  move({ feature, ...vertex }: SharedVertex, place: Vector): void {
    const coordinate = this.coordinateOf(feature, place);
    if (coordinate) moveVertex(vertex, coordinate);
  }

  /** Puts a vertex into a side, at a place of the globe, ECEF. @returns the vertex; undefined where the map has no such place */
  insert({ feature, ...side }: SharedVertex, place: Vector): SharedVertex | undefined {
    const coordinate = this.coordinateOf(feature, place);
    return coordinate && { feature, ...insertVertex(side, coordinate) };
  }

  /** Takes a vertex out of its line or ring, where enough others are left. */
  remove(vertex: SharedVertex): void {
    removeVertex(vertex);
  }

  /** The coordinates of a place, ECEF, for a vertex of a feature; its height is kept where they cannot hold it. */
  coordinateOf(feature: Feature, place: Vector): Coordinate | undefined {
    const at = this.#map.coordinateOf(place);
    if (!at) return undefined;
    const height = heightOf(place);
    this.#heightsOf(feature).set(keyOf(at), height);
    return [at[0], at[1], height];
  }

  /** What is drawn may have to follow to another projection. */
  update(): void {
    if (this.#map.plane === this.#plane) return;
    this.#plane = this.#map.plane;
    for (const feature of this.source.getFeatures()) this.#touch(feature);
  }

  dispose(): void {
    this.#end.abort();
    unByKey(this.#keys);
    if (this.#frame !== undefined) cancelAnimationFrame(this.#frame);
    this.#lines.dispose();
  }

  #touch(feature: Feature | undefined): void {
    if (!feature || this.#end.signal.aborted) return;
    this.#changed.add(feature);
    this.#frame ??= requestAnimationFrame(() => {
      this.#frame = undefined;
      if (!this.#globe.lives) return;
      const changed = [...this.#changed];
      this.#changed.clear();
      for (const one of changed) {
        this.#show(one);
        this.#unread.add(one);
      }
      if (!this.#reading) void this.#readHeights();
    });
  }

  #show(feature: Feature): void {
    const shown = this.#sketches.has(feature) || this.source.hasFeature(feature);
    const rows = shown ? rowsOf(feature.getGeometry()) : [];
    const lines = rows.flatMap((row): GlobeLine[] => {
      const { vertices, joined } = row;
      const places = vertices.map((vertex) => this.#placeOf(feature, vertex));
      if (!places.every((place) => place !== undefined)) return [];
      const sides = joined
        ? places.slice(1).flatMap((_, index) => this.#sideOf(feature, row, index).slice(1))
        : [];
      return [{ vertices: places, way: joined ? [places[0], ...sides] : [] }];
    });
    this.#lines.show(feature, lines);
  }

  /** A side of the map's line, with places between its ends where the ground bends away from a chord. */
  #sideOf(feature: Feature, { vertices }: VertexRow, index: number): Vector[] {
    const [from, to] = [vertices[index], vertices[index + 1]];
    const [start, end] = [from, to].map((vertex) => this.#placeOf(feature, vertex));
    if (!start || !end) return [];
    const [low, high] = [from, to].map((vertex) => this.#heightOf(feature, vertex));
    const parts = Math.min(Math.ceil(Math.hypot(...difference(end, start)) / CHORD), PARTS);
    const way = [start];
    for (let part = 1; part < parts; part++) {
      const share = part / parts;
      const at = [0, 1].map((axis) => from[axis] + share * (to[axis] - from[axis]));
      const place = placeOn(this.#map.plane, at, low + share * (high - low));
      if (place) way.push(place);
    }
    return [...way, end];
  }

  #placeOf(feature: Feature, vertex: Coordinate): Vector | undefined {
    return placeOn(this.#map.plane, vertex, this.#heightOf(feature, vertex));
  }

  #heightOf(feature: Feature, vertex: Coordinate): number {
    const [x, y, z] = vertex;
    const known = z ?? this.#heights.get(feature)?.get(keyOf(vertex));
    return known ?? this.#globe.heightAt(...this.#map.plane.inverse(x, y));
  }

  #heightsOf(feature: Feature): Map<string, number> {
    const heights = this.#heights.get(feature) ?? new Map<string, number>();
    this.#heights.set(feature, heights);
    return heights;
  }

  /** Reads the heights of vertices without any from the points that the map shows there, one after the other. */
  async #readHeights(): Promise<void> {
    const { signal } = this.#end;
    this.#reading = true;
    for (const feature of this.#unread) {
      this.#unread.delete(feature);
      const vertices = rowsOf(feature.getGeometry()).flatMap((row) => row.vertices);
      const heights = this.#heightsOf(feature);
      const keys = new Set(vertices.map(keyOf));
      // Where a vertex was once, nobody asks again.
      for (const key of heights.keys()) if (!keys.has(key)) heights.delete(key);
      for (const vertex of vertices) {
        if (vertex.length > 2 || heights.has(keyOf(vertex))) continue;
        const found = await this.#pickAt(vertex);
        if (signal.aborted) return;
        if (found === undefined) continue;
        heights.set(keyOf(vertex), found);
        this.#touch(feature);
      }
    }
    this.#reading = false;
  }

  /** Height of the point that the map shows at a place, metres above WGS 84. */
  async #pickAt(coordinate: Coordinate): Promise<number | undefined> {
    const { signal } = this.#end;
    const pixel = this.#map.map.getPixelFromCoordinate(coordinate);
    try {
      const found = pixel && (await this.#map.pick([pixel[0], pixel[1]], signal));
      return found && heightOf(found);
    } catch (thrown) {
      if (!signal.aborted) this.#failed(thrown);
      return undefined;
    }
  }
}

/** Distance of a place of the picture from a piece of a line, CSS pixels. */
function awayFrom({ x, y }: ScreenPlace, from: ScreenPlace, to: ScreenPlace): number {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const along = ((x - from.x) * dx + (y - from.y) * dy) / (dx * dx + dy * dy || 1);
  const share = Math.min(Math.max(along, 0), 1);
  return Math.hypot(from.x + share * dx - x, from.y + share * dy - y);
}

function keyOf([x, y]: readonly number[]): string {
  return `${x} ${y}`;
}
