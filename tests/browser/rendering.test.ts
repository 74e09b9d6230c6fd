import { Clip } from "@groma/layer";
import type { PNG } from "pngjs";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { pythonMissing } from "../python.js";
import { type LayerOptions, MIDDLE, type Pose } from "./stage/setting.js";
import { decode, difference, differenceToExpected, openStage, type StagePage } from "./stage.js";

/** One way to draw, and the way that it must not be mistaken for. */
interface Case {
  readonly scan: string;
  readonly options: LayerOptions;
  readonly pose?: Pose;
  /** The same picture without what the case is about; default: points of the style's size in own colours. */
  readonly without?: LayerOptions;
}

const OBLIQUE: Pose = { range: 26, pitch: -35, heading: 30 };
const small = { pointSize: 3 } as const;
/** Corners of a square, east and north of the middle of the scans, metres. */
const SQUARE = [
  [-6, -6],
  [6, -6],
  [6, 6],
  [-6, 6],
] as const;
const [EAST, NORTH, UP] = MIDDLE;

/** From the style's words to a case. */
const cases: Readonly<Record<string, Case>> = {
  rgb: { scan: "stripes", options: { style: small }, without: { style: { ...small, color: "intensity" } } },
  intensity: { scan: "stripes", options: { style: { ...small, color: "intensity" } } },
  gradient: {
    scan: "stripes",
    options: { style: { ...small, color: "intensity", gradient: "turbo", range: [0, 60_000] } },
    without: { style: { ...small, color: "intensity" } },
  },
  elevation: { scan: "steps", options: { style: { ...small, color: "elevation" } } },
  "ellipsoidal-height": {
    scan: "steps",
    options: { style: { ...small, color: "ellipsoidalHeight", range: [500, 508] } },
    without: { style: { ...small, color: "elevation" } },
  },
  classification: { scan: "stripes", options: { style: { ...small, color: "classification" } } },
  "classes-edited": {
    scan: "stripes",
    options: {
      style: {
        ...small,
        color: "classification",
        classes: { 3: { color: [1, 0, 1] }, 5: { show: false } },
      },
    },
    without: { style: { ...small, color: "classification" } },
  },
  returns: { scan: "stripes", options: { style: { ...small, color: "returnNumber" } } },
  "return-count": {
    scan: "stripes",
    options: { style: { ...small, color: "numberOfReturns", range: [0, 7] } },
  },
  "gps-time": { scan: "stripes", options: { style: { ...small, color: "gpsTime", gradient: "greyscale" } } },
  "scan-angle": { scan: "stripes", options: { style: { ...small, color: "scanAngle", gradient: "turbo" } } },
  "source-id": {
    scan: "stripes",
    options: { style: { ...small, color: "pointSourceId", gradient: "spectral" } },
  },
  "user-data": { scan: "stripes", options: { style: { ...small, color: "userData", gradient: "terrain" } } },
  "extra-bytes": { scan: "stripes", options: { style: { ...small, color: "amplitude" } } },
  "level-of-detail": {
    scan: "density",
    options: { style: { ...small, color: "levelOfDetail" }, maximumScreenSpaceError: 1 },
  },
  blend: {
    scan: "stripes",
    options: { style: { ...small, blend: { color: "intensity", share: 0.5 } } },
    without: { style: small },
  },
  tone: {
    scan: "stripes",
    options: { style: { ...small, gamma: 0.5, brightness: 0.1, contrast: 0.3 } },
    without: { style: small },
  },
  attenuated: {
    scan: "steps",
    options: { style: { color: "elevation", size: "attenuated" } },
    without: { style: { color: "elevation", pointSize: 1 } },
  },
  adaptive: {
    scan: "density",
    options: { style: { size: "adaptive" }, maximumScreenSpaceError: 1 },
    without: { style: { pointSize: 1 }, maximumScreenSpaceError: 1 },
  },
  disc: {
    scan: "cliff",
    options: { style: { pointSize: 24, shape: "disc" }, maximumScreenSpaceError: 12 },
    without: { style: { pointSize: 24 }, maximumScreenSpaceError: 12 },
  },
  paraboloid: {
    scan: "stripes",
    options: { style: { pointSize: 24, shape: "paraboloid" }, maximumScreenSpaceError: 12 },
    without: { style: { pointSize: 24, shape: "disc" }, maximumScreenSpaceError: 12 },
  },
  splats: {
    scan: "checks",
    pose: { range: 5, pitch: -25, heading: 20 },
    options: { style: { pointSize: 5, splats: true } },
    without: { style: { pointSize: 5, shape: "disc" } },
  },
  "eye-dome": {
    scan: "steps",
    options: { style: { ...small, eyeDomeLighting: true } },
    without: { style: small },
  },
  "eye-dome-8": {
    scan: "steps",
    options: { style: { ...small, eyeDomeLighting: { strength: 0.4, radius: 3, neighbours: 8 } } },
    without: { style: { ...small, eyeDomeLighting: true } },
  },
  "splats-eye-dome": {
    scan: "steps",
    options: { style: { pointSize: 6, color: "elevation", splats: true, eyeDomeLighting: true } },
    without: { style: { pointSize: 6, color: "elevation", splats: true } },
  },
  opacity: { scan: "cliff", options: { style: { ...small, opacity: 0.4 } }, without: { style: small } },
  filter: {
    scan: "stripes",
    options: { style: small, filter: { classes: [2, 5, 6, 9], ranges: { intensity: [0, 40_000] } } },
    without: { style: small },
  },
  "clip-box": {
    scan: "steps",
    options: {
      style: { ...small, color: "elevation" },
      clips: [Clip.box({ center: { source: [EAST, NORTH, UP + 2] }, size: [14, 6, 3], heading: 0.5 })],
    },
    without: { style: { ...small, color: "elevation" } },
  },
  "clip-polygon": {
    scan: "stripes",
    options: {
      style: small,
      clips: [
        Clip.polygon(
          SQUARE.map(([east, north]) => [EAST + east, NORTH + north] as const),
          { coordinates: "source", mode: "outside" },
        ),
      ],
    },
  },
  "clip-highlight": {
    scan: "stripes",
    options: {
      style: small,
      clips: [Clip.plane({ through: { source: [EAST, NORTH, UP] }, heading: 0.4, mode: "highlight" })],
    },
  },
};

