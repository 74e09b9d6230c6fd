import { describe, expect, it } from "vitest";
import { screenshot } from "./harness.js";
import { LinkedPage, missing, unless } from "./linked.js";

describe.skipIf(missing)(`the pointer on map and globe${unless}`, () => {
  const linked = new LinkedPage();

  it("has a handle on the map that moves and turns the camera, and nothing else", {
    timeout: 120_000,
  }, async () => {
    const { map } = await linked.show({ view: "both", cursor: false });
    const state = () =>
      linked.page.evaluate(async () => {
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
    await linked.page.evaluate(() => {
      const { stage } = window.linked;
      const view = stage.maps[0]!.map.getView();
      view.setResolution(0.2);
      return stage.maps[0]!.complete();
    });
    const before = await state();
    const moves = await linked.page.evaluateHandle(() => {
      const moves: string[] = [];
      window.linked.link.onMove(({ origin, target }) => moves.push(`${origin} > ${target}`));
      return moves;
    });
    expect(Math.hypot(before.stand[0]! - before.nadir[0]!, before.stand[1]! - before.nadir[1]!)).toBeLessThan(
      1e-3,
    );
    const { mouse } = linked.page;
    const drag = async (from: number[], to: number[]) => {
      await mouse.move(map[0] + from[0]!, map[1] + from[1]!);
      await mouse.down();
      await mouse.move(map[0] + to[0]!, map[1] + to[1]!, { steps: 4 });
      await mouse.up();
      return state();
    };
    await screenshot(linked.page, "link-handle");
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
    await screenshot(linked.page, "link-handle-turned");
    // The map goes on from where the handle has left the camera.
    await linked.page.evaluate(() => window.linked.stage.maps[0]!.map.getView().adjustCenter([3, 0]));
    const nudged = await state();
    expect(nudged.nadir[0]! - turned.nadir[0]!).toBeCloseTo(3, 2);
    expect(nudged.nadir[1]! - turned.nadir[1]!).toBeCloseTo(0, 2);
    expect(nudged.heading).toBeCloseTo(turned.heading, 4);
  });

  it("marks the record under the pointer of one side on the other", { timeout: 120_000 }, async () => {
    const { map, globe } = await linked.show({ camera: false, footprint: false });
    const { mouse } = linked.page;
    /** The cursor's marks, once that of the globe is shown or not as asked, and elsewhere than before. */
    const look = async (shown: boolean, before?: readonly number[]) => {
      await linked.until(
        ({ shown, before }) => {
          const { map, globe } = window.linked.link.cursor!;
          const { x, y, z } = globe.position;
          const other = before === undefined || `${[x, y, z]}` !== `${before}`;
          return globe.show === shown && other && !(shown && map.getGeometry());
        },
        { shown, before },
      );
      return linked.page.evaluate(() => {
        const { link, Cesium } = window.linked;
        const { map, globe } = link.cursor!;
        const { x, y, z } = globe.position;
        const { height } = Cesium.Cartographic.fromCartesian(globe.position) ?? { height: Number.NaN };
        return { map: map.getGeometry()?.getCoordinates(), globe: [x, y, z], height };
      });
    };
    await mouse.move(globe[0] + 215, globe[1] + 140);
    await linked.until(() => window.linked.link.cursor!.map.getGeometry(), undefined);
    const onGlobe = await look(false);
    const [picked, ecef] = await linked.page.evaluate(async () => {
      const { stage, Cesium } = window.linked;
      const { source, position } = (await stage.globe.layer.pick(new Cesium.Cartesian2(215, 140)))!;
      return [source, [position.x, position.y, position.z]];
    });
    await screenshot(linked.page, "link-cursor");
    // The map's plane is the scan's own: the record's coordinates are the place on it.
    expect(Math.hypot(onGlobe.map![0]! - picked![0]!, onGlobe.map![1]! - picked![1]!)).toBeLessThan(1e-3);
    const pixel = await linked.page.evaluate(
      (at) => window.linked.stage.maps[0]!.map.getPixelFromCoordinate(at!),
      onGlobe.map,
    );
    await mouse.move(Math.round(map[0] + pixel[0]!), Math.round(map[1] + pixel[1]!));
    const onMap = await look(true);
    expect(onMap.map).toBeUndefined();
    const recorded = await linked.page.evaluate(
      async (at) => {
        const { stage } = window.linked;
        const hit = (await stage.maps[0]!.layer.pick(at))!;
        return [...stage.cloud.place(...hit.source)];
      },
      [Math.round(pixel[0]!), Math.round(pixel[1]!)],
    );
    const away = (place: readonly number[]) =>
      Math.hypot(...onMap.globe.map((value, axis) => value - place[axis]!));
    expect(away(recorded)).toBeLessThan(1e-6);
    // The pointer stands on whole pixels, of which two lie between neighbouring points.
    expect(away(ecef!)).toBeLessThan(0.15);
    // Beside the scan it is the ground at the height that was looked at.
    await mouse.move(map[0] + 20, map[1] + 20);
    const beside = await look(true, onMap.globe);
    expect(beside.height).toBeCloseTo(500, 0);
    await mouse.move(map[0] + 750, map[1] + 20);
    await look(false);
  });

  it("goes where it is clicked", { timeout: 120_000 }, async () => {
    const { map, globe } = await linked.show({ view: "both", flight: 0, camera: false });
    expect(
      await linked.page.evaluate(() => {
        const before = window.linked.link.click;
        window.linked.link.click = true;
        return before;
      }),
    ).toBe(false);
    /** The views, once they are elsewhere than before and rest. */
    const seen = async (before?: readonly number[]) => {
      await linked.until(
        (before) => `${window.linked.stage.maps[0]!.map.getView().getCenter()}` !== `${before}`,
        before,
      );
      return linked.page.evaluate(async () => {
        const { stage, Cesium } = window.linked;
        const { scene } = stage.globe;
        const view = stage.maps[0]!.map.getView();
        const pose = () => `${view.getCenter()} ${scene.camera.positionWC}`;
        // Longer than the link waits before it reads the record in the middle.
        for (let last = "", resting = 0; resting < 8; last = pose()) {
          await new Promise((done) => setTimeout(done, 30));
          resting = pose() === last && stage.globe.layer.settled ? resting + 1 : 0;
        }
        const [width, height] = [scene.canvas.clientWidth, scene.canvas.clientHeight];
        const hit = await stage.globe.layer.pick(new Cesium.Cartesian2(width / 2, height / 2));
        return { source: hit?.source, center: view.getCenter()!, pitch: scene.camera.pitch };
      });
    };
    const start = await seen();
    const coordinate = await linked.page.evaluate(() =>
      window.linked.stage.maps[0]!.map.getCoordinateFromPixel([340, 180]),
    );
    await linked.page.mouse.click(map[0] + 340, map[1] + 180);
    const gone = await seen(start.center);
    expect(gone.pitch).toBeCloseTo(start.pitch, 4);
    for (const found of [gone.center, gone.source!]) {
      expect(Math.hypot(found[0]! - coordinate[0]!, found[1]! - coordinate[1]!)).toBeLessThan(0.5);
    }
    await linked.page.mouse.click(globe[0] + 180, globe[1] + 170);
    const back = await seen(gone.center);
    expect(Math.hypot(back.center[0]! - gone.center[0]!, back.center[1]! - gone.center[1]!)).toBeGreaterThan(
      1,
    );
    expect(Math.hypot(back.center[0]! - back.source![0]!, back.center[1]! - back.source![1]!)).toBeLessThan(
      0.5,
    );
  });

  it("goes nowhere by clicks that any tool for measuring takes", { timeout: 120_000 }, async () => {
    const { map, globe } = await linked.show({ view: "none", flight: 0, camera: false, click: true });
    await linked.page.evaluate(() => {
      const { stage, Cesium, MeasureTool, measureGlobe, measureMap } = window.linked;
      const [{ map, layer }] = stage.maps as [(typeof stage.maps)[number]];
      const { layer: onGlobe, scene } = stage.globe;
      const clicks = { seen: 0, drawn: 0, places: () => "" };
      // Told after the link is, and once the same point was read as it would have been for a flight.
      const told = async (record: Promise<unknown>) => {
        await record;
        await stage.frames(3);
        clicks.seen++;
      };
      map.on("singleclick" as never, ({ pixel }: { pixel: number[] }) => void told(layer.pick(pixel)));
      new Cesium.ScreenSpaceEventHandler(scene.canvas).setInputAction(
        ({ position }: { position: { x: number; y: number } }) => void told(onGlobe.pick(position)),
        Cesium.ScreenSpaceEventType.LEFT_CLICK,
      );
      const tools = [
        new MeasureTool(measureGlobe(scene, () => [onGlobe])),
        new MeasureTool(measureMap(map, () => [layer])),
      ];
      clicks.places = () => `${map.getView().getCenter()} ${scene.camera.positionWC}`;
      for (const tool of tools) void tool.distance().then(() => clicks.drawn++);
      Object.assign(window, { clicks, end: () => tools.map((tool) => tool.destroy()) });
    });
    type Clicking = Window & {
      clicks: { seen: number; drawn: number; places(): string };
      end(): void;
    };
    const places = () => linked.page.evaluate(() => (window as never as Clicking).clicks.places());
    const click = async (x: number, y: number, seen: number) => {
      await linked.mouse.click(x, y);
      await linked.until((seen) => (window as never as Clicking).clicks.seen === seen, seen);
    };
    const before = await places();
    await click(map[0] + 340, map[1] + 180, 1);
    await click(map[0] + 260, map[1] + 230, 2);
    await click(globe[0] + 180, globe[1] + 140, 3);
    await click(globe[0] + 220, globe[1] + 170, 4);
    await linked.until(() => (window as never as Clicking).clicks.drawn === 2, undefined);
    expect(await places()).toBe(before);
    // Nothing is drawn any more: the next clicks are the link's.
    await linked.mouse.click(map[0] + 340, map[1] + 180);
    await linked.until((before) => (window as never as Clicking).clicks.places() !== before, before);
    const between = await places();
    await linked.mouse.click(globe[0] + 240, globe[1] + 120);
    await linked.until((before) => (window as never as Clicking).clicks.places() !== before, between);
    await linked.page.evaluate(() => (window as never as Clicking).end());
  });

  it("ends by itself where the globe is destroyed first, and bears a map that is", {
    timeout: 120_000,
  }, async () => {
    await linked.show({});
    const seen = await linked.page.evaluate(async () => {
      const { Cesium, Stage, stage, link, ol, synchronize } = window.linked;
      link.dispose();
      const { map } = stage.maps[0]!;
      const globe = new Stage({ width: 200, height: 150 });
      globe.scene.camera.setView({ destination: Cesium.Cartesian3.fromDegrees(9, 47, 1000) });
      globe.frame();
      const features = new ol.VectorSource();
      const count = () => {
        const { listeners_ } = map as unknown as { readonly listeners_: object };
        return [Object.values(listeners_).flat().length, map.getInteractions().getLength()];
      };
      const before = count();
      const viewer = globe.widget;
      const options = { viewer, map, click: true, features };
      const ended = synchronize(options);
      // One hears of it by the map, another by the pointer there, the third by a feature.
      const others = [synchronize({ ...options, view: "to-map" }), synchronize({ ...options, view: "none" })];
      viewer.destroy();
      const { left, top } = map.getViewport().getBoundingClientRect();
      const at = { clientX: left + 300, clientY: top + 200, bubbles: true, pointerType: "mouse" };
      map.getViewport().firstElementChild!.dispatchEvent(new PointerEvent("pointermove", at));
      map.getView().adjustCenter([1, 1]);
      features.addFeature(new ol.Feature(new ol.LineString([[500_000, 5_200_000]])));
      await stage.frames(3);
      await new Promise((done) => setTimeout(done, 300));
      const after = count();
      const rejected = await ended.draw("Point").catch((thrown) => thrown.name);
      for (const one of [ended, ...others]) one.dispose();
      // The other way round.
      const other = new ol.OlMap({
        target: map.getTargetElement()!.cloneNode() as HTMLElement,
        view: new ol.View({ projection: "EPSG:32632", center: [500_000, 5_200_000], resolution: 1 }),
      });
      const { scene } = stage.globe;
      const primitives = scene.primitives.length;
      const alone = synchronize({ viewer: stage.globe.widget, map: other, click: true, features });
      other.setTarget(undefined);
      other.dispose();
      scene.camera.moveForward(1);
      await stage.frames(3);
      alone.dispose();
      const left_ = [scene.primitives.length - primitives, scene.preRender.numberOfListeners];
      return { before, after, rejected, left: left_ };
    });
    expect(seen.after).toEqual(seen.before);
    expect(seen.rejected).toBe("AbortError");
    expect(seen.left).toEqual([0, 0]);
  });

  it("leaves nothing behind when it is disposed of, whatever it was doing", {
    timeout: 120_000,
  }, async () => {
    await linked.show({});
    const seen = await linked.page.evaluate(async () => {
      const { stage, link, ol, synchronize, countListeners } = window.linked;
      const { map } = stage.maps[0]!;
      const { scene } = stage.globe;
      link.dispose();
      const features = new ol.VectorSource();
      const draw = new ol.Draw({ source: features, type: "LineString" });
      map.addInteraction(draw);
      const count = () => {
        const targets = [map, map.getView(), features, draw, map.getInteractions()];
        const listeners = targets.map((target) => {
          const { listeners_ } = target as unknown as { readonly listeners_: object | null };
          return Object.values(listeners_ ?? {}).flat().length;
        });
        return [
          ...[...listeners, scene.preRender.numberOfListeners, scene.primitives.length],
          ...[map.getInteractions().getLength(), Number(scene.screenSpaceCameraController.enableInputs)],
        ];
      };
      await stage.frames(2);
      const before = count();
      const found: unknown[] = [];
      for (const busy of [false, true]) {
        const listeners = countListeners();
        const viewer = stage.globe.widget;
        const linked = synchronize({ viewer, map, click: true, features });
        const drawn = busy ? linked.draw("Polygon") : undefined;
        if (busy) {
          linked.follow(draw);
          features.addFeature(
            new ol.Feature(
              new ol.LineString([
                [500_000, 5_200_000],
                [500_001, 5_200_001],
              ]),
            ),
          );
          viewer.scene.canvas.dispatchEvent(new PointerEvent("pointermove", { clientX: 200, clientY: 150 }));
        }
        const parts: { isDestroyed(): boolean }[] = [];
        for (let at = 0; at < scene.primitives.length; at++) parts.push(scene.primitives.get(at));
        const during = count();
        const listening = listeners.count();
        await stage.frames(2);
        linked.dispose();
        features.clear();
        await stage.frames(2);
        found.push({
          grows: during.reduce((sum, one, at) => sum + one - before[at]!, 0) > 8,
          listens: listening > 8,
          after: count(),
          listeners: listeners.count(),
          // All but the cloud's own layer.
          left: parts.filter((part) => !part.isDestroyed()).length,
          drawn: await drawn,
        });
        listeners.end();
      }
      return { before, found };
    });
    const nothing = {
      grows: true,
      listens: true,
      after: seen.before,
      listeners: 0,
      left: 1,
      drawn: undefined,
    };
    expect(seen.found).toEqual([nothing, nothing]);
  });
});
