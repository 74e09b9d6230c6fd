import {
  eastNorthUp,
  exactTransform,
  type Frame,
  geodesicBetween,
  geodesicFrom,
  geodeticToEcef,
  pointIn,
  pointTransform,
  resolveCrs,
  type Vector,
} from "@groma/georef";
import { describe, expect, it } from "vitest";
import { Clip } from "./clip.js";
import { ClipSet } from "./clip-set.js";
import { draws, EARTH } from "./clip-shader.fixture.js";
import { sourceRing } from "./rings.js";
import { type Corner, extendedPlace } from "./source-space.js";
import { finish } from "./steps.js";
import type { SourceSpace } from "./volume.js";

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

function ecefOf(longitude: number, latitude: number, height: number): Vector {
  const out = new Float64Array(3);
  geodeticToEcef(longitude, latitude, height, out);
  return [out[0], out[1], out[2]];
}

/** A star around a place: corners by turns at a greater and a lesser distance, counter-clockwise; concave where they differ. */
function star(
  longitude: number,
  latitude: number,
  radius: number,
  corners: number,
  hollow: number,
): Corner[] {
  return Array.from({ length: corners }, (_, index): Corner => {
    const distance = radius * (index % 2 === 0 ? 1 : hollow);
    const end = geodesicFrom(longitude, latitude, (-2 * Math.PI * index) / corners, distance);
    return [end.longitude, end.latitude];
  });
}

/** Places of the world that are hard, and one that is not. */
const PLACES: Readonly<Record<string, Corner>> = {
  Zurich: [0.149, 0.8267],
  "north pole": [0.3, Math.PI / 2 - 1e-9],
  "near the south pole": [-2, -Math.PI / 2 + 1e-5],
  antimeridian: [Math.PI - 1e-7, -0.3],
  equator: [-1.2, 0],
};

const NODE_SIZES = [10, 100, 1000, 20_000];

/** A node of a size somewhere around a point, so that the point is anywhere in it. */
function nodeAround(
  ecef: Vector,
  size: number,
  next: () => number,
): { frame: Frame; box: number[]; local: Vector } {
  const about = eastNorthUp(ecef);
  // However the node's own axes lie to these (at a pole anyhow), the point is within its box.
  const shift = [0, 1, 2].map(() => ((next() - 0.5) * size) / Math.sqrt(3));
  const origin = [0, 1, 2].map(
    (axis) =>
      ecef[axis] +
      about.rotation[axis] * shift[0] +
      about.rotation[axis + 3] * shift[1] +
      about.rotation[axis + 6] * shift[2],
  );
  const frame = eastNorthUp(origin);
  const half = size / 2;
  return { frame, box: [-half, -half, -half, half, half, half], local: pointIn(frame, ...ecef) };
}

