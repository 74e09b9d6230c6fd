import { eastNorthUp, geodesicFrom, geodeticToEcef } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { rolesOf } from "../../layer/src/clips/clip-shader.fixture.js";
import { Clip, ClipSet, clipTexture, type SourceSpace } from "../../layer/src/clips/index.js";
import { draw, random, usePage } from "./effect-draw.js";

const page = usePage();

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
      page(),
      {
        facts: { clips: 4, highlights: 1 },
        node: { clips: records[0] },
        columns: { position: points.flat(), rgb: points.flatMap(() => [0, 0, 255, 255]) },
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
