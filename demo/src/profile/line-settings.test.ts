import { describe, expect, it } from "vitest";
import { settingsIn } from "./line-settings.js";

describe("settings of lines that the browser has kept", () => {
  it("are those with a width and a start, whatever else stands there", () => {
    const settings = { width: 3, start: 1200.5 };
    const profiles = {
      ...{ line: settings, ["__proto__"]: { width: 1, start: 0 }, none: null, text: "width" },
      ...{ flat: { ...settings, width: 0 }, wordy: { ...settings, start: "0" }, half: { width: 2 } },
    };
    expect(settingsIn(JSON.stringify({ type: "FeatureCollection", profiles })).get("line")).toEqual(settings);
    expect([...settingsIn(JSON.stringify({ profiles })).keys()]).toEqual(["line", "__proto__"]);
    for (const profilesOfOthers of [undefined, null, 1, [], "text"])
      expect(settingsIn(JSON.stringify({ profiles: profilesOfOthers })).size).toBe(0);
  });
});
