import { Cartesian2, DepthFunction } from "cesium";
import {
  type Context,
  type PickId,
  RenderState,
  ShaderProgram,
  ShaderSource,
  type UniformMap,
} from "./cesium-private.js";
import type { DrawShared } from "./node-drawable.js";
import { ATTRIBUTE_LOCATIONS, FRAGMENT_SHADER, vertexShader } from "./shaders.js";
import type { ColourBy, PointCloudStyle } from "./style.js";

/** What the uniforms are read from at each draw. */
export interface UniformSource {
  readonly style: PointCloudStyle;
  /** Least and greatest intensity as recorded, 0 to 65535. */
  readonly intensityRange: readonly [number, number];
}

/** What a layer holds in one WebGL context besides its nodes: programs, render state, pick colour. */
export class LayerResources {
  readonly #context: Context;
  readonly #owner: object;
  readonly #programs = new Map<ColourBy, ShaderProgram>();
  readonly #pickId: PickId;
  readonly #renderState: RenderState;
  readonly #uniformMap: UniformMap;

  /**
   * @param owner the primitive
   * @param picked what `scene.pick` returns
   */
  constructor(context: Context, owner: object, picked: object, source: UniformSource) {
    this.#context = context;
    this.#owner = owner;
    this.#pickId = context.createPickId(picked);
    this.#renderState = RenderState.fromCache({
      depthTest: { enabled: true, func: DepthFunction.LESS_OR_EQUAL },
    });
    const intensity = new Cartesian2();
    this.#uniformMap = {
      u_pointSize: () => source.style.pointSize,
      u_pickColor: () => this.#pickId.color,
      u_intensityRange: () => {
        const [least, greatest] = source.intensityRange;
        return Cartesian2.fromElements(least / 65535, greatest / 65535, intensity);
      },
    };
  }

  /** Program of a colouring, compiled when first asked for. */
  program(colourBy: ColourBy): ShaderProgram {
    let program = this.#programs.get(colourBy);
    if (!program) {
      program = ShaderProgram.fromCache({
        context: this.#context,
        vertexShaderSource: new ShaderSource({ sources: [vertexShader(colourBy)] }),
        fragmentShaderSource: new ShaderSource({ sources: [FRAGMENT_SHADER] }),
        attributeLocations: ATTRIBUTE_LOCATIONS,
      });
      this.#programs.set(colourBy, program);
    }
    return program;
  }

  shared(colourBy: ColourBy): DrawShared {
    return {
      owner: this.#owner,
      shaderProgram: this.program(colourBy),
      renderState: this.#renderState,
      uniformMap: this.#uniformMap,
    };
  }

  destroy(): void {
    for (const program of this.#programs.values()) program.destroy();
    this.#programs.clear();
    RenderState.removeFromCache(this.#renderState);
    this.#pickId.destroy();
  }
}
