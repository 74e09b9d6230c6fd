import type { Clip, ClipMode, PointCloudLayer } from "@groma/layer/cesium";
import type { Profile } from "@groma/layer/tools";
import { byId } from "../panel/elements.js";

/** Shows the strip of a profile on globe and map: among all of the cloud, highlighted, or alone. */
export class CutClips {
  readonly #choice = byId("profile-cut", HTMLSelectElement);
  readonly #layer: () => PointCloudLayer | undefined;
  #profile: Profile | undefined;
  #shown: readonly Clip[] = [];

  constructor(layer: () => PointCloudLayer | undefined) {
    this.#layer = layer;
    this.#choice.addEventListener("change", () => this.show(this.#profile));
  }

  /** @param profile undefined: none, and so all of the cloud */
  show(profile: Profile | undefined): void {
    this.#profile = profile;
    const clips = this.#layer()?.clips;
    for (const clip of this.#shown) clips?.remove(clip);
    const mode = this.#choice.value as ClipMode | "";
    this.#shown = mode === "" || !profile ? [] : profile.clips(mode);
    for (const clip of this.#shown) clips?.add(clip);
  }
}
