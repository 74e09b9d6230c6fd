import { exactTransform, fitPlacement, placeIntegers, pointTransform } from "@groma/georef";
import { expect, it } from "vitest";
import { OctreeNode, type Selection } from "../octree/index.js";
import { nodesHere } from "../octree/nodes-here.fixture.js";
import type { FrameCamera } from "./frame-camera.js";
import { sceneFacts } from "./scene-facts.js";

/** Points along the edge of a node's cube, as the converter chooses them. */
const GRID = 128;
/** `maximumScreenSpaceError` where nothing else is said: pixels between the points of a node that is refined. */
const REFINED = 2;
/** Pixels from which a point is seen beside its place. */
const SEEN = 0.05;
const HEIGHT = 1000;
const FIELD_OF_VIEW = Math.PI / 3;
const METRE = { name: "metre", kind: "linear", size: 1, declared: true } as const;
const DEGREE = { name: "degree", kind: "angular", size: Math.PI / 180, declared: true } as const;

/** A view from a place along an axis; where it looks plays no part. */
function cameraAt(position: readonly [number, number, number]): FrameCamera {
  return {
    view: {
      ...{ position: [...position], direction: [1, 0, 0], planes: new Array(24).fill(0), height: HEIGHT },
      ...{ projection: { kind: "perspective", fieldOfView: FIELD_OF_VIEW }, horizon: false },
    },
    ...{ width: HEIGHT, pixelRatio: 1, near: 0.1, depth: { own: true, scene: true }, pose: () => [] },
  };
}

const layer = {
  ...{ attributes: [], clips: 0, highlights: 0 },
  ...{ filter: undefined, silhouettes: undefined, placing: undefined },
};
const UTM = "+proj=utm +zone=33 +ellps=WGS84 +towgs84=0,0,0";
const LAEA = "+proj=laea +lat_0=52 +lon_0=10 +x_0=4321000 +y_0=3210000 +ellps=GRS80 +towgs84=0,0,0";

it.each([
  ["UTM", UTM, 500_000, 5_500_000, 20_000],
  ["UTM", UTM, 500_000, 5_500_000, 100_000],
  ["LAEA Europe", LAEA, 4_321_000, 3_210_000, 400_000],
  ["LAEA Europe", LAEA, 4_321_000, 3_210_000, 1_600_000],
  ["degrees", "+proj=longlat +ellps=WGS84 +towgs84=0,0,0", 12, 48, 5],
] as const)(
  "a node of %s is right to 0.05 pixels from where it is refined on: %#",
  (_, proj4, x, y, edge) => {
    const unit = proj4.includes("longlat") ? DEGREE : METRE;
    const height = { kind: "ellipsoidal" } as const;
    const exact = exactTransform({ proj4, horizontalUnit: unit, verticalUnit: METRE, height }, 0);
    const [minX, minY] = [x - edge / 2, y - edge / 2];
    const domain = { minX, minY, minZ: 0, maxX: minX + edge, maxY: minY + edge, maxZ: 3000 };
    const placement = fitPlacement(exact, domain, 0.001);
    const count = 500;
    const scale = [edge / 2 ** 30, edge / 2 ** 30, 3000 / 2 ** 30];
    // Numbers that fill the node evenly (R. Korobov).
    const xyz = Int32Array.from({ length: 3 * count }, (_, i) =>
      Math.floor(((i * 0.6180339887) % 1) * 2 ** 30),
    );
    const local = new Float32Array(3 * count);
    placeIntegers(placement, xyz, count, scale, [minX, minY, 0], local);
    const { origin, rotation: r } = placement.frame;
    const truth = pointTransform(exact);
    const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
    const want = new Float64Array(3);
    let off = 0;
    for (let i = 0; i < count; i++) {
      const p = local.subarray(3 * i, 3 * i + 3);
      const source = [0, 1, 2].map((axis) => xyz[3 * i + axis]! * scale[axis]! + [minX, minY, 0][axis]!);
      truth(source[0]!, source[1]!, source[2]!, want, 0);
      const apart = [0, 1, 2].map((axis) => {
        box[axis] = Math.min(box[axis]!, p[axis]!);
        box[axis + 3] = Math.max(box[axis + 3]!, p[axis]!);
        return origin[axis]! + r[axis]! * p[0]! + r[axis + 3]! * p[1]! + r[axis + 6]! * p[2]! - want[axis]!;
      });
      off = Math.max(off, Math.hypot(...apart));
    }
    expect(off).toBeLessThanOrEqual(placement.bound);

    const side = Math.max(box[3]! - box[0]!, box[4]! - box[1]!);
    const pixelsAt = (distance: number) => HEIGHT / (2 * distance * Math.tan(FIELD_OF_VIEW / 2));
    const refined = ((side / GRID) * HEIGHT) / (2 * REFINED * Math.tan(FIELD_OF_VIEW / 2));
    const node = new OctreeNode({ depth: 0, x: 0, y: 0, z: 0 }, "listed");
    node.pointCount = count;
    node.bounds = { x: origin[0]!, y: origin[1]!, z: origin[2]!, radius: side, spacing: side / GRID };
    const stated = (distance: number) => {
      const up = box[5]! + distance;
      const position = [0, 1, 2].map((axis) => origin[axis]! + r[axis + 6]! * up) as [number, number, number];
      const vertices = { box, bound: placement.bound, frame: placement.frame, toCube: new Float64Array(12) };
      const selection = {
        nodes: [node],
        points: count,
        counts: [count],
        spacings: [REFINED],
      } as unknown as Selection;
      return sceneFacts(cameraAt(position), selection, nodesHere([node], [vertices]), layer).placingPixels!;
    };
    const there = stated(refined);
    console.info(
      `${side.toFixed(0)} m wide: ${(off * 1e3).toFixed(2)} mm off, ${(off * pixelsAt(refined)).toExponential(1)} px, ${there.toExponential(1)} px stated at ${refined.toFixed(0)} m`,
    );
    expect(there).toBeLessThan(SEEN);
    // Its points stay when it is refined, and are seen from nearer: what they are off is never said to be less than it is.
    for (const nearer of [refined / 10, 1000, 10]) {
      expect(stated(nearer)).toBeGreaterThanOrEqual(off * pixelsAt(nearer));
    }
  },
);
