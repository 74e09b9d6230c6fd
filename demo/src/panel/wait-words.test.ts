import { describe, expect, it } from "vitest";
import { againWords, outageWords } from "./wait-words.js";

describe("waiting in words", () => {
  it.each([
    ["busy", "The server is busy."],
    ["failing", "The server fails."],
    ["silent", "The server does not answer."],
    ["unreachable", "The server cannot be reached."],
  ] as const)("says of a server that is %s: %s", (outage, words) =>
    expect(outageWords({ outage })).toBe(words),
  );

  it.each([
    [5000, "trying again in 4 s"],
    [1001, "trying again in 1 s"],
    [1000, "trying again now"],
    [undefined, "trying again now"],
  ])("counts down to %s", (until, words) => expect(againWords({ outage: "busy", until }, 1000)).toBe(words));

  it("does not say that a silent server is asked again: it has been asked", () => {
    expect(againWords({ outage: "silent", until: undefined }, 1000)).toBe("still waiting for it");
  });
});
