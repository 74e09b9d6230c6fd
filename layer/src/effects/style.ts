import type { ClassTable } from "./classes.js";
import { ASPRS_CLASSES } from "./classes.js";
import type { GradientName, GradientStop } from "./gradients.js";

/**
 * What a point's colour shows: the scan's own colours, the level of the most detailed node drawn around the point, or
 * the name of an attribute (`elevation`, `intensity`, `classification`, `gpsTime`, any extra byte …).
 */
export type ColourBy = "rgb" | "levelOfDetail" | "elevation" | "intensity" | "classification" | (string & {});

/** How the size of a point comes about (thesis, 4.3). */
export type SizeMode = "fixed" | "attenuated" | "adaptive";

/** What a point is drawn as (thesis, 4.2). */
export type PointShape = "square" | "disc" | "paraboloid";

/** Eye-Dome Lighting in numbers (thesis, 4.4). */
export interface EyeDomeLighting {
  /** `edlStrength` of eq. 4.6. Default: 0.4. */
  readonly strength: number;
  /** Distance of the neighbours, CSS pixels. Default: 1.4. */
  readonly radius: number;
  /** Default: 4. */
  readonly neighbours: 4 | 8;
}

/** Strength, radius and neighbours where only on or off was said. */
export const EYE_DOME_LIGHTING: EyeDomeLighting = { strength: 0.4, radius: 1.4, neighbours: 4 };

/** How points are drawn. */
export interface PointCloudStyle {
  /** Default: `rgb` where the scan has colours, else `elevation`. */
  readonly color: ColourBy;
  /** A second colouring mixed in with the share given, 0 to 1. Default: none. */
  readonly blend: { readonly color: ColourBy; readonly share: number } | undefined;
  /** Colours of scalar attributes. Default: `auto`, which is greyscale for intensity and viridis for all others. */
  readonly gradient: "auto" | GradientName | readonly GradientStop[];
  /** Values at the ends of the gradient, in the attribute's unit. Default: what the data set's statistics say. */
  readonly range: readonly [number, number] | undefined;
  /** Exponent over colours, and over values before the gradient; 0.1 to 10. Default: 1. */
  readonly gamma: number;
  /** Added after gamma; −1 to 1. Default: 0. */
  readonly brightness: number;
  /** Steepness around the middle: −1 flattens to grey, 0 leaves as it is, 1 is a step. Default: 0. */
  readonly contrast: number;
  /** Names, colours and visibility of classes; those given replace single ones of ASPRS' table. */
  readonly classes: ClassTable;
  /** Default: `fixed`. */
  readonly size: SizeMode;
  /** Width of a point where the size is fixed, CSS pixels, 1 to 64. Default: 2. */
  readonly pointSize: number;
  /**
   * Width of a point as a multiple of the spacing where the size is attenuated or adaptive, 0.1 to 10. 1 closes a square
   * grid of squares, √2 one of discs. 2 closes any maximal Poisson-disc sample, in which a radius of one spacing around
   * each point leaves nothing out; it is the radius of eq. 4.4 of the thesis. Default: 2.
   */
  readonly spacingFactor: number;
  /** Least width where the size is attenuated or adaptive, CSS pixels. Default: 1. */
  readonly minimumSize: number;
  /** Greatest width where the size is attenuated or adaptive, CSS pixels. Default: 50. */
  readonly maximumSize: number;
  /** Default: `square`. */
  readonly shape: PointShape;
  /** Blends overlapping points in three passes (thesis, 4.2.2); `auto`: where they overlap by 3 px. Default: false. */
  readonly highQuality: boolean | "auto";
  /** Exponent of a splat's weight, eq. 4.1; 0.5 to 50. Default: 2. */
  readonly hardness: number;
  /** Shading by depth (thesis, 4.4); `auto`: where colours do not show the shape. Default: false. */
  readonly eyeDomeLighting: boolean | "auto" | EyeDomeLighting;
  /** 0 to 1. Default: 1. */
  readonly opacity: number;
  /** Colour, and its share, of points inside volumes that highlight. Default: red, 0.6. */
  readonly highlight: { readonly color: readonly [number, number, number]; readonly share: number };
  /** Breaks up bands of 8-bit colour by noise of half a step. Default: false. */
  readonly dithering: boolean;
}

/** The style of a layer that was given none. */
export function defaultStyle(hasColour: boolean): PointCloudStyle {
  return {
    color: hasColour ? "rgb" : "elevation",
    blend: undefined,
    gradient: "auto",
    range: undefined,
    gamma: 1,
    brightness: 0,
    contrast: 0,
    classes: ASPRS_CLASSES,
    size: "fixed",
    pointSize: 2,
    spacingFactor: 2,
    minimumSize: 1,
    maximumSize: 50,
    shape: "square",
    highQuality: false,
    hardness: 2,
    eyeDomeLighting: false,
    opacity: 1,
    highlight: { color: [1, 0, 0], share: 0.6 },
    dithering: false,
  };
}

/** The numbers of Eye-Dome Lighting that a style asks for, on or off. */
export function eyeDomeOf(style: PointCloudStyle): EyeDomeLighting {
  return typeof style.eyeDomeLighting === "object" ? style.eyeDomeLighting : EYE_DOME_LIGHTING;
}
