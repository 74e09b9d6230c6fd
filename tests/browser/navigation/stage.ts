import { basename, dirname } from "node:path";
import type { Cartesian3 } from "cesium";
import { converted } from "../../converted.js";
import { openStage } from "../stage.js";

/** CSS pixels of the page. */
export interface Spot {
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

/** Places of the picture where the scan shows. */
export const [from, to] = [
  { x: 215, y: 165 },
  { x: 280, y: 130 },
];

/** Pixels between two places of the picture. */
export const away = (a: Spot, b: Spot) => Math.hypot(a.x - b.x, a.y - b.y);

/** Metres from a place to a camera. */
export const metres = (place: Point, { position: [x, y, z] }: Stand) =>
  Math.hypot(place.x - x, place.y - y, place.z - z);

/** A page with a scan and its navigation, and what tests do there: one for all of them, since loading takes most of the time. */
export type NavigationStage = Awaited<ReturnType<typeof openNavigation>>;

/** @param scan that is moved about */
export async function openNavigation(scan: string) {
  const copc = converted(scan);
  const stage = await openStage("stage", { "/scans/": dirname(copc) });
  const touch = await stage.page.context().newCDPSession(stage.page);
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

  return {
    ...{ page: stage.page, watch: stage.watch, touch, close: () => stage.close() },
    ...{ look, stand, pick, pixelOf, rest, farthest, drag },
  };
}
