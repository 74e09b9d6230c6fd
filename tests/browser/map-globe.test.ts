import { PNG } from "pngjs";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { pythonMissing } from "../python.js";
import type { LayerOptions } from "./stage/setting.js";
import { decode, difference, openStage, type StagePage } from "./stage.js";

const UTM = { "EPSG:32632": "+proj=utm +zone=32 +datum=WGS84 +units=m +no_defs" };
/** Metres per pixel, and the pictures' size in pixels. */
const RESOLUTION = 0.05;
const [WIDTH, HEIGHT] = [600, 400];

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

/** How they are drawn. `share`: of pixels in which map and globe may differ: edges of points, and where relief begins. */
const MODES: Readonly<Record<string, { readonly options: LayerOptions; readonly share: number }>> = {
  squares: { options: { style: { pointSize: 3 } }, share: 0.004 },
  discs: { options: { style: { pointSize: 7, shape: "disc" } }, share: 0.01 },
  paraboloids: { options: { style: { pointSize: 9, shape: "paraboloid" } }, share: 0.03 },
  attenuated: { options: { style: { size: "attenuated" } }, share: 0.01 },
  adaptive: { options: { style: { size: "adaptive" } }, share: 0.01 },
  splats: { options: { style: { pointSize: 6, splats: true } }, share: 0.01 },
  "eye-dome": { options: { style: { pointSize: 3, eyeDomeLighting: true } }, share: 0.02 },
  tone: { options: { style: { pointSize: 3, gamma: 0.6, contrast: 0.4, opacity: 0.6 } }, share: 0.01 },
  filter: {
    options: { style: { pointSize: 3 }, filter: { ranges: { intensity: [0, 30_000] } } },
    share: 0.004,
  },
};

const colours = Object.keys(COLOURS) as (keyof typeof COLOURS)[];
const modes = Object.keys(MODES);
/** Each attribute and each mode; all of them with each other where `GROMA_GRID=1` (2 minutes). */
const grid = colours.flatMap((colour, at) =>
  modes
    .filter((_, mode) => process.env.GROMA_GRID === "1" || mode === at % modes.length)
    .map((mode) => [colour, mode] as const),
);

describe.skipIf(pythonMissing)(`map and globe${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`, () => {
  let stage: StagePage;
  beforeAll(async () => {
    stage = await openStage("link-stage");
    await stage.page.evaluate(
      async ({ projections, view, size, resolution }) => {
        const { ol, PointCloud, LinkStage } = window.linked;
        for (const [code, definition] of Object.entries(projections)) ol.proj4.defs(code, definition);
        ol.register(ol.proj4);
        const cloud = await PointCloud.fromUrl("/clouds/stripes.copc.laz", { workers: { size: 1 } });
        const stage = new LinkStage(cloud, { width: size[0]!, height: size[1]! });
        window.linked.stage = stage as typeof window.linked.stage;
        stage.addMap(view);
        // The globe from straight above, without perspective, at the map's scale and with its north.
        stage.globe.look({ range: 200 });
        // A metre of the plane is 1 / 0.9996 metres on the ellipsoid, and the scan lies 500 m above it.
        stage.globe.orthographic((size[0]! * resolution) / 0.9996 / (1 - 500 / 6.38e6));
      },
      {
        projections: UTM,
        view: { projection: "EPSG:32632", center: [500_000, 5_200_000], resolution: RESOLUTION },
        size: [WIDTH, HEIGHT],
        resolution: RESOLUTION,
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
        ...{ gamma: 1, contrast: 0, opacity: 1, gradient: undefined, range: undefined },
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
    const { options } = MODES[mode]!;
    return { ...options, style: { ...options.style, ...COLOURS[colour] } as LayerOptions["style"] };
  };
  let before: PNG | undefined;

  it.each(grid)("draw %s as %s alike", { timeout: 60_000 }, async (colour, mode) => {
    const { map, globe } = await draw(optionsOf(colour, mode), `above-${colour}-${mode}`);
    expect(difference(map, globe)).toBeLessThan(MODES[mode]!.share);
    // What is shown is not what another attribute or mode shows, and not an empty map (negative control).
    const other = before ?? new PNG({ width: WIDTH, height: HEIGHT });
    expect(difference(map, other)).toBeGreaterThan(0.02);
    before = map;
  });

  it("pick the same records, wherever both show a point", { timeout: 180_000 }, async () => {
    await draw({ style: { pointSize: 3 } }, "above-picks");
    const found = await stage.page.evaluate(async () => {
      const { stage, Cesium } = window.linked;
      const map = stage.maps[0]!;
      // Points 5 pixels apart: none hides another.
      map.map.getView().setResolution(0.02);
      stage.globe.orthographic((600 * 0.02) / 0.9996 / (1 - 500 / 6.38e6));
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
    });
    expect(found.length).toBeGreaterThan(8);
    for (const [globe, map] of found) expect(map).toEqual(globe);
    expect(new Set(found.map(([globe]) => String(globe))).size).toBe(found.length);
  });
});
