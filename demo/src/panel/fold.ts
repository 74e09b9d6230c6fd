import { i18n } from "../language/i18n.js";
import type { ScreenRectangle } from "../scene/framing.js";
import { byId, setText } from "./elements.js";

/** Screens narrower than this (CSS pixels) begin with the panel folded; as in panel.css. */
const NARROW = 640;
/** Space kept between a cloud and what is beside it, CSS pixels. */
const MARGIN = 16;

/** Lets the reader fold the panel to its heading. */
export function connectFold(): void {
  const button = byId("fold", HTMLButtonElement);
  button.addEventListener("click", () => setFolded(button.getAttribute("aria-expanded") === "true"));
}

/** Whether what lies over globe and map takes all of their width. */
export function isNarrow(): boolean {
  return innerWidth < NARROW;
}

/** Folds the panel where it would hide the cloud. */
export function foldIfNarrow(): void {
  if (isNarrow()) setFolded(true);
}

/** Opens the panel, and all folds that an element of it is in. */
export function unfold(element: Element): void {
  setFolded(false);
  for (let fold = element.closest("details"); fold; fold = fold.parentElement?.closest("details") ?? null) {
    fold.open = true;
  }
}

function setFolded(folded: boolean): void {
  const button = byId("fold", HTMLButtonElement);
  byId("body", HTMLDivElement).hidden = folded;
  button.setAttribute("aria-expanded", String(!folded));
  setText(button, folded ? i18n.t("More") : i18n.t("Less"));
}

/** The part of the globe beside or below the panel; the whole globe where that would be too small. */
export function freeArea(): ScreenRectangle {
  const panel = byId("panel", HTMLElement).getBoundingClientRect();
  // A map may take a part of the window.
  const { clientWidth: width, clientHeight: height } = byId("globe", HTMLElement);
  // It stands where lines begin, on the right where they run from right to left.
  const atLeft = panel.left + panel.right < innerWidth;
  const beside = atLeft ? panel.right < 0.6 * width : panel.left > 0.4 * width;
  const below = !beside && panel.bottom < height / 2;
  return {
    left: MARGIN + (beside && atLeft ? panel.right : 0),
    top: MARGIN + (below ? panel.bottom : 0),
    right: (beside && !atLeft ? Math.min(panel.left, width) : width) - MARGIN,
    bottom: height - 2 * MARGIN,
  };
}
