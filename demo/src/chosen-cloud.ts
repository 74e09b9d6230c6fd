import type { PointCloudLayer } from "@groma/layer/cesium";
import type { OpenCloud } from "./clouds/clouds.js";
import { clearTitle, showFacts } from "./panel/facts.js";
import type { Heights } from "./panel/heights.js";
import { madeOctree } from "./panel/made-octree.js";
import type { Progress } from "./panel/progress.js";
import type { ProfilePanel } from "./profile/profile-panel.js";

/** A part of the page that is told the chosen cloud's layer alone. */
interface LayerPart {
  attach(layer: PointCloudLayer): void;
}

/** What speaks of the chosen cloud. */
export interface ChosenParts {
  readonly heights: Heights;
  readonly profile: ProfilePanel;
  readonly progress: Progress;
  readonly others: readonly LayerPart[];
  /** Hears what kept an octree that the page made from being saved. */
  readonly failed: (thrown: unknown) => void;
}

/** The cloud that the page speaks of. */
export class ChosenCloud {
  readonly #parts: ChosenParts;
  #layer: PointCloudLayer | undefined;

  constructor(parts: ChosenParts) {
    this.#parts = parts;
  }

  /** The layer that the page was told last. */
  get layer(): PointCloudLayer | undefined {
    return this.#layer;
  }

  /** Has the page speak of this one from now on; undefined: there is none any more. */
  show(chosen: OpenCloud | undefined): void {
    this.#layer = chosen?.layer;
    document.body.classList.toggle("has-cloud", chosen !== undefined);
    if (chosen) this.#attach(chosen);
    else this.#leave();
  }

  #attach({ layer, how, crs, indexed }: OpenCloud): void {
    const { heights, profile, others, failed } = this.#parts;
    const octree = indexed && madeOctree(indexed, failed);
    showFacts(layer, { given: crs !== undefined, octree });
    heights.attach(layer.cloud, how.vertical);
    for (const part of others) part.attach(layer);
    profile.open(layer);
  }

  #leave(): void {
    clearTitle();
    this.#parts.profile.leave();
    this.#parts.progress.rest();
  }
}
