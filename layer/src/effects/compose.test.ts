import { describe, expect, it } from "vitest";
import { CESIUM } from "../cesium/engine/shader-target.js";
import { EFFECT_NAMES, type EffectName } from "./catalogue/index.js";
import { composePointShader } from "./compose.js";
import { composeQuad } from "./compose-quad.js";
import type { PointPass, PointShader, QuadShader } from "./declaration/shader.js";
import { type EffectPlan, layerUniforms, passesOf, styleTextures } from "./effect-plan.js";
import { planEffects, withoutClips } from "./plan.js";
import { combinations, hasOwnTest, richFacts, styleOf } from "./scene.fixture.js";
import { WEBGL2 } from "./webgl2-target.js";

/** By what each effect is known in a program's text. Those that are not here have a test of their own. */
const TRACES: Readonly<Partial<Record<EffectName, readonly RegExp[]>>> = {
  rgb: [/\ba_rgb\b/],
  gradient: [/\bu_value\d/],
  classification: [/classEntry\(a_classification\)\.rgb/],
  levelOfDetail: [/\bu_levels\b/, /\bu_nodeLevel\b/],
  blend: [/\bu_blend\b/, /\bcolor[01]\b/],
  tone: [/\btone\(/, /\bu_tone\b/],
  fixedSize: [/\bu_pointSize\b/],
  attenuatedSize: [/\bu_groundSize\b/],
  adaptiveSize: [/\bu_nodeSize\b/, /visible\.y/],
  disc: [/squared > 1\.0/],
  paraboloid: [/v_paraboloid/, /gl_FragDepth/, /writeDepth/],
  splats: [/\bu_hardness\b/, /\bweight\b/, /\bnearer\(/],
  eyeDomeLighting: [/\bu_eyeDome\b/, /\brelief\(/],
  opacity: [/\bu_opacity\b/],
  dithering: [/dithering/, /\brand\(/],
  clip: [/roles\.[xyz]/],
  highlight: [/roles\.w/, /\bu_highlight\b/],
  filter: [/\bu_range\d/, /\bu_returns\b/, /\.a < 0\.5/],
};

/** What serves more than one effect, and whom. */
const SHARED: readonly (readonly [RegExp, readonly EffectName[]])[] = [
  [/\bu_gradient\b|gradientColor/, ["gradient", "levelOfDetail"]],
  [/\bu_octree|\bu_toCube\b|visibleLevels/, ["adaptiveSize", "levelOfDetail"]],
  [/\bu_classes\b|classEntry/, ["classification", "filter"]],
  [/\bu_clips\b|\bu_clipRecords\b|clipRoles/, ["clip", "highlight"]],
  [/pixelsPerMetre/, ["attenuatedSize", "adaptiveSize", "paraboloid", "splats"]],
  [/gl_PointCoord|discard/, ["disc", "paraboloid", "splats"]],
  [/\bu_sizeLimits\b/, ["attenuatedSize", "adaptiveSize"]],
];

/** Effects whose way of leaving the square is the same. */
const ROUND: readonly EffectName[] = ["disc", "paraboloid", "splats"];

/** The passes that a plan can be drawn in: of its picture, and of the numbers of its points. */
function pointPasses(plan: EffectPlan): PointPass[] {
  return [...new Set<PointPass>(["color", ...passesOf(plan).points, "id"])];
}

/** The quad that shows the picture of a plan, where there is one. */
function quadsOf(plan: EffectPlan): QuadShader[] {
  return passesOf(plan).offscreen ? [composeQuad(plan, WEBGL2)] : [];
}

/** A program's text with all it declares. */
function textOf({ vertex, fragment, attributes, uniforms }: PointShader): string {
  return [vertex, fragment, ...[...attributes, ...uniforms].map(({ name }) => name)].join("\n");
}

describe("composed programs, over all combinations of effects", () => {
  const all = combinations().map((one) => ({ ...one, plan: planEffects(one.style, one.facts) }));

  it("are looked through for every effect without a test of its own", () => {
    const others = EFFECT_NAMES.filter((name) => !hasOwnTest(name));
    expect(Object.keys(TRACES)).toEqual(expect.arrayContaining(others));
  });

  it("have the effects that the scene means, and no other", () => {
    expect(all.length).toBeGreaterThan(1000);
    for (const { name, plan, meant } of all)
      expect([name, [...plan.active].sort()]).toEqual([name, [...meant].sort()]);
  });

  it.each([
    ["Cesium", CESIUM],
    ["WebGL 2", WEBGL2],
  ])("hold no trace of an inactive effect (%s)", (_, target) => {
    const faults: string[] = [];
    for (const { name, plan } of all) {
      const inactive = EFFECT_NAMES.filter((effect) => !plan.active.has(effect));
      const round = ROUND.some((effect) => plan.active.has(effect));
      for (const pass of pointPasses(plan)) {
        const text = textOf(composePointShader(plan, target, pass));
        for (const effect of inactive) {
          if (effect === "disc" && round) continue;
          if (TRACES[effect]?.some((trace) => trace.test(text))) faults.push(`${name}, ${pass}: ${effect}`);
        }
        for (const [trace, effects] of SHARED) {
          if (effects.some((effect) => plan.active.has(effect))) continue;
          if (trace.test(text)) faults.push(`${name}, ${pass}: ${trace}`);
        }
      }
    }
    expect(faults.slice(0, 5)).toEqual([]);
  });

  it("hold a trace of each active effect in one of their passes", () => {
    const faults: string[] = [];
    for (const { name, plan } of all) {
      const points = pointPasses(plan).map((pass) => textOf(composePointShader(plan, WEBGL2, pass)));
      const text = [...points, ...quadsOf(plan).map(({ fragment }) => fragment)].join();
      for (const effect of plan.active) {
        if (!TRACES[effect]?.some((trace) => trace.test(text))) faults.push(`${name}: ${effect}`);
      }
    }
    expect(faults.slice(0, 5)).toEqual([]);
  });

  it("declare nothing that they do not use", () => {
    const faults: string[] = [];
    for (const { name, plan } of all) {
      for (const pass of pointPasses(plan)) {
        const { vertex, fragment, attributes, uniforms } = composePointShader(plan, CESIUM, pass);
        for (const text of [vertex, fragment]) {
          for (const [, declared] of text.matchAll(/^(?:flat )?(?:in|out|uniform)(?: highp)? \w+ (\w+);/gm)) {
            // Cesium's pick pass is what uses it.
            if (declared === "u_pickColor") continue;
            const uses = text.match(new RegExp(`\\b${declared}\\b`, "g"))!.length;
            if (uses < 2) faults.push(`${name}, ${pass}: ${declared}`);
          }
        }
        for (const { name: declared } of [...attributes, ...uniforms]) {
          if (!`${vertex}${fragment}`.includes(declared))
            faults.push(`${name}, ${pass}: ${declared} is only listed`);
        }
      }
    }
    expect(faults.slice(0, 5)).toEqual([]);
  });

  it("are given values for exactly the uniforms of the layer, and textures for the style's samplers", () => {
    for (const { name, plan } of all) {
      const passes = pointPasses(plan).map((pass) => composePointShader(plan, WEBGL2, pass).uniforms);
      const declared = [...passes.flat(), ...quadsOf(plan).flatMap(({ uniforms }) => uniforms)];
      const names = (scope: string) => new Set(declared.filter((u) => u.scope === scope).map((u) => u.name));
      const given = Object.keys(layerUniforms(plan));
      expect([name, given.sort()]).toEqual([name, [...names("layer")].sort()]);
      const textures = styleTextures(plan).map((texture) => texture.name);
      const nodes = ["u_octree", "u_clips"];
      const samplers = [...names("texture")].filter((texture) => !nodes.includes(texture));
      expect([name, textures.sort()]).toEqual([name, samplers.sort()]);
    }
  });

  it("have the same text where the key is the same", () => {
    const byKey = new Map<string, string>();
    for (const { plan } of all) {
      for (const pass of pointPasses(plan)) {
        const text = textOf(composePointShader(plan, CESIUM, pass));
        const key = `${plan.key}|${pass}`;
        expect(byKey.get(key) ?? text).toBe(text);
        byKey.set(key, text);
      }
    }
  });

  it("for nodes that no volume touches are those of a scene without volumes", () => {
    for (const { plan, style, facts } of all) {
      const bare = planEffects(style, { ...facts, clips: 0, highlights: 0 });
      expect(withoutClips(plan).key).toBe(bare.key);
    }
  });
});

describe("the programs of five scenes", () => {
  const scenes = {
    "plain colours": styleOf(),
    "elevation in discs with tone": styleOf({ color: "elevation", shape: "disc", pointSize: 5, gamma: 1.5 }),
    "classes, adaptive paraboloids, filter": styleOf({
      color: "classification",
      size: "adaptive",
      shape: "paraboloid",
    }),
    "splats with Eye-Dome Lighting": styleOf({ splats: true, eyeDomeLighting: true, pointSize: 8 }),
    "clips and highlight, levels blended with intensity": styleOf({
      color: "levelOfDetail",
      blend: { color: "intensity", share: 0.3 },
      opacity: 0.5,
    }),
  };
  it.each(Object.entries(scenes))("%s", async (name, style) => {
    const facts = richFacts({
      ...(name.startsWith("clips") && { clips: 1, highlights: 1 }),
      ...(name.includes("filter") && { filter: { returns: ["last"], ranges: { intensity: [10, 900] } } }),
    });
    const plan = planEffects(style, facts);
    const passes = pointPasses(plan).map((pass) => {
      const { vertex, fragment } = composePointShader(plan, CESIUM, pass);
      return `// ${pass}: vertex\n${vertex}\n// ${pass}: fragment\n${fragment}`;
    });
    const quad = plan.active.has("eyeDomeLighting") ? "edl" : "splatNormalise";
    if (passesOf(plan).offscreen) passes.push(`// ${quad}\n${composeQuad(plan, CESIUM).fragment}`);
    const text = `// ${name}: ${[...plan.active].join(", ")}\n\n${passes.join("\n")}`;
    await expect(text).toMatchFileSnapshot(`snapshots/${name.replace(/[^a-zA-Z]+/g, "-")}.glsl`);
  });
});
