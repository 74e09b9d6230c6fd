import { type Kind, SHARED, shared } from "../options/index.js";
import type { Clip } from "./clip.js";
import { type ClipVolume, ClipVolumes } from "./clip-volumes.js";
import { checkClip, compileClip } from "./compile-clip.js";
import { finish, type Steps } from "./steps.js";
import type { SourceSpace, Volume } from "./volume.js";

/** Name of the class, and version of what is internal here (see {@link SHARED}). */
const MARK = "ClipSet 1";

/** The volumes of a scene; layers may share one. */
export class ClipSet {
  /** @internal */
  readonly [SHARED] = MARK;
  readonly #clips: Clip[] = [];
  readonly #listeners = new Set<() => void>();
  readonly #compiled = new WeakMap<SourceSpace, WeakMap<Clip, Volume>>();
  #volumes = new WeakMap<SourceSpace, ClipVolumes>();
  #revision = 0;

  /** @throws StyleError STYLE_CLIP */
  constructor(clips: Iterable<Clip> = []) {
    for (const clip of clips) this.add(clip);
  }

  [Symbol.iterator](): Iterator<Clip> {
    return this.#clips.values();
  }

  get size(): number {
    return this.#clips.length;
  }

  /** Grows with each change. */
  get revision(): number {
    return this.#revision;
  }

  /** Number of volumes that cut: that keep their inside, or leave it out. */
  get cutting(): number {
    return this.#clips.filter(({ mode }) => mode !== "highlight").length;
  }

  /** Number of volumes that highlight. */
  get highlighting(): number {
    return this.#clips.length - this.cutting;
  }

  /**
   * Adds a volume and returns it, to be removed by.
   * @throws StyleError STYLE_CLIP
   */
  add<T extends Clip>(clip: T): T {
    checkClip(clip);
    this.#clips.push(clip);
    this.#changed();
    return clip;
  }

  /** Removes a volume that was added; false where it is not here. */
  remove(clip: Clip): boolean {
    const at = this.#clips.indexOf(clip);
    if (at < 0) return false;
    this.#clips.splice(at, 1);
    this.#changed();
    return true;
  }

  /** Puts a volume in another's place: for one that is being dragged. @throws StyleError STYLE_CLIP */
  replace<T extends Clip>(old: Clip, clip: T): T {
    const at = this.#clips.indexOf(old);
    if (at < 0) return this.add(clip);
    checkClip(clip);
    this.#clips[at] = clip;
    this.#changed();
    return clip;
  }

  clear(): void {
    if (this.#clips.length === 0) return;
    this.#clips.length = 0;
    this.#changed();
  }

  /** Calls a function after each change; what is returned stops that. */
  onChange(listener: () => void): () => void {
    this.#listeners.add(listener);
    return () => void this.#listeners.delete(listener);
  }

  /**
   * The volumes over a data set (a `PointCloud`), compiled when first asked for after a change.
   * @internal
   * @throws StyleError STYLE_CLIP; PlacementError where a volume in source coordinates has no place there
   */
  over(space: SourceSpace): ClipVolumes {
    return finish(this.overInSteps(space));
  }

  /**
   * The same in steps, of the volumes as they are now; each is compiled once for a data set. The steps throw what
   * {@link over} does.
   * @internal
   */
  overInSteps(space: SourceSpace): Steps<ClipVolumes> {
    return this.#compile([...this.#clips], this.#revision, space);
  }

  *#compile(clips: readonly Clip[], revision: number, space: SourceSpace): Steps<ClipVolumes> {
    const known = this.#volumes.get(space);
    if (known && revision === this.#revision) return known;
    const compiled = this.#compiled.get(space) ?? new WeakMap<Clip, Volume>();
    this.#compiled.set(space, compiled);
    const volumes: ClipVolume[] = [];
    for (const clip of clips) {
      const volume = compiled.get(clip) ?? (yield* compileClip(clip, space));
      compiled.set(clip, volume);
      volumes.push({ mode: clip.mode, volume });
    }
    const all = new ClipVolumes(volumes);
    if (revision === this.#revision) this.#volumes.set(space, all);
    return all;
  }

  #changed(): void {
    this.#revision++;
    this.#volumes = new WeakMap();
    for (const listener of this.#listeners) listener();
  }
}

/** What an option of volumes may be. */
export const CLIPS_OPTION: Kind<ClipSet> = shared(MARK);
