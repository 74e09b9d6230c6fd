import { ecefToGeodetic } from "@groma/georef";
import type { PointCloudLayer } from "@groma/layer/cesium";
import {
  ArcType,
  CallbackProperty,
  Cartesian3,
  Color,
  type Entity,
  ScreenSpaceEventHandler,
  ScreenSpaceEventType,
  type Viewer,
} from "cesium";

/** Pixels around the pointer in which a point counts as hit. */
const REACH = 9;

/** What the line and its vertices are drawn in. */
const COLOUR = Color.fromCssColorString("#f2b84b");

/** A line on the globe: longitude and latitude of each vertex, radians. */
export type DrawnLine = readonly (readonly [number, number])[];

/** Takes the vertices of a line by clicks on points of the cloud, and shows the line. */
export class DrawLine {
  readonly #viewer: Viewer;
  readonly #layer: () => PointCloudLayer | undefined;
  readonly #changed: (line: DrawnLine) => void;
  readonly #places: Cartesian3[] = [];
  /** The vertices in the scene, seen through whatever stands before them. */
  readonly #marks: Entity[] = [];
  #entity: Entity | undefined;
  #handler: ScreenSpaceEventHandler | undefined;

  /** @param changed hears of each vertex */
  constructor(viewer: Viewer, layer: () => PointCloudLayer | undefined, changed: (line: DrawnLine) => void) {
    this.#viewer = viewer;
    this.#layer = layer;
    this.#changed = changed;
  }

  /** Whether clicks are vertices now. */
  get active(): boolean {
    return this.#handler !== undefined;
  }

  get line(): DrawnLine {
    const geodetic = new Float64Array(3);
    return this.#places.map(({ x, y, z }) => {
      ecefToGeodetic(x, y, z, geodetic);
      return [geodetic[0]!, geodetic[1]!];
    });
  }

  /** Begins a line anew. @param failed hears why a point could not be read */
  begin(failed: (thrown: unknown) => void): void {
    this.clear();
    const handler = new ScreenSpaceEventHandler(this.#viewer.canvas);
    this.#handler = handler;
    handler.setInputAction(({ position }: ScreenSpaceEventHandler.PositionedEvent) => {
      this.#add(position).catch(failed);
    }, ScreenSpaceEventType.LEFT_CLICK);
    this.#entity = this.#viewer.entities.add({
      polyline: {
        // Asked for with each frame: a line that is built anew in a worker would come seconds later.
        positions: new CallbackProperty(() => [...this.#places], false),
        arcType: ArcType.NONE,
        width: 3,
        material: COLOUR,
      },
    });
  }

  /** Clicks are no longer vertices; the line stays. */
  end(): void {
    this.#handler?.destroy();
    this.#handler = undefined;
  }

  clear(): void {
    this.end();
    if (this.#entity) this.#viewer.entities.remove(this.#entity);
    this.#entity = undefined;
    for (const mark of this.#marks.splice(0)) this.#viewer.entities.remove(mark);
    this.#places.length = 0;
  }

  async #add(position: ScreenSpaceEventHandler.PositionedEvent["position"]): Promise<void> {
    const hit = await this.#layer()?.pick(position, { window: REACH });
    if (!hit || !this.active) return;
    const { x, y, z } = hit.position;
    this.#places.push(new Cartesian3(x, y, z));
    this.#marks.push(
      this.#viewer.entities.add({
        position: new Cartesian3(x, y, z),
        point: {
          pixelSize: 9,
          color: COLOUR,
          outlineColor: Color.BLACK,
          outlineWidth: 1,
          disableDepthTestDistance: Number.POSITIVE_INFINITY,
        },
      }),
    );
    this.#viewer.scene.requestRender();
    this.#changed(this.line);
  }
}
