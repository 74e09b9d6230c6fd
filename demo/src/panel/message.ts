import { type Fault, GromaError } from "@groma/georef";
import { i18n } from "../language/i18n.js";
import { byId, textElement } from "./elements.js";
import { sentenceFor } from "./fault-words.js";

/** Something the reader can do about a fault besides what its text names. */
export interface Action {
  readonly label: string;
  readonly run: () => void;
}

/** The place of the panel where faults are told, one at a time; read out by screen readers. */
export class Message {
  readonly #place = byId("message", HTMLDivElement);

  /** Tells a fault: where it is, what it is and what to do about it. What was given up, or closed meanwhile, is none. */
  show(thrown: unknown, action?: Action): void {
    if (thrown instanceof Error && thrown.name === "AbortError") return;
    const { code, file, cause, fix } = faultOf(thrown);
    const buttons = document.createElement("p");
    buttons.className = "row";
    if (action) buttons.append(this.#button(action));
    buttons.append(this.#button({ label: i18n.t("Dismiss"), run: () => undefined }));
    const detail = [
      isolated(file, ": ", sentence(cause)),
      textElement("p", sentence(fix.charAt(0).toUpperCase() + fix.slice(1)), "fix"),
    ];
    const told = sentenceFor(thrown);
    // What stays English is read out as English.
    if (told !== undefined) for (const element of detail) element.lang = "en";
    const stable = textElement("p", code, "code");
    stable.translate = false;
    this.#place.replaceChildren(
      stable,
      ...(told === undefined ? [] : [textElement("p", told, "told")]),
      ...detail,
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
