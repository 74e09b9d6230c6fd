import { type Crs, ecefToGeodetic, geodesicBetween, PlacementError } from "@groma/georef";
import { Clip, type ClipMode, type SourceSpace } from "../../clips/index.js";
import { Pace, type PointBatch, type PointOrigin } from "../../query/index.js";
import { type LineOnEllipsoid, lineOnEllipsoid } from "../ellipsoid/line-on-ellipsoid.js";
import { CorridorOnEllipsoid, CrossSectionsOnEllipsoid, type Geodetic } from "../ellipsoid/on-ellipsoid.js";
import { Corridor } from "../profile/corridor.js";
import { sourceLine } from "../profile/source-line.js";
import type { CrossSections } from "../sections/cross-sections.js";
import { stripRings } from "./strip-rings.js";

/** What a profile is cut from; a `PointCloud` is one. */
export interface ProfiledCloud extends PointOrigin, SourceSpace {
  readonly crs: Pick<Crs, "horizontalUnit" | "verticalUnit">;
}

/** Where a profile runs. */
export interface ProfileOptions {
  /** Longitude and latitude of each vertex, WGS 84, radians. */
  readonly line: readonly (readonly [number, number])[];
  /** Of the whole strip, metres in the plane in which points are decided. */
  readonly width: number;
  /**
   * How chainage is counted: in the plane of the data set's coordinates, or along the geodesics of WGS 84 between the
   * vertices, and in proportion between them. Default: `grid`.
   */
  readonly chainage?: "grid" | "geodesic" | undefined;
  /** Chainage at the start of the line, metres. Default: 0. */
  readonly start?: number | undefined;
  /**
   * In which plane points are decided. Default: that of the data set's coordinates, or one of the ellipsoid where these are
   * angles. Profiles of data sets of several systems have the one of the ellipsoid in common.
   */
  readonly plane?: "source" | "ellipsoid" | undefined;
}

/** Points of a node that come at a time: so many are drawn, and made fit to be found, within some milliseconds. */
const PART = 16_384;

/** Points between two looks at the clock. */
const SLICE = 2048;

/** Points of a profile from one node, all or some of them, along the line. */
export interface ProfilePoints {
  readonly batch: PointBatch;
  /** Metres along the line, as the profile counts them. */
  readonly chainage: Float64Array;
  /** Metres from the line, left positive. */
  readonly offset: Float64Array;
  /** Source z, metres. */
  readonly height: Float64Array;
}

/** A line in a plane of the ellipsoid, and what brings the data set's points there. */
interface PlacedLine extends LineOnEllipsoid {
  readonly geodetic: Geodetic;
}

/**
 * All points in a strip along a line that is given by longitude and latitude. What it selects goes as it is to the
 * functions of `@groma/layer/export`.
 *
 * Points are decided in a plane: that of the data set's coordinates, or, where these are angles, the transverse Mercator plane of
 * WGS 84 about the middle of the line, as `groma profile` does.
 */
export class Profile {
  readonly origin: ProfiledCloud;
  /** The strip in its plane. */
  readonly strip: Corridor;
  /** The strip, asked about source coordinates. */
  readonly volume: Corridor | CorridorOnEllipsoid;
  /** Metres in a unit of lengths of the plane. */
  readonly unit: number;
  /** Where the plane lies that is not that of the data set's coordinates. */
  readonly #ellipsoid: PlacedLine | undefined;

  /**
   * @throws PlacementError PLACE_DOMAIN where a vertex has no place in the data set's coordinates, PLACE_ANGLES where
   * these are angles and their own plane is asked for, PLACE_LINE where the line has no length, or
   * reaches too far on the ellipsoid, or the width is none
   */
  constructor(cloud: ProfiledCloud, { line, width, chainage = "grid", start = 0, plane }: ProfileOptions) {
    const { horizontalUnit } = cloud.crs;
    const refuse = (code: string, cause: string, fix: string) =>
      new PlacementError({ code, file: cloud.name, cause, fix });
    const angular = horizontalUnit.kind === "angular";
    if (angular && plane === "source") {
      const cause = "its coordinates are angles, in which no width is the same everywhere";
      throw refuse("PLACE_ANGLES", cause, "Have points decided on the ellipsoid");
    }
    this.origin = cloud;
    const onEllipsoid = angular || plane === "ellipsoid";
    this.#ellipsoid = onEllipsoid
      ? { ...lineOnEllipsoid(line, cloud.name), geodetic: geodeticOf(cloud) }
      : undefined;
    this.unit = onEllipsoid ? 1 : horizontalUnit.size;
    const vertices = this.#ellipsoid?.vertices ?? sourceLine(cloud, line, cloud.name);
    try {
      const { unit } = this;
      const lengths =
        chainage === "geodesic" ? geodesicLengths(line).map((metres) => metres / unit) : undefined;
      this.strip = new Corridor(vertices, width / unit, { lengths, start: start / unit });
    } catch (thrown) {
      if (!(thrown instanceof RangeError)) throw thrown;
      throw refuse("PLACE_LINE", thrown.message, "Give two or more different vertices, and a width above 0");
    }
    this.volume = this.#ellipsoid
      ? new CorridorOnEllipsoid(this.strip, ...this.#around(this.#ellipsoid))
      : this.strip;
  }

  #around({ plane, geodetic }: PlacedLine) {
    return [plane, geodetic, this.origin.boundingBox] as const;
  }

