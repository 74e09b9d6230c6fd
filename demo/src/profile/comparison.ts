import { type Crs, samePlane } from "@groma/georef";
import type { PointCloud } from "@groma/layer/cesium";
import {
  areaBetween,
  Profile,
  type ProfileOptions,
  type ProfilePoints,
  type TerrainStation,
} from "@groma/layer/tools";
import { i18n } from "../language/i18n.js";
import { libraryWords } from "../language/library-words.js";
import { fixed } from "../language/numbers.js";
import { openCompared } from "../panel/compared.js";
import { byId, optionElement, setText } from "../panel/elements.js";

/** A second cloud along the same line, another survey of the place say: its points, and the areas between both grounds. */
export class Comparison {
  readonly #changed: () => void;
  readonly #words = byId("profile-compared", HTMLElement);
  readonly #end = byId("profile-alone", HTMLButtonElement);
  readonly #choice = byId("profile-with", HTMLSelectElement);
  #offered: readonly PointCloud[] = [];
  #cloud: PointCloud | undefined;
  #opening: AbortController | undefined;
  #parts: ProfilePoints[] = [];

  /**
   * @param changed hears that there is another cloud, or none any more
   * @param failed hears why a file could not be opened
   */
  constructor(changed: () => void, failed: (thrown: unknown) => void) {
    this.#changed = changed;
    const file = byId("profile-other", HTMLInputElement);
    file.addEventListener("change", () => {
      const [chosen] = file.files ?? [];
      file.value = "";
      if (chosen) this.#open(chosen).catch(failed);
    });
    this.#choice.addEventListener("change", () => this.#take(this.#offered[Number(this.#choice.value)]));
    this.#end.addEventListener("click", () => {
      this.clear();
      changed();
    });
  }

  get active(): boolean {
    return this.#cloud !== undefined;
  }

  /** Points of the second cloud, node by node. */
  get parts(): readonly ProfilePoints[] {
    return this.#parts;
  }

  /** Lets clouds of the scene be compared with; one of them that is gone is compared with no longer. */
  offer(clouds: readonly PointCloud[]): void {
    const lost = this.#cloud && this.#offered.includes(this.#cloud) && !clouds.includes(this.#cloud);
    this.#offered = clouds;
    const others = namesApart(clouds).map((label, at) => optionElement({ value: String(at), label }));
    this.#choice.replaceChildren(optionElement({ value: "", label: i18n.t("compare with…") }), ...others);
    this.#choice.hidden = clouds.length === 0;
    if (this.#cloud && !lost) this.#choice.value = String(clouds.indexOf(this.#cloud));
    if (!lost) return;
    this.clear();
    this.#changed();
  }

  /** Forgets the second cloud, and one that is being opened. */
  clear(): void {
    this.#opening?.abort();
    // One of the scene goes on there.
    if (this.#cloud && !this.#offered.includes(this.#cloud)) this.#cloud.destroy();
    this.#cloud = undefined;
    this.#choice.value = "";
    this.#parts = [];
    this.#end.hidden = true;
    setText(this.#words, "");
  }

  /** In which plane both clouds are cut: undefined, their own, where it is the same. */
  planeWith({ crs }: PointCloud): ProfileOptions["plane"] {
    return this.#cloud && !samePlane(this.#cloud.crs, crs) ? "ellipsoid" : undefined;
  }

  /** Reads the second cloud along a line. @throws as `Profile` and its points do */
  async read(
    options: ProfileOptions,
    add: (points: ProfilePoints, cloud: PointCloud) => void,
    signal: AbortSignal,
  ): Promise<void> {
    this.#parts = [];
    if (!this.#cloud) return;
    setText(this.#words, i18n.t("reading {name}…", { name: this.#cloud.name }));
    for await (const points of new Profile(this.#cloud, options).points({ signal })) {
      this.#parts.push(points);
      add(points, this.#cloud);
    }
  }

  /** Tells the areas between the ground of the first cloud and that of the second, stations alike. */
  tell(first: readonly TerrainStation[], second: readonly TerrainStation[], { crs }: PointCloud): void {
    if (!this.#cloud || second.length === 0) return;
    const { above, below, length } = areaBetween(first, second);
    const { name, crs: other } = this.#cloud;
    const areas = i18n.t("{name}: {above} m² above the first ground, {below} m² below it, over {length} m", {
      name,
      above: fixed(above, 2),
      below: fixed(below, 2),
      length: fixed(length, 1),
    });
    const mean =
      length > 0 ? [i18n.t("{metres} m in the mean", { metres: fixed((above - below) / length, 3) })] : [];
    setText(this.#words, [[areas, ...mean].join(", "), ...referencesOf(crs, other)].join("; "));
  }

  async #open(file: File): Promise<void> {
    this.#opening?.abort();
    const opening = new AbortController();
    this.#opening = opening;
    const before = this.#words.textContent;
    try {
      const cloud = await openCompared(file, (text) => setText(this.#words, text), opening.signal);
      this.#opening = undefined;
      this.#take(cloud);
    } catch (thrown) {
      if (opening.signal.aborted) return;
      setText(this.#words, before);
      throw thrown;
    }
  }

  #take(cloud: PointCloud | undefined): void {
    this.clear();
    this.#cloud = cloud;
    this.#end.hidden = cloud === undefined;
    if (cloud && this.#offered.includes(cloud)) this.#choice.value = String(this.#offered.indexOf(cloud));
    this.#changed();
  }
}

/** What the heights of two clouds are measured from, where that is not the same. */
function referencesOf(...systems: Pick<Crs, "height">[]): string[] {
  const [first, second] = systems.map(({ height }) => (height.kind === "geoid" ? height.model : height.kind));
  if (first === undefined || second === undefined || (first === second && first !== "unknown")) return [];
  return [
    i18n.t("heights: {first} against {second}", {
      first: libraryWords(first),
      second: libraryWords(second),
    }),
  ];
}

/** Names of clouds; those of one name have a number behind it, by which a reader tells them apart. */
function namesApart(clouds: readonly PointCloud[]): string[] {
  return clouds.map(({ name }, at) => {
    const namesakes = clouds.filter((other) => other.name === name);
    return namesakes.length > 1 ? `${name} (${namesakes.indexOf(clouds[at]!) + 1})` : name;
  });
}
