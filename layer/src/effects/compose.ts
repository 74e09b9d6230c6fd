import {
  FRAGMENT_STAGES,
  type Part,
  type PartContext,
  SHARED_STAGES,
  showsColour,
  type Varying,
  VERTEX_STAGES,
} from "./declaration/effect.js";
import {
  type AttributeDeclaration,
  attributeName,
  FIRST_ID,
  type PointPass,
  type PointShader,
  type ShaderTarget,
} from "./declaration/shader.js";
import { type EffectPlan, effectsOf, passesOf } from "./effect-plan.js";
import { NODE_UNIFORMS, type NodeLayout, nodeLayout } from "./node-layout.js";
import { readBy, shaderText, stagedStatements, unique } from "./shader-text.js";
import { STEP, STORED } from "./stored-positions.js";

/**
 * The program of a set of effects: what each of them adds, in the order of the stages, and nothing of the others.
 * Uniforms and attributes begin with `u_` and `a_`, varyings with `v_`.
 * @param pass Default: `color`
 */
export function composePointShader(
  plan: EffectPlan,
  target: ShaderTarget,
  pass: PointPass = "color",
): PointShader {
  const parts = partsOf(plan, target, pass);
  const attributes = attributesOf(parts);
  const uniforms = parts.flatMap((part) => part.uniforms ?? []);
  const varyings = unique(parts.flatMap((part) => part.varyings ?? []));
  const all = [...uniforms, ...target.uniforms];
  const filled = target.nodeTable ? [...all.filter(({ scope }) => scope !== "node"), ...NODE_UNIFORMS] : all;
  const vertex = shaderText(target, {
    nodes: target.nodeTable ? nodeLayoutOf(plan, target) : undefined,
    uniforms,
    declarations: [
      ...attributes.map(attributeLine),
      ...varyings.map((varying) => varyingLine(varying, "out")),
    ],
    functions: parts.flatMap((part) => part.vertexFunctions ?? []),
    statements: stagedStatements(
      VERTEX_STAGES,
      parts.map((part) => part.vertex),
      SHARED_STAGES,
    ),
  });
  const fragment = shaderText(target, {
    uniforms,
    declarations: [
      ...varyings.map((varying) => varyingLine(varying, "in")),
      ...parts.flatMap((part) => part.fragmentDeclarations ?? []),
      ...(target.output ? [target.output] : []),
    ],
    functions: parts.flatMap((part) => part.fragmentFunctions ?? []),
    statements: stagedStatements(
      FRAGMENT_STAGES,
      parts.map((part) => part.fragment),
    ),
  });
  return {
    vertex,
    fragment,
    attributes,
    uniforms: readBy(vertex + fragment, filled),
  };
}

/** What belongs to a node in all programs of a set of effects. */
export function nodeLayoutOf(plan: EffectPlan, target: ShaderTarget): NodeLayout {
  const uniforms = PASSES.flatMap((pass) => partsOf(plan, target, pass)).flatMap(
    (part) => part.uniforms ?? [],
  );
  return nodeLayout(unique([...uniforms, ...target.uniforms]));
}

const PASSES: readonly PointPass[] = ["color", "depth", "splat", "id"];

/** What each effect adds to the program of a pass. */
function partsOf(plan: EffectPlan, target: ShaderTarget, pass: PointPass): Part[] {
  const context: Omit<PartContext<unknown>, "variant"> = {
    target,
    pass,
    colourings: plan.scene.colourings,
    offscreen: passesOf(plan).offscreen,
    runs: ({ name }) => [...plan.active].some((active) => active === name),
    attribute: attributeName,
  };
  const parts: Part[] = [base(context)];
  for (const effect of effectsOf(plan)) {
    const part = effect.part?.({ ...context, variant: plan.variants.get(effect.name) });
    if (part) parts.push(part);
  }
  return parts;
}

/** What every program of points begins with: the position, and what its pass writes. */
function base({ target, pass, offscreen }: Omit<PartContext<unknown>, "variant">): Part {
  const shown = showsColour(pass);
  const color = "vec4(v_color, 1.0)";
  // A quad that shows the picture corrects its colours.
  const output = `out_FragColor = ${offscreen ? color : target.colour(color)};`;
  return {
    attributes: [{ column: POSITION, components: 4, normalized: false }],
    uniforms: [{ name: FIRST_ID, type: "int", scope: "node" }, STEP],
    varyings: [
      ...(shown ? [{ name: "v_color", type: "vec3" } as const] : []),
      ...(pass === "id" ? [{ name: "v_id", type: "uint", flat: true } as const] : []),
    ],
    vertex: {
      locate: `${STORED}\nvec4 eye = $modelView * vec4(stored, 1.0);`,
      project: "gl_Position = $projection * eye;",
      ...(target.vertexDepth && { deepen: target.vertexDepth }),
      ...(shown && { hand: "v_color = color;" }),
      ...(pass === "id" && { hand: `v_id = uint(${FIRST_ID} + gl_VertexID) + 1u;` }),
    },
    ...(pass === "color" && { fragmentDeclarations: target.declarations }),
    fragment: {
      ...(pass === "color" && { output }),
      ...(pass === "depth" && { output: "out_FragColor = vec4(1.0);" }),
      ...(pass === "id" && { output: ID_OUTPUT }),
    },
  };
}

/** The column that places are in. */
const POSITION = "position";

/** One number per drawn point over all nodes, 0 for none: least significant byte in red. */
const ID_OUTPUT = "out_FragColor = vec4(uvec4(v_id, v_id >> 8u, v_id >> 16u, v_id >> 24u) & 255u) / 255.0;";

/** Position first, then columns in the order of their effects, each once. */
function attributesOf(parts: readonly Part[]): AttributeDeclaration[] {
  const uses = new Map(
    parts.flatMap((part) => part.attributes ?? []).map((use) => [use.column, use] as const),
  );
  return [...uses.values()].map((use, location) => ({ ...use, name: attributeName(use.column), location }));
}

function attributeLine({ name, components }: AttributeDeclaration): string {
  return `in ${components === 1 ? "float" : `vec${components}`} ${name};`;
}

function varyingLine({ name, type, flat }: Varying, direction: "in" | "out"): string {
  return `${flat ? "flat " : ""}${direction} ${type === "uint" ? "highp uint" : type} ${name};`;
}
