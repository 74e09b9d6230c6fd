import { basename, dirname } from "node:path";
import type { Cartesian3 } from "cesium";
import type { CDPSession } from "playwright-core";
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { data } from "../project.js";
import { pythonMissing } from "../python.js";
import { screenshot } from "./harness.js";
import { openStage, type StagePage } from "./stage.js";

const scan = data("autzen.laz");
const missing = scan.missing ?? pythonMissing;

/** CSS pixels of the page. */
interface Spot {
  readonly x: number;
  readonly y: number;
}

/** A camera of the page: ECEF, metres, and radians. */
interface Stand {
  readonly position: readonly [number, number, number];
  readonly height: number;
  readonly heading: number;
  readonly pitch: number;
}

type Point = Pick<Cartesian3, "x" | "y" | "z">;

describe.skipIf(missing)(`navigation${missing ? ` (skipped: ${missing})` : ""}`, () => {
  let stage: StagePage;
  let touch: CDPSession;

  beforeAll(async () => {
    const copc = converted(scan.path);
    stage = await openStage("stage", { "/scans/": dirname(copc) });
    touch = await stage.page.context().newCDPSession(stage.page);
    await stage.page.evaluate(async (name) => {
      const { Stage, PointNavigation, layer } = window.page;
      const stage = new Stage({ width: 400, height: 300, globe: true });
      window.page.stage = stage;
      stage.layer = await layer.PointCloudLayer.fromUrl(`/scans/${name}`, {
        ...{ pointBudget: 40_000, style: { pointSize: 3 }, workers: { size: 1 } },
      });
      stage.scene.primitives.add(stage.layer);
      // Every frame of the page, and how far the camera goes in each.
      const moves: number[] = [];
      let before = window.page.Cesium.Cartesian3.clone(stage.scene.camera.positionWC);
      stage.scene.preRender.addEventListener(() => {
        const { Cartesian3 } = window.page.Cesium;
        const now = Cartesian3.clone(stage.scene.camera.positionWC);
        moves.push(Cartesian3.distance(before, now));
        before = now;
      });
      Object.assign(window, { moves });
      const { layer: scan } = stage;
      const pickPosition = scan.pickPosition.bind(scan);
      const picks = { pending: 0 };
      scan.pickPosition = async (...given) => {
        picks.pending++;
        return pickPosition(...given).finally(() => picks.pending--);
      };
      Object.assign(window, { picks });
      const frame = () => {
        // Flights, and Cesium's own navigation.
        (stage.scene as unknown as { initializeFrame(): void }).initializeFrame();
        stage.frame();
        requestAnimationFrame(frame);
      };
      frame();
      window.page.navigation = new PointNavigation(stage.widget);
    }, basename(copc));
  }, 240_000);

  afterAll(() => stage?.close());

  /** Looks at the middle of the scan from the south, from above. */
  const look = (pitch = -35, range = 700) =>
    stage.page.evaluate(
      async ([degrees, metres]) => {
        const { stage, Cesium, navigation } = window.page;
        const { HeadingPitchRange, Matrix4 } = Cesium;
        const { camera } = stage.scene;
        camera.cancelFlight();
        Object.assign(navigation, {
          mode: "orbit",
          lookUnder: true,
          collision: 0,
          enabled: true,
          drag: "pan",
        });
        const offset = new HeadingPitchRange(0.3, Cesium.Math.toRadians(degrees!), metres!);
        camera.lookAt(stage.layer.boundingSphere.center, offset);
        camera.lookAtTransform(Matrix4.IDENTITY);
        for (let frames = 0; frames < 600 && !stage.layer.settled; frames++) {
          await new Promise((done) => setTimeout(done, 50));
        }
        (window as unknown as { moves: number[] }).moves.length = 0;
      },
      [pitch, range] as const,
    );

  const stand = (): Promise<Stand> =>
    stage.page.evaluate(() => {
      const { positionWC: p, positionCartographic, heading, pitch } = window.page.stage.scene.camera;
      return { position: [p.x, p.y, p.z], height: positionCartographic.height, heading, pitch };
    });

  /** What the picture shows at a place: as deep as the point drawn there. */
  const pick = (at: Spot): Promise<Point> =>
    stage.page.evaluate(async (spot) => {
      const { stage, Cesium } = window.page;
      const { camera } = stage.scene;
      const found = (await stage.layer.pickPosition(spot, { window: 15 }))!;
      const { origin, direction } = camera.getPickRay(new Cesium.Cartesian2(spot.x, spot.y))!;
      const { Cartesian3 } = Cesium;
      const depth = Cartesian3.dot(Cartesian3.subtract(found, origin, new Cartesian3()), camera.directionWC);
      const way = depth / Cartesian3.dot(direction, camera.directionWC);
      const { x, y, z } = direction;
      return { x: origin.x + way * x, y: origin.y + way * y, z: origin.z + way * z };
    }, at);

  const pixelOf = (place: Point): Promise<Spot> =>
    stage.page.evaluate((at) => {
      const { x, y } = window.page.stage.scene.cartesianToCanvasCoordinates(at as Cartesian3)!;
      return { x, y };
    }, place);

  /** Frames go by, until nothing is looked for and the camera rests. */
  const rest = () =>
    stage.page.evaluate(async () => {
      const { moves, picks } = window as unknown as { moves: number[]; picks: { pending: number } };
      const first = moves.length;
      for (let waits = 0; waits < 400; waits++) {
        await new Promise((done) => setTimeout(done, 25));
        if (picks.pending > 0 || moves.length < first + 6) continue;
        if (moves.slice(-4).every((move) => move < 1e-6)) return;
      }
      throw new Error("the camera does not come to rest");
    });

  /** Farthest that the camera went in one frame since it was placed, metres. */
  const farthest = () =>
    stage.page.evaluate(() => Math.max(0, ...(window as unknown as { moves: number[] }).moves));

  const drag = async (from: Spot, to: Spot, button: "left" | "middle" | "right" = "left") => {
    const { mouse } = stage.page;
    await mouse.move(from.x, from.y);
    await mouse.down({ button });
    await mouse.move(to.x, to.y, { steps: 6 });
    await mouse.up({ button });
    await rest();
  };

  const away = (a: Spot, b: Spot) => Math.hypot(a.x - b.x, a.y - b.y);
  const metres = (place: Point, { position: [x, y, z] }: Stand) =>
    Math.hypot(place.x - x, place.y - y, place.z - z);

  beforeEach(() => look(), 60_000);

  afterEach(() => expect(stage.watch.errors).toEqual([]));

  const [from, to] = [
    { x: 215, y: 165 },
    { x: 280, y: 130 },
  ];

  it("drags the picked point along, at one height", { timeout: 60_000 }, async () => {
    const [place, before] = [await pick(from), await stand()];
    await drag(from, to);
    const after = await stand();
    expect(away(await pixelOf(place), to)).toBeLessThan(0.5);
    expect(after.height).toBeCloseTo(before.height, 2);
    expect(after.pitch).toBeCloseTo(before.pitch, 4);
    expect(
      metres({ x: before.position[0], y: before.position[1], z: before.position[2] }, after),
    ).toBeGreaterThan(20);
    await screenshot(stage.page, "navigation-dragged");
  });

  it("orbits about the picked point, and approaches it", { timeout: 60_000 }, async () => {
    const [place, before] = [await pick(from), await stand()];
    await drag(from, { x: 125, y: 125 }, "right");
    const orbited = await stand();
    expect(away(await pixelOf(place), from)).toBeLessThan(0.5);
    expect(metres(place, orbited)).toBeCloseTo(metres(place, before), 3);
    // 90 pixels of 300 are 54°, to the left: the camera goes round to the right.
    expect(Math.abs(Math.sin(orbited.heading - before.heading))).toBeCloseTo(
      Math.sin((54 * Math.PI) / 180),
      2,
    );
    expect(orbited.pitch - before.pitch).toBeCloseTo((40 / 300) * Math.PI, 2);

    await look();
    await stage.page.mouse.move(from.x, from.y);
    for (let turns = 0; turns < 5; turns++) await stage.page.mouse.wheel(0, -120);
    await rest();
    const near = await stand();
    expect(away(await pixelOf(place), from)).toBeLessThan(0.5);
    expect(metres(place, near) / metres(place, before)).toBeCloseTo(Math.exp(-600 / 400), 2);
  });

  it("flies to the point of a double click", { timeout: 60_000 }, async () => {
    const [place, before] = [await pick(from), await stand()];
    await stage.page.mouse.dblclick(from.x, from.y);
    await stage.page.waitForFunction(
      ([at, metres]) => {
        const { Cesium, stage } = window.page;
        return Cesium.Cartesian3.distance(stage.scene.camera.positionWC, at as Cartesian3) < metres;
      },
      [place, 0.34 * metres(place, before)] as const,
    );
    await rest();
    const after = await stand();
    expect(away(await pixelOf(place), { x: 200, y: 150 })).toBeLessThan(1);
    expect(metres(place, after) / metres(place, before)).toBeCloseTo(1 / 3, 2);
    expect(after.heading).toBeCloseTo(before.heading, 2);
  });

  it("goes on where there is no point, into the sky and beside the scan", { timeout: 60_000 }, async () => {
    await look(-4, 700);
    // Above the horizon: what is as far as what was found last.
    await drag({ x: 200, y: 20 }, { x: 230, y: 40 });
    await drag({ x: 20, y: 200 }, { x: 120, y: 190 }, "right");
    await stage.page.mouse.wheel(0, -120);
    await rest();
    const { position } = await stand();
    expect(position.every(Number.isFinite)).toBe(true);
    // All of a drag may be in one frame here: a third of half a turn at 700 m.
    expect(await farthest()).toBeLessThan(800);
  });

  it("looks around from where it stands, and walks", { timeout: 60_000 }, async () => {
    const before = await stand();
    await stage.page.keyboard.down("Shift");
    await drag(from, { x: 255, y: 165 });
    await stage.page.keyboard.up("Shift");
    const looked = await stand();
    expect(looked.position).toEqual(before.position);
    // 40 pixels of the 60° that the picture is wide, at its middle.
    expect(before.heading - looked.heading).toBeGreaterThan(0.09);
    expect(looked.pitch).toBeCloseTo(before.pitch, 4);

    await stage.page.focus("canvas");
    await stage.page.keyboard.press("f");
    expect(await stage.page.evaluate(() => window.page.navigation.mode)).toBe("walk");
    await stage.page.keyboard.down("w");
    await stage.page.waitForFunction((from) => {
      const { x, y, z } = window.page.stage.scene.camera.positionWC;
      return Math.hypot(x - from[0]!, y - from[1]!, z - from[2]!) > 30;
    }, before.position);
    await stage.page.keyboard.up("w");
    await rest();
    const walked = await stand();
    expect(walked.height).toBeCloseTo(before.height, 2);
    expect(walked.pitch).toBeCloseTo(looked.pitch, 3);
    const [x, y, z] = walked.position;
    expect(metres({ x, y, z }, before)).toBeGreaterThan(30);
    await drag(from, { x: 255, y: 195 });
    expect((await stand()).position).toEqual(walked.position);
  });

  it("is moved by the keyboard alone", { timeout: 90_000 }, async () => {
    const press = async (...keys: string[]) => {
      for (const key of keys) await stage.page.keyboard.press(key);
      await rest();
      return stand();
    };
    await stage.page.focus("canvas");
    const before = await stand();
    const ahead = await press("ArrowUp");
    const [x, y, z] = ahead.position;
    expect(metres({ x, y, z }, before)).toBeGreaterThan(10);
    expect(ahead.height).toBeCloseTo(before.height, 2);
    const near = await press("+", "+");
    expect(near.height).toBeLessThan(ahead.height - 20);
    const turned = await press("Shift+ArrowLeft", "Shift+ArrowUp");
    expect(Math.abs(turned.heading - near.heading)).toBeGreaterThan(0.05);
    expect(turned.pitch).toBeGreaterThan(near.pitch + 0.03);
    const north = await press("n");
    expect(Math.abs(Math.sin(north.heading))).toBeLessThan(1e-3);
    const down = await press("u");
    expect(down.pitch).toBeCloseTo(-Math.PI / 2, 3);
    expect(await farthest()).toBeLessThan(800);
    await screenshot(stage.page, "navigation-down");
  });

  it("looks from under the scan, where it may", { timeout: 60_000 }, async () => {
    const place = await pick(from);
    const rise = { x: from.x, y: from.y - 130 };
    await drag(from, rise, "right");
    const below = await stand();
    expect(below.pitch).toBeGreaterThan(0.5);
    expect(away(await pixelOf(place), from)).toBeLessThan(0.5);
    await screenshot(stage.page, "navigation-under");
    await look();
    await stage.page.evaluate(() => {
      window.page.navigation.lookUnder = false;
    });
    await drag(from, rise, "right");
    expect((await stand()).pitch).toBeLessThan(0.01);
  });

  it("keeps away from points where it is told to", { timeout: 90_000 }, async () => {
    const walk = async (clearance: number) => {
      await look(-10, 200);
      await stage.page.evaluate((metres) => {
        const { navigation, stage } = window.page;
        navigation.collision = metres;
        stage.scene.screenSpaceCameraController.enableCollisionDetection = false;
      }, clearance);
      await stage.page.focus("canvas");
      await stage.page.keyboard.down("Shift");
      await stage.page.keyboard.down("q");
      // At some 500 m a second; of a slow frame a tenth of a second counts.
      await stage.page.waitForTimeout(1200);
      await stage.page.waitForFunction(() => {
        const { moves } = window as unknown as { moves: number[] };
        return window.page.stage.scene.camera.positionCartographic.height < 0 || moves.length > 15;
      });
      await stage.page.keyboard.up("q");
      await stage.page.keyboard.up("Shift");
      await rest();
      const { position, height } = await stand();
      const nearest = await stage.page.evaluate((at) => {
        const { layer } = window.page.stage as unknown as {
          layer: { drawnNear(place: readonly number[], radius: number): readonly number[] };
        };
        const points = layer.drawnNear(at, 100);
        let least = Number.POSITIVE_INFINITY;
        for (let i = 0; i < points.length; i += 3) {
          least = Math.min(
            least,
            Math.hypot(points[i]! - at[0], points[i + 1]! - at[1], points[i + 2]! - at[2]),
          );
        }
        return least;
      }, position);
      return { height, nearest };
    };
    const through = await walk(0);
    const kept = await walk(15);
    expect(kept.nearest).toBeGreaterThan(14.9);
    expect(kept.nearest).toBeLessThan(25);
    expect(kept.height).toBeGreaterThan(through.height + 15);
  });

  it("is moved by one, two and three fingers", { timeout: 90_000 }, async () => {
    /** Takes fingers from some places to others. */
    const fingers = async (...ways: readonly (readonly [Spot, Spot])[]) => {
      const at = (share: number) =>
        ways.map(([a, b], id) => ({ id, x: a.x + share * (b.x - a.x), y: a.y + share * (b.y - a.y) }));
      const send = (
        type: "touchStart" | "touchMove" | "touchEnd",
        touchPoints: { id: number; x: number; y: number }[],
      ) => touch.send("Input.dispatchTouchEvent", { type, touchPoints });
      await send("touchStart", at(0));
      for (const share of [0.3, 0.6, 1]) await send("touchMove", at(share));
      await send("touchEnd", []);
      await rest();
    };
    const place = await pick(from);
    await fingers([from, to]);
    expect(away(await pixelOf(place), to)).toBeLessThan(0.5);

    await look();
    const before = await stand();
    const middle = await pick({ x: 200, y: 150 });
    // A pinch that doubles, moves and turns by a right angle.
    await fingers(
      [
        { x: 170, y: 150 },
        { x: 220, y: 110 },
      ],
      [
        { x: 230, y: 150 },
        { x: 220, y: 230 },
      ],
    );
    const pinched = await stand();
    expect(away(await pixelOf(middle), { x: 220, y: 170 })).toBeLessThan(0.5);
    // Half as far, and a little nearer by being dragged towards the camera.
    expect(metres(middle, pinched) / metres(middle, before)).toBeGreaterThan(0.43);
    expect(metres(middle, pinched) / metres(middle, before)).toBeLessThan(0.5);
    expect(Math.abs(Math.sin(pinched.heading - before.heading))).toBeCloseTo(1, 2);

    await look();
    const spots = [150, 200, 250].map(
      (x) =>
        [
          { x, y: 150 },
          { x: x - 60, y: 130 },
        ] as const,
    );
    await fingers(...spots);
    const orbited = await stand();
    expect(Math.abs(Math.sin(orbited.heading - before.heading))).toBeCloseTo(
      Math.sin((60 / 300) * Math.PI),
      2,
    );
    expect(away(await pixelOf(middle), { x: 200, y: 150 })).toBeLessThan(0.5);
  });

  it("leaves the camera to tools, flights, and Cesium's own navigation", { timeout: 60_000 }, async () => {
    const before = await stand();
    const allow = (enableInputs: boolean) =>
      stage.page.evaluate((inputs) => {
        window.page.stage.scene.screenSpaceCameraController.enableInputs = inputs;
      }, enableInputs);
    await allow(false);
    await drag(from, to);
    expect((await stand()).position).toEqual(before.position);
    await allow(true);
    const flags = () =>
      stage.page.evaluate(() => {
        const { enableRotate, enableZoom, enableTilt, enableLook } =
          window.page.stage.scene.screenSpaceCameraController;
        return [enableRotate, enableZoom, enableTilt, enableLook];
      });
    expect(await flags()).toEqual([false, false, false, false]);
    await stage.page.evaluate(() => {
      window.page.navigation.enabled = false;
    });
    expect(await flags()).toEqual([true, true, true, true]);
    const arrived = await stage.page.evaluate(async () => {
      const { navigation, stage } = window.page;
      navigation.enabled = true;
      const { center } = stage.layer.boundingSphere;
      const all = [
        navigation.flyTo(center, { distance: 400, duration: 0.3 }),
        navigation.flyTo(center, { distance: 500, duration: 0.3 }),
      ];
      return Promise.all(all);
    });
    // The second one has ended the first.
    expect(arrived).toEqual([false, true]);
    const { center } = await stage.page.evaluate(() => {
      const { x, y, z } = window.page.stage.layer.boundingSphere.center;
      return { center: { x, y, z } };
    });
    expect(metres(center, await stand())).toBeCloseTo(500, 2);
    const refused = await stage.page.evaluate(async () => {
      const { navigation } = window.page;
      const codes: unknown[] = [];
      for (const wrong of [
        () => Object.assign(navigation, { mode: "fly" }),
        () => Object.assign(navigation, { collision: -1 }),
        () => navigation.flyTo({ x: 1 } as never),
        () => new window.page.PointNavigation({} as never),
        () => new window.page.PointNavigation(window.page.stage.widget, { colision: 1 } as never),
      ]) {
        try {
          wrong();
          codes.push("nothing");
        } catch (thrown) {
          codes.push((thrown as { code: string }).code);
        }
      }
      return codes;
    });
    expect(refused).toEqual(Array(5).fill("STYLE_OPTION"));
    // At last, it goes without a trace.
    await stage.page.evaluate(() => {
      const { navigation } = window.page;
      navigation.enabled = true;
      navigation.destroy();
      navigation.destroy();
    });
    expect(await flags()).toEqual([true, true, true, true]);
    expect(await stage.page.evaluate(() => window.page.navigation.isDestroyed())).toBe(true);
  });
});
