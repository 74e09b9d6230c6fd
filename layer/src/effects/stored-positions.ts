import type { UniformDeclaration } from "./declaration/shader.js";

/** Length of a step of the stored positions, metres; 1 where they are metres. */
export const STEP: UniformDeclaration = { name: "u_step", type: "float", scope: "node" };

/**
 * Positions at whole steps, each coordinate a sign and 20 bits, as four uint16 a point: the 16 lower bits of x, y and z, and
 * in the last one, from its second bit on, the five upper bits of each. Its first bit is 0, as in no float: where positions
 * are three floats, GL has the fourth be 1.
 * @param positions metres, whole multiples of the step
 */
export function inSteps(positions: Float32Array, step: number): Uint16Array {
  const points = positions.length / 3;
  const stored = new Uint16Array(4 * points);
  const perMetre = 1 / step;
  for (let point = 0, from = 0, to = 0; point < points; point++, from += 3, to += 4) {
    const x = positions[from] * perMetre;
    const y = positions[from + 1] * perMetre;
    const z = positions[from + 2] * perMetre;
    stored[to] = x;
    stored[to + 1] = y;
    stored[to + 2] = z;
    stored[to + 3] = (((x >> 16) & 31) << 1) | (((y >> 16) & 31) << 6) | (((z >> 16) & 31) << 11);
  }
  return stored;
}

/**
 * GLSL of a point's position as it is stored, `stored`: whole steps by {@link inSteps}, or metres. All its numbers are whole
 * and below 2²¹, so that none is rounded. A node's matrices are for stored positions, so that no step is multiplied with.
 */
export const STORED =
  "vec3 stored = a_position.xyz + 65536.0 * vec3((ivec3(int(a_position.w)) << ivec3(26, 21, 16)) >> 27);";
