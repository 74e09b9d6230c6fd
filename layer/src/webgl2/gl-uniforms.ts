import type { UniformNumbers, Uniforms } from "../drawing/gpu.js";
import type { GlTexture } from "./gl-types.js";

/** What a uniform is set to. */
export type GlValue = number | readonly number[] | GlTexture;

/** Values of uniforms by name, on top of others. */
export class GlUniforms implements Uniforms<GlTexture> {
  readonly #base: GlUniforms | undefined;
  readonly #values = new Map<string, GlValue>();

  constructor(base?: GlUniforms) {
    this.#base = base;
  }

  set(values: UniformNumbers): void {
    for (const [name, value] of Object.entries(values)) this.#values.set(name, value);
  }

  setTexture(name: string, texture: GlTexture): void {
    this.#values.set(name, texture);
  }

  /** The value that a program reads; undefined where nobody gave one. */
  get(name: string): GlValue | undefined {
    return this.#values.get(name) ?? this.#base?.get(name);
  }
}