describe.each(Object.entries(PLACES))("polygons at: %s", (name, [longitude, latitude]) => {
  const widths = [1, 30, 1000, 30_000, 1_000_000];

  it.each(widths)("%d m wide keep what is inside by more than the tolerance", (width) => {
    const next = random(width + name.length);
    const ring = star(longitude, latitude, width / 2, 10, 0.55);
    const volumes = new ClipSet([Clip.polygon(ring)]).over(EARTH);
    const wrong: string[] = [];
    for (let trial = 0; trial < 120; trial++) {
      const corner = Math.floor(next() * ring.length);
      const [a, b] = [ring[corner], ring[(corner + 1) % ring.length]];
      const edge = geodesicBetween(...a, ...b);
      const foot = geodesicFrom(...a, edge.azimuthFrom, edge.distance * (0.1 + 0.8 * next()));
      const size = NODE_SIZES[trial % NODE_SIZES.length];
      // A little more than the tolerance, or up to 1 % of the polygon.
      const tolerance = 1e-3 + 4 * 2 ** -24 * size;
      // A coarse node's float32 cannot show a small polygon.
      if (tolerance > 0.003 * width) continue;
      const aside = trial % 2 === 0 ? tolerance * (1 + 1e-6) : Math.max(tolerance, next() * 0.01 * width);
      const inside = next() < 0.5;
      // Counter-clockwise: inside is to the left.
      const turn = inside ? -Math.PI / 2 : Math.PI / 2;
      const at = geodesicFrom(foot.longitude, foot.latitude, foot.azimuth + turn, aside);
      const ecef = ecefOf(at.longitude, at.latitude, -100 + 900 * next());
      const node = nodeAround(ecef, size, next);
      const seen = draws(volumes.forNode(node), node.local);
      if (seen !== inside) wrong.push(`shader: ${aside} m ${inside ? "inside" : "outside"}, node ${size} m`);
      if (volumes.keeps(ecef, []) !== inside)
        wrong.push(`exact: ${aside} m ${inside ? "inside" : "outside"}`);
    }
    expect(wrong.slice(0, 3)).toEqual([]);
  });

  it("agree with the sum of angles for places anywhere, and never reject what they keep", () => {
    const next = random(7);
    const ring = star(longitude, latitude, 5000, 14, 0.4);
    const volumes = new ClipSet([Clip.polygon(ring, { bottom: 0, top: 300 })]).over(EARTH);
    const outline = densified(ring, 64);
    let kept = 0;
    for (let trial = 0; trial < 60; trial++) {
      const at = geodesicFrom(longitude, latitude, 2 * Math.PI * next(), 6000 * Math.sqrt(next()));
      const height = -200 + 700 * next();
      const inside = winding(outline, at.longitude, at.latitude) && height >= 0 && height <= 300;
      const ecef = ecefOf(at.longitude, at.latitude, height);
      expect(volumes.keeps(ecef, [])).toBe(inside);
      const node = nodeAround(ecef, 2000, next);
      expect(draws(volumes.forNode(node), node.local)).toBe(inside);
      const [x, y, z] = node.frame.origin;
      if (inside) expect(volumes.rejects({ x, y, z, radius: 1000 * Math.sqrt(3) })).toBe(false);
      if (volumes.forNode(node).state === "out") expect(inside).toBe(false);
      if (inside) kept++;
    }
    expect(kept).toBeGreaterThan(3);
  });
});

/** A ring with more vertices on its edges. */
function densified(ring: readonly Corner[], pieces: number): Corner[] {
  return ring.flatMap((corner, index) => {
    const edge = geodesicBetween(...corner, ...ring[(index + 1) % ring.length]);
    return Array.from({ length: pieces }, (_, piece): Corner => {
      const at = geodesicFrom(...corner, edge.azimuthFrom, (edge.distance * piece) / pieces);
      return [at.longitude, at.latitude];
    });
  });
}

/** Whether the directions to a ring's vertices turn once around: GeographicLib's azimuths, nothing else. */
function winding(outline: readonly Corner[], longitude: number, latitude: number): boolean {
  let sum = 0;
  const azimuths = outline.map((corner) => geodesicBetween(longitude, latitude, ...corner).azimuthFrom);
  azimuths.forEach((azimuth, index) => {
    const turn = azimuths[(index + 1) % azimuths.length] - azimuth;
    sum += turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI));
  });
  return Math.abs(sum) > Math.PI;
}

