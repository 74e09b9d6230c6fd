/**
 * The element of the page's markup with an id.
 * @throws Error where the markup has none of that kind: a mistake in the page itself
 */
export function byId<Kind extends HTMLElement>(id: string, Kind: new () => Kind): Kind {
  const element = document.getElementById(id);
  if (element instanceof Kind) return element;
  throw new Error(`index.html has no ${Kind.name} #${id}`);
}

/** A new element with a text, which is never read as markup. */
export function textElement<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  text: string,
  className?: string,
): HTMLElementTagNameMap[Tag] {
  const element = document.createElement(tag);
  element.textContent = text;
  if (className) element.className = className;
  return element;
}
