import type { Crs } from "@groma/georef";
import type { SourceSpace } from "../clips/index.js";
import type { StyledAttribute } from "../effects/index.js";
import type { PointOrigin } from "../query/index.js";

/** What is known of points besides their records: where they lie, which clips of the globe ask for, their attributes and system. */
export interface KnownPoints {
  readonly space?: SourceSpace | undefined;
  readonly attributes?: readonly StyledAttribute[] | undefined;
  readonly crs?: Crs | undefined;
}

/** What an origin itself tells; a `PointCloud` tells all of it. */
export function knownOf(origin: PointOrigin): KnownPoints {
  const space =
    "place" in origin && "boundingBox" in origin ? (origin as PointOrigin & SourceSpace) : undefined;
  const attributes = "attributes" in origin ? (origin as KnownPoints).attributes : undefined;
  const crs = "crs" in origin ? (origin as KnownPoints).crs : undefined;
  return { space, attributes, crs };
}
