import { dirname } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { data } from "../project.js";
import { pythonMissing } from "../python.js";
import { screenshot } from "./harness.js";
import type { MapStage } from "./map-stage/map-stage.js";
import { openStage, type StagePage } from "./stage.js";

const scan = data("las-variants/las__autzen_trim.las");
// Pages of tests lie beside clouds that a script makes.
const missing = scan.missing ?? pythonMissing;

describe.skipIf(missing)(`measuring on a map${missing ? ` (skipped: ${missing})` : ""}`, () => {
  let stage: StagePage;
  beforeAll(async () => {
    stage = await openStage("map-stage", { "/scans/": dirname(converted(scan.path)) });
    await stage.page.evaluate(async () => {
      const { MapStage, layer, tools } = window.map;
      const made = new MapStage({
        view: { projection: "EPSG:3857", center: [0, 0], resolution: 1 },
        source: { url: "/scans/las__autzen_trim.copc.laz" },
        layer: { style: { pointSize: 4 } },
      }) as MapStage;
      window.map.stage = made;
      await made.source.opened();
      const [minX, minY, maxX, maxY] = made.source.getExtent()!;
      await made.show({
        projection: "EPSG:3857",
        center: [(minX! + maxX!) / 2, (minY! + maxY!) / 2],
        resolution: Math.max((maxX! - minX!) / 560, (maxY! - minY!) / 360),
      });
      window.map.measure = new tools.MeasureTool(layer.measureView(made.map, () => [made.layer]));
    });
  }, 280_000);
  afterAll(() => stage?.close());

  /** Places of the map where a point is found, far apart, with its integers. */
  const hits = () =>
    stage.page.evaluate(async () => {
      const found: { x: number; y: number; integers: readonly number[] }[] = [];
      for (const [x, y] of [
        [250, 190],
        [350, 200],
        [300, 240],
        [200, 180],
        [400, 220],
      ] as const) {
        const hit = await window.map.stage.layer.pick([x, y], { window: 15 });
        if (hit) found.push({ x, y, integers: hit.integers });
      }
      return found;
    });
  const records = () =>
    stage.page.evaluate(() =>
      window.map.measure.measurements.map(({ vertices }) => vertices.map(({ record }) => record?.integers)),
    );
  /** Waits until so many vertices are drawn, or the figure is there. */
  const drawn = (count: number, measured: number) =>
    stage.page.waitForFunction(
      ([vertices, figures]) => {
        const { measure } = window.map;
        return measure.drawnVertices.length === vertices || measure.measurements.length === figures;
      },
      [count, measured] as const,
    );
  const until = (count: number) =>
    stage.page.waitForFunction((wanted) => window.map.measure.measurements.length === wanted, count);

  it("by mouse, with the vertices on the records and the figure at their places", {
    timeout: 120_000,
  }, async () => {
    const { page } = stage;
    const [a, b] = await hits();
    await page.evaluate(() => void window.map.measure.distance());
    for (const [i, { x, y }] of [a!, b!].entries()) {
      await page.mouse.click(x, y);
      await drawn(i + 1, 1);
    }
    await until(1);
    expect(await records()).toEqual([[a!.integers, b!.integers]]);
    const dots = await page
      .locator(".groma-measure circle")
      .evaluateAll((circles) =>
        circles.map((circle) => [Number(circle.getAttribute("cx")), Number(circle.getAttribute("cy"))]),
      );
    for (const [i, { x, y }] of [a!, b!].entries()) {
      expect(Math.hypot(dots[i]![0]! - x, dots[i]![1]! - y)).toBeLessThan(11);
    }
    await screenshot(page, "measuring-map");
    // This page has no style of its own for figures.
    const line = page.locator(".groma-line").first();
    expect(await line.evaluate((element) => getComputedStyle(element).stroke)).toBe("rgb(242, 184, 75)");
    await page.evaluate(() => window.map.measure.undo());
    expect(await records()).toEqual([]);
    await page.evaluate(() => window.map.measure.redo());
    expect(await records()).toEqual([[a!.integers, b!.integers]]);
  });

  it("by touch, heights above the ground too", { timeout: 120_000 }, async () => {
    const { page } = stage;
    const [a, b, c] = await hits();
    const session = await page.context().newCDPSession(page);
    await session.send("Emulation.setTouchEmulationEnabled", { enabled: true });
    await page.evaluate(() => void window.map.measure.area());
    for (const [i, { x, y }] of [a!, b!, c!, a!].entries()) {
      await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [{ x, y }] });
      await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
      await drawn(i + 1, 2);
    }
    await until(2);
    expect((await records())[1]).toEqual([a!.integers, b!.integers, c!.integers]);
    await page.evaluate(() => void window.map.measure.draw("aboveGround"));
    await session.send("Input.dispatchTouchEvent", {
      type: "touchStart",
      touchPoints: [{ x: a!.x, y: a!.y }],
    });
    await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
    await until(3);
    await page.waitForFunction(() => {
      const { measure } = window.map;
      return measure.readingOf(measure.measurements[2]!)?.state === "done";
    });
    const [above] = await page.evaluate(() => {
      const { measure } = window.map;
      return measure.valuesOf(measure.measurements[2]!).map(({ name, quantity }) => [name, quantity.value]);
    });
    expect(above![0]).toBe("aboveGround");
    expect(above![1]).toBeGreaterThan(-3);
    expect(above![1]).toBeLessThan(60);
    expect(await page.evaluate(() => window.map.stage.errors)).toEqual([]);
    expect(stage.watch.errors).toEqual([]);
  });

  it("across the antimeridian, drawn where it is and not across the map", { timeout: 120_000 }, async () => {
    const { page } = stage;
    const shown = await page.evaluate(async () => {
      const { measure, stage, tools } = window.map;
      const place = (longitude: number, latitude: number) =>
        tools.placeVertex((longitude * Math.PI) / 180, (latitude * Math.PI) / 180, 0);
      const figure = (kind: "distance" | "area", ...vertices: ReturnType<typeof place>[]) => ({
        ...{ id: kind, kind, name: kind, vertices },
      });
      const before = measure.measurements.length;
      measure.add([
        figure("distance", place(179, 10), place(-178, 12)),
        figure("area", place(178, -10), place(-177, -10), place(-177, -4), place(178, -4)),
      ]);
      const [line, area] = measure.measurements
        .slice(before)
        .map((one) => tools.valuesOf(one).find(({ name }) => name === "geodesic")!.quantity.value);
      // From either side of 180°, and from the middle of the earth, where both edges of the map show.
      const seen: number[][] = [];
      for (const [east, wanted] of [
        [179.5, 2_000],
        [-179.5, 2_000],
        [0, 80_000],
      ] as const) {
        await stage.show({
          projection: "EPSG:3857",
          center: [(east * 20037508.34) / 180, 0],
          resolution: wanted,
        });
        const resolution = stage.map.getView().getResolution()!;
        const ways = Array.from(document.querySelectorAll("path.groma-line")).slice(before);
        seen.push(ways.map((way) => (way as SVGPathElement).getBBox().width * resolution));
      }
      return { line, area, seen };
    });
    await screenshot(page, "measuring-antimeridian");
    expect(shown.line).toBeCloseTo(396_000, -4);
    // Five degrees by six: the band between the parallels, edges along geodesics nearly as the parallels.
    expect(shown.area! / 1e9).toBeCloseTo(368, -1);
    const degrees = 20037508.34 / 180;
    for (const [line, area] of shown.seen) {
      expect(line! / degrees).toBeCloseTo(3, 0);
      expect(area! / degrees).toBeCloseTo(5, 0);
    }
    await page.evaluate(() => {
      for (const id of ["distance", "area"]) window.map.measure.remove(id);
    });
  });

  it("around a pole, filled up to it; and labels beside the buttons of the map", {
    timeout: 120_000,
  }, async () => {
    const { page } = stage;
    const shown = await page.evaluate(async () => {
      const { measure, stage: shownMap, tools } = window.map;
      const before = measure.measurements.length;
      const vertices = [0, 90, 180, -90].map((longitude) =>
        tools.placeVertex((longitude * Math.PI) / 180, (75 * Math.PI) / 180, 0),
      );
      measure.add([{ id: "cap", kind: "area", name: "cap", vertices }]);
      await shownMap.show({ projection: "EPSG:3857", center: [0, 15e6], resolution: 80_000 });
      const group = document.querySelectorAll(".groma-measure g")[before]!;
      const [fill, line] = Array.from(group.querySelectorAll("path"));
      const { top, height, width } = shownMap.map.getViewport().getBoundingClientRect();
      const label = Array.from(document.querySelectorAll(".groma-label"))[before]!;
      const at = label.getBoundingClientRect();
      // A button of the map where the label stands.
      const button = document.createElement("div");
      button.className = "ol-control";
      button.style.cssText = `position:fixed;left:${at.left}px;top:${at.top}px;width:${at.width}px;height:${at.height}px`;
      shownMap.map.getViewport().append(button);
      await shownMap.show({ projection: "EPSG:3857", center: [0, 15e6], resolution: 80_001 });
      const beside = label.getBoundingClientRect();
      const apart =
        beside.right <= at.left ||
        beside.left >= at.right ||
        beside.bottom <= at.top ||
        beside.top >= at.bottom;
      button.remove();
      const isIn = (path: SVGGeometryElement, x: number, y: number) => path.isPointInFill(new DOMPoint(x, y));
      const result = {
        area: tools.valuesOf(measure.measurements.at(-1)!)[0]!.quantity.value,
        classes: [fill!.getAttribute("class"), line!.getAttribute("class")],
        // The pole lies above, the equator below.
        inside: [isIn(fill!, width / 2, 1), isIn(fill!, width / 2, height - 1 - top)],
        apart,
      };
      measure.remove("cap");
      return result;
    });
    expect(shown.classes).toEqual(["groma-ring", "groma-line"]);
    expect(shown.inside).toEqual([true, false]);
    // Edges along geodesics lie nearer to the pole than the parallel of 75°, whose cap has 8.7e12 m².
    expect(shown.area / 1e12).toBeGreaterThan(5);
    expect(shown.area / 1e12).toBeLessThan(8.7);
    expect(shown.apart).toBe(true);
  });

  it("works volumes out in a worker that ends with them, or with the signal", {
    timeout: 120_000,
  }, async () => {
    const told = await stage.page.evaluate(async () => {
      const { stage, tools } = window.map;
      const cloud = await stage.source.opened();
      const { min, max } = cloud.boundingBox;
      const [x, y, z] = [0, 1, 2].map((axis) => (min[axis]! + max[axis]!) / 2);
      const ring = [
        [-250, -250],
        [250, -200],
        [200, 250],
      ].map(([east, north]) => tools.sourceVertex(cloud, [x! + east!, y! + north!, z!]));
      let [made, ended] = [0, 0];
      const { Worker: Real } = window;
      window.Worker = class extends Real {
        constructor(url: string | URL, options?: WorkerOptions) {
          super(url, options);
          made++;
        }
        override terminate(): void {
          ended++;
          super.terminate();
        }
      };
      const base = { kind: "height", height: min[2]! * 0.3048 } as const;
      const shares: number[] = [];
      const volume = await tools.measureVolume(cloud, ring, {
        base,
        onProgress: (share) => shares.push(share),
      });
      const counts = [made, ended];
      const stop = new AbortController();
      const onProgress = (share: number) => share > 0.5 && stop.abort(new Error("enough"));
      const given = await tools.measureVolume(cloud, ring, { base, signal: stop.signal, onProgress }).then(
        () => "done",
        (thrown: Error) => thrown.message,
      );
      window.Worker = Real;
      return {
        cut: volume.cut.value,
        covered: volume.covered / volume.area,
        shares,
        counts,
        given,
        after: [made, ended],
      };
    });
    expect(told.counts).toEqual([1, 1]);
    expect(told.after).toEqual([2, 2]);
    expect(told.given).toBe("enough");
    // A fifth of this square lies in gaps up to 80 feet wide, of points 2.4 feet apart.
    expect(told.covered).toBeGreaterThan(0.75);
    expect(told.covered).toBeLessThan(0.9);
    expect(told.cut).toBeGreaterThan(1000);
    expect(told.shares.at(-1)).toBe(1);
    expect(told.shares).toEqual([...told.shares].sort((a, b) => a - b));
    expect(told.shares.some((share) => share > 0.5 && share < 1)).toBe(true);
    expect(stage.watch.errors).toEqual([]);
  });
});
