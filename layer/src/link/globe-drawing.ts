import type { Vector } from "@groma/georef";
import { ScreenSpaceEventHandler, ScreenSpaceEventType } from "cesium";
import Feature from "ol/Feature.js";
import LineString from "ol/geom/LineString.js";
import Point from "ol/geom/Point.js";
import Polygon from "ol/geom/Polygon.js";
import type { GlobeSide } from "./globe-side.js";
import type { SharedFeatures } from "./shared-features.js";

/** What can be drawn on the globe. */
export type DrawnKind = "Point" | "LineString" | "Polygon";

/** Vertices that a kind needs before it can be ended, and at most. */
const COUNTS: Readonly<Record<DrawnKind, { readonly least: number; readonly most: number }>> = {
  Point: { least: 1, most: 1 },
  LineString: { least: 2, most: Number.POSITIVE_INFINITY },
  Polygon: { least: 3, most: Number.POSITIVE_INFINITY },
};

/** Where a feature is drawn, and who hears of it. */
interface DrawingParts {
  readonly globe: GlobeSide;
  readonly features: SharedFeatures;
  /** Called with what kept a record from being read. */
  readonly failed: (thrown: unknown) => void;
  /** Called once it is drawn or given up. */
  readonly ended: () => void;
}

/**
 * A feature that the reader draws by clicks on the globe; it is in the source from its first vertex on. A double click or Enter
 * ends it, Escape gives it up.
 */
export class GlobeDrawing {
  /** Undefined where the reader gives it up; rejects with the signal's reason. */
  readonly done: Promise<Feature | undefined>;
  readonly #parts: DrawingParts;
  readonly #kind: DrawnKind;
  readonly #feature = new Feature();
  /** ECEF, metres. */
  readonly #places: Vector[] = [];
  readonly #handler: ScreenSpaceEventHandler;
  readonly #over = new AbortController();
  #resolve!: (drawn: Feature | undefined) => void;
  /** Clicks keep their order, however long their records take. */
  #last: Promise<void> = Promise.resolve();

  constructor(parts: DrawingParts, kind: DrawnKind, signal: AbortSignal | undefined) {
    this.#parts = parts;
    this.#kind = kind;
    this.done = new Promise((resolve, reject) => {
      this.#resolve = resolve;
      const abandon = () => {
        reject(signal?.reason);
        this.giveUp();
      };
      signal?.addEventListener("abort", abandon, { signal: this.#over.signal });
    });
    this.#handler = new ScreenSpaceEventHandler(parts.globe.scene.canvas);
    this.#connect();
  }

  /** Takes it out of the source. */
  giveUp(): void {
    this.#end(undefined);
  }

  #connect(): void {
    this.#handler.setInputAction(({ position: { x, y } }: ScreenSpaceEventHandler.PositionedEvent) => {
      this.#last = this.#last
        .then(() => this.#place({ x, y }))
        .catch((thrown) => {
          if (!this.#over.signal.aborted) this.#parts.failed(thrown);
        });
    }, ScreenSpaceEventType.LEFT_CLICK);
    const finish = () => void this.#last.then(() => this.#finish());
    this.#handler.setInputAction(finish, ScreenSpaceEventType.LEFT_DOUBLE_CLICK);
    document.addEventListener(
      "keydown",
      ({ key }) => {
        if (key === "Enter") finish();
        else if (key === "Escape") this.giveUp();
      },
      { signal: this.#over.signal },
    );
  }

  async #place(at: { readonly x: number; readonly y: number }): Promise<void> {
    const { globe, features } = this.#parts;
    const { signal } = this.#over;
    const found = await globe.placeAt(at, signal);
    // The second click of a double click is on the record of the first.
    if (!found || signal.aborted || `${found}` === `${this.#places.at(-1)}`) return;
    this.#places.push(found);
    const coordinates = this.#places.flatMap((one) => [features.coordinateOf(this.#feature, one) ?? []]);
    this.#feature.setGeometry(geometryOf(this.#kind, coordinates));
    const { source } = features;
    if (!source.hasFeature(this.#feature)) source.addFeature(this.#feature);
    if (this.#places.length >= COUNTS[this.#kind].most) this.#finish();
  }

  #finish(): void {
    if (this.#places.length >= COUNTS[this.#kind].least) this.#end(this.#feature);
  }

  #end(drawn: Feature | undefined): void {
    if (this.#over.signal.aborted) return;
    const { features, ended } = this.#parts;
    ended();
    this.#handler.destroy();
    this.#over.abort();
    if (!drawn && features.source.hasFeature(this.#feature)) features.source.removeFeature(this.#feature);
    this.#resolve(drawn);
  }
}

function geometryOf(kind: DrawnKind, coordinates: number[][]): Point | LineString | Polygon {
  if (kind === "Point") return new Point(coordinates[0], "XYZ");
  if (kind === "LineString" || coordinates.length < 3) return new LineString(coordinates, "XYZ");
  return new Polygon([[...coordinates, coordinates[0]]], "XYZ");
}
