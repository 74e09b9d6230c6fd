import type { Clouds, OpenCloud, Opening } from "../clouds/clouds.js";
import { i18n } from "../language/i18n.js";
import { byId, textElement } from "./elements.js";
import { type IconName, iconButton } from "./icons.js";
import { countWords } from "./words.js";

/** What the reader wants of a cloud of the list. */
export interface CloudWishes {
  readonly choose: (cloud: OpenCloud) => void;
  readonly goTo: (cloud: OpenCloud) => void;
  readonly remove: (cloud: OpenCloud) => void;
}

interface Row {
  readonly element: HTMLLIElement;
  readonly choose: HTMLButtonElement;
  readonly show: HTMLInputElement;
  cloud: OpenCloud;
}

/** The clouds of the scene: which are shown, and which one the panel speaks of. */
export class CloudList {
  readonly #list = byId("cloud-list", HTMLUListElement);
  readonly #address = byId("address", HTMLInputElement);
  readonly #wishes: CloudWishes;
  #rows: readonly Row[] = [];

  constructor(wishes: CloudWishes) {
    this.#wishes = wishes;
  }

  /** Rows of those that stay are kept, and with them the reader's focus. */
  show({ all, openings, chosen }: Clouds): void {
    const focused = this.#rows.findIndex(({ element }) => element.contains(document.activeElement));
    this.#rows = all.map((cloud) => {
      const row = this.#rows.find((one) => one.cloud.id === cloud.id) ?? this.#row(cloud);
      row.cloud = cloud;
      row.show.checked = cloud.layer.show;
      if (cloud === chosen) row.choose.setAttribute("aria-current", "true");
      else row.choose.removeAttribute("aria-current");
      return row;
    });
    const wanted = [...this.#rows.map(({ element }) => element), ...openings.map(openingRow)];
    const same =
      wanted.length === this.#list.children.length &&
      wanted.every((one, i) => one === this.#list.children[i]);
    if (!same) this.#list.replaceChildren(...wanted);
    this.#list.hidden = wanted.length === 0;
    // Whoever removed one by keyboard goes on at the next, or opens another one.
    if (focused < 0 || this.#list.contains(document.activeElement)) return;
    const next = this.#rows[Math.min(focused, this.#rows.length - 1)];
    (next?.choose ?? this.#address).focus();
  }

  #row(cloud: OpenCloud): Row {
    const { name, pointCount } = cloud.layer.cloud;
    const element = document.createElement("li");
    const show = document.createElement("input");
    show.type = "checkbox";
    show.setAttribute("aria-label", i18n.t("Show {name}", { name }));
    const choose = textElement("button", name, "name");
    choose.type = "button";
    // Where the row has too little room, the name is cut.
    choose.title = choose.textContent;
    const count = textElement("small", countWords(pointCount));
    const row: Row = { element, choose, show, cloud };
    const button = (icon: IconName, label: string, wish: (one: OpenCloud) => void) => {
      const made = iconButton(icon, label);
      made.addEventListener("click", () => wish(row.cloud));
      return made;
    };
    show.addEventListener("change", () => {
      row.cloud.layer.show = show.checked;
    });
    choose.addEventListener("click", () => this.#wishes.choose(row.cloud));
    element.append(
      show,
      choose,
      count,
      button("target", i18n.t("Go to {name}", { name }), this.#wishes.goTo),
      button("remove", i18n.t("Remove {name}", { name }), this.#wishes.remove),
    );
    return row;
  }
}

/** A cloud on its way, and the button that gives it up. */
function openingRow({ from, work }: Opening): HTMLLIElement {
  const name = typeof from === "string" ? (new URL(from).pathname.split("/").at(-1) ?? from) : from.name;
  const element = document.createElement("li");
  const cancel = iconButton("remove", i18n.t("Give up {name}", { name }));
  cancel.addEventListener("click", () => work.abort());
  const told = textElement("span", i18n.t("Opening {name}…", { name }));
  told.className = "name dim";
  element.append(told, cancel);
  return element;
}
