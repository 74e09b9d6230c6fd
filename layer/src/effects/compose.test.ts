import { describe, expect, it } from "vitest";
import { composePointShader } from "./compose.js";
import { composePass } from "./compose-pass.js";
import { drawsOffscreen, EFFECT_NAMES, type EffectName } from "./effect-plan.js";
import { planEffects, withoutClips } from "./plan.js";
import { combinations, richFacts, styleOf } from "./scene.fixture.js";
import type { PointPass, PointShader } from "./shader-target.js";
import { styleTextures } from "./textures.js";
import { layerUniforms } from "./uniforms.js";

/** By what each effect is known in a program's text; and the effects with which it shares that. */
const TRACES: Readonly<Record<EffectName, readonly RegExp[]>> = {
  ownColour: [/\ba_color\b/],
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

function passesOf(active: ReadonlySet<EffectName>): PointPass[] {
  return active.has("splats") ? ["color", "depth", "splat", "id"] : ["color", "id"];
}

/** A program's text with all it declares. */
function textOf({ vertex, fragment, attributes, uniforms }: PointShader): string {
  return [vertex, fragment, ...[...attributes, ...uniforms].map(({ name }) => name)].join("\n");
}

describe("composed programs, over all combinations of effects", () => {
  const all = combinations().map((one) => ({ ...one, plan: planEffects(one.style, one.facts) }));

  it("have the effects that the scene means, and no other", () => {
    expect(all.length).toBeGreaterThan(1000);
    for (const { name, plan, meant } of all)
      expect([name, [...plan.active].sort()]).toEqual([name, [...meant].sort()]);
  });

  it.each(["cesium", "webgl2"] as const)("hold no trace of an inactive effect (%s)", (target) => {
    const faults: string[] = [];
    for (const { name, plan } of all) {
      const inactive = EFFECT_NAMES.filter((effect) => !plan.active.has(effect));
      const round = ROUND.some((effect) => plan.active.has(effect));
      for (const pass of passesOf(plan.active)) {
        const text = textOf(composePointShader(plan, target, pass));
        for (const effect of inactive) {
          if (effect === "disc" && round) continue;
          if (TRACES[effect].some((trace) => trace.test(text))) faults.push(`${name}, ${pass}: ${effect}`);
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
      const points = passesOf(plan.active).map((pass) => textOf(composePointShader(plan, "webgl2", pass)));
      const quad = plan.active.has("eyeDomeLighting") ? "edl" : "splatNormalise";
      const text = [
        ...points,
        ...(drawsOffscreen(plan) ? [composePass(quad, plan, "webgl2").fragment] : []),
      ].join();
      for (const effect of plan.active) {
        if (!TRACES[effect].some((trace) => trace.test(text))) faults.push(`${name}: ${effect}`);
      }
    }
    expect(faults.slice(0, 5)).toEqual([]);
  });

  it("declare nothing that they do not use", () => {
    const faults: string[] = [];
    for (const { name, plan } of all) {
      for (const pass of passesOf(plan.active)) {
        const { vertex, fragment, attributes, uniforms } = composePointShader(plan, "cesium", pass);
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
    for (const { name, plan, style, facts } of all) {
      const passes = passesOf(plan.active).map((pass) => composePointShader(plan, "webgl2", pass).uniforms);
      const quads = drawsOffscreen(plan)
        ? composePass(plan.active.has("eyeDomeLighting") ? "edl" : "splatNormalise", plan, "webgl2").uniforms
        : [];
      const declared = [...passes.flat(), ...quads];
      const names = (scope: string) => new Set(declared.filter((u) => u.scope === scope).map((u) => u.name));
      const given = Object.keys(layerUniforms(plan, style, facts));
      expect([name, given.sort()]).toEqual([name, [...names("layer")].sort()]);
      const textures = styleTextures(plan, style).map((texture) => texture.name);
      const nodes = ["u_octree", "u_clips"];
      const samplers = [...names("texture")].filter((texture) => !nodes.includes(texture));
      expect([name, textures.sort()]).toEqual([name, samplers.sort()]);
    }
  });

  it("have the same text where the key is the same", () => {
    const byKey = new Map<string, string>();
    for (const { plan } of all) {
      for (const pass of passesOf(plan.active)) {
        const text = textOf(composePointShader(plan, "cesium", pass));
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
    "splats with Eye-Dome Lighting": styleOf({ highQuality: true, eyeDomeLighting: true, pointSize: 8 }),
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
    const passes = passesOf(plan.active).map((pass) => {
      const { vertex, fragment } = composePointShader(plan, "cesium", pass);
      return `// ${pass}: vertex\n${vertex}\n// ${pass}: fragment\n${fragment}`;
    });
    const quad = plan.active.has("eyeDomeLighting") ? "edl" : "splatNormalise";
    if (drawsOffscreen(plan)) passes.push(`// ${quad}\n${composePass(quad, plan, "cesium").fragment}`);
    const text = `// ${name}: ${[...plan.active].join(", ")}\n\n${passes.join("\n")}`;
    await expect(text).toMatchFileSnapshot(`snapshots/${name.replace(/[^a-zA-Z]+/g, "-")}.glsl`);
  });
});
