import { ecefToGeodetic } from "@groma/georef";
import { type BoxClip, Clip, type ClipPlace, ClipSet, type PointCloudLayer } from "@groma/layer/cesium";

/** What the box does to the points in it; `off`: there is none. */
export type ClipWish = "off" | Clip["mode"];

/** Least and greatest edge of the box, metres. */
export const CLIP_EDGES = [1, 10_000] as const;

/** One box that cuts the cloud: round the point that was picked last, else round the cloud's middle. */
export class ClipBox {
  readonly #clips = new ClipSet();
  #wish: ClipWish = "off";
  #edge = 0;
  #middle: ClipPlace | undefined;
  /** The box as it stands among the volumes. */
  #own: Clip | undefined;

  /** What the layers of the page are to be cut by. */
  get clips(): ClipSet {
    return this.#clips;
  }

  get wish(): ClipWish {
    return this.#wish;
  }

  set wish(wish: ClipWish) {
    this.#wish = wish;
    this.#write();
  }

  /** Edge on the ground, metres. */
  get edge(): number {
    return this.#edge;
  }

  set edge(metres: number) {
    this.#edge = metres;
    this.#write();
  }

  /** Begins anew with another cloud. */
  attach({ cloud: { bounds } }: PointCloudLayer): void {
    this.#edge = Math.max(CLIP_EDGES[0], Math.min(CLIP_EDGES[1], Math.round(bounds.radius / 4)));
    this.moveTo(bounds);
  }

  /** Puts the box around a place. @param position ECEF, metres */
  moveTo({ x, y, z }: { readonly x: number; readonly y: number; readonly z: number }): void {
    const geodetic = new Float64Array(3);
    ecefToGeodetic(x, y, z, geodetic);
    const [longitude, latitude, height] = geodetic;
    this.#middle = { longitude: longitude!, latitude: latitude!, height: height! };
    this.#write();
  }

  /** Takes volumes over: one upright cube as the box of the page, others as they are. */
  take(clips: readonly Clip[]): void {
    const [first] = clips;
    this.#clips.clear();
    if (clips.length === 1 && first?.kind === "box" && isCube(first) && "longitude" in first.center) {
      this.#middle = first.center;
      this.#edge = first.size[0];
      this.wish = first.mode;
      return;
    }
    this.wish = "off";
    for (const clip of clips) this.#clips.add(clip);
  }

  #write(): void {
    if (this.#own) this.#clips.remove(this.#own);
    this.#own = undefined;
    if (this.#wish === "off" || !this.#middle) return;
    const edge = this.#edge;
    this.#own = this.#clips.add(
      Clip.box({ center: this.#middle, size: [edge, edge, edge], mode: this.#wish }),
    );
  }
}

function isCube({ size: [width, depth, height], heading, pitch, roll }: BoxClip): boolean {
  return width === depth && depth === height && heading === 0 && pitch === 0 && roll === 0;
}
