import type { PointCloudLayer } from "@groma/layer/cesium";
import type { Profile, Vertex } from "@groma/layer/tools";
import {
  Cartesian2,
  Cartesian3,
  Color,
  type Entity,
  Material,
  PolylineCollection,
  type Viewer,
} from "cesium";
import { i18n } from "../language/i18n.js";
import { textElement } from "../panel/elements.js";

const COLOUR = Color.fromCssColorString("#f2b84b").withAlpha(0.9);

/** By how much a key changes the width. */
const STEP = 1.1;

/** Pixels around the pointer in which a point counts as hit. */
const REACH = 9;

/** The edges of a strip in the scene, and the handle that its width is dragged by. */
export class StripOutline {
  readonly #viewer: Viewer;
  readonly #lines: PolylineCollection;
  readonly #handle: HTMLButtonElement;
  readonly #widened: (width: number) => void;
  readonly #layer: () => PointCloudLayer | undefined;
  #profile: Profile | undefined;
  #grip: Cartesian3 | undefined;

  /**
   * @param widened hears of another width, metres
   * @param failed hears what kept the point under the pointer from being read
   */
  constructor(
    viewer: Viewer,
    layer: () => PointCloudLayer | undefined,
    widened: (width: number) => void,
    failed: (thrown: unknown) => void,
  ) {
    this.#viewer = viewer;
    this.#layer = layer;
    this.#widened = widened;
    this.#lines = viewer.scene.primitives.add(new PolylineCollection());
    this.#handle = textElement("button", "↔", "width-handle");
    this.#handle.type = "button";
    this.#handle.hidden = true;
    this.#handle.setAttribute("aria-label", i18n.t("Width of the profile: drag, or arrow keys"));
    viewer.container.append(this.#handle);
    viewer.scene.postRender.addEventListener(() => this.#put());
    this.#handle.addEventListener("pointerdown", (event) => this.#handle.setPointerCapture(event.pointerId));
    this.#handle.addEventListener("pointerup", (event) => {
      this.#drop(event).catch(failed);
    });
    this.#handle.addEventListener("keydown", (event) => this.#key(event));
  }

  /** Shows the strip of a profile; undefined: none. @param vertices of its line */
  show(profile: Profile | undefined, vertices: readonly Vertex[]): void {
    this.#lines.removeAll();
    this.#profile = profile;
    this.#grip = undefined;
    if (profile && vertices.length > 1) this.#draw(profile, vertices);
    this.#handle.hidden = this.#grip === undefined;
    this.#viewer.scene.requestRender();
  }

  #draw(profile: Profile, vertices: readonly Vertex[]): void {
    const along = profile.strip;
    const place = new Float64Array(3);
    const heights = vertices.map(({ source }) => source?.[2] ?? 0);
    const at = (x: number, y: number, z: number) => {
      profile.place(x, y, z, place);
      return new Cartesian3(place[0], place[1], place[2]);
    };
    for (const side of [along.reach, -along.reach]) {
      const positions = along.chainages.flatMap((chainage, index) => {
        const found = along.at(chainage);
        if (!found) return [];
        const [dx, dy] = found.direction;
        return [at(found.x - side * dy, found.y + side * dx, heights[index]!)];
      });
      this.#lines.add({ positions, width: 1.5, material: Material.fromType("Color", { color: COLOUR }) });
    }
    const middle = along.at(along.chainages[0]! + along.length / 2);
    if (!middle) return;
    const [dx, dy] = middle.direction;
    const height = (heights[0]! + heights[heights.length - 1]!) / 2;
    this.#grip = at(middle.x - along.reach * dy, middle.y + along.reach * dx, height);
  }

  #put(): void {
    const { scene } = this.#viewer;
    const pixel = this.#grip && scene.cartesianToCanvasCoordinates(this.#grip);
    if (!pixel || this.#handle.matches(":active")) return;
    this.#handle.style.translate = `calc(${pixel.x}px - 50%) calc(${pixel.y}px - 50%)`;
  }

  /** Takes the distance of the point under the pointer from the line as half the width. */
  async #drop({ clientX, clientY }: PointerEvent): Promise<void> {
    const { left, top } = this.#viewer.canvas.getBoundingClientRect();
    const profile = this.#profile;
    const hit = await this.#layer()?.pick(new Cartesian2(clientX - left, clientY - top), { window: REACH });
    if (!hit || !profile) return;
    const place = new Float64Array(2);
    profile.toPlane(...hit.source, place);
    const width = 2 * distance(profile.strip.vertices, place[0]!, place[1]!) * profile.unit;
    if (width > 0) this.#widened(width);
  }

  #key(event: KeyboardEvent): void {
    const wider = event.key === "ArrowUp" || event.key === "ArrowRight";
    if (!wider && event.key !== "ArrowDown" && event.key !== "ArrowLeft") return;
    event.preventDefault();
    const profile = this.#profile;
    if (!profile) return;
    const width = 2 * profile.strip.reach * profile.unit;
    this.#widened(width * (wider ? STEP : 1 / STEP));
  }
}

/** Distance of a place from a polyline, in the same unit. */
function distance(line: readonly (readonly [number, number])[], x: number, y: number): number {
  const distances = line.slice(1).map(([bx, by], index) => {
    const [ax, ay] = line[index]!;
    const [ux, uy] = [bx - ax, by - ay];
    const square = ux * ux + uy * uy;
    const share = square > 0 ? Math.min(1, Math.max(0, (ux * (x - ax) + uy * (y - ay)) / square)) : 0;
    return Math.hypot(x - ax - share * ux, y - ay - share * uy);
  });
  return Math.min(...distances);
}

/** A mark in the scene that follows what is pointed at in the plot. */
export class PlaceMark {
  readonly #viewer: Viewer;
  readonly #entity: Entity;
  #place: Cartesian3 | undefined;

  constructor(viewer: Viewer) {
    this.#viewer = viewer;
    this.#entity = viewer.entities.add({
      show: false,
      point: {
        pixelSize: 10,
        color: Color.fromCssColorString("#f2b84b"),
        outlineColor: Color.BLACK,
        outlineWidth: 2,
        disableDepthTestDistance: Number.POSITIVE_INFINITY,
      },
    });
  }

  /** Where the mark stands, ECEF, metres. */
  get place(): Cartesian3 | undefined {
    return this.#place;
  }

  /** @param place ECEF, metres; undefined: nothing is pointed at */
  show(place: ArrayLike<number> | undefined): void {
    this.#place = place && new Cartesian3(place[0], place[1], place[2]);
    this.#entity.show = place !== undefined;
    if (this.#place) this.#entity.position = this.#place as never;
    this.#viewer.scene.requestRender();
  }
}
