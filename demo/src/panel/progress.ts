import type { PointCloudLayer, ServerWait, StreamProgress } from "@groma/layer/cesium";
import { byId } from "./elements.js";
import { againWords, outageWords } from "./wait-words.js";
import { counted, countWords } from "./words.js";

/** Milliseconds between two looks at what is drawn: what has come is drawn some frames later. */
const INTERVAL = 250;

/** How far the loading of the current view is. */
export class Progress {
  readonly #place = byId("progress", HTMLDivElement);
  readonly #stage = byId("stage", HTMLParagraphElement);
  readonly #bar = byId("bar", HTMLProgressElement);
  readonly #count = byId("count", HTMLParagraphElement);
  #unfollow: (() => void) | undefined;

  /** A cloud is being opened; nothing is known of it yet. */
  opening(name: string): void {
    this.rest();
    this.#place.hidden = false;
    this.#say(`Opening ${name}…`);
    this.#bar.removeAttribute("value");
    this.#bar.hidden = false;
    this.#count.textContent = "";
  }

  /**
   * The server of the cloud that is being opened is waited for.
   * @param wait undefined: it answers
   */
  openingWaits(name: string, wait: ServerWait | undefined): void {
    this.opening(name);
    if (!wait) return;
    this.#say(outageWords(wait));
    const count = () => this.#count.replaceChildren(againWords(wait, Date.now()));
    count();
    const timer = setInterval(count, INTERVAL);
    this.#unfollow = () => clearInterval(timer);
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
  }

  #tell(layer: PointCloudLayer, { wanted, ready, failed, pending, waiting }: StreamProgress): void {
    const { pointsDrawn, budgetReached } = layer.statistics;
    const waits = pending > 0 || (wanted > failed && pointsDrawn === 0 && !layer.settled);
    this.#bar.hidden = !waits;
    this.#bar.max = Math.max(wanted, 1);
    this.#bar.value = ready;
    if (waits && waiting) this.#say(outageWords(waiting));
    else if (waits) this.#say("Loading this view…");
    else if (failed > 0) this.#say(`This view is drawn without ${counted(failed, "node")} that failed.`);
    else this.#say(wanted > 0 ? "This view is complete." : "No points in this view.");
    const nodes = `${countWords(ready)} of ${counted(wanted, "node")}`;
    const limit = budgetReached ? ", all that the budget allows" : "";
    const again = waits && waiting ? `${againWords(waiting, Date.now())} · ` : "";
    const count = `${again}${nodes} · ${counted(pointsDrawn, "point")} drawn${limit}`;
    if (this.#count.textContent !== count) this.#count.textContent = count;
  }

  /** Speaks only when there is something new, since screen readers read each change. */
  #say(text: string): void {
    if (this.#stage.textContent !== text) this.#stage.textContent = text;
  }
}
