import { CrsError } from "@groma/georef";
import {
  PointCloudLayer,
  type PointCloudLayerOptions,
  type PointCloudOptions,
  type ServerWait,
} from "@groma/layer/cesium";
import type { PrimitiveCollection } from "cesium";

/** How a cloud is opened and drawn. */
export interface OpenOptions
  extends PointCloudLayerOptions,
    Pick<PointCloudOptions, "crs" | "vertical" | "transformation"> {
  /** Coordinate system for a cloud that names none. Never used in place of one that the file names. */
  readonly crsIfMissing?: string | undefined;
}

/** The one cloud of a scene. Opening another one replaces it, but only once the other one could be opened. */
export class CloudSlot {
  readonly #primitives: PrimitiveCollection;
  #opening: AbortController | undefined;
  #layer: PointCloudLayer | undefined;

  constructor(primitives: PrimitiveCollection) {
    this.#primitives = primitives;
  }

  /** The cloud in the scene. */
  get layer(): PointCloudLayer | undefined {
    return this.#layer;
  }

  /**
   * Opens a cloud in place of the one that is there; what was being opened before is given up.
   * @param waits told while its server is waited for, as long as this call goes on
   * @returns undefined where another call of `open` came before this one was done
   * @throws GromaError where it cannot be opened; the cloud that is there stays
   */
  async open(
    from: string | File,
    options: OpenOptions,
    waits: (wait: ServerWait | undefined) => void,
  ): Promise<PointCloudLayer | undefined> {
    this.#opening?.abort();
    const opening = new AbortController();
    this.#opening = opening;
    let layer: PointCloudLayer;
    let opened = false;
    try {
      const onWait = (wait: ServerWait | undefined) => {
        if (this.#opening === opening && !opened) waits(wait);
      };
      layer = await fromUrl(from, { ...options, onWait }, opening.signal);
      opened = true;
    } catch (thrown) {
      if (opening.signal.aborted) return undefined;
      throw thrown;
    }
    if (opening.signal.aborted) {
      layer.destroy();
      return undefined;
    }
    if (this.#layer) this.#primitives.remove(this.#layer);
    this.#layer = layer;
    this.#primitives.add(layer);
    return layer;
  }
}

async function fromUrl(
  from: string | File,
  { crsIfMissing, ...options }: OpenOptions & Pick<PointCloudOptions, "onWait">,
  signal: AbortSignal,
): Promise<PointCloudLayer> {
  try {
    return await PointCloudLayer.fromUrl(from, { ...options, signal });
  } catch (thrown) {
    const missing = thrown instanceof CrsError && thrown.code === "CRS_MISSING";
    if (!missing || !crsIfMissing) throw thrown;
    return await PointCloudLayer.fromUrl(from, { ...options, crs: crsIfMissing, signal });
  }
}
