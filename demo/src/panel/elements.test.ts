import { parseHTML } from "linkedom";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { optionElement, setText, textElement } from "./elements.js";

beforeEach(() => vi.stubGlobal("document", parseHTML("<html><body></body></html>").document));
afterEach(() => vi.unstubAllGlobals());

describe("texts of the page", () => {
  const name = "<img src=x onerror=alert(1)>\x1b[31m\u202egnp.exe\n";

  it("show what a file put in to mislead, and are no markup", () => {
    const shown = "<img src=x onerror=alert(1)>\\u{1b}[31m\\u{202e}gnp.exe\\u{a}";
    for (const element of [textElement("p", name), optionElement({ value: name, label: name })]) {
      expect(element.textContent).toBe(shown);
      expect(element.children.length).toBe(0);
    }
    expect(optionElement({ value: name, label: name }).value).toBe(name);
  });

  it("are written only where they change", () => {
    const element = textElement("p", "one");
    const node = element.firstChild;
    setText(element, "one");
    expect(element.firstChild).toBe(node);
    setText(element, "two");
    expect(element.textContent).toBe("two");
  });
});
