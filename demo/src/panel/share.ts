import {
  cameraView,
  layerView,
  type PointCloudLayer,
  readPermalink,
  type SharedProfile,
  type SharedView,
  showCameraView,
  writePermalink,
} from "@groma/layer/cesium";
import type { Viewer } from "cesium";
import { i18n } from "../language/i18n.js";
import type { ClipBox } from "../scene/clip-box.js";
import type { Picking } from "../scene/picking.js";
import { byId, setText } from "./elements.js";
import { shortlyOf } from "./fault-words.js";

/** Of the fragment of the page's address. */
const NAME = "#view=";

/** What of the page a link brings back. */
export interface Shared {
  readonly layer: () => PointCloudLayer | undefined;
  /** Clouds that an address can name; the chosen one is the first where it is one of them. */
  readonly addressed: () => readonly PointCloudLayer[];
  /** Has an address name them, in their order. */
  readonly writeTo: (page: URL) => void;
  readonly box: ClipBox;
  readonly picking: Picking;
  /** The line whose profile is shown. */
  readonly profiles: { readonly shared: SharedProfile | undefined; showShared(line: SharedProfile): void };
  /** Has an address ask for what the page shows beside or in place of the globe. */
  readonly beside: { writeTo(page: URL): void };
}

/** Links to the page as it is seen: camera, style, filter, clips, the record that is selected, the profile. */
export class Share {
  readonly #viewer: Viewer;
  readonly #shared: Shared;
  /** Ends the watch for the view that the address names to be left. */
  #unwatch: () => void = () => undefined;

  constructor(viewer: Viewer, shared: Shared) {
    this.#viewer = viewer;
    this.#shared = shared;
    byId("copy-link", HTMLButtonElement).addEventListener("click", () => void this.#copy());
  }

  /**
   * The view that the page's address asks for; undefined where it asks for none.
   * @throws LinkError, StyleError
   */
  static wanted(): SharedView | undefined {
    const { hash } = location;
    return hash.startsWith(NAME) ? readPermalink(decoded(hash.slice(NAME.length))) : undefined;
  }

  /** Brings a view back, all of it that can be. @throws what could not be, the first of several */
  async show({ camera, clips, selected, profile, others: _, ...drawn }: SharedView): Promise<void> {
    const { box, picking, profiles, layer: shown } = this.#shared;
    const layer = shown();
    if (!layer) return;
    const failures: unknown[] = [];
    const attempt = (work: () => void) => {
      try {
        work();
      } catch (thrown) {
        failures.push(thrown);
      }
    };
    if (camera) attempt(() => showCameraView(this.#viewer.camera, camera));
    for (const [name, value] of Object.entries(drawn)) attempt(() => Object.assign(layer, { [name]: value }));
    if (selected) await picking.select(layer, selected).catch((thrown: unknown) => failures.push(thrown));
    // The box moves to what is selected: where it was comes after.
    if (clips) attempt(() => box.take(clips));
    if (profile) attempt(() => profiles.showShared(profile));
    if (camera) this.#nameUntilLeft();
    if (failures.length > 0) throw failures[0];
  }

  /** The address names the view that is seen now until the camera leaves it: the page reloaded would go back there. */
  #nameUntilLeft(): void {
    this.#unwatch();
    const { camera } = this.#viewer;
    const seen = () => writePermalink({ camera: cameraView(camera) });
    const named = seen();
    this.#unwatch = camera.moveEnd.addEventListener(() => {
      if (seen() === named) return;
      this.#unwatch();
      const page = new URL(location.href);
      page.hash = "";
      history.replaceState(null, "", page);
    });
  }

  async #copy(): Promise<void> {
    const { layer: shown, addressed, writeTo, picking, profiles, beside } = this.#shared;
    const layer = shown();
    if (!layer) return;
    const note = byId("link-note", HTMLParagraphElement);
    const [first, ...further] = addressed();
    if (first !== layer) {
      setText(note, i18n.t("A file of this computer has no address that a link could name."));
      return;
    }
    const page = new URL(location.href);
    writeTo(page);
    beside.writeTo(page);
    // The volumes are the page's, of all clouds.
    const others = further.map((one) => ({ ...layerView(one), clips: undefined }));
    const camera = cameraView(this.#viewer.camera);
    const { hit } = picking;
    // A link brings back a record of the cloud whose style it has.
    const selected = hit?.layer === layer ? { node: hit.node, index: hit.index } : undefined;
    try {
      const profile = profiles.shared;
      page.hash = `view=${writePermalink({ camera, ...layerView(layer), others, selected, profile })}`;
    } catch (thrown) {
      setText(note, shortlyOf(thrown));
      return;
    }
    history.replaceState(null, "", page);
    this.#nameUntilLeft();
    const copied = await navigator.clipboard?.writeText(page.href).then(
      () => true,
      () => false,
    );
    setText(
      note,
      copied
        ? i18n.t("The link is copied; the address bar has it too.")
        : i18n.t("The address bar has the link."),
    );
  }
}

/** Part of an address without its escapes; as it is where they are damaged, which its reader tells better. */
function decoded(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}
