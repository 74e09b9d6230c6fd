import { QUAD_STAGES, type QuadPart } from "./declaration/effect.js";
import type { QuadShader, ShaderTarget } from "./declaration/shader.js";
import { type EffectPlan, effectsOf } from "./effect-plan.js";
import { readBy, shaderText, stagedStatements } from "./shader-text.js";

/**
 * The program of a quad that puts points drawn offscreen into the scene, with their depth. Its samplers are u_color and
 * u_depth, the colours and the depth of the passes before, of the picture's size and without filtering.
 */
export function composeQuad(plan: EffectPlan, target: ShaderTarget): QuadShader {
  const parts = effectsOf(plan).flatMap(
    (effect) => effect.quad?.({ target, variant: plan.variants.get(effect.name) }) ?? [],
  );
  const resolved = parts.some(({ statements }) => statements?.resolve !== undefined);
  const base: QuadPart = {
    uniforms: [
      { name: "u_color", type: "sampler2D", scope: "view" },
      { name: "u_depth", type: "sampler2D", scope: "view" },
      ...target.uniforms,
    ],
    functions: target.quad.functions,
    statements: {
      ...(!resolved && { resolve: "vec3 color = sum.rgb;" }),
      output: `out_FragColor = ${target.colour("vec4(color, 1.0)")};`,
    },
  };
  const all = [base, ...parts];
  const uniforms = all.flatMap((part) => part.uniforms ?? []);
  const fragment = shaderText(target, {
    uniforms,
    declarations: ["in vec2 v_textureCoordinates;", ...(target.output ? [target.output] : [])],
    functions: all.flatMap((part) => part.functions ?? []),
    statements: [
      "float depth = texture(u_depth, v_textureCoordinates).r;",
      "if (depth >= 1.0) discard;",
      "vec4 sum = texture(u_color, v_textureCoordinates);",
      ...stagedStatements(
        QUAD_STAGES,
        all.map(({ statements }) => statements),
      ),
      ...target.quad.depth.split("\n"),
    ],
  });
  return { vertex: target.quad.vertex, fragment, uniforms: readBy(fragment, uniforms) };
}