describe("polygons in source coordinates", () => {
  // Gauss-Krüger on another ellipsoid with a Helmert shift: source z is no normal of WGS 84.
  const crs =
    "+proj=tmerc +lat_0=0 +lon_0=9 +k=1 +x_0=3500000 +ellps=bessel +towgs84=598.1,73.7,418.2,0.202,0.045,-2.455,6.7";
  const transform = pointTransform(
    exactTransform(resolveCrs({ file: "a", given: crs, givenVertical: "ellipsoidal" })),
  );
  const space: SourceSpace = {
    place(x, y, z, out) {
      transform(x, y, z, out, 0);
      return out;
    },
    boundingBox: { min: [3_510_000, 5_400_000, 100], max: [3_514_000, 5_404_000, 900] },
  };
  const ring: Corner[] = [
    [3_511_000, 5_401_000],
    [3_513_200, 5_401_400],
    [3_512_000, 5_402_000],
    [3_513_500, 5_409_000],
    [3_510_700, 5_403_100],
  ];

  it("cut where the source's lines are, to the tolerance, at any height", () => {
    const volumes = new ClipSet([Clip.polygon(ring, { coordinates: "source", bottom: 200, top: 600 })]).over(
      space,
    );
    const next = random(3);
    const wrong: string[] = [];
    for (let trial = 0; trial < 400; trial++) {
      const corner = Math.floor(next() * ring.length);
      const [a, b] = [ring[corner], ring[(corner + 1) % ring.length]];
      const share = 0.02 + 0.96 * next();
      const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
      const size = NODE_SIZES[trial % 3];
      const aside = (1.2e-3 + 4 * 2 ** -24 * size) * (next() < 0.5 ? 1 : 1 + 100 * next());
      const side = next() < 0.5 ? 1 : -1;
      const x = a[0] + share * (b[0] - a[0]) - (side * aside * (b[1] - a[1])) / length;
      const y = a[1] + share * (b[1] - a[1]) + (side * aside * (b[0] - a[0])) / length;
      if (y > space.boundingBox.max[1]) continue;
      const z = 150 + 500 * next();
      if (Math.min(Math.abs(z - 200), Math.abs(z - 600)) < 0.01) continue;
      const inside = side > 0 && z > 200 && z < 600;
      const ecef = space.place(x, y, z, new Float64Array(3));
      const node = nodeAround([ecef[0], ecef[1], ecef[2]], size, next);
      if (draws(volumes.forNode(node), node.local) !== inside) wrong.push(`${x} ${y} ${z}, node ${size} m`);
      if (volumes.keeps(ecef, [x, y, z]) !== inside) wrong.push(`exact: ${x} ${y} ${z}`);
    }
    expect(wrong.slice(0, 3)).toEqual([]);
  });

  it("have no more vertices than corners where their edges are short", () => {
    const corners = Array.from({ length: 60 }, (_, index): Corner => {
      const angle = (2 * Math.PI * index) / 60;
      return [3_512_000 + 150 * Math.cos(angle), 5_402_000 + 150 * Math.sin(angle)];
    });
    expect(finish(sourceRing(corners, extendedPlace(space))).count).toBe(60);
  });

  it("end where source z says, to the tolerance", () => {
    const volumes = new ClipSet([Clip.polygon(ring, { coordinates: "source", bottom: 200, top: 600 })]).over(
      space,
    );
    const next = random(5);
    for (let trial = 0; trial < 100; trial++) {
      const [x, y] = [3_511_300 + 300 * next(), 5_401_400 + 300 * next()];
      const size = NODE_SIZES[trial % 3];
      const aside = (1.2e-3 + 4 * 2 ** -24 * size) * (next() < 0.5 ? 1 : -1);
      const atTop = next() < 0.5;
      const z = (atTop ? 600 : 200) + aside;
      const ecef = space.place(x, y, z, new Float64Array(3));
      const node = nodeAround([ecef[0], ecef[1], ecef[2]], size, next);
      expect(draws(volumes.forNode(node), node.local)).toBe(aside > 0 !== atTop);
    }
  });
});

