import type { PickResult, PointCloudLayer } from "@groma/layer/cesium";
import {
  Cartesian3,
  Color,
  type Entity,
  ScreenSpaceEventHandler,
  ScreenSpaceEventType,
  type Viewer,
} from "cesium";

/** The record of a point that was clicked. */
export type Hit = PickResult<PointCloudLayer>;

/** Pixels around the pointer in which a point counts as hit. */
const REACH = 7;

/** Finds the point under a click, and marks it in the scene. */
export class Picking {
  readonly #viewer: Viewer;
  readonly #layer: () => PointCloudLayer | undefined;
  readonly #found: (hit: Hit | undefined) => void;
  #picking: AbortController | undefined;
  #mark: Entity | undefined;
  #selected: { readonly node: string; readonly index: number } | undefined;

  /**
   * @param found hears of each point that was clicked, and of clicks beside all points
   * @param failed hears why a point's record could not be read
   */
  constructor(
    viewer: Viewer,
    layer: () => PointCloudLayer | undefined,
    found: (hit: Hit | undefined) => void,
    failed: (thrown: unknown) => void,
  ) {
    this.#viewer = viewer;
    this.#layer = layer;
    this.#found = found;
    let begun = false;
    // A tap that ends a figure is the figure's, though the click comes when nothing is drawn any more.
    const press = () => {
      begun = layer() !== undefined;
    };
    viewer.canvas.addEventListener("pointerdown", press, { capture: true });
    const handler = new ScreenSpaceEventHandler(viewer.canvas);
    handler.setInputAction(({ position }: ScreenSpaceEventHandler.PositionedEvent) => {
      if (begun) this.#pick(position).catch(failed);
    }, ScreenSpaceEventType.LEFT_CLICK);
  }

  /** The record that was found last. */
  get selected(): { readonly node: string; readonly index: number } | undefined {
    return this.#selected;
  }

  /** Shows a record as if it had been clicked. @throws FormatError FORMAT_NODE where there is no such record */
  async select({ node, index }: { readonly node: string; readonly index: number }): Promise<void> {
    const layer = this.#layer();
    if (!layer) return;
    const signal = this.#begin();
    const record = await layer.cloud.readPoint(node, { record: index }, { signal });
    const [x, y, z] = layer.cloud.place(...record.source);
    this.show({ ...record, layer, cloud: layer.cloud, position: new Cartesian3(x, y, z) });
  }

  /** Forgets the point that was found. */
  clear(): void {
    this.#picking?.abort();
    this.#selected = undefined;
    if (this.#mark) this.#viewer.entities.remove(this.#mark);
    this.#mark = undefined;
    this.#found(undefined);
  }

  async #pick(position: ScreenSpaceEventHandler.PositionedEvent["position"]): Promise<void> {
    const layer = this.#layer();
    if (!layer) return;
    const signal = this.#begin();
    let hit: Hit | undefined;
    try {
      hit = await layer.pick(position, { window: REACH, signal });
    } catch (thrown) {
      if (signal.aborted) return;
      throw thrown;
    }
    if (signal.aborted) return;
    this.show(hit);
  }

  /** One point is looked for at a time. */
  #begin(): AbortSignal {
    this.#picking?.abort();
    this.#picking = new AbortController();
    return this.#picking.signal;
  }

  /** Marks a point and tells of it; undefined: of none. */
  show(hit: Hit | undefined): void {
    this.clear();
    if (!hit) return;
    this.#selected = { node: hit.node, index: hit.index };
    this.#mark = this.#viewer.entities.add({
      position: hit.position,
      point: {
        pixelSize: 11,
        color: Color.TRANSPARENT,
        outlineColor: Color.fromCssColorString("#f2b84b"),
        outlineWidth: 2,
        disableDepthTestDistance: Number.POSITIVE_INFINITY,
      },
    });
    this.#found(hit);
  }
}
