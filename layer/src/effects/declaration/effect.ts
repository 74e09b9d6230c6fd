import type { SceneFacts, StyledNode } from "./facts.js";
import type { AttributeKind, Option } from "./option.js";
import type { PointPass, ShaderTarget, TextureData, UniformDeclaration, UniformValues } from "./shader.js";

/** Where a colour comes from. */
export interface Colouring extends Pick<Colours, "toned" | "smooth"> {
  /** Name of the effect that shows it. */
  readonly effect: string;
  /** The column read; undefined where it is none. */
  readonly column: string | undefined;
  /** Share of a point's colour, 0 to 1. */
  readonly share: number;
}

/** A style and the frame that it is drawn in. */
export interface Scene<Style> {
  readonly style: Style;
  readonly facts: SceneFacts;
  /** Where the colour of a point comes from: one colouring, or the two that are blended. */
  readonly colourings: readonly Colouring[];
  /** Width of the widest points on screen, drawing-buffer pixels. */
  readonly width: number;
  /** Pixels by which neighbouring points overlap where they do most. */
  readonly overlap: number;
}

/** What of a scene stays from frame to frame until the style or the filter changes. */
export interface StyledScene<Style> extends Pick<Scene<Style>, "style" | "colourings"> {
  readonly facts: Pick<SceneFacts, "attributes" | "filter">;
}

/** Whether a scene asks for an effect: `asked` and `auto` run from the threshold on, `forced` always, `off` never. */
export interface Wish {
  readonly kind: "asked" | "auto" | "forced" | "off";
  readonly why: string;
}

/** What an effect is made of, as types. */
export interface Signature {
  readonly name: string;
  /** Properties of the style that are declared with it. */
  readonly own?: object;
  /** Properties of the style that it reads besides. */
  readonly reads?: object;
  /** Words of `color`, `size` or `shape` that ask for it. */
  readonly words?: Partial<Record<"color" | "size" | "shape", string>>;
  /** What of the scene its program depends on. */
  readonly variant?: unknown;
}

type Member<S, Key extends string, Else> = S extends Readonly<Record<Key, infer Type>> ? Type : Else;
type Own<S> = Member<S, "own", unknown>;
type StyleOf<S> = Own<S> & Member<S, "reads", unknown>;
type Variant<S> = Member<S, "variant", undefined>;

/** How wide points are, as an effect of the group `sizes` draws them. */
export interface Widths<Style> {
  /** Width of the widest points on screen, drawing-buffer pixels. */
  widest(scene: Pick<Scene<Style>, "style" | "facts">): number;
  /** Pixels by which neighbouring points of that width overlap. */
  overlap(width: number, scene: Pick<Scene<Style>, "style" | "facts">): number;
  /** Width that no point passes, CSS pixels. */
  limit(style: Style): number;
}

/** What an effect that colours points says of its colours. */
export interface Colours {
  /** Whether it shows what a style's `color` names. @param kind of the attribute of that name; undefined: there is none */
  shows(color: string, kind: AttributeKind | undefined): boolean;
  /** Whether gamma, brightness and contrast change them. */
  readonly toned?: boolean;
  /** Whether they are steps of one row, in which bands show. */
  readonly smooth?: boolean;
}

