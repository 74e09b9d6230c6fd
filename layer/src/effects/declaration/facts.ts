import type { AccuracyPart } from "@groma/georef";
import type { PointFilter } from "./filter.js";
import type { StyledAttribute } from "./option.js";

/** What is known of the placing of a data set and of the nodes drawn, metres. */
export interface PlacingFacts {
  /** Greatest distance that the data set allows a drawn point from its exact place. */
  readonly tolerance: number;
  /** Longest edge of a drawn node's box. */
  readonly nodeEdge: number;
  /** Number of drawn nodes by their placing scheme. */
  readonly schemes: Readonly<Record<string, number>>;
  /** Worst certified bound of a drawn node. */
  readonly bound: number;
  /** Of that, what rounding to float32 may cost, and to whole steps where positions are stored so. */
  readonly storageBound: number;
  /** Number of drawn nodes whose positions are stored at whole steps, 8 bytes a point, and as float32, 12 bytes. */
  readonly stored: { readonly steps: number; readonly floats: number };
  /** What heights are measured from. */
  readonly heights: "ellipsoidal" | "geoid" | "unknown";
  /** Height over the ellipsoid of source height 0, at the data set's middle. */
  readonly undulation: number;
  /** A length on the ground over that in source coordinates, less 1; undefined for angles. */
  readonly scaleDeviation: number | undefined;
  /** Named parts of the stated accuracy. */
  readonly parts: readonly AccuracyPart[];
}

/** All numbers that the magnitudes of effects are computed from: one frame of one layer. */
export interface SceneFacts {
  /** Of the drawing buffer, pixels. */
  readonly viewportHeight: number;
  /** Drawing-buffer pixels per CSS pixel. */
  readonly pixelRatio: number;
  readonly nodes: number;
  readonly points: number;
  /**
   * Least and greatest distance between neighbouring points, drawing-buffer pixels, of the drawn nodes that are the
   * finest somewhere in the picture; the others' points lie among those of their children.
   */
  readonly spacings: readonly [number, number];
  /** Least and greatest level of these nodes. */
  readonly levels: readonly [number, number];
  /** Least and greatest distance between neighbouring points of these nodes, metres on the ground. */
  readonly groundSpacings: readonly [number, number];
  /** Distance between neighbouring points that one size on the ground has to bridge, metres; see `groundSpacing`. */
  readonly groundSpacing: number;
  /** Drawing-buffer pixels that a metre takes at the nearest of these nodes that the camera is not in. */
  readonly pixelsPerMetre: number;
  /** Step of the depth buffer at the farthest node, as a share of the distance. */
  readonly depthStep: number;
  /** Step that a linear depth buffer of the scene's near and far plane would have at the farthest node, on screen, pixels. */
  readonly depthStepPixels?: number | undefined;
  /** Whether the depth buffer is logarithmic. */
  readonly logarithmicDepth?: boolean | undefined;
  /** Measured share of pixels whose depth steps by 1 % or more; undefined where it was not measured. */
  readonly silhouettes?: number | undefined;
  /** Volumes that cut. */
  readonly clips: number;
  /** Volumes that highlight. */
  readonly highlights: number;
  readonly filter?: PointFilter | undefined;
  readonly attributes: readonly StyledAttribute[];
  readonly placing?: PlacingFacts | undefined;
  /** What a drawn point may be off on screen at most, drawing-buffer pixels. */
  readonly placingPixels?: number | undefined;
}

/** How a column's stored numbers become values: stored · scale + offset, or one value for all points. */
export interface ColumnScale {
  readonly scale: number;
  readonly offset: number;
  readonly constant?: readonly number[] | undefined;
}

/** What the effects must know of a node to draw it; it stays as long as its points are there. */
export interface StyledNode {
  /** Its columns by name, at least those that the program's attributes name. */
  readonly columns: { get(name: string): ColumnScale | undefined };
  /** Level in the octree. */
  readonly level: number;
  /** Distance of its points on the ground, metres. */
  readonly spacing: number;
  /** Length that its positions are stored in, metres; undefined where they are metres. */
  readonly step?: number | undefined;
  /** 3 × 4, row by row: node frame → its own cube, 0 to 1. */
  readonly toCube: ArrayLike<number>;
}
