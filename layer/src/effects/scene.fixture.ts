import { existsSync } from "node:fs";
import type { EffectName, PointCloudStyle } from "./catalogue/index.js";
import type { SceneFacts } from "./declaration/facts.js";
import { defaultStyle } from "./style.js";

/** Whether an effect has a test file beside it. */
export function hasOwnTest(effect: EffectName): boolean {
  const file = effect.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
  return existsSync(new URL(`catalogue/${file}.test.ts`, import.meta.url));
}

/** A frame in which every effect that is asked for shows: levels meet, points overlap, volumes and a filter are there. */
export function richFacts(parts: Partial<SceneFacts> = {}): SceneFacts {
  return {
    viewportHeight: 1080,
    pixelRatio: 1,
    nodes: 40,
    points: 900_000,
    spacings: [1, 20],
    levels: [2, 6],
    groundSpacings: [0.05, 0.8],
    groundSpacing: 0.2,
    pixelsPerMetre: 100,
    depthStep: 1e-6,
    clips: 0,
    highlights: 0,
    attributes: [
      { name: "rgb", kind: "color" },
      { name: "elevation", kind: "scalar", range: [10, 250] },
      { name: "intensity", kind: "scalar", range: [0, 4000] },
      { name: "gpsTime", kind: "scalar", range: [2e8, 2e8 + 3600] },
      { name: "classification", kind: "class", range: [0, 18] },
      { name: "echo width [ns]", kind: "scalar", range: [0, 9] },
    ],
    ...parts,
  };
}

export function styleOf(parts: Partial<PointCloudStyle> = {}): PointCloudStyle {
  return { ...defaultStyle(richFacts()), ...parts };
}

/** A style and facts in words that change them: every choice that changes programs. */
const CHOICES = {
  color: ["rgb", "intensity", "classification", "levelOfDetail", "echo width [ns]"],
  blend: [undefined, { color: "elevation", share: 0.4 }],
  size: ["fixed", "attenuated", "adaptive"],
  shape: ["square", "disc", "paraboloid", "splats"],
  eyeDomeLighting: [false, { strength: 0.4, radius: 1.4, neighbours: 8 }],
  rest: ["none", "tone", "clip", "highlight", "filter", "all"],
} as const;

/** One combination of choices. */
export interface Combination {
  readonly name: string;
  readonly style: PointCloudStyle;
  readonly facts: SceneFacts;
  /** Effects that the choices mean to have, by the choices alone. */
  readonly meant: ReadonlySet<EffectName>;
}

const COLOUR_EFFECTS = {
  rgb: "rgb",
  intensity: "gradient",
  classification: "classification",
  levelOfDetail: "levelOfDetail",
  "echo width [ns]": "gradient",
} as const satisfies Record<string, EffectName>;

const SIZE_EFFECTS = {
  fixed: "fixedSize",
  attenuated: "attenuatedSize",
  adaptive: "adaptiveSize",
} as const satisfies Record<string, EffectName>;

const REST = ["tone", "clip", "highlight", "filter", "opacity", "dithering"] as const;

/** All combinations of choices, in a fixed order. */
export function combinations(): Combination[] {
  const all: Combination[] = [];
  for (const color of CHOICES.color) {
    for (const blend of CHOICES.blend) {
      for (const size of CHOICES.size) {
        for (const shape of CHOICES.shape) {
          for (const eyeDomeLighting of CHOICES.eyeDomeLighting) {
            for (const rest of CHOICES.rest) {
              all.push(combine({ color, blend, size, shape, eyeDomeLighting, rest }));
            }
          }
        }
      }
    }
  }
  return all;
}

type Choice = { readonly [Name in keyof typeof CHOICES]: (typeof CHOICES)[Name][number] };

function combine({ color, blend, size, shape, eyeDomeLighting, rest }: Choice): Combination {
  const has = (name: (typeof REST)[number]) => rest === name || rest === "all";
  const style = styleOf({
    color,
    blend,
    size,
    pointSize: 8,
    shape: shape === "splats" ? "square" : shape,
    splats: shape === "splats",
    eyeDomeLighting,
    ...(has("tone") && { gamma: 2, contrast: 0.3 }),
    ...(has("opacity") && { opacity: 0.5 }),
    ...(has("dithering") && { dithering: true }),
  });
  const facts = richFacts({
    clips: has("clip") ? 2 : 0,
    highlights: has("highlight") ? 1 : 0,
    filter: has("filter")
      ? { classes: [2, 6], returns: ["last"], ranges: { elevation: [10, 90], "echo width [ns]": [1, 3] } }
      : undefined,
  });
  const scalar = COLOUR_EFFECTS[color] === "gradient" || blend !== undefined;
  const toned = scalar || color === "rgb";
  const meant: EffectName[] = [
    COLOUR_EFFECTS[color],
    SIZE_EFFECTS[size],
    ...(blend ? (["gradient", "blend"] as const) : []),
    ...(shape === "square" ? [] : [shape]),
    ...(eyeDomeLighting ? (["eyeDomeLighting"] as const) : []),
    ...REST.filter((name) => has(name)).filter((name) => {
      if (name === "tone") return toned;
      return name !== "dithering" || scalar || eyeDomeLighting !== false;
    }),
  ];
  const name = [color, blend ? "blend" : "", size, shape, eyeDomeLighting ? "edl" : "", rest].join(" ");
  return { name, style, facts, meant: new Set(meant) };
}
