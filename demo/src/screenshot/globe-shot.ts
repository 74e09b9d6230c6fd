import { type Vector, WGS84 } from "@groma/georef";
import type { PointCloudLayer } from "@groma/layer/cesium";
import {
  Cartesian3,
  Cartographic,
  Ellipsoid,
  EllipsoidTerrainProvider,
  IntersectionTests,
  PerspectiveFrustum,
  Ray,
  type Scene,
  type Viewer,
} from "cesium";
import { groundAt } from "./ground-at.js";
import { drawFigures, type Ground, type ViewShot, viewCanvas } from "./view-shot.js";

/** CSS pixels around the middle in which a point counts. */
const REACH = 15;

/**
 * Takes a picture of the globe, at the full resolution of the screen, once it shows all that the view wants.
 * @param complete whether all is there that the page waits for besides
 * @throws the signal's reason
 */
export async function shootGlobe(
  viewer: Viewer,
  layers: () => readonly PointCloudLayer[],
  complete: () => boolean,
  signal: AbortSignal,
): Promise<ViewShot> {
  const { scene, canvas, container } = viewer;
  const before = viewer.resolutionScale;
  const ratio = devicePixelRatio;
  viewer.resolutionScale = ratio;
  try {
    const [image, box] = await drawn(viewer, signal, () => {
      const whole = !scene.globe.show || scene.globe.tilesLoaded;
      const wide = Math.abs(canvas.width - canvas.clientWidth * ratio) <= 1;
      if (!whole || !wide || !complete() || layers().some(({ settled }) => !settled)) return undefined;
      const place = container.getBoundingClientRect();
      const context = viewCanvas(place, ratio);
      // What is drawn is gone when the browser has shown the frame.
      context.drawImage(canvas, 0, 0, place.width, place.height);
      drawFigures(context, container, place);
      return [context.canvas, place] as const;
    });
    return { image, box, ground: await groundOf(viewer, layers(), signal), perspective: true };
  } finally {
    viewer.resolutionScale = before;
  }
}

/** What `take` returns right after the first frame for which it returns anything. @throws the signal's reason */
function drawn<Taken>({ scene }: Viewer, signal: AbortSignal, take: () => Taken | undefined): Promise<Taken> {
  signal.throwIfAborted();
  return new Promise((resolve, reject) => {
    const end = () => {
      stop();
      signal.removeEventListener("abort", give);
    };
    const give = () => {
      end();
      reject(signal.reason);
    };
    const stop = scene.postRender.addEventListener(() => {
      try {
        const taken = take();
        if (taken === undefined) return scene.requestRender();
        end();
        resolve(taken);
      } catch (thrown) {
        end();
        reject(thrown);
      }
    });
    signal.addEventListener("abort", give);
    scene.requestRender();
  });
}

/**
 * Scale and north where the globe's camera looks: at the depth of the point drawn there, else on the terrain, else at the
 * height of the cloud ahead.
 */
async function groundOf(
  { scene, camera }: Viewer,
  layers: readonly PointCloudLayer[],
  signal: AbortSignal,
): Promise<Ground | undefined> {
  const { clientWidth: width, clientHeight: height } = scene.canvas;
  const { frustum } = camera;
  const ray = new Ray(Cartesian3.clone(camera.positionWC), Cartesian3.clone(camera.directionWC));
  const pose = {
    position: vectorOf(ray.origin),
    direction: vectorOf(ray.direction),
    up: vectorOf(camera.upWC),
  };
  const halfHeight = Math.tan(((frustum instanceof PerspectiveFrustum && frustum.fovy) || Math.PI / 3) / 2);
  const beside = meetGround(scene, ray, layers);
  const picks = layers.map((layer) =>
    layer.pick({ x: width / 2, y: height / 2 }, { window: 2 * REACH + 1, signal }).catch(() => undefined),
  );
  const found = (await Promise.all(picks)).flatMap((hit) => (hit ? [hit.position] : []));
  signal.throwIfAborted();
  const seen = found.length > 0 ? found : beside ? [beside] : [];
  const depths = seen.map((place) =>
    Cartesian3.dot(Cartesian3.subtract(place, ray.origin, new Cartesian3()), ray.direction),
  );
  return groundAt(pose, Math.min(...depths), (2 * halfHeight) / height);
}

/** Where a ray meets the terrain, or without one the ellipsoid at the height of the cloud that lies ahead. */
function meetGround(scene: Scene, ray: Ray, layers: readonly PointCloudLayer[]): Cartesian3 | undefined {
  const { globe } = scene;
  if (globe.show && !(globe.terrainProvider instanceof EllipsoidTerrainProvider)) {
    return globe.pick(ray, scene);
  }
  const ahead = layers.find(({ boundingSphere }) => IntersectionTests.raySphere(ray, boundingSphere));
  const height = ahead ? Cartographic.fromCartesian(ahead.boundingSphere.center).height : 0;
  const { a, f } = WGS84;
  const surface = new Ellipsoid(a + height, a + height, a * (1 - f) + height);
  const met = IntersectionTests.rayEllipsoid(ray, surface);
  return met && Ray.getPoint(ray, met.start);
}

function vectorOf({ x, y, z }: Cartesian3): Vector {
  return [x, y, z];
}