describe.skipIf(pythonMissing)(`ways to draw${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`, () => {
  let stage: StagePage;
  beforeAll(async () => {
    stage = await openStage();
    await stage.page.evaluate(() => {
      window.page.stage = new window.page.Stage();
    });
  }, 120_000);
  afterAll(() => stage?.close());

  /** A picture once all is drawn, and the WebGL errors that were made. */
  async function draw(name: string, scan: string, options: LayerOptions, pose: Pose): Promise<PNG> {
    const { picture, errors } = await stage.page.evaluate(
      async ([scan, options, pose]) => {
        const { stage } = window.page;
        await stage.show(scan, options);
        stage.look(pose);
        await stage.settle();
        return { picture: stage.picture(), errors: stage.errors() };
      },
      [scan, options, pose] as const,
    );
    expect(errors).toEqual([]);
    return decode(picture, name);
  }

  it.each(Object.entries(cases))(
    "%s",
    { timeout: 30_000 },
    async (name, { scan, options, pose, without }) => {
      const shown = await draw(`mode-${name}`, scan, options, pose ?? OBLIQUE);
      expect(differenceToExpected(shown, `mode-${name}`)).toBeLessThan(0.01);
      const control = await draw(`mode-${name}-without`, scan, without ?? { style: small }, pose ?? OBLIQUE);
      expect(difference(shown, control)).toBeGreaterThan(0.02);
    },
  );

  it("makes no error in the console", () => {
    expect(stage.watch.errors).toEqual([]);
    expect(stage.watch.foreign).toEqual([]);
  });
});
