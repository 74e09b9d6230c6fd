/** Attributes whose value is read by people. */
const ATTRIBUTES = ["aria-label", "placeholder", "title", "alt"];

/** A text of the markup, and how to put another one in its place. */
export interface MarkupText {
  /** As it is looked up: no space at the ends, one space within. */
  readonly words: string;
  write(words: string): void;
}

/** The texts of markup within an element, but for what says `translate="no"`, as names and examples of input do. */
export function textsOf(root: Element): MarkupText[] {
  return Array.from(root.querySelectorAll("*:not(script, style)"))
    .filter((element) => !element.closest('[translate="no"]'))
    .flatMap((element) => [...attributesOf(element), ...ownTexts(element)])
    .filter(({ words }) => /\p{L}/u.test(words));
}

function attributesOf(element: Element): MarkupText[] {
  return ATTRIBUTES.map((name) => ({
    words: element.getAttribute(name) ?? "",
    write: (words) => element.setAttribute(name, words),
  }));
}

function ownTexts(element: Element): MarkupText[] {
  return Array.from(element.childNodes)
    .filter((node) => node.nodeType === 3)
    .map((node) => {
      const text = node.nodeValue ?? "";
      const words = text.trim();
      return {
        words: words.replace(/\s+/g, " "),
        write: (other) => {
          node.nodeValue = text.replace(words, () => other);
        },
      };
    });
}
