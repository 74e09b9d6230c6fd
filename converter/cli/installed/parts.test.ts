import { describe, expect, it } from "vitest";
import { platformName } from "./parts.js";

const told = (header: object) => ({ getReport: () => ({ header }) });

describe("a platform is called as its package is", () => {
  it.each([
    ["linux", "x64", told({ glibcVersionRuntime: "2.36" }), "linux-x64-gnu"],
    ["linux", "arm64", told({}), "linux-arm64-musl"],
    ["darwin", "arm64", undefined, "darwin-arm64"],
    ["win32", "x64", undefined, "win32-x64-msvc"],
  ])("%s on %s", (system, processor, report, name) => {
    expect(platformName(system, processor, report)).toBe(name);
  });
});
