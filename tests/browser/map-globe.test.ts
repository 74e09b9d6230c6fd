import type { PNG } from "pngjs";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { pythonMissing } from "../python.js";
import type { LayerOptions } from "./stage/setting.js";
import { decode, difference, openStage, type StagePage } from "./stage.js";

const UTM = { "EPSG:32632": "+proj=utm +zone=32 +datum=WGS84 +units=m +no_defs" };
/** Metres per pixel: points lie 8 pixels apart, so that their sizes and shapes show; and the pictures' size in pixels. */
const RESOLUTION = 0.0125;
const [WIDTH, HEIGHT] = [600, 400];
/** In the middle of the pictures: no point lies on the edge between two pixels. */
const CENTER = [500_000.004, 5_200_000.003] as const;
/** Width of the globe's picture at the map's scale: a metre of the plane is 1 / 0.9996 metres, and the scan lies 500 m up. */
const widthAt = (resolution: number) => (WIDTH * resolution) / 0.9996 / (1 - 500 / 6.38e6);

/** What points are coloured by, and the range where a scan of five strips needs one. */
const COLOURS = {
  rgb: { color: "rgb" },
  intensity: { color: "intensity", gradient: "turbo" },
  elevation: { color: "elevation" },
  ellipsoidalHeight: { color: "ellipsoidalHeight", range: [498, 506] },
  classification: { color: "classification" },
  returnNumber: { color: "returnNumber" },
  gpsTime: { color: "gpsTime", gradient: "greyscale" },
  scanAngle: { color: "scanAngle" },
  pointSourceId: { color: "pointSourceId", gradient: "spectral" },
  userData: { color: "userData" },
  extra: { color: "amplitude", gradient: "terrain" },
} as const;

/** How they are drawn. */
const MODES: Readonly<Record<string, LayerOptions>> = {
  squares: { style: { pointSize: 3 } },
  discs: { style: { pointSize: 7, shape: "disc" } },
  paraboloids: { style: { pointSize: 9, shape: "paraboloid" } },
  attenuated: { style: { size: "attenuated", maximumSize: 5 } },
  adaptive: { style: { size: "adaptive" } },
  splats: { style: { pointSize: 6, splats: true } },
  // Without gaps, so that the sides of the terraces are what shows.
  "eye-dome": { style: { pointSize: 8, eyeDomeLighting: true } },
  tone: { style: { pointSize: 3, gamma: 0.6, contrast: 0.4, opacity: 0.6 } },
  filter: { style: { pointSize: 3 }, filter: { ranges: { intensity: [0, 30_000] } } },
};

/** Share of pixels in which map and globe may differ, and in which any two cases do at least. */
const SAME = 0.001;
const ANOTHER = 0.01;
/** Colours that are farther apart than this are two, of 1. */
const SHADE = 0.03;

const colours = Object.keys(COLOURS) as (keyof typeof COLOURS)[];
const modes = Object.keys(MODES);
/** Each attribute and each mode; all 99 pairs where `GROMA_GRID=1` (minutes). */
const grid = modes.flatMap((mode, at) =>
  colours
    .filter((_, colour) => process.env.GROMA_GRID === "1" || colour % modes.length === at)
    .map((colour) => [colour, mode] as const),
);

