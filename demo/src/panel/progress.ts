import type { PointCloudLayer, ServerWait, StreamProgress } from "@groma/layer/cesium";
import type { IndexProgress } from "../indexing/index-file.js";
import { i18n } from "../language/i18n.js";
import { byId, setText } from "./elements.js";
import { againWords, outageWords } from "./wait-words.js";
import { countWords } from "./words.js";

/** Milliseconds between two looks at what is drawn: what has come is drawn some frames later. */
const INTERVAL = 250;

/** What a view draws, and wants to. */
type Drawn = Pick<
  PointCloudLayer["statistics"],
  "nodesVisible" | "nodesLoaded" | "nodesFailed" | "pointsDrawn" | "budgetReached"
>;

/** How far the loading of the current view is. */
export class Progress {
  readonly #place = byId("progress", HTMLDivElement);
  readonly #stage = byId("stage", HTMLParagraphElement);
  readonly #bar = byId("bar", HTMLProgressElement);
  readonly #count = byId("count", HTMLParagraphElement);
  readonly #instead: () => Drawn | undefined;
  #unfollow: (() => void) | undefined;

  /** @param instead what a view draws that stands in the place of the globe, if one does */
  constructor(instead: () => Drawn | undefined) {
    this.#instead = instead;
  }

  /** A cloud is being opened; nothing is known of it yet. */
  opening(name: string): void {
    this.rest();
    this.#place.hidden = false;
    setText(this.#stage, i18n.t("Opening {name}…", { name }));
    this.#bar.removeAttribute("value");
    this.#bar.hidden = false;
    setText(this.#count, "");
  }

  /**
   * The server of the cloud that is being opened is waited for.
   * @param wait undefined: it answers
   */
  openingWaits(name: string, wait: ServerWait | undefined): void {
    this.opening(name);
    if (!wait) return;
    setText(this.#stage, outageWords(wait));
    const count = () => setText(this.#count, againWords(wait, Date.now()));
    count();
    const timer = setInterval(count, INTERVAL);
    this.#unfollow = () => clearInterval(timer);
  }

  /** A cloud that has no octree is given one. */
  indexing(name: string, { stage, done, total }: IndexProgress): void {
    this.rest();
    this.#place.hidden = false;
    setText(this.#stage, indexingWords(name, stage));
    this.#bar.setAttribute("aria-label", i18n.t("Points that are indexed"));
    this.#bar.max = Math.max(total, 1);
    this.#bar.value = done;
    this.#bar.hidden = false;
    setText(
      this.#count,
      i18n.t("{done} of {total, plural, one {# point} other {# points}}", { done: countWords(done), total }),
    );
  }

  /** Shows what a layer loads, until another call. */
  follow(layer: PointCloudLayer): void {
    this.rest();
    this.#place.hidden = false;
    const { nodesVisible: wanted, nodesLoaded: ready, nodesFailed: failed } = layer.statistics;
    let latest: StreamProgress = { wanted, ready, failed, pending: layer.settled ? 0 : 1 };
    this.#tell(layer, latest);
    const unsubscribe = layer.loadProgress.addEventListener((progress) => {
      latest = progress;
      this.#tell(layer, latest);
    });
    const timer = setInterval(() => this.#tell(layer, latest), INTERVAL);
    this.#unfollow = () => {
      unsubscribe();
      clearInterval(timer);
    };
  }

  /** Nothing is being opened and no cloud is there. */
  rest(): void {
    this.#unfollow?.();
    this.#unfollow = undefined;
    this.#place.hidden = true;
    this.#bar.setAttribute("aria-label", i18n.t("Nodes of this view that are loaded"));
  }

  #tell(layer: PointCloudLayer, progress: StreamProgress): void {
    const instead = this.#instead();
    const settled = instead !== undefined || layer.settled;
    const drawn = instead ?? layer.statistics;
    const { pointsDrawn, budgetReached } = drawn;
    // A layer that has nothing to load tells nothing: out of the view it is settled all the same.
    const { wanted, ready, failed, pending, waiting } = settled ? progressOf(drawn) : progress;
    const waits = pending > 0 || (wanted > failed && pointsDrawn === 0 && !settled);
    this.#bar.hidden = !waits;
    this.#bar.max = Math.max(wanted, 1);
    this.#bar.value = ready;
    if (waits && waiting) setText(this.#stage, outageWords(waiting));
    else if (waits) setText(this.#stage, i18n.t("Loading this view…"));
    else if (failed > 0)
      setText(
        this.#stage,
        i18n.t("This view is drawn without {count, plural, one {# node} other {# nodes}} that failed.", {
          count: failed,
        }),
      );
    else
      setText(this.#stage, wanted > 0 ? i18n.t("This view is complete.") : i18n.t("No points in this view."));
    const nodes = i18n.t("{ready} of {wanted, plural, one {# node} other {# nodes}}", {
      ready: countWords(ready),
      wanted,
    });
    const points = budgetReached
      ? i18n.t("{count, plural, one {# point} other {# points}} drawn, limited by the point budget", {
          count: pointsDrawn,
        })
      : i18n.t("{count, plural, one {# point} other {# points}} drawn", { count: pointsDrawn });
    const again = waits && waiting ? `${againWords(waiting, Date.now())} · ` : "";
    setText(this.#count, `${again}${nodes} · ${points}`);
  }
}

/** What is done with a scan while it gets its octree. */
export function indexingWords(name: string, stage: IndexProgress["stage"]): string {
  if (stage === "read") return i18n.t("Indexing {name}, 1 of 3: reading the points…", { name });
  if (stage === "build") return i18n.t("Indexing {name}, 2 of 3: building the octree…", { name });
  return i18n.t("Indexing {name}, 3 of 3: writing it…", { name });
}

function progressOf({
  nodesVisible: wanted,
  nodesLoaded: ready,
  nodesFailed: failed,
}: Drawn): StreamProgress {
  return { wanted, ready, failed, pending: wanted - ready - failed };
}
