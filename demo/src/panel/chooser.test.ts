import { CrsError, GromaError } from "@groma/georef";
import { parseHTML } from "linkedom";
import { afterEach, describe, expect, it, vi } from "vitest";
import { crsRemedy } from "./chooser.js";

/** Whether the reader is led to the field for a coordinate system, which holds this text. */
function isLedThere(thrown: unknown, given: string): boolean {
  const { document } = parseHTML(`<input id="crs" value="${given}">`);
  vi.stubGlobal("document", document);
  vi.stubGlobal("HTMLInputElement", document.querySelector("input")!.constructor);
  return crsRemedy(thrown) !== undefined;
}

const fault = { file: "a.laz", cause: "a", fix: "b" };

describe("where a coordinate system can be given", () => {
  afterEach(() => vi.unstubAllGlobals());

  it("is offered to who has a cloud without one, or gave one that is not right", () => {
    expect(isLedThere(new CrsError({ ...fault, code: "CRS_MISSING" }), "")).toBe(true);
    expect(isLedThere(new CrsError({ ...fault, code: "CRS_UNKNOWN" }), "EPSG:1")).toBe(true);
  });

  it("is not offered where the file's own is at fault, or something else is", () => {
    expect(isLedThere(new CrsError({ ...fault, code: "CRS_UNSUPPORTED" }), " ")).toBe(false);
    expect(isLedThere(new GromaError({ ...fault, code: "SOURCE_NOT_FOUND" }), "EPSG:1")).toBe(false);
  });
});
