import { describe, expect, it } from "vitest";
import { settingsIn, stationsOn } from "./line-settings.js";

describe("stations of a line", () => {
  const vertices = [
    [0.1, 0.8],
    [0.1001, 0.8],
  ] as const;
  const stationing = { vertices, equations: [{ internal: 50, ahead: 5000 }] };

  it("are counted anew at the same place, wherever its chainage starts, and on no line that was changed", () => {
    const stationOf = (start: number, chainage: number) =>
      stationsOn({ width: 2, start, stationing }, vertices)!.stationOf(chainage).station;
    expect([stationOf(0, 49), stationOf(0, 60)]).toEqual([49, 5010]);
    expect([stationOf(1200, 1249), stationOf(1200, 1260)]).toEqual([1249, 5010]);
    const settings = { width: 2, start: 0, stationing };
    expect(stationsOn(settings, vertices.toReversed())).toBeUndefined();
    expect(stationsOn(settings, [vertices[0], [0.1001, 0.800001]])).toBeUndefined();
    expect(stationsOn(settings, [...vertices, [0.1002, 0.8]])).toBeUndefined();
    expect(stationsOn({ width: 2, start: 0 }, vertices)).toBeUndefined();
  });

  it("are kept with the settings, and passed over where they are none", () => {
    const settings = { width: 3, start: 0, stationing };
    const twice = { vertices, equations: [stationing.equations[0], stationing.equations[0]] };
    const profiles = {
      a: settings,
      b: { ...settings, stationing: twice },
      c: { ...settings, stationing: 1 },
    };
    expect([...settingsIn(JSON.stringify({ profiles }))]).toEqual([
      ["a", settings],
      ["b", { width: 3, start: 0 }],
      ["c", { width: 3, start: 0 }],
    ]);
  });
});

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
