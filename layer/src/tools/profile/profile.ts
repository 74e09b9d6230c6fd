import { type Crs, geodesicBetween, PlacementError } from "@groma/georef";
import type { SourceSpace } from "../../clips/index.js";
import type { PointBatch, PointOrigin } from "../../query/index.js";
import { Corridor } from "./corridor.js";
import { sourceLine } from "./source-line.js";

/** What a profile is cut from; a `PointCloud` is one. */
export interface ProfiledCloud extends PointOrigin, SourceSpace {
  readonly crs: Pick<Crs, "horizontalUnit" | "verticalUnit">;
}

/** Where a profile runs. */
export interface ProfileOptions {
  /** Longitude and latitude of each vertex, WGS 84, radians. */
  readonly line: readonly (readonly [number, number])[];
  /** Of the whole strip, metres in the plane of the data set's coordinates. */
  readonly width: number;
  /**
   * How chainage is counted: in the plane of the data set's coordinates, or along the geodesics of WGS 84 between the
   * vertices, and in proportion between them. Default: `grid`.
   */
  readonly chainage?: "grid" | "geodesic" | undefined;
  /** Chainage at the start of the line, metres. Default: 0. */
  readonly start?: number | undefined;
}

/** Points of a profile from one node, along the line. */
export interface ProfilePoints {
  readonly batch: PointBatch;
  /** Metres along the line, as the profile counts them. */
  readonly chainage: Float64Array;
  /** Metres from the line, left positive. */
  readonly offset: Float64Array;
  /** Source z, metres. */
  readonly height: Float64Array;
}

/**
 * All points in a strip along a line that is given by longitude and latitude. What it selects goes as it is to the
 * functions of `@groma/layer/export`.
 */
export class Profile {
  readonly origin: ProfiledCloud;
  /** The strip, in source coordinates and their units. */
  readonly volume: Corridor;

  /**
   * @throws PlacementError PLACE_DOMAIN where a vertex has no place in the data set's coordinates, PLACE_ANGLES where
   * these are angles, PLACE_LINE where the line has no length or the width is none
   */
  constructor(cloud: ProfiledCloud, { line, width, chainage = "grid", start = 0 }: ProfileOptions) {
    const { horizontalUnit } = cloud.crs;
    const refuse = (code: string, cause: string, fix: string) =>
      new PlacementError({ code, file: cloud.name, cause, fix });
    if (horizontalUnit.kind === "angular") {
      const cause = "its coordinates are angles, in which no width is the same everywhere";
      throw refuse("PLACE_ANGLES", cause, "Convert the scan to a projected system first");
    }
    this.origin = cloud;
    const vertices = sourceLine(cloud, line, cloud.name);
    try {
      const { size } = horizontalUnit;
      const lengths =
        chainage === "geodesic" ? geodesicLengths(line).map((metres) => metres / size) : undefined;
      this.volume = new Corridor(vertices, width / size, { lengths, start: start / size });
    } catch (thrown) {
      if (!(thrown instanceof RangeError)) throw thrown;
      throw refuse("PLACE_LINE", thrown.message, "Give two or more different vertices, and a width above 0");
    }
  }

  /** The line along which points are located; that of the strip. */
  get along(): Corridor {
    return this.volume;
  }

  /** Chainage at the start of the line, metres. */
  get from(): number {
    return this.volume.chainages[0] * this.origin.crs.horizontalUnit.size;
  }

  /** Length of the line, metres, as the profile counts them. */
  get length(): number {
    return this.volume.length * this.origin.crs.horizontalUnit.size;
  }

  /**
   * Reads the points, coarser nodes first, each point once.
   * @param options with `spacing`, metres that suffice between neighbouring points
   * @throws SourceError, FormatError, DecodeError; the signal's reason when aborted
   */
  async *points(
    options: { readonly signal?: AbortSignal | undefined; readonly spacing?: number | undefined } = {},
  ): AsyncGenerator<ProfilePoints, void> {
    const { scale, offset: origin, crs } = this.origin;
    const { size } = crs.horizontalUnit;
    const place = new Float64Array(2);
    const query = this.origin.query({ volume: this.volume, spacing: options.spacing });
    for await (const batch of query.batches({ signal: options.signal })) {
      const { xyz } = batch.records;
      const { inside } = batch;
      const [chainage, offset, height] = [0, 1, 2].map(() => new Float64Array(inside.length));
      for (let index = 0; index < inside.length; index++) {
        const at = 3 * inside[index];
        this.volume.locate(xyz[at] * scale[0] + origin[0], xyz[at + 1] * scale[1] + origin[1], place);
        chainage[index] = place[0] * size;
        offset[index] = place[1] * size;
        height[index] = (xyz[at + 2] * scale[2] + origin[2]) * crs.verticalUnit.size;
      }
      yield { batch, chainage, offset, height };
    }
  }
}

/**
 * Lengths of the geodesics of WGS 84 between the vertices of a line, metres.
 * @param line longitude and latitude of each, radians
 */
export function geodesicLengths(line: ProfileOptions["line"]): number[] {
  return line.slice(1).map(([longitude, latitude], index) => {
    const [fromLongitude, fromLatitude] = line[index];
    return geodesicBetween(fromLongitude, fromLatitude, longitude, latitude).distance;
  });
}
