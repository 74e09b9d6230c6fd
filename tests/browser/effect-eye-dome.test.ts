import { describe, expect, it } from "vitest";
import {
  composeQuad,
  layerUniforms,
  type PointCloudStyle,
  planEffects,
} from "../../layer/src/effects/index.js";
import { richFacts, styleOf } from "../../layer/src/effects/scene.fixture.js";
import { WEBGL2 } from "../../layer/src/effects/webgl2-target.js";
import { PERSPECTIVE, SIZE, usePage, VIEW } from "./effect-draw.js";
import { run } from "./gpu-page.js";

const page = usePage();

describe("Eye-Dome Lighting", () => {
  /** Shades a picture of eye depths; 0 is background. */
  async function shade(
    eyeDepth: (column: number, row: number) => number,
    style: Partial<PointCloudStyle> = { eyeDomeLighting: { strength: 0.1, radius: 1, neighbours: 4 } },
    projection: number[] = PERSPECTIVE,
  ): Promise<number[]> {
    const whole = styleOf(style);
    const scene = richFacts({ depthStep: 1e-7 });
    const plan = planEffects(whole, scene);
    const { vertex, fragment, uniforms } = composeQuad(plan, WEBGL2);
    const depths: number[] = [];
    const colors: number[] = [];
    for (let row = 0; row < SIZE; row++) {
      for (let column = 0; column < SIZE; column++) {
        const z = -eyeDepth(column, row);
        const clip = (projection[10] * z + projection[14]) / (projection[11] * z + projection[15]);
        depths.push(z === 0 ? 1 : 0.5 + 0.5 * clip, 0, 0, 0);
        colors.push(128, 128, 128, 255);
      }
    }
    const { values } = await run(page(), {
      vertex,
      fragment,
      declared: uniforms,
      uniforms: { ...VIEW, u_projection: projection, ...layerUniforms(plan) },
      textures: [
        { name: "u_color", width: SIZE, height: SIZE, data: colors, float: false },
        { name: "u_depth", width: SIZE, height: SIZE, data: depths, float: true },
      ],
      attributes: [],
      count: 3,
      wanted: { kind: "picture", size: SIZE, primitive: "triangle" },
    });
    return values.filter((_, index) => index % 4 === 0);
  }
  const GREY = 128 / 255;

  it.each([5, 60, 900])("leaves a plane seen face on as it is, %d m away", async (distance) => {
    const values = await shade(() => distance, {
      eyeDomeLighting: { strength: 0.4, radius: 1.4, neighbours: 8 },
    });
    expect(Math.min(...values)).toBeCloseTo(GREY, 4);
    expect(Math.max(...values)).toBeCloseTo(GREY, 4);
  });

  it("darkens what lies behind an edge as eq. 4.5 and 4.6 say, and nothing else", async () => {
    const values = await shade((column) => (column < 30 ? 10 : 12));
    const behind = GREY * Math.exp((-Math.log2(12 / 10) / 4) * 300 * 0.1);
    const row = values.slice(20 * SIZE, 21 * SIZE);
    expect(row[30] / behind).toBeCloseTo(1, 2);
    row.forEach((value, column) => {
      if (column !== 30) expect(value).toBeCloseTo(GREY, 4);
    });
  });

  it("shades by ratio: twice as large twice as far is the same", async () => {
    const near = await shade((column, row) => 10 + 0.02 * column + 0.5 * (row > 30 ? 1 : 0));
    const far = await shade((column, row) => 2 * (10 + 0.02 * column + 0.5 * (row > 30 ? 1 : 0)));
    const worst = near.reduce((most, value, at) => Math.max(most, Math.abs(value - far[at])), 0);
    expect(worst).toBeLessThan(2e-3);
  });

  it("neither darkens the background nor what lies before it", async () => {
    const values = await shade((column) => (column < 30 ? 10 : 0));
    expect(values[20 * SIZE + 29]).toBeCloseTo(GREY, 4);
    expect(values[20 * SIZE + 30]).toBe(0);
  });

  it("shades without perspective too, and alike wherever the camera stands", async () => {
    // 40 m wide, near 0, far 1000.
    const orthographic = [0.05, 0, 0, 0, 0, 0.05, 0, 0, 0, 0, -0.002, 0, 0, 0, -1, 1];
    const near = await shade((column) => (column < 30 ? 100 : 101), undefined, orthographic);
    const far = await shade((column) => (column < 30 ? 800 : 801), undefined, orthographic);
    expect(near[30]).toBeLessThan(0.9 * GREY);
    expect(near[30]).toBeCloseTo(far[30], 2);
    expect(near[29]).toBeCloseTo(GREY, 4);
  });
});
