import { geodesicBetween } from "@groma/georef";
import type OlMap from "ol/Map.js";
import { fromLonLat, toLonLat } from "ol/proj.js";
import { drawFigures, type Ground, type ViewShot, viewCanvas } from "../screenshot/view-shot.js";

const DEGREE = Math.PI / 180;
/** Metres in a degree of a meridian, about. */
const METRES_PER_DEGREE = 111_000;
/** Pixels to the north of the middle at which it is looked where north is. */
const STEP = 10;

/** Takes a picture of a map, at its own resolution, once it shows all that its view wants. @throws the signal's reason */
export async function shootMap(map: OlMap, signal: AbortSignal): Promise<ViewShot> {
  await complete(map, signal);
  const target = map.getTargetElement();
  const box = target.getBoundingClientRect();
  const context = viewCanvas(box, devicePixelRatio);
  context.fillStyle = getComputedStyle(document.body).backgroundColor;
  context.fillRect(0, 0, box.width, box.height);
  for (const canvas of Array.from(
    map.getViewport().querySelectorAll<HTMLCanvasElement>(".ol-layers canvas"),
  )) {
    if (canvas.width === 0) continue;
    const { transform, width, height } = canvas.style;
    context.save();
    context.globalAlpha = opacityOf(canvas, target);
    // Canvases of OpenLayers are as large as their pixels, and turned and scaled by their style.
    const { a, b, c, d, e, f } = new DOMMatrix(transform || undefined);
    context.transform(a, b, c, d, e, f);
    if (transform) context.drawImage(canvas, 0, 0);
    else context.drawImage(canvas, 0, 0, Number.parseFloat(width), Number.parseFloat(height));
    context.restore();
  }
  drawFigures(context, target, box);
  return { image: context.canvas, box, ground: groundOf(map), perspective: false };
}

/** What a map says of its sources, as text. */
export function creditsOf(map: OlMap): string[] {
  const items = Array.from(map.getViewport().querySelectorAll(".ol-attribution li"));
  return items.map(({ textContent }) => textContent);
}

/** @throws the signal's reason */
function complete(map: OlMap, signal: AbortSignal): Promise<void> {
  signal.throwIfAborted();
  return new Promise((resolve, reject) => {
    const done = () => {
      signal.removeEventListener("abort", give);
      resolve();
    };
    const give = () => {
      map.un("rendercomplete", done);
      reject(signal.reason);
    };
    map.once("rendercomplete", done);
    signal.addEventListener("abort", give);
    map.render();
  });
}

function opacityOf(element: Element, root: Element): number {
  let opacity = 1;
  for (let at: Element | null = element; at && at !== root; at = at.parentElement) {
    opacity *= Number(getComputedStyle(at).opacity);
  }
  return opacity;
}

/** Scale and north in the middle of a map: those of its projection there, on the ellipsoid. */
function groundOf(map: OlMap): Ground | undefined {
  const view = map.getView();
  const center = view.getCenter();
  const resolution = view.getResolution();
  if (!center || !resolution) return undefined;
  const projection = view.getProjection();
  const [x, y] = center as [number, number];
  const turn = view.getRotation();
  // Half a pixel to either side: the scale of a small map is another one already at its edges.
  const [dx, dy] = [(Math.cos(turn) * resolution) / 2, (Math.sin(turn) * resolution) / 2];
  const radians = (at: number[]) => toLonLat(at, projection).map((one) => one * DEGREE) as [number, number];
  const metresPerPixel = geodesicBetween(...radians([x - dx, y - dy]), ...radians([x + dx, y + dy])).distance;
  const [longitude, latitude] = toLonLat(center, projection) as [number, number];
  const step = (STEP * metresPerPixel) / METRES_PER_DEGREE;
  const [east, north] = fromLonLat([longitude, latitude + step], projection).map(
    (at, axis) => at - [x, y][axis]!,
  );
  const angle = Math.atan2(east!, north!) + turn;
  return metresPerPixel > 0 && Number.isFinite(angle) ? { metresPerPixel, north: angle } : undefined;
}
