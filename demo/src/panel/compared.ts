import { PointCloud } from "@groma/layer/cesium";
import { openOrIndex, openPlaced } from "../clouds/open-layer.js";
import { i18n } from "../language/i18n.js";
import { givenCrs } from "./chooser.js";
import { byId, setText } from "./elements.js";
import { indexingWords } from "./progress.js";

/** Scans that volumes are measured against: opened beside the one that is shown, and not drawn. */
export class Compared {
  readonly #clouds = new Map<string, PointCloud>();
  readonly #changed: () => void;
  readonly #failed: (thrown: unknown) => void;
  readonly #note = byId("compare-note", HTMLParagraphElement);
  /** One is opened at a time: another one gives it up. */
  #opening: AbortController | undefined;

  /**
   * @param address of what the reader typed; throws where that is none
   * @param changed told when there is a further one
   * @param failed told of what cannot be opened
   */
  constructor(address: (text: string) => string, changed: () => void, failed: (thrown: unknown) => void) {
    this.#changed = changed;
    this.#failed = failed;
    const file = byId("compare-file", HTMLInputElement);
    file.addEventListener("change", () => {
      const [chosen] = file.files ?? [];
      file.value = "";
      if (chosen) void this.#open(() => chosen);
    });
    byId("compare", HTMLFormElement).addEventListener("submit", (event) => {
      event.preventDefault();
      const { value } = byId("compare-address", HTMLInputElement);
      void this.#open(() => address(value));
    });
  }

  /** Those that are open, by what their points are: two scans of one name are two. */
  get clouds(): readonly PointCloud[] {
    return [...this.#clouds.values()];
  }

  async #open(from: () => string | File): Promise<void> {
    this.#opening?.abort();
    this.#opening = new AbortController();
    const { signal } = this.#opening;
    setText(this.#note, i18n.t("Opening…"));
    try {
      const cloud = await openCompared(from(), (text) => setText(this.#note, text), signal);
      this.#clouds.get(cloud.identity)?.destroy();
      this.#clouds.set(cloud.identity, cloud);
      setText(
        this.#note,
        i18n.t("{name} is open: choose it where a volume says what it is measured against.", {
          name: cloud.name,
        }),
      );
      this.#changed();
    } catch (thrown) {
      if (signal.aborted) return;
      setText(this.#note, "");
      this.#failed(thrown);
    }
  }
}

/**
 * Opens a scan that another one is compared with, and that is not drawn. One without an octree is indexed first; one without
 * a coordinate system has the one that the reader gave.
 * @param told hears what is done meanwhile, in words
 * @throws GromaError where it cannot be opened; the signal's reason
 */
export function openCompared(
  from: string | File,
  told: (text: string) => void,
  signal: AbortSignal,
): Promise<PointCloud> {
  const name = typeof from === "string" ? from : from.name;
  const open = (one: string | File) =>
    openPlaced((crs) => PointCloud.fromUrl(one, { signal, crs }), givenCrs());
  return openOrIndex(from, open, {
    onIndexing: ({ stage }) => signal.aborted || told(indexingWords(name, stage)),
    onIndexed: () => undefined,
    signal,
  });
}