describe("boxes and planes", () => {
  const center = { longitude: 2.1, latitude: -0.7, height: 250 };
  const ecef = ecefOf(center.longitude, center.latitude, center.height);
  const { rotation } = eastNorthUp(ecef);
  const moved = (east: number, north: number, up: number): Vector => [
    ecef[0] + rotation[0] * east + rotation[3] * north + rotation[6] * up,
    ecef[1] + rotation[1] * east + rotation[4] * north + rotation[7] * up,
    ecef[2] + rotation[2] * east + rotation[5] * north + rotation[8] * up,
  ];

  it("a box turned by heading, pitch and roll is the turned box", () => {
    const [heading, pitch, roll] = [0.6, 0.3, -0.2];
    const size = [40, 900, 6] as const;
    const volumes = new ClipSet([Clip.box({ center, size, heading, pitch, roll })]).over(EARTH);
    const next = random(11);
    let inside = 0;
    for (let trial = 0; trial < 600; trial++) {
      // In the box's own axes, then turned by three rotations one after the other.
      let [x, y, z] = size.map((edge) => (next() - 0.5) * 1.4 * edge);
      const least = Math.min(...[x, y, z].map((at, axis) => Math.abs(Math.abs(at) - size[axis] / 2)));
      if (least < 2e-3) continue;
      const within = [x, y, z].every((at, axis) => Math.abs(at) < size[axis] / 2);
      [x, z] = [x * Math.cos(roll) + z * Math.sin(roll), z * Math.cos(roll) - x * Math.sin(roll)];
      [y, z] = [y * Math.cos(pitch) - z * Math.sin(pitch), y * Math.sin(pitch) + z * Math.cos(pitch)];
      [x, y] = [x * Math.cos(heading) + y * Math.sin(heading), y * Math.cos(heading) - x * Math.sin(heading)];
      const point = moved(x, y, z);
      const node = nodeAround(point, 200, next);
      expect(volumes.keeps(point, [])).toBe(within);
      expect(draws(volumes.forNode(node), node.local)).toBe(within);
      if (within) inside++;
    }
    expect(inside).toBeGreaterThan(100);
  });

  it("a plane keeps its inner side to the tolerance, a thousand kilometres from where it is given too", () => {
    const volumes = new ClipSet([Clip.plane({ through: center, heading: 0.4, pitch: 0.1 })]).over(EARTH);
    const normal = [Math.cos(0.1) * Math.sin(0.4), Math.cos(0.1) * Math.cos(0.4), Math.sin(0.1)];
    const next = random(2);
    for (let trial = 0; trial < 200; trial++) {
      const along = (next() - 0.5) * 2e6;
      const aside = (next() < 0.5 ? 1 : -1) * 1.001e-3;
      const across = [Math.cos(0.4), -Math.sin(0.4), 0];
      const point = moved(
        ...([0, 1, 2].map((axis) => across[axis] * along + normal[axis] * aside) as unknown as Vector),
      );
      const node = nodeAround(point, 200, next);
      expect(volumes.keeps(point, [])).toBe(aside > 0);
      expect(draws(volumes.forNode(node), node.local)).toBe(aside > 0);
    }
  });

  it("many volumes together keep the union of what is inside, less what is cut", () => {
    const box = (mode: "inside" | "outside", east: number) => {
      const [x, y, z] = moved(east, 0, 0);
      return { mode, clip: Clip.box({ center, size: [10, 10, 10], mode }), at: [x, y, z] as Vector, east };
    };
    const set = new ClipSet();
    set.add(box("inside", 0).clip);
    set.add(Clip.box({ center, size: [30, 4, 4] }));
    set.add(Clip.box({ center, size: [4, 4, 4], mode: "outside" }));
    set.add(Clip.box({ center, size: [100, 100, 100], mode: "highlight" }));
    const volumes = set.over(EARTH);
    const cases: readonly (readonly [number, number, boolean])[] = [
      [0, 0, false],
      [3, 0, true],
      [12, 0, true],
      [12, 3, false],
      [4, 4, true],
      [16, 0, false],
    ];
    for (const [east, north, kept] of cases) {
      const point = moved(east, north, 0);
      const node = nodeAround(point, 50, random(1));
      expect([east, north, volumes.keeps(point, [])]).toEqual([east, north, kept]);
      expect([east, north, draws(volumes.forNode(node), node.local)]).toEqual([east, north, kept]);
    }
    expect([set.cutting, set.highlighting]).toEqual([3, 1]);
  });

  it("say of a node wholly inside, wholly outside, and of one apart, that it needs no test", () => {
    const next = random(9);
    const inner = nodeAround(ecef, 1, next);
    const far = nodeAround(moved(500, 0, 0), 1, next);
    const keep = new ClipSet([Clip.box({ center, size: [100, 100, 100] })]).over(EARTH);
    const cut = new ClipSet([Clip.box({ center, size: [100, 100, 100], mode: "outside" })]).over(EARTH);
    expect([keep.forNode(inner).state, keep.forNode(far).state]).toEqual(["in", "out"]);
    expect([cut.forNode(inner).state, cut.forNode(far).state]).toEqual(["out", "in"]);
    const sphere = ({ frame }: { frame: Frame }) => {
      const [x, y, z] = frame.origin;
      return { x, y, z, radius: 1 };
    };
    expect([keep.rejects(sphere(inner)), keep.rejects(sphere(far))]).toEqual([false, true]);
    expect([cut.rejects(sphere(inner)), cut.rejects(sphere(far))]).toEqual([true, false]);
  });
});