/** A part of the picture that could be left out: all that is to be known of it. */
export interface Effect<S extends Signature> {
  readonly name: S["name"];
  readonly unit: "px" | "share" | "1" | "m" | "levels";
  /** From this magnitude on it runs. */
  readonly threshold: number;
  /** Formula of the magnitude and where it comes from. */
  readonly source: string;
  /** Properties of the style that are declared with it. */
  readonly options: { readonly [Key in keyof Own<S>]: Option<Own<S>[Key]> };
  /** Words of the style that ask for it. */
  readonly words?: Member<S, "words", never>;
  /**
   * Effects that exclude each other: of several that would run, the last in the catalogue does. Colours exclude each
   * other for each colouring of a blend.
   */
  readonly group?: "colours" | "sizes" | "shapes";
  /**
   * Where it works: in the program of the points, which is the default; in a quad that shows a picture of the points; or
   * in passes over the points that fill that picture.
   */
  readonly pass?: "points" | "quad" | readonly [PointPass, ...PointPass[]];
  /** Whether a later one of its passes reads the depths of the first, of which it is given a copy, `u_front`. */
  readsFront?(variant: Variant<S>): boolean;
  /** Whether the scene shows through the points. */
  readonly translucent?: boolean;
  /** What `forced` may say of it: on and off, which is the default, or `off`, or nothing. */
  readonly forcible?: "off" | "never";
  /** What of the drawn nodes it reads in a texture: `u_octree` or `u_clips`. */
  readonly nodeTexture?: "octree" | "clips";
  readonly colours?: Colours;
  readonly widths?: Widths<StyleOf<S>>;
  wish(scene: Scene<StyleOf<S>>): Wish;
  /** How much the picture would change without it, in {@link unit}. */
  magnitude(scene: Scene<StyleOf<S>>): number;
  /** Why it runs where no other of its group does; undefined: it does not. */
  lastResort?(style: StyleOf<S>): string | undefined;
  /** What of the scene its program depends on: part of the program's key, which {@link part} and {@link quad} are given. */
  variant?(scene: Scene<StyleOf<S>>): Variant<S>;
  /** What it adds to the point program of a pass; undefined where nothing. */
  part?(context: PartContext<Variant<S>>): Part | undefined;
  /** What it adds to the program of the quad. */
  quad?(context: QuadContext<Variant<S>>): QuadPart;
  /** Values of its uniforms that hold for all nodes. */
  values?(scene: Scene<StyleOf<S>>): UniformValues;
  /** Values of its uniforms for a node, as long as style and filter stay. */
  nodeValues?(scene: StyledScene<StyleOf<S>>, node: StyledNode): UniformValues;
  /** Textures that style and filter fill. */
  textures?(scene: Scene<StyleOf<S>>): readonly TextureData[];
}

/**
 * Where in the vertex shader's `main` statements go, in this order: what is known of the point (`locate`), whether it is
 * drawn, its colour, its place on screen, what is known there (`measure`), its size, shifts, and what fragments get.
 */
export const VERTEX_STAGES = [
  "locate",
  "cull",
  "color",
  "project",
  "measure",
  "size",
  "place",
  "deepen",
  "hand",
] as const;
/** Stages whose lines several effects may need and that come in once. */
export const SHARED_STAGES: readonly string[] = ["locate", "measure"];
/** Where in the fragment shader's `main` statements go, in this order. */
export const FRAGMENT_STAGES = ["shape", "output", "finish", "depth"] as const;
/** Where in the quad's `main` statements go: the picture's `sum` becomes `color`, which is shaded and finished. */
export const QUAD_STAGES = ["resolve", "shade", "output", "finish"] as const;

/** A value that goes from the vertex to the fragment shader. */
export interface Varying {
  readonly name: string;
  readonly type: "float" | "vec2" | "vec3" | "vec4" | "uint";
  readonly flat?: boolean;
}

/** What one effect adds to a program for points. A function that several effects need comes in once. */
export interface Part {
  readonly attributes?: readonly {
    readonly column: string;
    readonly components: 1 | 2 | 3 | 4;
    readonly normalized: boolean;
  }[];
  readonly uniforms?: readonly UniformDeclaration[];
  readonly varyings?: readonly Varying[];
  readonly vertexFunctions?: readonly string[];
  readonly vertex?: Partial<Record<(typeof VERTEX_STAGES)[number], string>>;
  /** Lines before the functions of the fragment shader. */
  readonly fragmentDeclarations?: readonly string[];
  readonly fragmentFunctions?: readonly string[];
  readonly fragment?: Partial<Record<(typeof FRAGMENT_STAGES)[number], string>>;
}

/** What one effect adds to the program of the quad. */
export interface QuadPart {
  readonly uniforms?: readonly UniformDeclaration[];
  readonly functions?: readonly string[];
  readonly statements?: Partial<Record<(typeof QUAD_STAGES)[number], string>>;
}

/** What a part of the quad is written for. */
export interface QuadContext<V> {
  readonly target: ShaderTarget;
  readonly variant: V;
}

/** What a part is written for. */
export interface PartContext<V> extends QuadContext<V> {
  readonly pass: PointPass;
  readonly colourings: readonly Colouring[];
  /** Whether a quad finishes the picture. */
  readonly offscreen: boolean;
  /** Whether another effect runs. */
  runs(effect: { readonly name: string }): boolean;
  /** GLSL name of the attribute that reads a column. */
  attribute(column: string): string;
}

/** Whether a pass shows colours. */
export function showsColour(pass: PointPass): boolean {
  return pass === "color" || pass === "splat";
}

/** Statement that leaves a point out: outside the clip volume nothing of it is drawn. */
export function rejectIf(condition: string): string {
  return `if (${condition}) {\n  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);\n  gl_PointSize = 1.0;\n  return;\n}`;
}
