import { NAVIGATION_KEYS, type PointNavigation } from "@groma/layer/navigation";
import { i18n } from "../language/i18n.js";
import { libraryWords } from "../language/library-words.js";
import { byId, textElement } from "./elements.js";

/** What the mouse and fingers do, as the sheet tells it. */
const POINTERS: readonly (readonly [string, string])[] = [
  [i18n.t("Drag, one finger"), i18n.t("move what is under the pointer; look around on foot")],
  [i18n.t("Right or Ctrl + drag, three fingers"), i18n.t("turn and tilt about it")],
  [i18n.t("Shift + drag"), i18n.t("look around")],
  [i18n.t("Wheel, two fingers"), i18n.t("nearer, farther")],
  [i18n.t("Double click, double tap"), i18n.t("fly there")],
];

/** The buttons for moving about, and the sheet of keys, which `?` opens too. */
export class Moving {
  readonly #navigation: PointNavigation;
  readonly #walk = byId("walk", HTMLButtonElement);
  readonly #sheet = byId("keys", HTMLDialogElement);

  /** @param drawing whether a figure is drawn on the globe at the moment, which double clicks belong to */
  constructor(navigation: PointNavigation, canvas: HTMLCanvasElement, drawing: () => boolean) {
    this.#navigation = navigation;
    canvas.addEventListener("pointerdown", () => {
      navigation.doubleClick = !drawing();
    });
    byId("north-up", HTMLButtonElement).addEventListener("click", () => navigation.northUp());
    this.#walk.addEventListener("click", () => {
      navigation.mode = navigation.mode === "walk" ? "orbit" : "walk";
      // Whoever walks does so by keys.
      canvas.focus();
    });
    navigation.modeChanged.addEventListener(() => this.#show());
    byId("keys-open", HTMLButtonElement).addEventListener("click", () => this.#open());
    document.addEventListener("keydown", (event) => {
      const { key, target, defaultPrevented } = event;
      const types = target instanceof Element && target.matches("input, select, textarea");
      if (key !== "?" || types || defaultPrevented) return;
      event.preventDefault();
      this.#open();
    });
    this.#show();
  }

  #open(): void {
    if (this.#sheet.open) return;
    const rows = byId("keys-rows", HTMLTableSectionElement);
    const keys = NAVIGATION_KEYS.map(({ keys, mode, deed: english }) => {
      const deed = libraryWords(english);
      const words = mode === "walk" ? i18n.t("{deed}, on foot", { deed }) : deed;
      return [keys.map(libraryWords).join(", "), words] as const;
    });
    rows.replaceChildren(
      ...[...POINTERS, ...keys, ["?", i18n.t("this sheet")] as const].map(([what, deed]) => {
        const row = document.createElement("tr");
        const head = textElement("th", what);
        head.scope = "row";
        row.append(head, textElement("td", deed));
        return row;
      }),
    );
    this.#sheet.showModal();
  }

  #show(): void {
    this.#walk.setAttribute("aria-pressed", String(this.#navigation.mode === "walk"));
  }
}
