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
  readonly #layers: () => readonly PointCloudLayer[];
  readonly #told: (hit: Hit | undefined) => void;
  #picking: AbortController | undefined;
  #mark: Entity | undefined;
  #found: Hit | undefined;

  /**
   * @param layers those whose points are found
   * @param found hears of each point that was clicked, and of clicks beside all points
   * @param failed hears why a point's record could not be read
   */
  constructor(
    viewer: Viewer,
    layers: () => readonly PointCloudLayer[],
    found: (hit: Hit | undefined) => void,
    failed: (thrown: unknown) => void,
  ) {
    this.#viewer = viewer;
    this.#layers = layers;
    this.#told = found;
    let begun = false;
    // A tap that ends a figure is the figure's, though the click comes when nothing is drawn any more.
    const press = () => {
      begun = layers().length > 0;
    };
    viewer.canvas.addEventListener("pointerdown", press, { capture: true });
    const handler = new ScreenSpaceEventHandler(viewer.canvas);
    handler.setInputAction(({ position }: ScreenSpaceEventHandler.PositionedEvent) => {
      if (begun) this.#pick(position).catch(failed);
    }, ScreenSpaceEventType.LEFT_CLICK);
  }

  /** The record that was found last. */
  get hit(): Hit | undefined {
    return this.#found;
  }

  /** Shows a record of a layer as if it had been clicked. @throws FormatError FORMAT_NODE where there is no such record */
  async select(
    layer: PointCloudLayer,
    { node, index }: { readonly node: string; readonly index: number },
  ): Promise<void> {
    const signal = this.#begin();
    const { cloud } = layer;
    const record = await cloud.readPoint(node, { record: index }, { signal });
    const [x, y, z] = cloud.place(...record.source);
    this.show({ ...record, layer, cloud, position: new Cartesian3(x, y, z) });
  }

  /** Forgets the point that was found. */
  clear(): void {
    this.#picking?.abort();
    this.#found = undefined;
    if (this.#mark) this.#viewer.entities.remove(this.#mark);
    this.#mark = undefined;
    this.#viewer.scene.requestRender();
    this.#told(undefined);
  }

  async #pick(position: ScreenSpaceEventHandler.PositionedEvent["position"]): Promise<void> {
    const signal = this.#begin();
    let hits: (Hit | undefined)[];
    try {
      hits = await Promise.all(
        this.#layers().map((layer) => layer.pick(position, { window: REACH, signal })),
      );
    } catch (thrown) {
      if (signal.aborted) return;
      throw thrown;
    }
    if (signal.aborted) return;
    const eye = this.#viewer.scene.camera.positionWC;
    const away = (hit: Hit) => Cartesian3.distance(eye, hit.position);
    const [nearest] = hits.filter((hit) => hit !== undefined).sort((a, b) => away(a) - away(b));
    this.show(nearest);
  }

  /** One point is looked for at a time. */
  #begin(): AbortSignal {
    this.#picking?.abort();
    this.#picking = new AbortController();
    return this.#picking.signal;
  }

  /** Marks a point and tells of it; undefined: of none. A scene that draws on demand sees no entity come or go. */
  show(hit: Hit | undefined): void {
    this.clear();
    if (!hit) return;
    this.#found = hit;
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
    this.#told(hit);
  }
}
