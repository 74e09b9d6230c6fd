import { describe, expect, it } from "vitest";
import { chooseHeight } from "./height-choice.js";

describe("the height reference that a reader chooses", () => {
  it("is as the file says, or the ellipsoid", () => {
    expect(chooseHeight("declared", "5728")).toEqual({ kind: "open", vertical: undefined });
    expect(chooseHeight("ellipsoidal", "")).toEqual({ kind: "open", vertical: "ellipsoidal" });
  });

  it.each(["5728", " EPSG:5728 ", "epsg:5728"])("%j is a height system", (code) => {
    expect(chooseHeight("code", code)).toEqual({ kind: "open", vertical: "EPSG:5728" });
  });

  it.each(["", "NAP", "EPSG:", "12", "5728; rm"])("%j is asked for again", (code) => {
    expect(chooseHeight("code", code)).toEqual({
      kind: "refused",
      words: "Give the EPSG code of a height system, such as 5728.",
    });
  });
});
