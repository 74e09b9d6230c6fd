import { NAVIGATION_KEYS, type PointNavigation } from "@groma/layer/navigation";
import { byId, textElement } from "./elements.js";

/** What the mouse and fingers do, as the sheet tells it. */
const POINTERS: readonly (readonly [string, string])[] = [
  ["Drag, one finger", "move what is under the pointer; look around on foot"],
  ["Right or Ctrl + drag, three fingers", "turn and tilt about it"],
  ["Shift + drag", "look around"],
  ["Wheel, two fingers", "nearer, farther"],
  ["Double click, double tap", "fly there"],
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
    const keys = NAVIGATION_KEYS.map(({ keys, mode, deed }) => {
      return [keys.join(", "), mode === "walk" ? `${deed}, on foot` : deed] as const;
    });
    rows.replaceChildren(
      ...[...POINTERS, ...keys, ["?", "this sheet"] as const].map(([what, deed]) => {
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
