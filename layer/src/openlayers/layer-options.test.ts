import { describe, expect, it } from "vitest";
import { PointCloudLayer, PointCloudSource } from "./index.js";

describe("a layer and a source of a map", () => {
  it.each([
    [[Number.NaN, 1], {}, "pixel cannot be"],
    [[300], {}, "pixel cannot be an array of 1. Use [x, y]"],
    [null, {}, "pixel cannot be null"],
    [[1, 1], { window: -3 }, "options.window cannot be -3"],
    [[1, 1], { window: Number.NaN }, "options.window cannot be NaN. Use a number from 0 to 1000"],
    [[1, 1], { window: "5" }, "options.window cannot be"],
    [[1, 1], { widow: 5 }, 'Did you mean "window"'],
  ])("refuse a pick at %j with %j", async (pixel, options, cause) => {
    const layer = new PointCloudLayer();
    const picked = layer.pick(pixel as number[], options as object);
    await expect(picked).rejects.toThrow(/STYLE_OPTION/);
    await expect(picked).rejects.toThrow(cause);
    expect(await layer.pick([1, 1], { window: 0, signal: undefined })).toBeUndefined();
  });

  it("name what is missing where nothing is given", () => {
    expect(() => new PointCloudSource()).toThrow(/STYLE_OPTION.*0 of url, file and cloud/s);
  });

  it("end with the source", async () => {
    const source = new PointCloudSource({ file: new Blob(["no points"]) });
    source.dispose();
    await expect(source.opened()).rejects.toThrow(/disposed/);
    expect([source.cloud, source.getExtent()]).toEqual([undefined, undefined]);
  });
});
