import type { PointCloudLayer } from "@groma/layer/cesium";
import type { LayerStatistics, LedgerRow } from "@groma/layer/openlayers";
import type { Viewer } from "cesium";
import { byId } from "../panel/elements.js";
import type { ViewShot } from "../screenshot/view-shot.js";
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

/** What the page shows. */
export type Shown = "globe" | "both" | "map";

/** The map beside the globe or in its place: loaded when it is first shown, with a bar between the two. */
export class Beside {
  readonly #viewer: Viewer;
  readonly #failed: (thrown: unknown) => void;
  readonly #begins: (view: MapView) => void;
  readonly #choice = byId("views", HTMLSelectElement);
  readonly #link = byId("link", HTMLInputElement);
  readonly #north = byId("north", HTMLInputElement);
  readonly #bar = byId("split", HTMLHRElement);
  #view: Promise<MapView> | undefined;
  /** The same once it is there. */
  #shown: MapView | undefined;
  #layers: readonly PointCloudLayer[] = [];
  #chosen: PointCloudLayer | undefined;
  /** The frame of the page in which a covered globe is looked at next. */
  #next = 0;

  /**
   * @param failed told of what the map cannot draw
   * @param begins told of the map when it is first shown
   */
  constructor(viewer: Viewer, failed: (thrown: unknown) => void, begins: (view: MapView) => void) {
    this.#viewer = viewer;
    this.#failed = failed;
    this.#begins = begins;
    this.#choice.addEventListener("change", () => this.show(this.#choice.value as Shown));
    for (const box of [this.#link, this.#north]) box.addEventListener("change", () => void this.#follow());
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

  /** Whether the map goes where the globe goes: alone it always does, so that what goes by the globe is true of it. */
  get linked(): boolean {
    return this.alone || (this.#choice.value === "both" && this.#link.checked);
  }

  /** Whether the map is in the place of the globe. */
  get alone(): boolean {
    return this.#choice.value === "map";
  }

  /** What the map draws, where it is in the place of the globe. */
  get statistics(): LayerStatistics | undefined {
    return this.alone ? this.#shown?.statistics : undefined;
  }

  /** The effects of what the map draws, where it is in the place of the globe. */
  get ledger(): readonly LedgerRow[] | undefined {
    return this.alone ? this.#shown?.ledger : undefined;
  }

  /** Lets nodes that failed on the map be asked for again. */
  retryFailed(): void {
    this.#shown?.retryFailed();
  }

  /** A picture of the map, where it is shown, and what that says of its sources. @throws the signal's reason */
  async shoot(
    signal: AbortSignal,
  ): Promise<{ readonly shot: ViewShot; readonly credits: readonly string[] } | undefined> {
    if (this.#choice.value === "globe") return undefined;
    return (await this.#view)?.shoot(signal);
  }

  /** Has an address of the page ask for what is shown. */
  writeTo(page: URL): void {
    const { searchParams: query } = page;
    for (const name of ["map", "link"]) query.delete(name);
    if (this.#choice.value !== "globe") query.set("map", this.alone ? "only" : "1");
    if (this.#choice.value === "both" && !this.#link.checked) query.set("link", "0");
  }

  /** Shows the globe, the map, or both. @param linked whether the two move together; default: as it is */
  show(shown: Shown, linked = this.#link.checked): void {
    this.#choice.value = shown;
    this.#link.checked = linked;
    document.body.classList.toggle("beside", shown === "both");
    document.body.classList.toggle("map-alone", shown === "map");
    byId("globe", HTMLElement).inert = shown === "map";
    byId("link-fields", HTMLElement).hidden = shown !== "both";
    // Nobody sees the frames of a globe that the map covers.
    this.#viewer.useDefaultRenderLoop = shown !== "map";
    if (shown === "map") this.#beat();
    if (shown !== "globe") void this.#attach();
    else void this.#follow();
  }

  /** Shows the clouds of the globe on the map, now or when it is shown. @param chosen the one that the panel speaks of */
  attach(layers: readonly PointCloudLayer[], chosen: PointCloudLayer | undefined): void {
    [this.#layers, this.#chosen] = [layers, chosen];
    if (this.#choice.value !== "globe") void this.#attach();
  }

  async #attach(): Promise<void> {
    try {
      this.#view ??= this.#load();
      const view = await this.#view;
      await this.#follow();
      view.attach(this.#layers, this.#chosen);
    } catch (thrown) {
      this.#failed(thrown);
    }
  }

  /** What cannot be loaded is loaded anew when the map is next shown. */
  async #load(): Promise<MapView> {
    try {
      const { MapView } = await import("./map-view.js");
      const view = new MapView(byId("map", HTMLElement), this.#viewer, this.#failed);
      this.#begins(view);
      this.#shown = view;
      return view;
    } catch (thrown) {
      this.#view = undefined;
      throw thrown;
    }
  }

  /** Goes on with what hangs on the frames of the globe, while none is drawn. */
  #beat(): void {
    if (!this.alone) return;
    this.#shown?.follow();
    cancelAnimationFrame(this.#next);
    this.#next = requestAnimationFrame(() => this.#beat());
  }

  /** Links the map to the globe as the panel says. */
  async #follow(): Promise<void> {
    const view = await this.#view;
    const how = { northUp: !this.alone && this.#north.checked, marks: !this.alone };
    view?.link(this.linked ? how : undefined);
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
