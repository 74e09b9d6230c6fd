import fc from "fast-check";
import { expect, it } from "vitest";
import type { UniformDeclaration, UniformType } from "./declaration/shader.js";
import { nodeLayout, nodeReading, writeNode } from "./node-layout.js";

const TYPES: readonly UniformType[] = ["float", "int", "vec2", "vec3", "vec4", "mat4"];

const declared = (types: readonly UniformType[]): UniformDeclaration[] =>
  types.map((type, index) => ({ name: `u_${index}`, type, scope: "node" }));

/** What GLSL would read of a row under each name, by the statements that it is given. */
function readBack(types: readonly UniformType[], table: Float32Array, row: number) {
  const uniforms = declared(types);
  const layout = nodeLayout(uniforms);
  const { statements } = nodeReading(layout, uniforms);
  const texel = (at: number) => [...table.subarray(4 * at, 4 * at + 4)];
  const texels = new Map<string, number[]>();
  const values = new Map<string, number | number[]>();
  for (const line of statements) {
    const fetched = /^vec4 (node\d+) = nodeValues\(ofNode \+ (\d+)\);$/.exec(line);
    if (fetched) texels.set(fetched[1], texel(row * layout.texels + Number(fetched[2])));
    const assigned = /^(u_\d+) = (.*);$/.exec(line);
    if (!assigned) continue;
    const [, name, expression] = assigned;
    const matrix = /^transpose\(mat4\((node\d+), (node\d+), (node\d+), /.exec(expression);
    const whole = /^int\((node\d+)\.(\w)\) \* 65536 \+ int\((node\d+)\.(\w)\)$/.exec(expression);
    const part = /^(node\d+)\.(\w+)$/.exec(expression);
    const of = (node: string, letters: string) =>
      [...letters].map((letter) => texels.get(node)!["xyzw".indexOf(letter)]);
    if (matrix)
      values.set(
        name,
        matrix.slice(1, 4).flatMap((node) => texels.get(node)!),
      );
    else if (whole) values.set(name, of(whole[1], whole[2])[0] * 65_536 + of(whole[3], whole[4])[0]);
    else if (part) values.set(name, part[2].length === 1 ? of(part[1], part[2])[0] : of(part[1], part[2]));
  }
  return { values, layout };
}

const LENGTHS = { float: 1, int: 1, vec2: 2, vec3: 3, vec4: 4, mat4: 16, sampler2D: 0 };
const number = fc.double({ min: -1e6, max: 1e6, noNaN: true }).map(Math.fround);

it("gives each node its own values back, whatever they are", () => {
  const uniform = fc.constantFrom(...TYPES);
  const lists = fc.array(uniform, { maxLength: 12 });
  fc.assert(
    fc.property(lists, fc.array(number, { minLength: 400, maxLength: 400 }), (types, numbers) => {
      const layout = nodeLayout(declared(types));
      const table = new Float32Array(4 * layout.texels * 3);
      let next = 0;
      const rows = [0, 1, 2].map(() =>
        types.map((type) => {
          if (type === "int") return Math.trunc(1000 * numbers[next++ % 400]) || 0;
          if (type === "float") return numbers[next++ % 400];
          const values = Array.from({ length: LENGTHS[type] }, () => numbers[next++ % 400]);
          if (type === "mat4") [values[3], values[7], values[11], values[15]] = [0, 0, 0, 1];
          return values;
        }),
      );
      rows.forEach((values, row) => {
        writeNode(
          layout,
          table,
          row,
          Object.fromEntries(values.map((value, index) => [`u_${index}`, value])),
        );
      });
      rows.forEach((expected, row) => {
        const { values } = readBack(types, table, row);
        types.forEach((type, index) => {
          const value = expected[index];
          const columns = value as readonly number[];
          const rowsOf = () =>
            [0, 1, 2].flatMap((line) => [0, 1, 2, 3].map((column) => columns[4 * column + line]));
          expect(values.get(`u_${index}`)).toEqual(type === "mat4" ? rowsOf() : value);
        });
      });
    }),
  );
});

it("keeps whole numbers that float32 does not hold", () => {
  const types: UniformType[] = ["int"];
  const layout = nodeLayout(declared(types));
  const table = new Float32Array(4);
  for (const value of [0, 65_535, 65_536, 2 ** 24 + 1, 2 ** 31 - 1]) {
    writeNode(layout, table, 0, { u_0: value });
    expect(readBack(types, table, 0).values.get("u_0")).toBe(value);
  }
});

it("reads only what a shader asks for, and leaves alone what is not given", () => {
  const uniforms = declared(["mat4", "vec2", "float", "int"]);
  const layout = nodeLayout([...uniforms, { name: "u_of_all", type: "vec4", scope: "layer" }]);
  expect(layout.texels).toBe(5);
  const { statements } = nodeReading(layout, [uniforms[1]]);
  expect(statements.filter((line) => line.includes("nodeValues("))).toHaveLength(1);
  expect(nodeReading(layout, []).statements).toEqual([]);
  const table = new Float32Array(4 * layout.texels).fill(7);
  writeNode(layout, table, 0, { u_2: 3, u_other: 1 });
  expect([...table].filter((value) => value !== 7)).toEqual([3]);
});
