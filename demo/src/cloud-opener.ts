import type { SharedView } from "@groma/layer/cesium";
import type { NamedCloud } from "./address.js";
import type { Clouds, OpenCloud } from "./clouds/clouds.js";
import type { OpenOptions } from "./clouds/open-layer.js";
import { rememberClouds } from "./named-clouds.js";
import { type Chooser, crsRemedy, givenCrs } from "./panel/chooser.js";
import type { Failures } from "./panel/failures.js";
import type { Message, ToldFault } from "./panel/message.js";
import type { Progress } from "./panel/progress.js";
import { Share } from "./panel/share.js";
import type { Flight } from "./scene/camera.js";

/** How the camera comes to a cloud; "stay": it does not, nor is the cloud chosen where another one is. */
type Wanted = Flight["way"] | "stay";

/** What is opened into, and who hears of it. */
export interface OpenerParts {
  readonly clouds: Clouds;
  readonly chooser: Chooser;
  readonly message: Message;
  readonly failures: Failures;
  readonly progress: Progress;
  readonly share: Share;
  /** How every cloud is opened. */
  readonly how: () => OpenOptions;
  /** Chooses a cloud and takes the camera there. */
  readonly goTo: (cloud: OpenCloud, by: Flight["way"]) => Promise<void>;
  /** An opening has come to its end, good or bad, or clouds look as a link asks for. */
  readonly ended: () => void;
  /** A cloud looks as the link to the page asks for. */
  readonly broughtBack: (cloud: OpenCloud) => void;
}

/** Opens clouds: those that the page's address names, those that the reader chooses, one anew with other heights. */
export class CloudOpener {
  readonly #parts: OpenerParts;

  constructor(parts: OpenerParts) {
    this.#parts = parts;
  }

  /** Opens the clouds that the page's address names; the view that it asks for is one of the first. */
  async openNamed([first, ...others]: readonly NamedCloud[], color: string | undefined): Promise<void> {
    if (!first) return;
    const { chooser, message } = this.#parts;
    const how = ({ crs, vertical, georef }: NamedCloud): OpenOptions => {
      const every = this.#parts.how();
      const style = { ...every.style, ...(color && { color }) };
      return { ...every, style, crs, vertical, transformation: georef };
    };
    chooser.fill(new URL(location.href).searchParams.get("cloud") ?? "");
    const faults: ToldFault[] = [];
    const tell = (thrown: unknown) => {
      faults.push({ thrown });
      message.showAll(faults);
    };
    let view: SharedView | undefined;
    let unread: unknown;
    try {
      view = Share.wanted();
    } catch (thrown) {
      unread = thrown;
    }
    const opened = await this.#open(first.address, how(first), view?.camera ? "stay" : undefined, faults);
    if (opened) await this.#bringBack(opened, view).catch(tell);
    // What cannot be brought back is told; the clouds are there all the same.
    if (unread !== undefined) tell(unread);
    for (const [at, named] of others.entries()) {
      const other = await this.#open(named.address, how(named), "stay", faults);
      try {
        if (other) Object.assign(other.layer, view?.others?.[at]);
      } catch (thrown) {
        tell(thrown);
      }
    }
    this.#parts.ended();
  }

  /**
   * Opens what the reader chose, one after the other; the camera goes to the first.
   * @param refused faults of what was chosen with it and is not opened
   */
  async openChosen(chosen: readonly (string | File)[], refused: readonly unknown[] = []): Promise<void> {
    const { message, clouds, how } = this.#parts;
    message.clear();
    const faults: ToldFault[] = refused.map((thrown) => ({ thrown }));
    message.showAll(faults);
    for (const [at, from] of chosen.entries()) {
      const wanted = at > 0 ? "stay" : undefined;
      const opened = await this.#open(from, { ...how(), crsIfMissing: givenCrs() }, wanted, faults);
      if (opened) rememberClouds(clouds);
    }
  }

  /** Opens the chosen cloud with another height reference, seen from where the camera stands. */
  async reopen(vertical: string | undefined): Promise<boolean> {
    const { clouds, message } = this.#parts;
    const { chosen } = clouds;
    if (!chosen) return false;
    message.clear();
    const { from, how, crs } = chosen;
    const { style, filter, heightOffset, show } = chosen.layer;
    const anew = { ...how, style, filter, heightOffset, show, crs, vertical };
    const opened = await this.#open(from, anew, "stay");
    if (opened) rememberClouds(clouds);
    return opened !== undefined;
  }

  /** Has a cloud look as the link to the page asks for. */
  async #bringBack(opened: OpenCloud, view: SharedView | undefined): Promise<void> {
    try {
      if (view) await this.#parts.share.show(view);
    } finally {
      this.#parts.broughtBack(opened);
    }
  }

  /**
   * Opens a cloud beside the others.
   * @param faults of clouds that were opened with it, which are told with its own
   * @returns undefined where it cannot be opened, which is told, or was given up
   */
  async #open(
    from: string | File,
    how: OpenOptions,
    wanted: Wanted = this.#parts.clouds.layer ? "fly" : "descend",
    faults: ToldFault[] = [],
  ): Promise<OpenCloud | undefined> {
    const { clouds, message, failures, progress } = this.#parts;
    const name = typeof from === "string" ? from : from.name;
    progress.opening(name);
    try {
      const opened = await clouds.open(from, how, {
        waits: (wait) => progress.openingWaits(name, wait),
        indexing: (done) => progress.indexing(name, done),
      });
      if (opened) {
        failures.watch(opened.layer);
        if (wanted !== "stay") await this.#parts.goTo(opened, wanted);
      }
      return opened;
    } catch (thrown) {
      faults.push({ thrown, action: crsRemedy(thrown) });
      message.showAll(faults);
      return undefined;
    } finally {
      this.#parts.ended();
    }
  }
}
