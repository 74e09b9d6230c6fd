import type { DrawEvent } from "ol/interaction/Draw.js";
import { describe, expect, it } from "vitest";
import { colourDifference, meanColour, screenshot } from "./harness.js";
import { type Boxes, LinkedPage, missing, unless } from "./linked.js";

/** A shared feature as both sides have it: coordinates of the map, those of the globe with heights. */
interface Both {
  readonly onMap: number[][];
  readonly onGlobe: number[][];
}

describe.skipIf(missing)(`features that map and globe share${unless}`, () => {
  const linked = new LinkedPage();

  /** Links with a source of features, which the map draws and lets the reader draw and move. */
  const share = async (): Promise<Boxes> => {
    const boxes = await linked.show({ camera: false, footprint: false, cursor: false });
    await linked.page.evaluate(() => {
      const { linked } = window;
      const { ol, stage, synchronize } = linked;
      const { map } = stage.maps[0]!;
      linked.link.dispose();
      linked.sketch = undefined;
      linked.features = new ol.VectorSource();
      map.addLayer(new ol.VectorLayer({ source: linked.features }));
      const { features } = linked;
      const viewer = stage.globe.widget;
      const options = { viewer, map, cursor: false, camera: false, features };
      // Clicks that belong to a figure are no flights.
      linked.link = synchronize({ ...options, view: "none", click: true, flight: 0 });
    });
    return boxes;
  };

  /** The only feature as both have it, once the globe shows so many vertices at the heights of the points. */
  const both = (vertices: number): Promise<Both> =>
    linked.page.evaluate(async (wanted) => {
      const { stage, features, link, ol, Cesium, sketch } = window.linked;
      const end = performance.now() + 20_000;
      for (;;) {
        await stage.frames(1);
        const one = features.getFeatures()[0] ?? sketch;
        const places = one ? link.placesOf(one).vertices : [];
        const onGlobe = places.map(([x, y, z]) => {
          const at = Cesium.Cartographic.fromCartesian(new Cesium.Cartesian3(x, y, z));
          const degrees = [at.longitude, at.latitude].map(Cesium.Math.toDegrees);
          return [...ol.fromLonLat(degrees, "EPSG:32632"), at.height];
        });
        const read = onGlobe.every(([, , height]) => Math.abs(height! - 500) < 0.5);
        if ((onGlobe.length === wanted && read) || performance.now() > end) {
          const geometry = one?.getGeometry() as InstanceType<typeof ol.LineString>;
          return { onMap: geometry.getCoordinates(), onGlobe };
        }
      }
    }, vertices);

  /** Holds that both have the same vertices to a millimetre, at the heights of the points and not on the ellipsoid. */
  const expectAlike = ({ onMap, onGlobe }: Both, vertices: number) => {
    expect([onMap.length, onGlobe.length]).toEqual([vertices, vertices]);
    for (const [at, [x, y]] of onMap.entries()) {
      const [px, py, height] = onGlobe[at]!;
      expect(Math.hypot(x! - px!, y! - py!)).toBeLessThan(1e-3);
      expect(Math.abs(height! - 500)).toBeLessThan(0.5);
    }
  };

  /** The record that the globe shows at a place of its picture. */
  const recordAt = (x: number, y: number) =>
    linked.page.evaluate(
      async ([x, y]) => {
        const { stage, Cesium } = window.linked;
        const hit = await stage.globe.layer.pick(new Cesium.Cartesian2(x, y));
        return [...hit!.source];
      },
      [x, y] as const,
    );

  /** Where the globe shows the middle between a vertex and the one after it, or the vertex itself. */
  const pixelOf = (vertex: number, share = 0) =>
    linked.page.evaluate(
      ([vertex, share]) => {
        const { link, features, stage, Cesium } = window.linked;
        const { vertices } = link.placesOf(features.getFeatures()[0]!);
        const [from, to] = [vertices[vertex]!, vertices[vertex + Math.ceil(share)]!];
        const place = from.map((value, axis) => value + share * (to[axis]! - value));
        const at = stage.globe.scene.cartesianToCanvasCoordinates(Cesium.Cartesian3.fromArray(place))!;
        return [at.x, at.y] as const;
      },
      [vertex, share] as const,
    );

  /** The camera of the globe, whether it takes the reader's inputs, and the middle of the map. */
  const camera = () =>
    linked.page.evaluate(() => {
      const { globe, maps } = window.linked.stage;
      const { camera, screenSpaceCameraController: controller } = globe.scene;
      const center = maps[0]!.map.getView().getCenter()!;
      return [
        camera.position.x,
        camera.position.y,
        camera.heading,
        Number(controller.enableInputs),
        ...center,
      ];
    });

  it("show on the globe while they are drawn on the map, and when they are moved", {
    timeout: 120_000,
  }, async () => {
    const { map } = await share();
    await linked.page.evaluate(() => {
      const { linked } = window;
      const { ol, stage, link, features } = linked;
      linked.draw = new ol.Draw({ source: features, type: "LineString" });
      link.follow(linked.draw);
      linked.draw.on("drawstart", (event: DrawEvent) => {
        linked.sketch = event.feature;
      });
      stage.maps[0]!.map.addInteraction(linked.draw);
    });
    const { mouse } = linked;
    const start = await camera();
    await mouse.click(map[0] + 280, map[1] + 190);
    await mouse.move(map[0] + 330, map[1] + 210, { steps: 3 });
    expectAlike(await both(2), 2);
    await mouse.dblclick(map[0] + 330, map[1] + 210);
    await linked.until(() => window.linked.features.getFeatures().length === 1, undefined);
    const ended = await both(2);
    expectAlike(ended, 2);
    await linked.page.evaluate(() => {
      const { ol, stage, features, draw } = window.linked;
      const { map } = stage.maps[0]!;
      map.removeInteraction(draw!);
      map.addInteraction(new ol.Modify({ source: features }));
    });
    await mouse.move(map[0] + 330, map[1] + 210);
    await mouse.down();
    await mouse.move(map[0] + 350, map[1] + 180, { steps: 3 });
    const dragged = await both(2);
    const moved = [0, 1].map((axis) => dragged.onMap[1]![axis]! - ended.onMap[1]![axis]!);
    expect(Math.hypot(...moved)).toBeGreaterThan(1);
    expectAlike(dragged, 2);
    await mouse.up();
    expect(await camera()).toEqual(start);
    await screenshot(linked.page, "link-features");
    const left = await linked.page.evaluate(async () => {
      const { features, link, stage } = window.linked;
      const [feature] = features.getFeatures();
      features.clear();
      await stage.frames(2);
      return link.placesOf(feature!);
    });
    expect(left).toEqual({ vertices: [], ways: [] });
  });

  it("of a click make it no flight, even where the pointer is down again before the map tells of it", {
    timeout: 120_000,
  }, async () => {
    const { map } = await share();
    const { mouse } = linked;
    await linked.page.evaluate(() => {
      const { linked } = window;
      linked.draw = new linked.ol.Draw({ source: linked.features, type: "Point" });
      linked.stage.maps[0]!.map.addInteraction(linked.draw);
    });
    const start = await camera();
    await mouse.click(map[0] + 280, map[1] + 190);
    await linked.page.evaluate(() => {
      const { draw, stage } = window.linked;
      stage.maps[0]!.map.removeInteraction(draw!);
    });
    await mouse.move(map[0] + 300, map[1] + 200);
    await mouse.down();
    await linked.page.waitForTimeout(600);
    expect(await linked.page.evaluate(() => window.linked.features.getFeatures().length)).toBe(1);
    expect(await camera()).toEqual(start);
    await mouse.up();
  });

  it("are drawn and moved on the globe, at the records there", { timeout: 120_000 }, async () => {
    const { globe } = await share();
    const { mouse } = linked;
    const before = await camera();
    await linked.page.evaluate(() => {
      void window.linked.link.draw("LineString");
    });
    await mouse.click(globe[0] + 180, globe[1] + 140);
    // It is on the map from its first vertex on.
    await linked.until(() => window.linked.features.getFeatures().length === 1, undefined);
    await mouse.dblclick(globe[0] + 220, globe[1] + 160);
    expectAlike(await both(2), 2);
    expect(await camera()).toEqual(before);
    const [x, y] = await pixelOf(1);
    await mouse.move(globe[0] + x, globe[1] + y);
    await mouse.down();
    await mouse.move(globe[0] + 240, globe[1] + 130, { steps: 4 });
    const picked = await recordAt(240, 130);
    // Still held: the map has it already.
    await linked.until(([x, y]) => {
      const line = window.linked.features.getFeatures()[0]!.getGeometry();
      const [, end] = (line as InstanceType<typeof window.linked.ol.LineString>).getCoordinates();
      return Math.hypot(end![0]! - x!, end![1]! - y!) < 1e-3;
    }, picked);
    const held = await both(2);
    await mouse.up();
    expect(held.onMap[1]![2]).toBeCloseTo(picked[2]!, 3);
    expectAlike(held, 2);
    expect(await camera()).toEqual(before);
    await screenshot(linked.page, "link-features-globe");
  });

  it("have vertices put in and taken out on the globe as on the map", { timeout: 120_000 }, async () => {
    const { globe } = await share();
    const { mouse } = linked;
    await linked.page.evaluate(() => {
      const { ol, features } = window.linked;
      // Without heights: those of the points are read.
      const ends = [
        [499_997, 5_199_999],
        [500_003, 5_200_001],
      ];
      features.addFeature(new ol.Feature(new ol.LineString(ends)));
    });
    const before = await both(2);
    expectAlike(before, 2);
    const pose = await camera();
    const [x, y] = await pixelOf(0, 0.5);
    await mouse.move(globe[0] + x, globe[1] + y);
    await mouse.down();
    await mouse.move(globe[0] + x + 2, globe[1] + y, { steps: 2 });
    // A hand that trembles adds nothing.
    expect((await both(2)).onMap).toEqual(before.onMap);
    const [toX, toY] = [Math.round(x) + 10, Math.round(y) - 40];
    await mouse.move(globe[0] + toX, globe[1] + toY, { steps: 3 });
    const picked = await recordAt(toX, toY);
    await linked.until(([x, y]) => {
      const line = window.linked.features.getFeatures()[0]!.getGeometry();
      const [, put] = (line as InstanceType<typeof window.linked.ol.LineString>).getCoordinates();
      return Math.hypot(put![0]! - x!, put![1]! - y!) < 1e-3;
    }, picked);
    const put = await both(3);
    expectAlike(put, 3);
    expect([put.onMap[0], put.onMap[2]]).toEqual(before.onMap);
    // Both sides lie on the points, which do not hide them.
    const picture = await screenshot(linked.page, "link-features-inserted");
    for (const vertex of [0, 1]) {
      const [x, y] = await pixelOf(vertex, 0.5);
      const seen = [-1, 0, 1].map((step) =>
        colourDifference(meanColour(picture, globe[0] + x, globe[1] + y + step, 0), [242, 184, 75]),
      );
      expect(Math.min(...seen)).toBeLessThan(40);
    }
    await mouse.up();
    expect(await camera()).toEqual(pose);
    const [atX, atY] = await pixelOf(1);
    await linked.page.keyboard.down("Alt");
    await mouse.click(globe[0] + atX, globe[1] + atY);
    const taken = await both(2);
    expect(taken.onMap).toEqual(before.onMap);
    // A line keeps its ends.
    const [endX, endY] = await pixelOf(0);
    await mouse.click(globe[0] + endX, globe[1] + endY);
    await linked.page.keyboard.up("Alt");
    expect((await both(2)).onMap).toEqual(before.onMap);
  });

  it("follow the map's line where the ground bends away from a chord", { timeout: 120_000 }, async () => {
    await share();
    const off = await linked.page.evaluate(async () => {
      const { ol, features, link, stage, Cesium } = window.linked;
      const line = [
        [500_000, 5_200_000, 0],
        [500_000, 5_210_000, 0],
      ];
      const feature = new ol.Feature(new ol.LineString(line));
      features.addFeature(feature);
      await stage.frames(2);
      const [way] = link.placesOf(feature).ways;
      // Middles of chords lie below the ellipsoid by what the ground bends.
      return way!.slice(1).map((place, at) => {
        const middle = place.map((value, axis) => (value + way![at]![axis]!) / 2);
        return Cesium.Cartographic.fromCartesian(Cesium.Cartesian3.fromArray(middle)).height;
      });
    });
    expect(off.length).toBeGreaterThan(40);
    expect(Math.min(...off)).toBeGreaterThan(-1.01e-3);
  });
});
