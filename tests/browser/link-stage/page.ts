import {
  Clip,
  measureView as measureGlobe,
  PointCloud,
  PointCloudLayer,
  SharedBudget,
} from "@groma/layer/cesium";
import { type Link, synchronize } from "@groma/layer/link";
import {
  PointCloudLayer as MapLayer,
  measureView as measureMap,
  PointCloudSource,
} from "@groma/layer/openlayers";
import { MeasureTool } from "@groma/layer/tools";
import * as Cesium from "cesium";
import type VectorSource from "ol/source/Vector.js";
import { MapStage, type StageView } from "../map-stage/map-stage.js";
import * as ol from "../map-stage/ol.js";
import type { StageOptions } from "../stage/setting.js";
import { Stage } from "../stage/stage.js";

/** A globe of 400 × 300 pixels and maps of 600 × 400 that show one scan; frames of the globe are drawn when told. */
class LinkStage {
  readonly globe: Stage;
  readonly cloud: PointCloud;
  readonly maps: MapStage[] = [];
  #next: number | undefined;

  constructor(cloud: PointCloud, options: StageOptions = {}) {
    this.cloud = cloud;
    this.globe = new Stage({ width: 400, height: 300, ...options });
    this.globe.layer = PointCloudLayer.fromCloud(cloud, { style: { pointSize: 3 } });
    this.globe.scene.primitives.add(this.globe.layer);
  }

  addMap(view: StageView): MapStage {
    const options = { layer: { style: { pointSize: 3 } }, source: { cloud: this.cloud } };
    const stage = new MapStage({ view, ...options });
    this.maps.push(stage);
    return stage;
  }

  /** Has the globe draw all frames of the page until it is to {@link halt}. */
  run(): void {
    const frame = () => {
      this.globe.frame();
      this.#next = requestAnimationFrame(frame);
    };
    this.halt();
    frame();
  }

  halt(): void {
    if (this.#next !== undefined) cancelAnimationFrame(this.#next);
    this.#next = undefined;
  }

  /** Resolves after the next frames of the page. */
  async frames(count = 2): Promise<void> {
    for (let frame = 0; frame < count; frame++) await new Promise(requestAnimationFrame);
  }

  destroy(): void {
    this.halt();
    for (const map of this.maps) map.destroy();
    this.globe.destroy();
  }
}

/** Counts the listeners of elements that are added from now on and not taken away. */
function countListeners(): { readonly count: () => number; readonly end: () => void } {
  const { addEventListener, removeEventListener } = EventTarget.prototype;
  const live = new Map<EventTarget, Set<string>>();
  const numbers = new Map<unknown, number>();
  const keyOf = (type: string, listener: unknown) => {
    numbers.set(listener, numbers.get(listener) ?? numbers.size);
    return `${type} ${numbers.get(listener)}`;
  };
  EventTarget.prototype.addEventListener = function (type, listener, options) {
    addEventListener.call(this, type, listener, options);
    const { signal, once = false } = typeof options === "object" ? options : {};
    if (once || signal?.aborted || this instanceof AbortSignal) return;
    const key = keyOf(type, listener);
    live.set(this, (live.get(this) ?? new Set()).add(key));
    if (signal) addEventListener.call(signal, "abort", () => live.get(this)?.delete(key));
  };
  EventTarget.prototype.removeEventListener = function (type, listener, options) {
    removeEventListener.call(this, type, listener, options);
    live.get(this)?.delete(keyOf(type, listener));
  };
  return {
    count: () => [...live.values()].reduce((sum, { size }) => sum + size, 0),
    end: () => Object.assign(EventTarget.prototype, { addEventListener, removeEventListener }),
  };
}

declare global {
  interface Window {
    /** What tests of the link work with in the page. */
    linked: {
      readonly Cesium: typeof Cesium;
      readonly ol: typeof ol;
      readonly synchronize: typeof synchronize;
      readonly PointCloud: typeof PointCloud;
      readonly MapLayer: typeof MapLayer;
      readonly PointCloudSource: typeof PointCloudSource;
      readonly Clip: typeof Clip;
      readonly SharedBudget: typeof SharedBudget;
      readonly LinkStage: typeof LinkStage;
      readonly Stage: typeof Stage;
      readonly countListeners: typeof countListeners;
      readonly MeasureTool: typeof MeasureTool;
      readonly measureGlobe: typeof measureGlobe;
      readonly measureMap: typeof measureMap;
      /** What stands, if anything. */
      stage: LinkStage;
      link: Link;
      /** Features that both sides share, one that is being drawn, and what draws it. */
      features: VectorSource;
      sketch: InstanceType<typeof ol.Feature> | undefined;
      draw: InstanceType<typeof ol.Draw> | undefined;
    };
  }
}

window.linked = {
  ...{
    Cesium,
    ol,
    synchronize,
    PointCloud,
    MapLayer,
    PointCloudSource,
    Clip,
    SharedBudget,
    LinkStage,
    Stage,
    countListeners,
    MeasureTool,
    measureGlobe,
    measureMap,
  },
  stage: undefined as unknown as LinkStage,
} as Window["linked"];
document.body.dataset.ready = "true";
