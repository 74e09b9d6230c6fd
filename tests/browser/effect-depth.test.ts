import { expect, it } from "vitest";
import { CESIUM } from "../../layer/src/cesium/engine/shader-target.js";
import { random, usePage } from "./effect-draw.js";
import { run } from "./gpu-page.js";

/** Pixels along an edge; each has a point of its own. */
const EDGE = 320;
const COUNT = EDGE * EDGE;
/** Metres. */
const [NEAR, FAR] = [0.1, 1e7];

/** What Cesium declares (Shaders/Builtin/Functions/vertexLogDepth.glsl, writeLogDepth.glsl), for a point at `a_at`. */
const HEAD = `#version 300 es
precision highp float;
#define LOG_DEPTH
#define czm_oneOverLog2FarDepthFromNearPlusOne u_scale
uniform float u_scale;
uniform float u_near;
`;
const VERTEX = `${HEAD}
in vec3 a_at;
out float v_depthFromNearPlusOne;
void czm_vertexLogDepth() {
  v_depthFromNearPlusOne = (gl_Position.w - u_near) + 1.0;
  gl_Position.z = clamp(gl_Position.z / gl_Position.w, -1.0, 1.0) * gl_Position.w;
}
void main() {
  gl_PointSize = 1.0;
  gl_Position = vec4(a_at.xy * a_at.z, 0.0, a_at.z);
`;
const OUT = "out vec4 to;\nvoid main() {\n  to = vec4(1.0);\n";
const WRITTEN = "gl_FragDepth = log2(v_depthFromNearPlusOne) * czm_oneOverLog2FarDepthFromNearPlusOne;";

const page = usePage();

it("vertices are as deep as Cesium makes fragments, to two steps of 24 bits, and no farther from the truth", {
  timeout: 120_000,
}, async () => {
  const next = random(12);
  const at: number[] = [];
  for (let index = 0; index < COUNT; index++) {
    const pixel = [index % EDGE, Math.floor(index / EDGE)].map((i) => (2 * i + 1) / EDGE - 1);
    // Evenly in the logarithm of the distance.
    at.push(...pixel, NEAR * (FAR / NEAR) ** next());
  }
  const draw = (vertex: string, fragment: string) =>
    run(page(), {
      vertex: `${VERTEX}${vertex}\n}\n`,
      fragment,
      declared: [
        { name: "u_scale", type: "float", scope: "view" },
        { name: "u_near", type: "float", scope: "view" },
      ],
      uniforms: { u_scale: 1 / Math.log2(FAR - NEAR + 1), u_near: NEAR },
      textures: [],
      attributes: [{ name: "a_at", location: 0, components: 3, data: at }],
      count: COUNT,
      wanted: { kind: "picture", size: EDGE, primitive: "points" },
    });
  const plain = `#version 300 es\nprecision highp float;\n${OUT}}\n`;
  const written = `${HEAD}in float v_depthFromNearPlusOne;\n${OUT}  ${WRITTEN}\n}\n`;
  const ours = await draw(CESIUM.vertexDepth, plain);
  const theirs = await draw("czm_vertexLogDepth();", written);
  const scale = Math.log2(FAR - Math.fround(NEAR) + 1);
  const truth = Array.from(
    { length: COUNT },
    (_, index) => Math.log2(Math.fround(at[3 * index + 2]) - Math.fround(NEAR) + 1) / scale,
  );
  expect(Math.max(...theirs.depths)).toBeGreaterThan(0.99);
  expect(Math.min(...theirs.depths)).toBeLessThan(0.01);
  expect(steps(ours.depths, theirs.depths)).toBeLessThanOrEqual(2);
  expect(steps(ours.depths, truth)).toBeLessThanOrEqual(steps(theirs.depths, truth));
  // A depth that is another by one part in a million would be seen.
  expect(
    steps(
      ours.depths.map((depth) => depth * (1 - 1e-6)),
      theirs.depths,
    ),
  ).toBeGreaterThan(10);
});

/** The greatest difference, steps of 24 bits. */
function steps(depths: readonly number[], others: readonly number[]): number {
  return depths.reduce((most, depth, index) => Math.max(most, Math.abs(depth - others[index]) * 2 ** 24), 0);
}
