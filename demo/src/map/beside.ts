import type { PointCloudLayer } from "@groma/layer/cesium";
import type { Viewer } from "cesium";
import { byId } from "../panel/elements.js";
import type { MapView } from "./map-view.js";

/** Least and greatest share of the page that the globe has beside the map. */
const SHARES = [0.1, 0.9];
/** By how much a key moves the bar. */
const STEPS: ReadonlyMap<string, number> = new Map([
  ["ArrowLeft", -0.05],
  ["ArrowUp", -0.05],
  ["ArrowRight", 0.05],
  ["ArrowDown", 0.05],
]);

/** The map beside the globe: loaded when it is first shown, with a bar between the two that can be dragged. */
export class Beside {
  readonly #viewer: Viewer;
  readonly #failed: (thrown: unknown) => void;
  readonly #begins: (view: MapView) => void;
  readonly #box = byId("beside", HTMLInputElement);
  readonly #bar = byId("split", HTMLHRElement);
  #view: Promise<MapView> | undefined;
  #layer: PointCloudLayer | undefined;

  /**
   * @param failed told of what the map cannot draw
   * @param begins told of the map when it is first shown
   */
  constructor(viewer: Viewer, failed: (thrown: unknown) => void, begins: (view: MapView) => void) {
    this.#viewer = viewer;
    this.#failed = failed;
    this.#begins = begins;
    this.#box.addEventListener("change", () => this.show(this.#box.checked));
    this.#bar.addEventListener("pointerdown", (down) => this.#bar.setPointerCapture(down.pointerId));
    this.#bar.addEventListener("pointermove", (move) => {
      if (this.#bar.hasPointerCapture(move.pointerId)) this.#split(move);
    });
    this.#bar.addEventListener("keydown", (event) => this.#step(event));
  }

  /** The map, once it was shown. */
  get view(): Promise<MapView> | undefined {
    return this.#view;
  }

  /** Shows the map or takes it away. */
  show(shown: boolean): void {
    this.#box.checked = shown;
    document.body.classList.toggle("beside", shown);
    if (shown) void this.#attach();
  }

  /** Shows a cloud on the map, now or when it is shown. */
  attach(layer: PointCloudLayer): void {
    this.#layer = layer;
    if (this.#box.checked) void this.#attach();
  }

  async #attach(): Promise<void> {
    try {
      this.#view ??= import("./map-view.js").then(({ MapView }) => {
        const view = new MapView(byId("map", HTMLElement), this.#viewer, this.#failed);
        this.#begins(view);
        return view;
      });
      const view = await this.#view;
      if (this.#layer) view.attach(this.#layer);
    } catch (thrown) {
      this.#failed(thrown);
    }
  }

  /** Moves the bar to the pointer: along the longer side of the page. */
  #split({ clientX, clientY }: PointerEvent): void {
    this.#moveTo(upright() ? clientY / innerHeight : clientX / innerWidth);
  }

  #step(event: KeyboardEvent): void {
    const step = STEPS.get(event.key);
    if (step === undefined) return;
    event.preventDefault();
    this.#moveTo(Number(document.body.style.getPropertyValue("--split") || 0.5) + step);
  }

  #moveTo(share: number): void {
    const held = Math.min(Math.max(share, SHARES[0]), SHARES[1]);
    document.body.style.setProperty("--split", String(held));
    this.#bar.setAttribute("aria-valuenow", String(Math.round(100 * held)));
  }
}

/** Whether the two stand one above the other. */
function upright(): boolean {
  return matchMedia("(orientation: portrait)").matches;
}
