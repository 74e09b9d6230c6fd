import { Cartesian2, Cartesian3, Cartesian4, Matrix4 } from "cesium";
import type { UniformNumbers, Uniforms } from "../../drawing/gpu.js";
import type { Texture, UniformMap } from "./cesium-private.js";

type EngineValue = number | Cartesian2 | Cartesian3 | Cartesian4 | Matrix4 | Texture;

/** Uniforms of a layer or of a node: plain numbers in, what Cesium asks for out. */
export class UniformValues implements Uniforms<Texture> {
  /** Functions by name, for commands; grows with the names that are set. */
  readonly map: UniformMap;
  readonly #map: Record<string, () => unknown>;
  readonly #values = new Map<string, EngineValue>();

  /** @param base uniforms besides */
  constructor(base: UniformMap) {
    this.#map = Object.create(base);
    this.map = this.#map;
  }

  /** Takes new values; those not named stay. */
  set(values: UniformNumbers): void {
    for (const [name, value] of Object.entries(values)) {
      const there = this.#values.get(name);
      this.#put(name, typeof value === "number" ? value : engineValue(value, there));
    }
  }

  setTexture(name: string, texture: Texture): void {
    this.#put(name, texture);
  }

  #put(name: string, value: EngineValue): void {
    if (!this.#values.has(name)) this.#map[name] = () => this.#values.get(name);
    this.#values.set(name, value);
  }
}

/** Written over the value that is there, where there is one: uniforms are set at each frame. */
function engineValue(numbers: readonly number[], reused: EngineValue | undefined): EngineValue {
  switch (numbers.length) {
    case 2:
      return Cartesian2.fromArray([...numbers], 0, reused instanceof Cartesian2 ? reused : undefined);
    case 3:
      return Cartesian3.fromArray([...numbers], 0, reused instanceof Cartesian3 ? reused : undefined);
    case 4:
      return Cartesian4.fromArray([...numbers], 0, reused instanceof Cartesian4 ? reused : undefined);
    default:
      return Matrix4.fromArray([...numbers], 0, reused instanceof Matrix4 ? reused : undefined);
  }
}
