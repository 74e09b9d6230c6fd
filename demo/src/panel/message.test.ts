import { GromaError } from "@groma/georef";
import { parseHTML } from "linkedom";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { Message } from "./message.js";

describe("the place where faults are told", () => {
  let place: HTMLElement;
  beforeEach(() => {
    const { document } = parseHTML('<div id="message"></div>');
    place = document.querySelector<HTMLElement>("#message")!;
    vi.stubGlobal("document", document);
    vi.stubGlobal("HTMLDivElement", place.constructor);
  });
  afterEach(() => vi.unstubAllGlobals());

  it("has code, file, cause and fix", () => {
    const fault = { code: "PLACE_LINE", file: "a.laz", cause: "it has one vertex", fix: "give two" };
    new Message().show(new GromaError(fault));
    for (const part of ["PLACE_LINE", "a.laz", "it has one vertex", "Give two"]) {
      expect(place.textContent).toContain(part);
    }
  });

  it("says what to do in the page's own words, where the page can do it", () => {
    const thrown = new GromaError({ code: "CRS_MISSING", file: "a.laz", cause: "none", fix: "pass --crs" });
    new Message().show(thrown, { label: "Give it", fix: "Give it here.", run: () => undefined });
    expect(place.querySelector(".fix")?.textContent).toBe("Give it here.");
    expect(place.textContent).not.toContain("--crs");
  });

  it("tells all faults of several files, and how many more there are of very many", () => {
    const faults = Array.from({ length: 7 }, (_, at) => ({
      thrown: new GromaError({ code: "FORMAT_MAGIC", file: `${at}.laz`, cause: "no", fix: "take another" }),
    }));
    const message = new Message();
    message.showAll([...faults.slice(0, 2), { thrown: new DOMException("", "AbortError") }]);
    expect(place.textContent).toMatch(/0\.laz.*1\.laz/);
    expect(place.textContent).not.toContain("further");
    expect(place.querySelectorAll("button").length).toBe(1);
    message.showAll(faults);
    expect(place.querySelectorAll(".code").length).toBe(5);
    expect(place.textContent).toContain("and 2 further faults");
  });

  it("tells nothing of what was given up, and keeps what it told", () => {
    const message = new Message();
    message.show(new Error("broken"));
    const told = place.textContent;
    message.show(new DOMException("the cloud is closed", "AbortError"));
    expect(told).toContain("broken");
    expect(place.textContent).toBe(told);
  });
});
