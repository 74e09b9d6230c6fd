import { eastNorthUp, geodesicFrom, geodeticToEcef } from "@groma/georef";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { rolesOf } from "../../layer/src/clips/clip-shader.fixture.js";
import { Clip, ClipSet, clipTexture, type SourceSpace } from "../../layer/src/clips/index.js";
import {
  composePass,
  composePointShader,
  type DrawnNode,
  type EffectPlan,
  encodeVisibleOctree,
  GRADIENTS,
  layerUniforms,
  nodeUniforms,
  type PointCloudStyle,
  type PointFilter,
  type PointPass,
  passesFilter,
  planEffects,
  type SceneFacts,
  styleTextures,
} from "../../layer/src/effects/index.js";
import { richFacts, styleOf } from "../../layer/src/effects/scene.fixture.js";
import type { VoxelKey } from "../../layer/src/octree/index.js";
import { columnsOf, type GpuResult, type PlainTexture, run } from "./gpu-page.js";
import { launch } from "./harness.js";

let browser: Browser;
let page: Page;
beforeAll(async () => {
  browser = await launch();
  page = await browser.newPage();
});
afterAll(() => browser?.close());

/** The same numbers at each run (mulberry32). */
function random(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const SIZE = 64;

/** A square view of 90° from the origin down −z, near 1, far 1000. */
const PERSPECTIVE = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1001 / 999, -1, 0, 0, -2000 / 999, 0];
const VIEW = {
  u_modelView: IDENTITY,
  u_projection: PERSPECTIVE,
  u_viewport: [0, 0, SIZE, SIZE],
  u_pixelRatio: 1,
};

const NODE: DrawnNode = {
  columns: { get: () => ({ scale: 1, offset: 0 }) },
  firstId: 0,
  level: 0,
  spacing: 1,
  octreeIndex: 0,
  toCube: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0],
  clips: [0, 0],
};

interface Draw {
  readonly style?: Partial<PointCloudStyle>;
  readonly facts?: Partial<SceneFacts>;
  readonly node?: Partial<DrawnNode>;
  readonly columns: Readonly<Record<string, readonly number[]>>;
  readonly textures?: readonly PlainTexture[];
  readonly pass?: PointPass;
}

