import { describe, expect, it } from "vitest";
import { LinkedPage, MIDDLE, missing, unless } from "./linked.js";
import { serveTerrain } from "./quantized-mesh.js";

describe.skipIf(missing)(`the ground that map and globe share${unless}`, () => {
  const linked = new LinkedPage();

  it("shows the ground that the camera sees, as Cesium's own rays find it", {
    timeout: 120_000,
  }, async () => {
    const seen = await linked.page.evaluate(async () => {
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

  it("is what a camera without perspective sees, and the map follows its width", {
    timeout: 120_000,
  }, async () => {
    const seen = await linked.page.evaluate(async () => {
      const { stage, synchronize, Cesium, ol } = window.linked;
      const { camera, canvas } = stage.globe.scene;
      const perspective = camera.frustum;
      const map = stage.addMap({ projection: "EPSG:32632", center: [500_000, 5_200_000], resolution: 10 });
      stage.globe.look({ at: [500_000, 5_200_000, 0], heading: 25, pitch: -50, range: 2000 });
      stage.globe.orthographic(1200);
      stage.globe.frame();
      const middle = () => ({ x: 150, y: 100 });
      const link = synchronize({ viewer: stage.globe.widget, map: map.map, middle });
      window.linked.link = link;
      const ring = link.footprint!.getGeometry()!.getCoordinates()[0]!;
      const [width, height] = [canvas.clientWidth, canvas.clientHeight];
      const placeAt = (x: number, y: number) => {
        const place = camera.pickEllipsoid(new Cesium.Cartesian2(x, y))!;
        const { longitude, latitude } = Cesium.Cartographic.fromCartesian(place);
        return ol.fromLonLat([longitude, latitude].map(Cesium.Math.toDegrees), "EPSG:32632");
      };
      const corners = [
        [0, height],
        [width, height],
        [width, 0],
        [0, 0],
      ].map(([x, y]) => placeAt(x!, y!));
      const view = map.map.getView();
      const shown = { center: view.getCenter()!, resolution: view.getResolution()! };
      const wanted = placeAt(150, 100);
      // Half as much ground to a pixel of the map: the globe follows, the place stays where it was.
      view.setResolution(shown.resolution / 2);
      await stage.frames(3);
      stage.globe.frame();
      const nearer = { width: (camera.frustum as { width?: number }).width, place: placeAt(150, 100) };
      camera.frustum = perspective;
      return { ring, corners, shown, wanted, nearer };
    });
    const apart = (a: readonly number[], b: readonly number[]) => Math.hypot(a[0]! - b[0]!, a[1]! - b[1]!);
    for (const corner of seen.corners) {
      expect(Math.min(...seen.ring.map((at) => apart(at, corner)))).toBeLessThan(1e-3);
    }
    // Cesium forms its rays with some micrometres for each metre of the picture.
    expect(apart(seen.shown.center, seen.wanted)).toBeLessThan(0.01);
    expect(seen.shown.resolution).toBeCloseTo((0.9996 * 1200) / 400, 3);
    expect(seen.nearer.width).toBeCloseTo(600, 3);
    expect(apart(seen.nearer.place, seen.wanted)).toBeLessThan(0.01);
  });

  it("is that of the map's points as soon as they are there, however late they come", {
    timeout: 120_000,
  }, async () => {
    const { height, later } = await linked.page.evaluate(async (middle) => {
      const { stage, synchronize } = window.linked;
      const { globe } = stage;
      const map = stage.addMap({ projection: "EPSG:32632", center: [...middle], resolution: 0.05 });
      const heightOf = () => globe.scene.camera.positionCartographic.height;
      globe.look({ at: [middle[0]!, middle[1]!, 0], heading: 0, pitch: -60, range: 40 });
      globe.layer.show = false;
      map.layer.setVisible(false);
      window.linked.link = synchronize({ viewer: globe.widget, map: map.map, view: "to-globe" });
      map.map.getView().adjustCenter([1, 1]);
      // Longer than the link waits before it reads what the map shows in the middle.
      await new Promise((done) => setTimeout(done, 400));
      const height = heightOf();
      map.layer.setVisible(true);
      for (let wait = 0; wait < 1000 && heightOf() < height + 400; wait++) {
        await new Promise((done) => setTimeout(done, 10));
      }
      globe.layer.show = true;
      return { height, later: heightOf() };
    }, MIDDLE);
    expect(later - height).toBeGreaterThan(499);
    expect(later - height).toBeLessThan(502);
  });

  it("is the terrain where the globe has one, as soon as that is there", { timeout: 180_000 }, async () => {
    const middle = (46.9542 * Math.PI) / 180;
    const slope = (_: number, north: number) =>
      1000 + 0.2 * Math.min(Math.max(6.37e6 * (north - middle), -4500), 4500);
    await serveTerrain(linked.page, "/slope/", slope);
    const seen = await linked.page.evaluate(async () => {
      const { stage, synchronize, Cesium, Stage, ol } = window.linked;
      const globe = new Stage({ width: 400, height: 300, globe: true });
      const { scene } = globe.widget;
      const { camera, canvas } = scene;
      // A slope: 1,000 m in the middle of the scans, and 20 m more for each 100 m to the north, 4.5 km to either side.
      const [longitude, latitude] = [9, 46.9542].map(Cesium.Math.toRadians) as [number, number];
      const heightAt = (_: number, north: number) =>
        1000 + 0.2 * Math.min(Math.max(6.37e6 * (north - latitude), -4500), 4500);
      const target = Cesium.Cartesian3.fromRadians(longitude, latitude, 1000);
      const degrees = Math.PI / 180;
      camera.lookAt(target, new Cesium.HeadingPitchRange(30 * degrees, -35 * degrees, 1500));
      camera.lookAtTransform(Cesium.Matrix4.IDENTITY);
      const load = async () => {
        for (let quiet = 0; quiet < 5; ) {
          globe.frame();
          await new Promise((done) => setTimeout(done, 5));
          quiet = scene.globe.tilesLoaded ? quiet + 1 : 0;
        }
      };
      /** Where the ray through a place of the picture meets the slope, found by halving. */
      const meets = (x: number, y: number) => {
        const ray = camera.getPickRay(new Cesium.Cartesian2(x, y))!;
        let [near, far] = [0, 20_000];
        for (let step = 0; step < 60; step++) {
          const middle = (near + far) / 2;
          const place = Cesium.Cartographic.fromCartesian(Cesium.Ray.getPoint(ray, middle));
          if (place.height > heightAt(place.longitude, place.latitude)) near = middle;
          else far = middle;
        }
        const { longitude, latitude, height } = Cesium.Cartographic.fromCartesian(
          Cesium.Ray.getPoint(ray, near),
        );
        const at = ol.fromLonLat([longitude, latitude].map(Cesium.Math.toDegrees), "EPSG:32632");
        return { at, height, away: near };
      };
      const map = stage.addMap({ projection: "EPSG:32632", center: [0, 0], resolution: 1 });
      map.layer.setVisible(false);
      const features = new ol.VectorSource();
      const link = synchronize({ viewer: globe.widget, map: map.map, features });
      window.linked.link = link;
      const view = map.map.getView();
      const [width, height] = [canvas.clientWidth, canvas.clientHeight];
      await load();
      const early = view.getCenter()!;
      // The terrain comes when the link has long been at rest, and the camera stays where it is.
      await new Promise((done) => setTimeout(done, 400));
      scene.terrainProvider = await Cesium.CesiumTerrainProvider.fromUrl("/slope/");
      await load();
      const corners = [
        [0, height],
        [width, height],
        [width, 0],
        [0, 0],
      ].map(([x, y]) => meets(x!, y!).at);
      const ringOff = () => {
        const ring = link.footprint!.getGeometry()!.getCoordinates()[0]!;
        const nearest = (corner: number[]) =>
          Math.min(...ring.map(([x, y]) => Math.hypot(x! - corner[0]!, y! - corner[1]!)));
        return Math.max(...corners.map(nearest));
      };
      for (let wait = 0; wait < 500 && ringOff() > 2; wait++) {
        await new Promise((done) => setTimeout(done, 20));
      }
      const before = {
        ...{ center: view.getCenter()!, resolution: view.getResolution()! },
        ringOff: ringOff(),
      };
      const looked = meets(width / 2, height / 2);
      // The map leads to a place farther up the slope.
      const wanted = [before.center[0]! + 100, before.center[1]! + 300];
      view.setCenter(wanted);
      await stage.frames(3);
      await load();
      const led = meets(width / 2, height / 2);
      // The pointer on the globe marks the ground of the slope on the map.
      canvas.scrollIntoView();
      canvas.dispatchEvent(
        new PointerEvent("pointermove", {
          clientX: canvas.getBoundingClientRect().left + 90,
          clientY: canvas.getBoundingClientRect().top + 220,
        }),
      );
      await stage.frames(3);
      const marked = link.cursor!.map.getGeometry()?.getCoordinates();
      const under = meets(90, 220).at;
      // A shared vertex without a height stands on the slope.
      const line = new ol.Feature(new ol.LineString([before.center, wanted]));
      features.addFeature(line);
      await stage.frames(3);
      const stands = link.placesOf(line).vertices.map((place) => {
        const at = Cesium.Cartographic.fromCartesian(Cesium.Cartesian3.fromArray([...place]));
        return at.height - heightAt(at.longitude, at.latitude);
      });
      link.dispose();
      globe.destroy();
      return { early, before, looked, wanted, led, marked, under, stands };
    });
    const apart = (a: readonly number[], b: readonly number[]) => Math.hypot(a[0]! - b[0]!, a[1]! - b[1]!);
    // Cesium keeps the vertices of a tile to 12 bits of its size.
    const near = 2;
    // Before there was any terrain, it was taken for the ellipsoid.
    expect(apart(seen.early, seen.looked.at)).toBeGreaterThan(500);
    expect(apart(seen.before.center, seen.looked.at)).toBeLessThan(near);
    const perPixel = (2 * Math.tan(Math.PI / 6)) / 400;
    expect(seen.before.resolution / (seen.looked.away * perPixel)).toBeCloseTo(0.9996, 2);
    expect(seen.before.ringOff).toBeLessThan(near);
    expect(apart(seen.led.at, seen.wanted)).toBeLessThan(near);
    expect(seen.led.away / seen.looked.away).toBeCloseTo(1, 2);
    expect(seen.led.height - seen.looked.height).toBeGreaterThan(50);
    expect(apart(seen.marked!, seen.under)).toBeLessThan(near);
    expect(seen.stands.length).toBe(2);
    for (const off of seen.stands) expect(Math.abs(off)).toBeLessThan(near);
  });
});
