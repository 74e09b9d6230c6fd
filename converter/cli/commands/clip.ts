import type { QueryVolume } from "@groma/layer/tools";
import type { CutRequest } from "../cut/cut.js";
import { readPolygon } from "../cut/geojson.js";
import { type NarrowingOptions, narrowing } from "../cut/narrowing.js";
import { type GivenCrs, inSource, requireCommonPlane } from "../cut/place.js";
import { box, polygon, slice } from "../cut/volumes.js";
import type { CutOptions } from "../cut/writers.js";
import type { ProgressKind } from "../given/choices.js";
import { tellCut } from "./cut.js";

export interface ClipCommandOptions extends CutOptions, NarrowingOptions {
  /** GeoJSON file with the polygon. */
  readonly polygon?: string;
  readonly polygonCrs: GivenCrs;
  /** Least, then greatest coordinates, source units: four or six numbers. */
  readonly box?: readonly number[];
  /** Lower and upper source z: what lies between, and on them, is kept. */
  readonly heights?: readonly number[];
  readonly progress?: ProgressKind;
}

/** The `clip` command: all points in a polygon, a box or other volumes, or that a filter leaves, as one file. */
export async function runClip(files: readonly string[], options: ClipCommandOptions): Promise<void> {
  const { polygon: file, polygonCrs } = options;
  const rings = file === undefined ? undefined : await readPolygon(file);
  const { heights } = options;
  const upright = options.box && box(options.box);
  const sliced = (volume: QueryVolume | undefined) => (heights ? slice(heights, volume) : volume);
  const narrow = await narrowing(options);
  const inSourceCoordinates = upright ? "--box" : polygonCrs === "source" ? file : undefined;
  const select: CutRequest["select"] = async (origin, all) => {
    if (inSourceCoordinates !== undefined) await requireCommonPlane(all, inSourceCoordinates);
    if (!rings || file === undefined) return narrow({ origin, volume: sliced(upright) });
    const inPlane = await Promise.all(rings.map((ring) => inSource(ring, polygonCrs, origin, file)));
    const volume = polygon(
      inPlane.map(({ positions }) => positions),
      file,
    );
    return narrow({ origin, volume: sliced(volume) });
  };
  await tellCut("clip", files, options, { select, given: [file, options.clips] });
}
