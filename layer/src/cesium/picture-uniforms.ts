import { Cartesian3 } from "cesium";
import type { PickId, UniformMap } from "./engine/cesium-private.js";
import type { Picture } from "./offscreen-target.js";
import type { PointFrustum } from "./point-frustum.js";

/** Uniforms that the drawing side itself fills: the pick colour, and the picture that a quad reads. */
export class PictureUniforms {
  readonly map: UniformMap;
  readonly #depthRange = new Cartesian3();
  #picture: Picture | undefined;

  constructor(pickId: PickId) {
    this.map = {
      u_pickColor: () => pickId.color,
      u_color: () => this.#picture?.blended ?? this.#picture?.colour,
      u_depth: () => this.#picture?.depth,
      u_depthRange: () => this.#depthRange,
    };
  }

  /** Takes the picture of a frame and the frustum that its depths lie in. */
  take(picture: Picture, { frustum: { near, far }, orthographic }: PointFrustum): void {
    this.#picture = picture;
    const logarithm = orthographic ? 0 : Math.log2(far - near + 1);
    Cartesian3.fromElements(near, far - near, logarithm, this.#depthRange);
  }
}
