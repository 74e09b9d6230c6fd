import { type Fault, GromaError } from "@groma/georef";
import { i18n } from "../language/i18n.js";
import { byId, textElement } from "./elements.js";
import { sentenceFor } from "./fault-words.js";

/** Something the reader can do about a fault besides what its text names. */
export interface Action {
  readonly label: string;
  readonly run: () => void;
  /** What to do, in the page's words: in place of those of the library, which speak to programmers too. */
  readonly fix?: string;
}

/** A fault, and what the reader can do about it. */
export interface ToldFault {
  readonly thrown: unknown;
  readonly action?: Action | undefined;
}

/** Faults that are told in full at once. */
const MOST = 5;

/** The place of the panel where faults are told; read out by screen readers. */
export class Message {
  readonly #place = byId("message", HTMLDivElement);

  /**
   * Tells a fault in place of those before: where it is, what it is and what to do about it. What was given up, or closed
   * meanwhile, is none.
   */
  show(thrown: unknown, action?: Action): void {
    this.showAll([{ thrown, action }]);
  }

  /** Tells faults of several files, the first of very many. */
  showAll(all: readonly ToldFault[]): void {
    const faults = all.filter(({ thrown }) => !(thrown instanceof Error && thrown.name === "AbortError"));
    if (faults.length === 0) return;
    const left = faults.length - MOST;
    const buttons = document.createElement("p");
    buttons.className = "row";
    // What can be done about it belongs to the first that asks for it.
    const action = faults.find((fault) => fault.action)?.action;
    if (action) buttons.append(this.#button(action));
    buttons.append(this.#button({ label: i18n.t("Dismiss"), run: () => undefined }));
    this.#place.replaceChildren(
      ...faults.slice(0, MOST).flatMap(partsOf),
      ...(left > 0
        ? [
            textElement(
              "p",
              i18n.t("and {count, plural, one {# further fault} other {# further faults}}", { count: left }),
            ),
          ]
        : []),
      buttons,
    );
  }

  clear(): void {
    this.#place.replaceChildren();
  }

  #button({ label, run }: Action): HTMLButtonElement {
    const button = textElement("button", label);
    button.type = "button";
    button.addEventListener("click", () => {
      this.clear();
      run();
    });
    return button;
  }
}

/** Code, sentence, place with cause, and fix of a fault. */
function partsOf({ thrown, action }: ToldFault): HTMLElement[] {
  const { code, file, cause, fix } = faultOf(thrown);
  const remedy = action?.fix ?? sentence(fix.charAt(0).toUpperCase() + fix.slice(1));
  const detail = [isolated(file, ": ", sentence(cause)), textElement("p", remedy, "fix")];
  const told = sentenceFor(thrown);
  // What stays English is read out as English.
  const english = action?.fix === undefined ? detail : detail.slice(0, 1);
  if (told !== undefined) for (const element of english) element.lang = "en";
  const stable = textElement("p", code, "code");
  stable.translate = false;
  return [stable, ...(told === undefined ? [] : [textElement("p", told, "told")]), ...detail];
}

/** A paragraph whose first and last part cannot change each other's direction of writing. */
function isolated(first: string, between: string, last: string): HTMLElement {
  const paragraph = document.createElement("p");
  paragraph.append(textElement("bdi", first), between, textElement("bdi", last));
  return paragraph;
}

function faultOf(thrown: unknown): Fault {
  if (thrown instanceof GromaError) return thrown;
  return {
    code: "PAGE_FAILED",
    file: i18n.t("the page"),
    cause: thrown instanceof Error ? thrown.message : String(thrown),
    fix: i18n.t("Reload the page"),
  };
}

/** A clause with its closing stop. */
function sentence(clause: string): string {
  return /[.!?]$/.test(clause) ? clause : `${clause}.`;
}
