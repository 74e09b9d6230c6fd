import type { DrawEvent } from "ol/interaction/Draw.js";
import { afterAll, afterEach, beforeAll, describe, expect, it } from "vitest";
import { pythonMissing } from "../python.js";
import { screenshot } from "./harness.js";
import { openStage, type StagePage } from "./stage.js";

/** Projections beside those of OpenLayers. */
const PROJECTIONS = {
  "EPSG:32632": "+proj=utm +zone=32 +datum=WGS84 +units=m +no_defs",
  "EPSG:3413": "+proj=stere +lat_0=90 +lat_ts=70 +lon_0=-45 +k=1 +datum=WGS84 +units=m +no_defs",
  "EPSG:3031": "+proj=stere +lat_0=-90 +lat_ts=-71 +lon_0=0 +k=1 +datum=WGS84 +units=m +no_defs",
};
/** Middle of the scans, in the plane of EPSG:32632. */
const MIDDLE = [500_000, 5_200_000] as const;
/** Random moves of a map; `GROMA_MOVES=1000` for the figure in docs/link.md, 2 minutes. */
const MOVES = Number(process.env.GROMA_MOVES ?? 100);

describe.skipIf(pythonMissing)(
  `globe and map in step${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`,
  () => {
    let stage: StagePage;
    beforeAll(async () => {
      stage = await openStage("link-stage");
      await stage.page.evaluate(async (projections) => {
        const { ol, PointCloud, LinkStage } = window.linked;
        for (const [code, definition] of Object.entries(projections)) ol.proj4.defs(code, definition);
        ol.register(ol.proj4);
        const cloud = await PointCloud.fromUrl("/clouds/stripes.copc.laz", { workers: { size: 1 } });
        window.linked.stage = new LinkStage(cloud) as typeof window.linked.stage;
      }, PROJECTIONS);
    }, 240_000);
    afterAll(() => stage?.close());
    afterEach(async () => {
      await stage.page.evaluate(() => {
        const { linked } = window;
        linked.link?.dispose();
        for (const map of linked.stage.maps.splice(0)) map.destroy();
      });
      expect(stage.watch.errors).toEqual([]);
    });

    it("has the point that a tilted camera looks at in the middle of the map", {
      timeout: 120_000,
    }, async () => {
      const seen = await stage.page.evaluate(async (middle) => {
        const { stage, synchronize } = window.linked;
        const map = stage.addMap({ projection: "EPSG:32632", center: [0, 0], resolution: 1 });
        stage.globe.look({ at: [middle[0], middle[1], 500], heading: 40, pitch: -30, range: 60 });
        await stage.globe.settle();
        // The link begins before the points are there.
        stage.globe.layer.show = false;
        window.linked.link = synchronize({ viewer: stage.globe.widget, map: map.map });
        const moves: string[] = [];
        window.linked.link.onMove(({ origin, target }) => moves.push(`${origin} > ${target}`));
        const view = map.map.getView();
        const before = view.getCenter()!;
        stage.globe.layer.show = true;
        // Nothing is known of the points yet; as soon as the view rests, one of them is read.
        for (let wait = 0; wait < 400 && moves.length === 0; wait++) {
          stage.globe.frame();
          await new Promise((done) => setTimeout(done, 10));
        }
        await map.complete();
        return {
          ...{ before, moves, center: view.getCenter()!, resolution: view.getResolution()! },
          rotation: view.getRotation(),
        };
      }, MIDDLE);
      await screenshot(stage.page, "link-tilted");
      expect(seen.moves).toEqual(["globe > map"]);
      // On the ellipsoid the camera would look at a place 500 m / tan 30° farther away.
      const [east, north] = [seen.before[0]! - MIDDLE[0], seen.before[1]! - MIDDLE[1]];
      expect(Math.hypot(east, north)).toBeGreaterThan(800);
      expect(Math.atan2(east, north)).toBeCloseTo((40 * Math.PI) / 180, 2);
      const off = Math.hypot(seen.center[0]! - MIDDLE[0], seen.center[1]! - MIDDLE[1]);
      // The point nearest to the middle of the picture is one of a grid of 0.1 m.
      expect(off).toBeLessThan(0.3);
      const perPixel = (2 * Math.tan(Math.PI / 6)) / 400;
      expect(seen.resolution / (60 * perPixel)).toBeCloseTo(0.9996, 2);
      expect(seen.rotation).toBeCloseTo((-40 * Math.PI) / 180, 3);
    });

    it(`comes back to the pixel after ${MOVES} moves, by the poles and over 180°, and nothing echoes`, {
      timeout: 240_000,
    }, async () => {
      const seen = await stage.page.evaluate(async (count) => {
        const { stage, synchronize, ol, Cesium } = window.linked;
        stage.globe.layer.show = false;
        // Two maps without layers: one leads the globe, the other follows it and knows nothing of the first.
        const maps = ["a", "b"].map(() => {
          const target = document.createElement("div");
          Object.assign(target.style, { width: "600px", height: "400px" });
          document.body.append(target);
          return new ol.OlMap({ target, controls: [], interactions: [] });
        });
        let seed = 20261128;
        const random = () => {
          seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
          return seed / 2 ** 32;
        };
        const between = (low: number, high: number) => low + random() * (high - low);
        const places: Record<string, () => number[]> = {
          // Over 180°, in other worlds, and up to where Mercator's ends.
          "EPSG:3857": () => [20037508.342789244 * between(0.99, 1.01), between(-1.5e7, 1.5e7)],
          "EPSG:4326": () => [between(-720, 720), between(-89, 89)],
          "EPSG:3413": () => [between(-1, 1), between(-1, 1)].map((at) => at * 10 ** between(-3, 6)),
          "EPSG:3031": () => (random() < 0.1 ? [0, 0] : [between(-1e6, 1e6), between(-1e6, 1e6)]),
          "EPSG:32632": () => [between(3e5, 7e5), between(1e5, 9e6)],
        };
        const codes = Object.keys(places);
        const events: string[] = [];
        let links: { dispose(): void }[] = [];
        let worst = 0;
        let moved = 0;
        for (let move = 0; move < count; move++) {
          const code = codes[Math.floor((move * codes.length) / count)]!;
          const [a, b] = maps as [(typeof maps)[0], (typeof maps)[0]];
          if (a.getView().getProjection().getCode() !== code || links.length === 0) {
            for (const one of links) one.dispose();
            for (const map of maps) {
              const options = {
                minResolution: 1e-9,
                maxResolution: 1e9,
                multiWorld: true,
                constrainRotation: false,
              };
              map.setView(
                new ol.View({
                  ...options,
                  projection: code,
                  center: places[code]!(),
                  resolution: 1,
                  rotation: 0,
                }),
              );
            }
            const viewer = stage.globe.widget;
            const leads = synchronize({ viewer, map: a, view: "to-globe" });
            const follows = synchronize({ viewer, map: b, view: "to-map" });
            leads.onMove(({ origin, target }) => events.push(`a: ${origin} > ${target}`));
            follows.onMove(({ origin, target }) => events.push(`b: ${origin} > ${target}`));
            links = [leads, follows];
          }
          const near = random() < 0.7;
          if (move % 20 === 0) {
            // The camera is tilted otherwise, and rolled.
            const { camera } = stage.globe.scene;
            const [longitude, latitude] = [between(-180, 180), between(-80, 80)];
            camera.setView({
              destination: Cesium.Cartesian3.fromDegrees(longitude, latitude, 1000),
              orientation: { heading: between(0, 6), pitch: between(-1.57, -0.1), roll: between(-0.5, 0.5) },
            });
            stage.globe.frame();
            events.length = 0;
            moved = 0;
          }
          const scale = code === "EPSG:4326" ? 1e-5 : 1;
          const view = a.getView();
          view.setCenter(places[code]!());
          view.setResolution(scale * 10 ** (near ? between(-2, 1) : between(1, 2)));
          view.setRotation(between(-3, 3));
          moved++;
          await stage.frames(2);
          stage.globe.frame();
          const other = b.getView();
          const resolution = view.getResolution()!;
          const world = { "EPSG:3857": 2 * 20037508.342789244, "EPSG:4326": 360 }[code];
          const pixel = ([px, py]: number[], of: typeof view) => {
            const [cosine, sine] = [Math.cos(of.getRotation()), Math.sin(of.getRotation())];
            const r = of.getResolution()!;
            const [x, y] = of.getCenter()!;
            return [x! + r * (cosine * px! - sine * py!), y! + r * (sine * px! + cosine * py!)];
          };
          for (const corner of [
            [0, 0],
            [-300, -200],
            [300, -200],
            [300, 200],
          ]) {
            const [p, q] = [pixel(corner, view), pixel(corner, other)];
            let dx = p[0]! - q[0]!;
            if (world) dx -= world * Math.round(dx / world);
            worst = Math.max(worst, Math.hypot(dx, p[1]! - q[1]!) / resolution);
          }
          await stage.frames(1);
          const wanted = Array.from({ length: moved }, () => ["a: map > globe", "b: globe > map"]).flat();
          if (events.join() !== wanted.join()) return { worst, events: events.slice(-6), move, code };
        }
        for (const one of links) one.dispose();
        for (const map of maps) {
          map.getTargetElement()?.remove();
          map.dispose();
        }
        stage.globe.layer.show = true;
        return { worst, events: [], move: count };
      }, MOVES);
      expect(seen.events).toEqual([]);
      expect(seen.move).toBe(MOVES);
      expect(seen.worst).toBeLessThan(0.5);
    });

    it("shows the ground that the camera sees, as Cesium's own rays find it", {
      timeout: 120_000,
    }, async () => {
      const seen = await stage.page.evaluate(async () => {
        const { stage, synchronize, Cesium } = window.linked;
        const map = stage.addMap({ projection: "EPSG:32632", center: [500_000, 5_200_000], resolution: 10 });
        stage.globe.look({ at: [500_000, 5_200_000, 0], heading: 25, pitch: -50, range: 2000 });
        stage.globe.frame();
        const link = synchronize({ viewer: stage.globe.widget, map: map.map });
        window.linked.link = link;
        await map.complete();
        const ring = link.footprint!.getGeometry()!.getCoordinates()[0]!;
        // The corners of Cesium's picture, on the ellipsoid.
        const { camera, canvas } = stage.globe.scene;
        const [width, height] = [canvas.clientWidth, canvas.clientHeight];
        const corners = [
          [0, height],
          [width, height],
          [width, 0],
          [0, 0],
        ].map(([x, y]) => {
          const place = camera.pickEllipsoid(new Cesium.Cartesian2(x, y))!;
          const { longitude, latitude } = Cesium.Cartographic.fromCartesian(place);
          const degrees = [longitude, latitude].map(Cesium.Math.toDegrees);
          return window.linked.ol.fromLonLat(degrees, "EPSG:32632");
        });
        return { ring, corners };
      });
      const off = seen.corners.map(([x, y]) =>
        Math.min(...seen.ring.map(([px, py]) => Math.hypot(px! - x!, py! - y!))),
      );
      expect(seen.ring.length).toBe(49);
      expect(Math.max(...off)).toBeLessThan(1e-3);
    });

    it("keeps to its mode, keeps north up, and does nothing once it is disposed of", {
      timeout: 120_000,
    }, async () => {
      const seen = await stage.page.evaluate(async (middle) => {
        const { stage, synchronize } = window.linked;
        const map = stage.addMap({ projection: "EPSG:32632", center: [...middle], resolution: 1 });
        const view = map.map.getView();
        const { camera } = stage.globe.scene;
        const look = (heading: number, range: number) => {
          stage.globe.look({ heading, pitch: -60, range });
          stage.globe.frame();
        };
        const onGlobe = () => [camera.positionWC.x, camera.heading];
        look(0, 100);
        const { primitives } = stage.globe.scene;
        const parts = () => [primitives.length, map.map.getInteractions().getLength()];
        const alone = parts();
        const link = synchronize({ viewer: stage.globe.widget, map: map.map, northUp: true, click: true });
        const together = parts();
        window.linked.link = link;
        const moves: string[] = [];
        link.onMove(({ origin, target }) => moves.push(`${origin} > ${target}`));
        const events = () => moves.splice(0);
        const found: unknown[] = [];
        look(30, 200);
        found.push([events(), view.getRotation()]);
        const { heading } = camera;
        view.setRotation(1);
        view.setResolution(3);
        await stage.frames(3);
        found.push([events(), camera.heading - heading < 1e-6]);
        link.view = "to-map";
        events();
        const before = onGlobe();
        view.setResolution(4);
        await stage.frames(3);
        found.push([events(), onGlobe().join() === before.join()]);
        link.view = "to-globe";
        events();
        const resolution = view.getResolution();
        look(0, 300);
        await stage.frames(3);
        found.push([events(), view.getResolution() === resolution]);
        link.view = "none";
        look(0, 400);
        view.setResolution(5);
        await stage.frames(3);
        found.push(events());
        link.view = "both";
        events();
        // Nothing moves: whatever is drawn, nothing is carried over.
        for (let frame = 0; frame < 5; frame++) stage.globe.frame();
        await map.complete();
        found.push(events());
        link.dispose();
        link.dispose();
        look(0, 500);
        view.setResolution(6);
        await stage.frames(3);
        const listeners = [stage.globe.scene.preRender.numberOfListeners, view.hasListener("change:center")];
        return {
          ...{ found: [...found, events()], listeners, resolution: view.getResolution() },
          ...{ alone, together, apart: parts(), pointers: map.map.hasListener("pointermove") },
        };
      }, MIDDLE);
      expect(seen.found).toEqual([
        [["globe > map"], 0],
        [["map > globe"], true],
        [[], true],
        [[], true],
        ...[[], [], []],
      ]);
      expect(seen.resolution).toBe(6);
      expect(seen.listeners[0]).toBe(0);
      expect(seen.together.map((count, at) => count - seen.alone[at]!)).toEqual([1, 1]);
      expect([seen.apart, seen.pointers]).toEqual([seen.alone, false]);
    });

    it("refuses what is no globe, no map and no mode by name", async () => {
      const codes = await stage.page.evaluate(() => {
        const { stage, synchronize } = window.linked;
        const viewer = stage.globe.widget;
        const map = stage.addMap({ projection: "EPSG:3857", center: [0, 0], resolution: 1 }).map;
        return [
          {},
          { viewer },
          { viewer: map, map },
          { viewer, map, view: "bth" },
          { viewer, map, norhUp: true },
        ].map((options) => {
          try {
            synchronize(options as Parameters<typeof synchronize>[0]);
            return "";
          } catch (thrown) {
            return (thrown as Error).message;
          }
        });
      });
      expect(codes.map((message) => message.split(":")[0])).toEqual(Array(5).fill("STYLE_OPTION"));
      expect(codes[3]).toContain('Did you mean "both"');
      expect(codes[4]).toContain("northUp");
    });

    /** Sets a globe and a map up that show the scan, and links them. */
    const linked = (options: Record<string, unknown>) =>
      stage.page.evaluate(async (given) => {
        const { stage, synchronize } = window.linked;
        const map = stage.addMap({
          projection: "EPSG:32632",
          center: [500_000, 5_200_000],
          resolution: 0.05,
        });
        stage.globe.look({ at: [500_000, 5_200_000, 500], heading: 20, pitch: -70, range: 25 });
        await stage.globe.settle();
        await map.complete();
        const link = synchronize({ viewer: stage.globe.widget, map: map.map, view: "none", ...given });
        window.linked.link = link;
        await map.complete();
        map.map.getTargetElement()!.scrollIntoView();
        const box = (element: Element) => {
          const { left, top } = element.getBoundingClientRect();
          return [left, top];
        };
        return { map: box(map.map.getViewport()), globe: box(stage.globe.scene.canvas) };
      }, options);

    it("has a handle on the map that moves and turns the camera, and nothing else", {
      timeout: 120_000,
    }, async () => {
      const { map } = await linked({ view: "both", cursor: false });
      const state = () =>
        stage.page.evaluate(async () => {
          const { stage, link, ol, Cesium } = window.linked;
          const { map } = stage.maps[0]!;
          const { camera } = stage.globe.scene;
          stage.globe.frame();
          await stage.frames(2);
          const { longitude, latitude, height } = camera.positionCartographic;
          const nadir = ol.fromLonLat([longitude, latitude].map(Cesium.Math.toDegrees), "EPSG:32632");
          const stand = link.camera!.getGeometry()!.getCoordinates();
          return {
            ...{ nadir, height, stand, pixel: map.getPixelFromCoordinate(stand) },
            ...{ heading: camera.heading, pitch: camera.pitch, rotation: map.getView().getRotation() },
            center: map.getView().getCenter()!,
          };
        });
      await stage.page.evaluate(() => {
        const { stage } = window.linked;
        const view = stage.maps[0]!.map.getView();
        view.setResolution(0.2);
        return stage.maps[0]!.complete();
      });
      const before = await state();
      const moves = await stage.page.evaluateHandle(() => {
        const moves: string[] = [];
        window.linked.link.onMove(({ origin, target }) => moves.push(`${origin} > ${target}`));
        return moves;
      });
      expect(
        Math.hypot(before.stand[0]! - before.nadir[0]!, before.stand[1]! - before.nadir[1]!),
      ).toBeLessThan(1e-3);
      const { mouse } = stage.page;
      const drag = async (from: number[], to: number[]) => {
        await mouse.move(map[0]! + from[0]!, map[1]! + from[1]!);
        await mouse.down();
        await mouse.move(map[0]! + to[0]!, map[1]! + to[1]!, { steps: 4 });
        await mouse.up();
        return state();
      };
      await screenshot(stage.page, "link-handle");
      const [x, y] = before.pixel as [number, number];
      const moved = await drag([x, y], [x + 50, y - 30]);
      // What lies under the pointer at the end is where the camera stands.
      const [cosine, sine] = [Math.cos(before.rotation), Math.sin(before.rotation)];
      const wanted = [
        before.stand[0]! + 0.2 * (cosine * 50 - sine * 30),
        before.stand[1]! + 0.2 * (sine * 50 + cosine * 30),
      ];
      expect(Math.hypot(moved.nadir[0]! - wanted[0]!, moved.nadir[1]! - wanted[1]!)).toBeLessThan(0.01);
      expect(moved.height).toBeCloseTo(before.height, 6);
      expect([moved.heading, moved.pitch]).toEqual([
        expect.closeTo(before.heading, 5),
        expect.closeTo(before.pitch, 5),
      ]);
      expect(moved.center).toEqual(before.center);
      // The arm points upwards, as the camera looks; its end is taken to the right.
      const [mx, my] = moved.pixel as [number, number];
      const turned = await drag([mx, my - 44], [mx + 60, my]);
      const quarter = turned.heading - moved.heading;
      expect((quarter + 2 * Math.PI) % (2 * Math.PI)).toBeCloseTo(Math.PI / 2, 4);
      expect(turned.pitch).toBeCloseTo(before.pitch, 5);
      expect(Math.hypot(turned.nadir[0]! - moved.nadir[0]!, turned.nadir[1]! - moved.nadir[1]!)).toBeLessThan(
        1e-3,
      );
      expect(turned.center).toEqual(before.center);
      const told = await moves.jsonValue();
      expect(told.length).toBeGreaterThan(4);
      expect(new Set(told)).toEqual(new Set(["handle > globe"]));
      await screenshot(stage.page, "link-handle-turned");
    });

    it("marks the record under the pointer of one side on the other", { timeout: 120_000 }, async () => {
      const { map, globe } = await linked({ camera: false, footprint: false });
      const { mouse } = stage.page;
      const look = () =>
        stage.page.evaluate(async () => {
          const { stage, link, Cesium } = window.linked;
          for (let frame = 0; frame < 10; frame++) {
            stage.globe.frame();
            await new Promise((done) => setTimeout(done, 40));
          }
          const { map, globe } = link.cursor!;
          const { x, y, z } = globe.position;
          const { height } = Cesium.Cartographic.fromCartesian(globe.position) ?? { height: Number.NaN };
          return { map: map.getGeometry()?.getCoordinates(), globe: globe.show && [x, y, z], height };
        });
      await mouse.move(globe[0]! + 215, globe[1]! + 140);
      const onGlobe = await look();
      const [picked, ecef] = await stage.page.evaluate(async () => {
        const { stage, Cesium } = window.linked;
        const hit = stage.globe.layer.pick(new Cesium.Cartesian2(215, 140));
        stage.globe.frame();
        const { source, position } = (await hit)!;
        return [source, [position.x, position.y, position.z]];
      });
      await screenshot(stage.page, "link-cursor");
      // The map's plane is the scan's own: the record's coordinates are the place on it.
      expect(Math.hypot(onGlobe.map![0]! - picked![0]!, onGlobe.map![1]! - picked![1]!)).toBeLessThan(1e-3);
      expect(onGlobe.globe).toBe(false);
      const pixel = await stage.page.evaluate(
        (at) => window.linked.stage.maps[0]!.map.getPixelFromCoordinate(at!),
        onGlobe.map,
      );
      await mouse.move(Math.round(map[0]! + pixel[0]!), Math.round(map[1]! + pixel[1]!));
      const onMap = await look();
      expect(onMap.map).toBeUndefined();
      const recorded = await stage.page.evaluate(
        async (at) => {
          const { stage } = window.linked;
          const hit = (await stage.maps[0]!.layer.pick(at))!;
          return [...stage.cloud.place(...hit.source)];
        },
        [Math.round(pixel[0]!), Math.round(pixel[1]!)],
      );
      const away = (place: readonly number[]) =>
        Math.hypot(...(onMap.globe as number[]).map((value, axis) => value - place[axis]!));
      expect(away(recorded)).toBeLessThan(1e-6);
      // The pointer stands on whole pixels, of which two lie between neighbouring points.
      expect(away(ecef!)).toBeLessThan(0.15);
      // Beside the scan it is the ground at the height that was looked at.
      await mouse.move(map[0]! + 20, map[1]! + 20);
      const beside = await look();
      expect(beside.globe).not.toBe(false);
      expect(beside.height).toBeCloseTo(500, 0);
      await mouse.move(map[0]! + 750, map[1]! + 20);
      expect((await look()).globe).toBe(false);
    });

    it("goes where it is clicked", { timeout: 120_000 }, async () => {
      const { map, globe } = await linked({ view: "both", click: true, flight: 0, camera: false });
      const seen = () =>
        stage.page.evaluate(async () => {
          const { stage, Cesium } = window.linked;
          for (let frame = 0; frame < 15; frame++) {
            stage.globe.frame();
            await new Promise((done) => setTimeout(done, 40));
          }
          const { scene } = stage.globe;
          const [width, height] = [scene.canvas.clientWidth, scene.canvas.clientHeight];
          const hit = stage.globe.layer.pick(new Cesium.Cartesian2(width / 2, height / 2));
          stage.globe.frame();
          const view = stage.maps[0]!.map.getView();
          return { source: (await hit)?.source, center: view.getCenter()!, pitch: scene.camera.pitch };
        });
      const start = await seen();
      const coordinate = await stage.page.evaluate(() =>
        window.linked.stage.maps[0]!.map.getCoordinateFromPixel([340, 180]),
      );
      await stage.page.mouse.click(map[0]! + 340, map[1]! + 180);
      const gone = await seen();
      expect(gone.pitch).toBeCloseTo(start.pitch, 4);
      for (const found of [gone.center, gone.source!]) {
        expect(Math.hypot(found[0]! - coordinate[0]!, found[1]! - coordinate[1]!)).toBeLessThan(0.5);
      }
      await stage.page.mouse.click(globe[0]! + 180, globe[1]! + 170);
      const back = await seen();
      expect(
        Math.hypot(back.center[0]! - gone.center[0]!, back.center[1]! - gone.center[1]!),
      ).toBeGreaterThan(1);
      expect(Math.hypot(back.center[0]! - back.source![0]!, back.center[1]! - back.source![1]!)).toBeLessThan(
        0.5,
      );
    });

    describe("shared features", () => {
      /** Links with a source of features, which the map draws and lets the reader draw and move. */
      const sharing = async () => {
        const boxes = await linked({ camera: false, footprint: false, cursor: false });
        await stage.page.evaluate(async () => {
          const { linked } = window;
          const { ol, stage, synchronize } = linked;
          const { map } = stage.maps[0]!;
          linked.link.dispose();
          const features = new ol.VectorSource();
          map.addLayer(new ol.VectorLayer({ source: features }));
          linked.link = synchronize({
            viewer: stage.globe.widget,
            map,
            view: "none",
            cursor: false,
            camera: false,
            features,
          });
          linked.features = features;
        });
        return boxes;
      };
      /** Vertices of the only feature on the map, and where the globe shows them, as coordinates of the map and heights. */
      const both = (feature = 0) =>
        stage.page.evaluate(async (at) => {
          const { stage, features, link, ol, Cesium, sketch } = window.linked;
          await new Promise((done) => setTimeout(done, 300));
          stage.globe.frame();
          const one = features.getFeatures()[at] ?? sketch!;
          const { vertices, ways } = link.placesOf(one);
          const onMap = (one.getGeometry() as InstanceType<typeof ol.LineString>).getCoordinates();
          const onGlobe = vertices.map(([x, y, z]) => {
            const { longitude, latitude, height } = Cesium.Cartographic.fromCartesian(
              new Cesium.Cartesian3(x, y, z),
            );
            const degrees = [longitude, latitude].map(Cesium.Math.toDegrees);
            return [...ol.fromLonLat(degrees, "EPSG:32632"), height];
          });
          return { onMap, onGlobe, parts: ways.map((way) => way.length) };
        }, feature);
      /** Greatest distance of vertices on the map from those on the globe, metres. */
      const apart = ({ onMap, onGlobe }: { onMap: number[][]; onGlobe: number[][] }) =>
        Math.max(...onMap.map(([x, y], at) => Math.hypot(x! - onGlobe[at]![0]!, y! - onGlobe[at]![1]!)));

      it("show on the globe while they are drawn on the map, and when they are moved", {
        timeout: 120_000,
      }, async () => {
        const { map } = await sharing();
        await stage.page.evaluate(() => {
          const { linked } = window;
          const { ol, stage, link, features } = linked;
          const { map } = stage.maps[0]!;
          const draw = new ol.Draw({ source: features, type: "LineString" });
          link.follow(draw);
          draw.on("drawstart", (event: DrawEvent) => {
            linked.sketch = event.feature;
          });
          map.addInteraction(draw);
          linked.draw = draw;
        });
        const { mouse } = stage.page;
        await mouse.click(map[0]! + 280, map[1]! + 190);
        await mouse.move(map[0]! + 330, map[1]! + 210, { steps: 3 });
        const drawn = await both();
        expect(drawn.onMap.length).toBe(2);
        expect(drawn.onGlobe.length).toBe(2);
        expect(apart(drawn)).toBeLessThan(1e-3);
        // At the height of the points there, not on the ellipsoid.
        for (const [, , height] of drawn.onGlobe) expect(Math.abs(height! - 500)).toBeLessThan(0.5);
        await mouse.dblclick(map[0]! + 330, map[1]! + 210);
        const ended = await both();
        expect(ended.onMap.length).toBe(2);
        expect(apart(ended)).toBeLessThan(1e-3);
        await stage.page.evaluate(() => {
          const { ol, stage, features, draw } = window.linked;
          const { map } = stage.maps[0]!;
          map.removeInteraction(draw!);
          map.addInteraction(new ol.Modify({ source: features }));
        });
        await mouse.move(map[0]! + 330, map[1]! + 210);
        await mouse.down();
        await mouse.move(map[0]! + 350, map[1]! + 180, { steps: 3 });
        const dragged = await both();
        expect(
          Math.hypot(...[0, 1].map((axis) => dragged.onMap[1]![axis]! - ended.onMap[1]![axis]!)),
        ).toBeGreaterThan(1);
        expect(apart(dragged)).toBeLessThan(1e-3);
        await mouse.up();
        await screenshot(stage.page, "link-features");
        const left = await stage.page.evaluate(async () => {
          const { features, link, stage } = window.linked;
          const [feature] = features.getFeatures();
          features.clear();
          await stage.frames(2);
          return link.placesOf(feature!);
        });
        expect(left).toEqual({ vertices: [], ways: [] });
      });

      it("are drawn and moved on the globe, at the records there", { timeout: 120_000 }, async () => {
        const { globe } = await sharing();
        const { mouse } = stage.page;
        await stage.page.evaluate(() => {
          void window.linked.link.draw("LineString");
        });
        const settle = () => stage.page.waitForTimeout(400);
        const frames = setInterval(() => {
          stage.page.evaluate(() => window.linked.stage.globe.frame()).catch(() => undefined);
        }, 50);
        try {
          await mouse.click(globe[0]! + 180, globe[1]! + 140);
          await settle();
          // It is on the map from its first vertex on.
          expect(await stage.page.evaluate(() => window.linked.features.getFeatures().length)).toBe(1);
          await mouse.dblclick(globe[0]! + 220, globe[1]! + 160);
          await settle();
          const drawn = await both();
          expect(drawn.onMap.length).toBe(2);
          expect(apart(drawn)).toBeLessThan(1e-3);
          const from = await stage.page.evaluate(() => {
            const { link, features, stage, Cesium } = window.linked;
            const [x, y, z] = link.placesOf(features.getFeatures()[0]!).vertices[1]!;
            const { camera } = stage.globe.scene;
            const at = stage.globe.scene.cartesianToCanvasCoordinates(new Cesium.Cartesian3(x, y, z))!;
            return { x: at.x, y: at.y, camera: [camera.position.x, camera.heading] };
          });
          await mouse.move(globe[0]! + from.x, globe[1]! + from.y);
          await mouse.down();
          await mouse.move(globe[0]! + 240, globe[1]! + 130, { steps: 4 });
          await settle();
          const picked = await stage.page.evaluate(async () => {
            const { stage, Cesium } = window.linked;
            const hit = await stage.globe.layer.pick(new Cesium.Cartesian2(240, 130));
            return [...hit!.source];
          });
          // Still held: the map has it already.
          const held = await both();
          await mouse.up();
          await settle();
          expect(Math.hypot(held.onMap[1]![0]! - picked[0]!, held.onMap[1]![1]! - picked[1]!)).toBeLessThan(
            1e-3,
          );
          expect(held.onMap[1]![2]).toBeCloseTo(picked[2]!, 3);
          expect(apart(held)).toBeLessThan(1e-3);
          const after = await stage.page.evaluate(() => {
            const { camera, screenSpaceCameraController } = window.linked.stage.globe.scene;
            return {
              camera: [camera.position.x, camera.heading],
              enabled: screenSpaceCameraController.enableInputs,
            };
          });
          expect(after).toEqual({ camera: from.camera, enabled: true });
        } finally {
          clearInterval(frames);
        }
        await screenshot(stage.page, "link-features-globe");
      });

      it("follow the map's line where the ground bends away from a chord", { timeout: 120_000 }, async () => {
        await sharing();
        const off = await stage.page.evaluate(async () => {
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
            return Cesium.Cartographic.fromCartesian(new Cesium.Cartesian3(...middle)).height;
          });
        });
        expect(off.length).toBeGreaterThan(40);
        expect(Math.min(...off)).toBeGreaterThan(-1.01e-3);
      });
    });
  },
);
