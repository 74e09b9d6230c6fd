import { printable } from "@groma/georef/printable";

/**
 * The element of the page's markup with an id.
 * @throws Error where the markup has none of that kind: a mistake in the page itself
 */
export function byId<Kind extends HTMLElement>(id: string, Kind: new () => Kind): Kind {
  const element = document.getElementById(id);
  if (element instanceof Kind) return element;
  throw new Error(`index.html has no ${Kind.name} #${id}`);
}

/**
 * Shows a text in an element: never read as markup, and with what a file or a server put in to mislead made visible.
 * A text that is there already is left alone, since screen readers read each change.
 */
export function setText(element: HTMLElement, text: string): void {
  const shown = printable(text);
  if (element.textContent !== shown) element.textContent = shown;
}

/** A new element with a text, see {@link setText}. */
export function textElement<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  text: string,
  className?: string,
): HTMLElementTagNameMap[Tag] {
  const element = document.createElement(tag);
  setText(element, text);
  if (className) element.className = className;
  return element;
}

/** An entry of a list of choices. */
export function optionElement({ value, label }: { value: string; label: string }): HTMLOptionElement {
  const option = textElement("option", label);
  option.value = value;
  return option;
}