/** Draws points, or only takes what the vertex shader makes of them. */
async function draw(
  { style, facts, node, columns, textures = [], pass = "color" }: Draw,
  outputs: readonly string[] | undefined,
): Promise<GpuResult & { plan: EffectPlan }> {
  const whole = styleOf(style);
  const scene = richFacts(facts);
  const plan = planEffects(whole, scene);
  const shader = composePointShader(plan, "webgl2", pass);
  const result = await run(page, {
    vertex: shader.vertex,
    fragment: shader.fragment,
    declared: shader.uniforms,
    uniforms: {
      ...VIEW,
      ...layerUniforms(plan, whole, scene),
      ...nodeUniforms(plan, whole, scene, { ...NODE, ...node }),
    },
    textures: [...styleTextures(plan, whole).map(plain), ...textures],
    attributes: columnsOf(shader, columns),
    count: columns.position.length / 3,
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

/** Holds three numbers against a colour, to a step of 8 bits. */
function expectColour(values: readonly number[], from: number, color: readonly number[]): void {
  for (const [i, part] of color.entries()) expect(values[from + i]).toBeCloseTo(part, 2);
}

describe("colours on the GPU", () => {
  it("of a scalar are the gradient's, over the range, with what lies beyond at its ends", async () => {
    const stored = [0, 100, 250, 400, 500, 900];
    const { values } = await draw(
      {
        style: { color: "gpsTime", gradient: "spectral", range: [2e8 + 1, 2e8 + 5] },
        node: { columns: { get: () => ({ scale: 0.01, offset: 2e8 }) } },
        columns: { position: stored.flatMap(() => [0, 0, -5]), gpsTime: stored },
      },
      ["v_color"],
    );
    const stops = GRADIENTS.spectral;
    // Stored 100 is the range's least value, 500 its greatest; 250 lies at 0.375, between stops 3 and 4 of 10.
    const between = stops[3].color.map((part, i) => part + 0.75 * (stops[4].color[i] - part));
    const expected = [stops[0].color, stops[0].color, between, undefined, stops[10].color, stops[10].color];
    expected.forEach((color, point) => {
      if (color) expectColour(values, 3 * point, color);
    });
  });

  it("of a constant column are right where its numbers are large", async () => {
    const { values } = await draw(
      {
        style: { color: "gpsTime", gradient: "greyscale" },
        node: { columns: { get: () => ({ scale: 1, offset: 0, constant: [2e8 + 900] }) } },
        columns: { position: [0, 0, -5], gpsTime: [0] },
      },
      ["v_color"],
    );
    expect(values[0]).toBeCloseTo(0.25, 5);
  });

  it("of classes are the table's, as it was edited", async () => {
    const classes = { ...styleOf().classes, 6: { name: "roof", color: [1, 0, 0.5] as const, show: true } };
    const { values } = await draw(
      {
        style: { color: "classification", classes },
        columns: { position: [0, 0, -5, 0, 0, -5], classification: [6, 2] },
      },
      ["v_color"],
    );
    expect(values[0]).toBeCloseTo(1, 2);
    expect(values[2]).toBeCloseTo(0.5, 2);
    expectColour(values, 3, styleOf().classes[2].color);
  });

  it("are blended by their shares, and toned", async () => {
    const { values } = await draw(
      {
        style: { color: "rgb", blend: { color: "intensity", share: 0.25 }, gradient: "greyscale", gamma: 2 },
        node: { columns: { get: () => ({ scale: 1, offset: 0 }) } },
        columns: { position: [0, 0, -5], color: [127.5, 255, 0, 255], intensity: [3200] },
      },
      ["v_color"],
    );
    const grey = 0.8 ** 2;
    const blended = [0.25, 1, 0].map((part) => 0.75 * part + 0.25 * grey);
    expectColour(values, 0, blended);
  });
});

describe("the visible octree on the GPU", () => {
  /** Some drawn nodes: each child is drawn by chance, deeper where x is small. */
  function someTree(seed: number): VoxelKey[] {
    const next = random(seed);
    const keys: VoxelKey[] = [{ depth: 0, x: 0, y: 0, z: 0 }];
    for (let at = 0; at < keys.length; at++) {
      const { depth, x, y, z } = keys[at];
      for (let octant = 0; octant < 8; octant++) {
        const key = {
          depth: depth + 1,
          x: 2 * x + (octant & 1),
          y: 2 * y + ((octant >> 1) & 1),
          z: 2 * z + (octant >> 2),
        };
        const likely = depth < 2 ? 0.9 : depth < 9 ? 0.28 : 0;
        if (next() < likely) keys.push(key);
      }
    }
    return keys;
  }

  it("gives each point the level of the deepest drawn node around it, from its own node down", async () => {
    const keys = someTree(4);
    expect(keys.length).toBeGreaterThan(300);
    const names = new Set(keys.map(({ depth, x, y, z }) => `${depth} ${x} ${y} ${z}`));
    const nodes = keys.map((key) => ({
      key,
      points: 100,
      count: 100,
      leaf: false,
      spacing: 2 ** -key.depth,
      box: [0, 0, 0, 1, 1, 1],
    }));
    const { texture, width, height, indices } = encodeVisibleOctree(nodes);
    const next = random(8);
    // The root, and some nodes farther down.
    for (const own of [0, 3, 40, 120]) {
      const key = keys[own];
      const places = Array.from({ length: 500 }, () => [next(), next(), next()]);
      const expected = places.map((place) => {
        let depth = key.depth;
        for (let below = 1; ; below++) {
          const cell = [key.x, key.y, key.z].map((index, axis) =>
            Math.floor((index + place[axis]) * 2 ** below),
          );
          if (!names.has(`${key.depth + below} ${cell.join(" ")}`)) return depth;
          depth++;
        }
      });
      const { values } = await draw(
        {
          style: { color: "levelOfDetail", gradient: "greyscale", range: [0, 255], size: "adaptive" },
          facts: { levels: [0, 9] },
          // The node frame is turned and larger than the cube: x there is y here.
          node: {
            octreeIndex: indices[own],
            level: key.depth,
            spacing: 2 ** -key.depth,
            toCube: [0, 0.1, 0, 0, 0.1, 0, 0, 0, 0, 0, -0.1, -0.5],
          },
          columns: { position: places.flatMap(([x, y, z]) => [10 * y, 10 * x, -10 * z - 5]) },
          textures: [{ name: "u_octree", width, height, data: [...texture], float: false }],
        },
        ["v_color", "gl_PointSize"],
      );
      const levels = places.map((_, point) => Math.round(values[4 * point] * 255));
      expect(levels).toEqual(expected);
      // Width: two spacings of that level, seen from the point's depth in a view of 90°.
      places.forEach(([, , z], point) => {
        const width = (2 * 2 ** -expected[point] * (SIZE / 2)) / (10 * z + 5);
        expect(values[4 * point + 3]).toBeCloseTo(Math.max(1, width), 4);
      });
    }
  });
});

describe("filters on the GPU", () => {
  it("leave the same points as on exact records", async () => {
    const filter: PointFilter = {
      classes: [2, 6, 255],
      returns: ["last", "first"],
      ranges: { intensity: [100, 60_000], elevation: [12.34, 80] },
    };
    const next = random(6);
    const scales: Record<string, { scale: number; offset: number }> = {
      elevation: { scale: 0.01, offset: 12 },
    };
    const points = Array.from({ length: 800 }, () => {
      const of = 1 + Math.floor(3 * next());
      return {
        classification: [2, 6, 7, 255][Math.floor(4 * next())],
        numberOfReturns: of,
        returnNumber: 1 + Math.floor(of * next()),
        intensity: [99, 100, 101, 59_999, 60_000, 60_001][Math.floor(6 * next())],
        // Stored numbers around the ends of the range.
        elevation: [33, 34, 35, 6799, 6800, 6801][Math.floor(6 * next())],
      };
    });
    const column = (name: keyof (typeof points)[0]) => points.map((point) => point[name]);
    const { values } = await draw(
      {
        facts: { filter },
        node: { columns: { get: (name) => scales[name] ?? { scale: 1, offset: 0 } } },
        columns: {
          position: points.flatMap(() => [0, 0, -5]),
          color: points.flatMap(() => [255, 255, 255, 255]),
          classification: column("classification"),
          numberOfReturns: column("numberOfReturns"),
          returnNumber: column("returnNumber"),
          intensity: column("intensity"),
          elevation: column("elevation"),
        },
      },
      ["gl_Position"],
    );
    const drawn = points.map((_, point) => values[4 * point] !== 2);
    const kept = points.map((point) => {
      // The record's own decimal number: stored hundredths over 12.
      const record = { ...point, elevation: (1200 + point.elevation) / 100 };
      return passesFilter(record, filter, styleOf());
    });
    expect(drawn).toEqual(kept);
    expect(new Set(kept).size).toBe(2);
  });
});

describe("clips on the GPU", () => {
  const space: SourceSpace = {
    place: (_x, _y, _z, out) => out,
    boundingBox: { min: [0, 0, 0], max: [1, 1, 1] },
  };

  it("are what float32 makes of them in the tests, point for point", async () => {
    const [longitude, latitude] = [2.9, 0.9];
    const corner = (turn: number, distance: number) => {
      const end = geodesicFrom(longitude, latitude, turn, distance);
      return [end.longitude, end.latitude] as const;
    };
    const star = (radius: number, shift: number) =>
      Array.from({ length: 40 }, (_, i) => corner(shift - (Math.PI * i) / 20, radius * (i % 2 ? 0.5 : 1)));
    const center = { longitude, latitude, height: 10 };
    const set = new ClipSet([
      Clip.polygon(star(300, 0)),
      Clip.polygon(star(420, 0.1), { bottom: 0, top: 90 }),
      Clip.polygon(star(60, 0.4), { mode: "outside" }),
      Clip.box({ center, size: [500, 40, 30], heading: 0.3, mode: "outside" }),
      Clip.box({ center, size: [80, 800, 100], heading: 0.7, mode: "highlight" }),
    ]);
    const origin = new Float64Array(3);
    geodeticToEcef(longitude + 1e-5, latitude, 20, origin);
    const node = { frame: eastNorthUp(origin), box: [-500, -500, -60, 500, 500, 120] };
    const clips = set.over(space).forNode(node);
    expect([clips.state, clips.count]).toEqual(["crossing", 5]);
    const next = random(12);
    const points = Array.from({ length: 3000 }, () =>
      [1000 * next() - 500, 1000 * next() - 500, 180 * next() - 60].map(Math.fround),
    );
    const { data, width, height, records } = clipTexture([clips]);
    const { values } = await draw(
      {
        facts: { clips: 4, highlights: 1 },
        node: { clips: records[0] },
        columns: { position: points.flat(), color: points.flatMap(() => [0, 0, 255, 255]) },
        textures: [{ name: "u_clips", width, height, data: [...data], float: true }],
      },
      ["gl_Position", "v_color"],
    );
    const counts = { drawn: 0, lit: 0 };
    points.forEach((point, index) => {
      const [keeping, around, cut, lit] = rolesOf(clips, point as [number, number, number]);
      const drawn = cut === 0 && (keeping === 0 || around > 0);
      expect(values[7 * index] !== 2).toBe(drawn);
      if (!drawn) return;
      expect(values[7 * index + 4]).toBeCloseTo(lit > 0 ? 0.6 : 0, 5);
      counts.drawn++;
      if (lit > 0) counts.lit++;
    });
    expect(counts.drawn).toBeGreaterThan(300);
    expect(counts.lit).toBeGreaterThan(20);
  });
});

describe("shapes", () => {
  const single = { position: [0.3, -0.2, -20], color: [255, 0, 0, 255] };

  it("a paraboloid recedes from the point's own depth by the square of the distance from its middle", async () => {
    const { values, depths, plan } = await draw(
      { style: { shape: "paraboloid", pointSize: 21 }, columns: single },
      undefined,
    );
    expect(plan.active.has("paraboloid")).toBe(true);
    const [x, y] = [0.3, -0.2].map((at) => (at / 20 + 1) * (SIZE / 2));
    const radius = (21 / 2) * (20 / (SIZE / 2));
    let seen = 0;
    for (let row = 0; row < SIZE; row++) {
      for (let column = 0; column < SIZE; column++) {
        const squared = ((column + 0.5 - x) ** 2 + (row + 0.5 - y) ** 2) / 10.5 ** 2;
        const at = row * SIZE + column;
        if (Math.abs(squared - 1) < 0.02) continue;
        expect(values[4 * at] > 0).toBe(squared < 1);
        if (squared >= 1) continue;
        const z = 20 + radius * squared;
        expect(depths[at]).toBeCloseTo((1001 / 999 - 2000 / 999 / z) / 2 + 0.5, 4);
        seen++;
      }
    }
    expect(seen).toBeGreaterThan(300);
  });

  it("the weights of a splat are (1 − d²) to the hardness, its colours times that", async () => {
    const { values } = await draw(
      { style: { highQuality: true, pointSize: 21, hardness: 3 }, columns: single, pass: "splat" },
      undefined,
    );
    const [x, y] = [0.3, -0.2].map((at) => (at / 20 + 1) * (SIZE / 2));
    for (const [column, row] of [
      [32, 31],
      [36, 34],
      [29, 40],
      [40, 31],
    ]) {
      const squared = ((column + 0.5 - x) ** 2 + (row + 0.5 - y) ** 2) / 10.5 ** 2;
      const weight = Math.max(0, 1 - squared) ** 3;
      const at = 4 * (row * SIZE + column);
      expect(values[at + 3]).toBeCloseTo(weight, 2);
      expect(values[at]).toBeCloseTo(weight, 2);
    }
  });

  it("splats are drawn nearer by their radius, on the ray through them, and the depth pass is not", async () => {
    const style = { highQuality: true, pointSize: 16 };
    const columns = { position: [3, -4, -20], color: [255, 0, 0, 255] };
    const splat = await draw({ style, columns, pass: "splat" }, ["gl_Position"]);
    const depth = await draw({ style, columns, pass: "depth" }, ["gl_Position"]);
    // 8 px of 32 px per tan 45° at 20 m: 5 m.
    expect(depth.values[3]).toBeCloseTo(20, 4);
    expect(splat.values[3]).toBeCloseTo(15, 4);
    for (const axis of [0, 1]) {
      expect(splat.values[axis] / splat.values[3]).toBeCloseTo(depth.values[axis] / depth.values[3], 5);
    }
  });

  it("the numbers of points are read back exactly", async () => {
    const firstId = 0x1234567;
    const { values } = await draw(
      {
        style: { pointSize: 3 },
        node: { firstId },
        columns: { position: [0, 0, -20, 10, 0, -20] },
        pass: "id",
      },
      undefined,
    );
    const id = (column: number, row: number) =>
      [0, 1, 2, 3].reduce(
        (sum, byte) => sum + Math.round(values[4 * (row * SIZE + column) + byte] * 255) * 256 ** byte,
        0,
      );
    expect([id(32, 32), id(48, 32), id(5, 5)]).toEqual([firstId + 1, firstId + 2, 0]);
  });
});

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
    const { vertex, fragment, uniforms } = composePass("edl", plan, "webgl2");
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
    const { values } = await run(page, {
      vertex,
      fragment,
      declared: uniforms,
      uniforms: { ...VIEW, u_projection: projection, ...layerUniforms(plan, whole, scene) },
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
