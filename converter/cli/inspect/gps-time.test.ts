import { describe, expect, it } from "vitest";
import { className } from "../terminal/class-names.js";
import { gpsSpan, gpsSpanInWords } from "./gps-time.js";

const words = (kind: "week" | "standard", min: number, max: number) =>
  gpsSpanInWords(gpsSpan(kind, { min, max })!);

describe("the span of GPS times", () => {
  it("has dates where seconds are counted from 1980", () => {
    // Week 2086 began on 2019-12-29; adjusted by 1e9.
    const seconds = 2086 * 604_800 + 3600 - 1e9;
    expect(words("standard", seconds, seconds + 61)).toBe(
      "2019-12-29 01:00:00 … 2019-12-29 01:01:01 GPS time",
    );
    expect(gpsSpan("standard", { min: 0, max: 1 })).toMatchObject({ from: "2011-09-14T01:46:40" });
  });

  it("has days of an unknown week where seconds are those of a week", () => {
    expect(words("week", 245_379.4, 245_385.9)).toBe(
      "245379.4 … 245385.9 s of an unstated GPS week: Tuesday 20:09:39 … Tuesday 20:09:45",
    );
    expect(words("week", 0, 604_800)).toMatch(/Sunday 00:00:00 … Sunday 00:00:00$/);
  });

  it("says what is no time of its kind, and nothing where there is none", () => {
    expect(words("week", 1, 3e8)).toMatch(/although the header declares/);
    expect(words("standard", 1, 1e300)).toMatch(/not a valid time/);
    expect(gpsSpan("week", { min: 0, max: 0 })).toBeUndefined();
    expect(gpsSpan("week", undefined)).toBeUndefined();
  });
});

it("gives classes the names of their point format", () => {
  expect(className(6, 1)).toBe("building");
  expect([className(8, 3), className(8, 6)]).toEqual(["model key-point", "reserved"]);
  expect([className(12, 3), className(12, 7)]).toEqual(["overlap", "reserved"]);
  expect([className(22, 6), className(23, 6), className(63, 6), className(64, 6)]).toEqual([
    ...["temporal exclusion", "reserved", "reserved", "user defined"],
  ]);
});
