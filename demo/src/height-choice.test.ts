import { describe, expect, it } from "vitest";
import { chooseHeight } from "./height-choice.js";

describe("the height reference that a reader chooses", () => {
  it("is opened where the page can place by it", () => {
    expect(chooseHeight("declared", "5728", "a")).toEqual({ kind: "open", vertical: undefined });
    expect(chooseHeight("ellipsoidal", "", "a")).toEqual({ kind: "open", vertical: "ellipsoidal" });
  });

  it.each(["5728", " EPSG:5728 ", "epsg:5728"])("%j is left to a conversion, by name", (code) => {
    const choice = chooseHeight("code", code, "site.copc.laz");
    expect(choice).toMatchObject({
      kind: "refused",
      words: expect.stringContaining("groma convert SCAN site.copc.laz --vertical EPSG:5728"),
    });
  });

  it.each(["", "NAP", "EPSG:", "12", "5728; rm"])("%j is asked for again", (code) => {
    expect(chooseHeight("code", code, "a")).toMatchObject({ words: expect.stringContaining("Give") });
  });
});
