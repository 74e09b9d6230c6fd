import { describe, expect, it } from "vitest";
import { StyleError } from "../errors/index.js";
import { FrameFailures } from "./frame-failures.js";

const volume = () =>
  new StyleError({ code: "STYLE_CLIP", file: "clips", cause: "no volume", fix: "Another" });

describe("FrameFailures", () => {
  it("tells each failure once, until a frame was whole", () => {
    const failures = new FrameFailures();
    const told = [1, 2, 3].map(() => failures.note(volume(), "a.laz"));
    expect(told.map((error) => error?.message)).toEqual([volume().message, undefined, undefined]);
    expect(failures.note(undefined, "a.laz")).toBeUndefined();
    failures.clear();
    expect(failures.note(volume(), "a.laz")).toMatchObject({ code: "STYLE_CLIP" });
  });

  it("gives whatever was thrown a code, the data set and where it happened", () => {
    const thrown = new RangeError("Invalid array length");
    const error = new FrameFailures().note(thrown, "a.laz");
    expect(error).toMatchObject({ code: "DRAW_FRAME", file: "a.laz", cause: "Invalid array length" });
    expect(error?.stack).toBe(thrown.stack);
    expect(new FrameFailures().note("lost", "a.laz")).toMatchObject({ cause: "lost" });
  });

  it("does not go on about a failure whose words change in every frame", () => {
    const failures = new FrameFailures();
    const told = Array.from({ length: 100 }, (_, at) => failures.note(new Error(`${at}`), "a.laz"));
    expect(told.filter((error) => error).length).toBeLessThan(10);
  });
});
