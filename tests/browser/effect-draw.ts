import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll } from "vitest";
import {
  CLIP_RECORDS,
  composePointShader,
  type EffectPlan,
  FIRST_ID,
  layerUniforms,
  nodeUniforms,
  OCTREE_INDEX,
  type PointCloudStyle,
  type PointPass,
  planEffects,
  type SceneFacts,
  type StyledNode,
  styleTextures,
} from "../../layer/src/effects/index.js";
import { richFacts, styleOf } from "../../layer/src/effects/scene.fixture.js";
import { WEBGL2 } from "../../layer/src/effects/webgl2-target.js";
import { columnsOf, type GpuResult, type PlainTexture, run } from "./gpu-page.js";
import { sharedBrowser } from "./harness.js";

/** A page with WebGL 2 for the tests of a file. */
export function usePage(): () => Page {
  let browser: Browser;
  let page: Page;
  beforeAll(async () => {
    browser = await sharedBrowser();
    page = await browser.newPage();
  });
  afterAll(() => browser?.close());
  return () => page;
}

/** The same numbers at each run (mulberry32). */
export function random(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
/** Pixels along an edge of a picture. */
export const SIZE = 64;

/** A square view of 90° from the origin down −z, near 1, far 1000. */
export const PERSPECTIVE = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1001 / 999, -1, 0, 0, -2000 / 999, 0];
/** Uniforms of that view. */
export const VIEW = {
  u_modelView: IDENTITY,
  u_onGlobe: IDENTITY,
  u_projection: PERSPECTIVE,
  u_viewport: [0, 0, SIZE, SIZE],
  u_pixelRatio: 1,
};

/** A node, and what a frame says of it. */
interface DrawnNode extends StyledNode {
  readonly firstId: number;
  readonly octreeIndex: number;
  /** First texel and number of its records in the texture of clips. */
  readonly clips: readonly [first: number, count: number];
}

const NODE: DrawnNode = {
  columns: { get: () => ({ scale: 1, offset: 0 }) },
  firstId: 0,
  level: 0,
  spacing: 1,
  octreeIndex: 0,
  toCube: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0],
  clips: [0, 0],
};

/** What is drawn; what is left out is plain. */
export interface Draw {
  readonly style?: Partial<PointCloudStyle>;
  readonly facts?: Partial<SceneFacts>;
  readonly node?: Partial<DrawnNode>;
  readonly columns: Readonly<Record<string, readonly number[]>>;
  /** Values in place of the view's. */
  readonly view?: Readonly<Partial<Record<keyof typeof VIEW, number | readonly number[]>>>;
  readonly textures?: readonly PlainTexture[];
  readonly pass?: PointPass;
}

/** Draws points, or only takes what the vertex shader makes of them. */
export async function draw(
  page: Page,
  { style, facts, node, columns, view, textures = [], pass = "color" }: Draw,
  outputs: readonly string[] | undefined,
): Promise<GpuResult & { plan: EffectPlan }> {
  const whole = styleOf(style);
  const scene = richFacts(facts);
  const plan = planEffects(whole, scene);
  const shader = composePointShader(plan, WEBGL2, pass);
  const drawn = { ...NODE, ...node };
  const result = await run(page, {
    vertex: shader.vertex,
    fragment: shader.fragment,
    declared: shader.uniforms,
    uniforms: {
      ...VIEW,
      ...view,
      ...layerUniforms(plan),
      ...nodeUniforms(plan, drawn),
      ...{ [FIRST_ID]: drawn.firstId, [OCTREE_INDEX]: drawn.octreeIndex, [CLIP_RECORDS]: drawn.clips },
    },
    textures: [...styleTextures(plan).map(plain), ...textures],
    attributes: columnsOf(shader, columns, node?.step !== undefined),
    count: columns.position.length / (node?.step === undefined ? 3 : 4),
    wanted: outputs ? { kind: "vertices", outputs } : { kind: "picture", size: SIZE, primitive: "points" },
  });
  return { ...result, plan };
}

function plain({
  name,
  width,
  height,
  data,
}: Omit<PlainTexture, "float" | "data"> & { data: ArrayLike<number> }) {
  return { name, width, height, data: Array.from(data), float: data instanceof Float32Array };
}
