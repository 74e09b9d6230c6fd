import type { UniformDeclaration, UniformType } from "./declaration/shader.js";

/** Values of a node by the names of its uniforms; matrices are column-major. */
export type NodeValues = Readonly<Record<string, number | ArrayLike<number>>>;

/** Texels in a row of the table of nodes. */
export const NODE_TABLE_WIDTH = 256;

/** Components of a type in the table; matrices are affine, so that three rows say all, and integers go in two parts. */
const COMPONENTS: Readonly<Record<UniformType, number>> = {
  float: 1,
  int: 2,
  vec2: 2,
  vec3: 3,
  vec4: 4,
  mat4: 12,
  sampler2D: 0,
};

/** Integers are told as two floats, each of which has no more than 24 bits to say. */
const PART = 65_536;

/** Where a value stands among those of its node. */
interface Field extends UniformDeclaration {
  /** Its first component; none goes on in another texel, but for matrices, which begin with one. */
  readonly at: number;
}

/** What belongs to each node, as it lies in a table of all nodes that are drawn: RGBA texels of floats, node after node. */
export interface NodeLayout {
  readonly fields: readonly Field[];
  /** Texels of a node. */
  readonly texels: number;
}

/** Lays out the uniforms of nodes. @param uniforms each once; those of another scope are left out */
export function nodeLayout(uniforms: readonly UniformDeclaration[]): NodeLayout {
  let next = 0;
  const own = uniforms.filter(({ scope }) => scope === "node");
  // The longest first, so that the texels are filled.
  const fields = [...own]
    .sort((a, b) => COMPONENTS[b.type] - COMPONENTS[a.type])
    .map((uniform): Field => {
      const length = COMPONENTS[uniform.type];
      if ((next % 4) + Math.min(length, 4) > 4) next += 4 - (next % 4);
      const at = next;
      next += length;
      return { ...uniform, at };
    });
  return { fields, texels: Math.max(1, Math.ceil(next / 4)) };
}

/** Where a value begins among those of its node; undefined where programs read none of that name. */
export function placeIn({ fields }: NodeLayout, name: string): number | undefined {
  return fields.find((field) => field.name === name)?.at;
}

/**
 * Writes values of a node; those not named stay.
 * @param row number of the node in the table
 * @param step metres that its positions are stored in: its matrices are given for metres, and told for stored positions
 */
export function writeNode(
  layout: NodeLayout,
  table: Float32Array,
  row: number,
  values: NodeValues,
  step = 1,
): void {
  const begin = 4 * layout.texels * row;
  for (const { name, type, at } of layout.fields) {
    const value = values[name];
    if (value === undefined) continue;
    if (type === "mat4") writeMatrix(table, begin + at, value as ArrayLike<number>, step);
    else if (type === "int") writeInteger(table, begin + at, value as number);
    else if (typeof value === "number") table[begin + at] = value;
    else table.set(value, begin + at);
  }
}

/** Writes an integer from a component on. */
export function writeInteger(table: Float32Array, at: number, value: number): void {
  const parts = Math.floor(value / PART);
  table[at] = parts;
  table[at + 1] = value - parts * PART;
}

/**
 * Writes the rows of an affine matrix, which is given column by column for metres, from a component on.
 * @param step metres that the positions are stored in
 */
export function writeMatrix(table: Float32Array, at: number, columns: ArrayLike<number>, step: number): void {
  for (let row = 0; row < 3; row++) {
    for (let column = 0; column < 3; column++) {
      table[at + 4 * row + column] = columns[4 * column + row] * step;
    }
    table[at + 4 * row + 3] = columns[12 + row];
  }
}

/** GLSL that gives a vertex shader the values of its node under the names of the uniforms. */
export interface NodeReading {
  readonly uniforms: readonly UniformDeclaration[];
  /** Global variables, which functions read too, and the function that reads a texel. */
  readonly globals: readonly string[];
  /** First lines of `main`. */
  readonly statements: readonly string[];
}

/** The uniform that says which node of the table is drawn; the first of them where one call draws many. */
export const NODE_NUMBER = "u_node";
/** The sampler of the table. */
export const NODE_TABLE = "u_nodes";

/** Uniforms by which a shader reads the table. */
export const NODE_UNIFORMS: readonly UniformDeclaration[] = [
  { name: NODE_TABLE, type: "sampler2D", scope: "view" },
  { name: NODE_NUMBER, type: "int", scope: "view" },
];

/**
 * @param read the uniforms of nodes that the shader reads
 * @param manyDraws whether one call draws many nodes that follow each other, the first of which the uniform names
 */
export function nodeReading(
  layout: NodeLayout,
  read: readonly UniformDeclaration[],
  manyDraws = false,
): NodeReading {
  const names = new Set(read.map(({ name }) => name));
  const fields = layout.fields.filter(({ name }) => names.has(name));
  if (fields.length === 0) return { uniforms: [], globals: [], statements: [] };
  const texels = [...new Set(fields.flatMap(texelsOf))].sort((a, b) => a - b);
  return {
    uniforms: NODE_UNIFORMS,
    globals: [
      ...fields.map(({ name, type }) => `${type} ${name};`),
      `vec4 nodeValues(int texel) { return texelFetch(${NODE_TABLE}, ivec2(texel % ${NODE_TABLE_WIDTH}, texel / ${NODE_TABLE_WIDTH}), 0); }`,
    ],
    statements: [
      `int ofNode = ${manyDraws ? `(${NODE_NUMBER} + gl_DrawID)` : NODE_NUMBER} * ${layout.texels};`,
      ...texels.map((texel) => `vec4 node${texel} = nodeValues(ofNode + ${texel});`),
      ...fields.map((field) => `${field.name} = ${expressionOf(field)};`),
    ],
  };
}

function texelsOf({ at, type }: Field): number[] {
  const first = Math.floor(at / 4);
  return type === "mat4" ? [first, first + 1, first + 2] : [first];
}

function expressionOf({ at, type }: Field): string {
  const first = Math.floor(at / 4);
  if (type === "mat4") {
    return `transpose(mat4(node${first}, node${first + 1}, node${first + 2}, vec4(0.0, 0.0, 0.0, 1.0)))`;
  }
  const swizzle = (begin: number, length: number) => "xyzw".slice(begin % 4, (begin % 4) + length);
  const part = (component: number) => `int(node${first}.${swizzle(component, 1)})`;
  if (type === "int") return `${part(at)} * ${PART} + ${part(at + 1)}`;
  return `node${first}.${swizzle(at, COMPONENTS[type])}`;
}