  /** The line along which points are located. */
  get along(): Corridor | CorridorOnEllipsoid {
    return this.volume;
  }

  /** Longitude and latitude about which the plane of the ellipsoid lies, radians; undefined: the data set's own plane. */
  get middle(): readonly [number, number] | undefined {
    return this.#ellipsoid?.middle;
  }

  /** Chainage at the start of the line, metres. */
  get from(): number {
    return this.strip.chainages[0] * this.unit;
  }

  /** Length of the line, metres, as the profile counts them. */
  get length(): number {
    return this.strip.length * this.unit;
  }

  /** Cross-sections of {@link strip}, asked about source coordinates. */
  across(sections: CrossSections): CrossSections | CrossSectionsOnEllipsoid {
    return this.#ellipsoid
      ? new CrossSectionsOnEllipsoid(sections, ...this.#around(this.#ellipsoid))
      : sections;
  }

  /**
   * The strip as clips, to highlight it in a scene or to show it alone. They are for the eye: corners are mitred.
   * @param mode of all of them; `inside` keeps their union
   */
  clips(mode: ClipMode): Clip[] {
    const ellipsoid = this.#ellipsoid;
    const out = new Float64Array(2);
    return stripRings(this.strip).map((ring) => {
      if (!ellipsoid) return Clip.polygon(ring, { mode, coordinates: "source" });
      const geodetic = ring.map(([x, y]) => {
        ellipsoid.plane.toGeodetic(x, y, out);
        return [out[0], out[1]] as const;
      });
      return Clip.polygon(geodetic, { mode });
    });
  }

  /** Where source coordinates are in the plane: x and y in its units, written to `out`. */
  toPlane(x: number, y: number, z: number, out: Float64Array): void {
    if (this.volume instanceof CorridorOnEllipsoid) this.volume.toPlane(x, y, z, out);
    else out.set([x, y]);
  }

  /**
   * Where a place of the plane is: ECEF, metres, written to `out`.
   * @param z source z
   * @throws PlacementError PLACE_DOMAIN
   */
  place(x: number, y: number, z: number, out: Float64Array): void {
    if (!this.#ellipsoid) {
      this.origin.place(x, y, z, out);
      return;
    }
    this.#ellipsoid.plane.toGeodetic(x, y, out);
    const [[sourceX, sourceY]] = sourceLine(this.origin, [[out[0], out[1]]], this.origin.name);
    this.origin.place(sourceX, sourceY, z, out);
  }

  /**
   * Reads the points, coarser nodes first, each point once; those of a node come a part at a time, with pauses, so that
   * whoever shows them does not hold up the page.
   * @param options with `spacing`, metres that suffice between neighbouring points
   * @throws SourceError, FormatError, DecodeError; the signal's reason when aborted
   */
  async *points(
    options: { readonly signal?: AbortSignal | undefined; readonly spacing?: number | undefined } = {},
  ): AsyncGenerator<ProfilePoints, void> {
    const { scale, offset: origin, crs } = this.origin;
    const { unit } = this;
    const place = new Float64Array(2);
    const query = this.origin.query({ volume: this.volume, spacing: options.spacing });
    const pace = new Pace(options.signal);
    for await (const batch of query.batches({ signal: options.signal })) {
      const { xyz } = batch.records;
      for (let from = 0; from < batch.inside.length; from += PART) {
        const inside = batch.inside.subarray(from, from + PART);
        const [chainage, offset, height] = [0, 1, 2].map(() => new Float64Array(inside.length));
        for (let index = 0; index < inside.length; index++) {
          if (index % SLICE === 0) await pace.rest();
          const at = 3 * inside[index];
          const x = xyz[at] * scale[0] + origin[0];
          const y = xyz[at + 1] * scale[1] + origin[1];
          const z = xyz[at + 2] * scale[2] + origin[2];
          this.volume.locate(x, y, place, z);
          chainage[index] = place[0] * unit;
          offset[index] = place[1] * unit;
          height[index] = z * crs.verticalUnit.size;
        }
        await pace.rest();
        yield { batch: { ...batch, inside }, chainage, offset, height };
      }
    }
  }
}

function geodeticOf(cloud: SourceSpace): Geodetic {
  const ecef = new Float64Array(3);
  return (x, y, z, out) => {
    cloud.place(x, y, z, ecef);
    ecefToGeodetic(ecef[0], ecef[1], ecef[2], out);
  };
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
