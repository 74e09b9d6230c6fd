import { Cartesian2, Cartesian3, Cartesian4, Matrix4 } from "cesium";
import type { UniformMap } from "./engine/cesium-private.js";

/** Values of uniforms as the effects give them; matrices are column-major. */
export type PlainValues = Readonly<Record<string, number | readonly number[]>>;

type EngineValue = number | Cartesian2 | Cartesian3 | Cartesian4 | Matrix4;

/** Uniforms of a layer or of a node: plain numbers in, what Cesium asks for out. */
export class UniformValues {
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
  set(values: PlainValues): void {
    for (const [name, value] of Object.entries(values)) {
      const there = this.#values.get(name);
      this.#values.set(name, typeof value === "number" ? value : engineValue(value, there));
      if (there === undefined) this.#map[name] = () => this.#values.get(name);
    }
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
