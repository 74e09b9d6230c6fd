import { describe, expect, it } from "vitest";
import { screenshot } from "./harness.js";
import { LinkedPage, MIDDLE, missing, unless } from "./linked.js";

/** Random moves of a map; `GROMA_MOVES=1000` for the figure in docs/link.md. */
const MOVES = Number(process.env.GROMA_MOVES ?? 60);

describe.skipIf(missing)(`globe and map in step${unless}`, () => {
  const linked = new LinkedPage();

  it("has the point that a tilted camera looks at in the middle of the map", {
    timeout: 120_000,
  }, async () => {
    const seen = await linked.page.evaluate(async (middle) => {
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
    await screenshot(linked.page, "link-tilted");
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
    timeout: 120_000 + 1000 * MOVES,
  }, async () => {
    const seen = await linked.page.evaluate(async (count) => {
      const { stage, synchronize, ol, Cesium } = window.linked;
      stage.globe.layer.show = false;
      // Frames of the page without waiting for a screen.
      const screen = { requestAnimationFrame, cancelAnimationFrame };
      const { port1, port2 } = new MessageChannel();
      const waiting = new Map<number, FrameRequestCallback>();
      let asked = 1e9;
      port1.onmessage = () => {
        const now = [...waiting.values()];
        waiting.clear();
        for (const call of now) call(performance.now());
      };
      window.requestAnimationFrame = (call) => {
        waiting.set(++asked, call);
        port2.postMessage(0);
        return asked;
      };
      window.cancelAnimationFrame = (frame) => void waiting.delete(frame);
      const frames = async (count: number) => {
        for (let frame = 0; frame < count; frame++) await new Promise(requestAnimationFrame);
      };
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
        await frames(2);
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
        await frames(1);
        const wanted = Array.from({ length: moved }, () => ["a: map > globe", "b: globe > map"]).flat();
        if (events.join() !== wanted.join()) return { worst, events: events.slice(-6), move, code };
      }
      for (const one of links) one.dispose();
      for (const map of maps) {
        map.getTargetElement()?.remove();
        map.dispose();
      }
      stage.globe.layer.show = true;
      Object.assign(window, screen);
      return { worst, events: [], move: count };
    }, MOVES);
    expect(seen.events).toEqual([]);
    expect(seen.move).toBe(MOVES);
    expect(seen.worst).toBeLessThan(0.5);
  });

  it("keeps to its mode, keeps north up, and does nothing once it is disposed of", {
    timeout: 120_000,
  }, async () => {
    const seen = await linked.page.evaluate(async (middle) => {
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
      // Also when the rest before it is over.
      await new Promise((done) => setTimeout(done, 300));
      found.push([events(), onGlobe().join() === before.join() && view.getResolution() === 4]);
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
      // A hidden globe leaves the map alone until it shows again; no frame of it is needed then.
      const { style } = stage.globe.scene.canvas;
      style.display = "none";
      look(0, 450);
      found.push(events());
      style.display = "";
      link.update();
      link.update();
      found.push(events());
      link.dispose();
      link.dispose();
      look(0, 500);
      link.update();
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
      ...[[], []],
      ...[[], ["globe > map"]],
      [],
    ]);
    expect(seen.resolution).toBe(6);
    expect(seen.listeners[0]).toBe(0);
    expect(seen.together.map((count, at) => count - seen.alone[at]!)).toEqual([1, 1]);
    expect([seen.apart, seen.pointers]).toEqual([seen.alone, false]);
  });

  it("takes what a map cannot show for no wish of its user's, and moves nothing to a place that it does not have", {
    timeout: 120_000,
  }, async () => {
    const seen = await linked.page.evaluate(async () => {
      const { stage, synchronize, ol, Cesium } = window.linked;
      const map = stage.addMap({ projection: "EPSG:3857", center: [0, 0], resolution: 1 });
      // Turned to within 5° of north it is turned to north, and it has the resolutions of its levels alone.
      const view = new ol.View({ center: [0, 0], zoom: 3, constrainResolution: true });
      map.map.setView(view);
      const { camera } = stage.globe.scene;
      const link = synchronize({ viewer: stage.globe.widget, map: map.map });
      window.linked.link = link;
      const moves: string[] = [];
      link.onMove(({ origin, target }) => moves.push(`${origin} > ${target}`));
      const look = (heading: number, range: number) => {
        stage.globe.look({ heading, pitch: -60, range });
        stage.globe.frame();
      };
      /** Heading (degrees), height of the camera, and place on the map. */
      const onGlobe = () => {
        const { longitude, latitude, height } = camera.positionCartographic;
        const degrees = [longitude, latitude].map((angle) => (angle * 180) / Math.PI);
        const [x, y] = ol.fromLonLat(degrees);
        return { heading: (camera.heading * 180) / Math.PI, height, x: x!, y: y! };
      };
      const panned = async (east: number) => {
        const before = onGlobe();
        const [x, y] = view.getCenter()!;
        view.setCenter([x! + east, y!]);
        await stage.frames(3);
        const after = onGlobe();
        return {
          turn: after.heading - before.heading,
          scale: after.height / before.height,
          east: after.x - before.x,
        };
      };
      look(3, 90);
      const [rotation, zoom] = [view.getRotation(), view.getZoom()! % 1];
      const pan = await panned(40);
      // What the user turns and zooms is as the map has it, and the rest stays.
      view.setZoom(view.getZoom()! - 1);
      await stage.frames(3);
      const zoomed = await panned(0.1);
      const away = onGlobe();
      view.setRotation(-0.5);
      await stage.frames(3);
      const turned = onGlobe();
      // A view that the edge of the world keeps in the middle.
      camera.setView({ destination: Cesium.Cartesian3.fromDegrees(9, 60, 4e7) });
      stage.globe.frame();
      const low = onGlobe();
      const clamped = await panned(1e6);
      const high = onGlobe();
      // Poles.
      const still = [view.getCenter()!.join()];
      moves.length = 0;
      for (const latitude of [89.9, 90, -90]) {
        camera.setView({ destination: Cesium.Cartesian3.fromDegrees(9, latitude, 4000) });
        stage.globe.frame();
        still.push(view.getCenter()!.join());
      }
      map.map.setView(new ol.View({ projection: "EPSG:3413", center: [1000, 2000], resolution: 10 }));
      await stage.frames(3);
      const polar = map.map.getView();
      moves.length = 0;
      camera.setView({ destination: Cesium.Cartesian3.fromDegrees(9, -89.999, 4000) });
      stage.globe.frame();
      return {
        ...{ rotation, zoom, pan, zoomed, turn: turned.heading - away.heading, away: away.heading },
        ...{ clamped, north: high.y - low.y, still, moves, polar: polar.getCenter() },
      };
    });
    expect([seen.rotation, seen.zoom]).toEqual([0, 0]);
    for (const { turn, scale } of [seen.pan, seen.zoomed]) {
      expect(Math.abs(turn)).toBeLessThan(1e-3);
      expect(Math.abs(scale - 1)).toBeLessThan(1e-3);
    }
    expect(seen.pan.east).toBeCloseTo(40, 1);
    expect(seen.away).toBeCloseTo(3, 2);
    // On the ellipsoid the map is not quite conformal.
    expect(Math.abs(seen.turn - ((0.5 * 180) / Math.PI - 3))).toBeLessThan(0.2);
    expect(seen.clamped.east).toBeCloseTo(1e6, -3);
    expect(Math.abs(seen.north)).toBeLessThan(1000);
    expect(new Set(seen.still).size).toBe(1);
    expect(seen.moves).toEqual([]);
    expect(seen.polar).toEqual([1000, 2000]);
  });

  it("refuses what is no globe, no map and no mode by name", async () => {
    const codes = await linked.page.evaluate(() => {
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
});