describe.skipIf(pythonMissing)(`map and globe${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`, () => {
  let stage: StagePage;
  beforeAll(async () => {
    stage = await openStage("link-stage");
    await stage.page.evaluate(
      async ({ projections, view, size, width }) => {
        const { ol, PointCloud, LinkStage } = window.linked;
        for (const [code, definition] of Object.entries(projections)) ol.proj4.defs(code, definition);
        ol.register(ol.proj4);
        const cloud = await PointCloud.fromUrl("/clouds/terraces.copc.laz", { workers: { size: 1 } });
        const stage = new LinkStage(cloud, { width: size[0]!, height: size[1]! });
        window.linked.stage = stage as typeof window.linked.stage;
        stage.addMap(view);
        // The globe from straight above, without perspective, at the map's scale and with its north.
        stage.globe.look({ at: [view.center[0]!, view.center[1]!, 502.4], range: 200 });
        stage.globe.orthographic(width);
      },
      {
        projections: UTM,
        view: { projection: "EPSG:32632", center: [...CENTER], resolution: RESOLUTION },
        size: [WIDTH, HEIGHT],
        width: widthAt(RESOLUTION),
      },
    );
  }, 240_000);
  afterAll(() => stage?.close());

  /** Both pictures in a style, the map's over the globe's background. */
  const draw = async (options: LayerOptions, name: string) => {
    const pictures = await stage.page.evaluate(async ({ filter, style }) => {
      const { stage } = window.linked;
      const map = stage.maps[0]!;
      const plain = {
        ...{
          color: "rgb",
          shape: "square",
          size: "fixed",
          pointSize: 3,
          splats: false,
          eyeDomeLighting: false,
        },
        ...{ maximumSize: 50, gamma: 1, contrast: 0, opacity: 1, gradient: "auto", range: undefined },
      };
      for (const layer of [map.layer, stage.globe.layer]) {
        layer.filter = filter;
        Object.assign(layer, { style: { ...plain, ...style } });
      }
      await stage.globe.settle();
      await map.complete();
      const canvas = document.createElement("canvas");
      Object.assign(canvas, { width: 600, height: 400 });
      const context = canvas.getContext("2d")!;
      context.fillStyle = "rgb(24, 28, 40)";
      context.fillRect(0, 0, 600, 400);
      context.drawImage(map.map.getViewport().querySelector("canvas")!, 0, 0);
      return { map: canvas.toDataURL("image/png"), globe: stage.globe.picture() };
    }, options);
    return { map: decode(pictures.map, `${name}-map`), globe: decode(pictures.globe, `${name}-globe`) };
  };
  const optionsOf = (colour: keyof typeof COLOURS, mode: string): LayerOptions => {
    const options = MODES[mode]!;
    return { ...options, style: { ...options.style, ...COLOURS[colour] } as LayerOptions["style"] };
  };
  /** Pictures of the map so far. */
  const drawn: { readonly colour: string; readonly mode: string; readonly globe: PNG }[] = [];

  it.each(grid)("draw %s as %s alike", { timeout: 60_000 }, async (colour, mode) => {
    const { map, globe } = await draw(optionsOf(colour, mode), `above-${colour}-${mode}`);
    expect(difference(map, globe, SHADE)).toBeLessThan(SAME);
    // The globe's picture of another attribute, or in another mode, would not pass (negative control).
    for (const other of drawn.filter(
      (one) => one.colour === colour || one.mode === mode || grid.length < 20,
    )) {
      expect(difference(map, other.globe, SHADE), `${other.colour} as ${other.mode}`).toBeGreaterThan(
        ANOTHER,
      );
    }
    drawn.push({ colour, mode, globe });
  });

  it("pick the same records, wherever both show a point", { timeout: 180_000 }, async () => {
    await draw({ style: { pointSize: 3 } }, "above-picks");
    const found = await stage.page.evaluate(async (width) => {
      const { stage, Cesium } = window.linked;
      const map = stage.maps[0]!;
      // Points 5 pixels apart: none hides another.
      map.map.getView().setResolution(0.02);
      stage.globe.orthographic(width);
      await stage.globe.settle();
      await map.complete();
      const pairs: (readonly number[] | undefined)[][] = [];
      for (let y = 50; y < 350; y += 110) {
        for (let x = 40; x < 560; x += 130) {
          const onGlobe = stage.globe.layer.pick(new Cesium.Cartesian2(x, y), { window: 9 });
          stage.globe.frame();
          const hit = await onGlobe;
          if (!hit) continue;
          const { longitude, latitude } = Cesium.Cartographic.fromCartesian(hit.position);
          const degrees = [longitude, latitude].map(Cesium.Math.toDegrees);
          const coordinate = window.linked.ol.fromLonLat(degrees, "EPSG:32632");
          const pixel = map.map.getPixelFromCoordinate(coordinate);
          pairs.push([hit.integers, (await map.layer.pick(pixel, { window: 1 }))?.integers]);
        }
      }
      return pairs.map((pair) => pair.map((one) => one && [...one]));
    }, widthAt(0.02));
    expect(found.length).toBeGreaterThan(8);
    for (const [globe, map] of found) expect(map).toEqual(globe);
    expect(new Set(found.map(([globe]) => String(globe))).size).toBe(found.length);
  });

  it.each([false, true])(
    "keep one budget, whichever of them moves; the globe draws on demand: %s",
    {
      timeout: 120_000,
    },
    async (requestRenderMode) => {
      const { drawn: seen, kept } = await stage.page.evaluate(
        async ([requestRenderMode, width, center]) => {
          const { stage, SharedBudget } = window.linked;
          const { globe } = stage;
          const map = stage.maps[0]!;
          const budget = new SharedBudget({ points: 20_000 });
          const view = map.map.getView();
          const look = () => {
            globe.look({ at: [...center, 502], range: 200 });
            globe.orthographic(width);
          };
          for (const layer of [map.layer, globe.layer]) {
            Object.assign(layer, { budget, maximumScreenSpaceError: 1 });
          }
          globe.scene.requestRender();
          Object.assign(globe.scene, {
            requestRenderMode,
            maximumRenderTimeChange: Number.POSITIVE_INFINITY,
          });
          view.setResolution(0.05);
          const drawn: number[][] = [];
          const note = async () => {
            // Frames of the globe come as the scene asks for them.
            const end = performance.now() + 20_000;
            let complete = false;
            map.complete().then(() => {
              complete = true;
            });
            while (!(complete && globe.layer.settled && budget.balanced) && performance.now() < end) {
              globe.frame();
              globe.wait();
              await stage.frames(1);
            }
            const points = [globe, map].map(({ layer }) => layer.statistics.pointsDrawn);
            drawn.push([...points, Number(complete && globe.layer.settled)]);
          };
          look();
          await note();
          globe.scene.camera.moveRight(5000);
          await note();
          look();
          await note();
          // The map alone moves: to where it has no points, and back.
          view.setCenter([center[0] + 5000, center[1]]);
          await note();
          view.setCenter([...center]);
          await note();
          globe.scene.requestRenderMode = false;
          for (const layer of [map.layer, globe.layer])
            Object.assign(layer, { budget: undefined, maximumScreenSpaceError: 2 });
          globe.frame();
          await map.complete();
          return { drawn, kept: [budget.granted, budget.gpu.used] };
        },
        [requestRenderMode, widthAt(0.05), CENTER] as const,
      );
      const [both, , again, , last] = seen;
      const [, mapAlone, , globeAlone] = seen;
      expect(seen.map(([, , done]) => done)).toEqual([1, 1, 1, 1, 1]);
      for (const [onGlobe, onMap] of seen) expect(onGlobe! + onMap!).toBeLessThanOrEqual(20_000);
      for (const shared of [both, again, last]) {
        expect(Math.min(shared![0]!, shared![1]!)).toBeGreaterThan(9_000);
      }
      // Without it nothing of it is theirs any more.
      expect(kept).toEqual([0, 0]);
      expect([mapAlone![0], globeAlone![1]]).toEqual([0, 0]);
      expect(Math.min(mapAlone![1]!, globeAlone![0]!)).toBeGreaterThan(19_000);
    },
  );
});
