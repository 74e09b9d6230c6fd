import { describe, expect, it } from "vitest";
import { optionPlace, SHARED, shared } from "./index.js";

const kind = shared<object>("SharedBudget 3");
const read = (given: unknown) => kind.read(given, optionPlace("budget", "scan"));

describe("what layers share", () => {
  it("may come from another copy of the library, of the same version", () => {
    class OfThisCopy {
      readonly [SHARED] = "SharedBudget 3";
    }
    const ofAnotherCopy = { [Symbol.for("@groma/layer shared")]: "SharedBudget 3" };
    for (const budget of [new OfThisCopy(), ofAnotherCopy]) expect(read(budget)).toBe(budget);
  });

  it("is refused by name where its methods are those of another version", () => {
    for (const version of [2, 4, 30]) {
      expect(() => read({ [SHARED]: `SharedBudget ${version}` })).toThrow(
        "STYLE_OPTION: scan: budget cannot be a SharedBudget of another version of @groma/layer. Bundle one version",
      );
    }
  });

  it("is refused where it is something else", () => {
    const others = [
      { [SHARED]: "ClipSet 3" },
      { [SHARED]: undefined },
      {},
      null,
      5,
      "SharedBudget 3",
      () => 1,
    ];
    for (const other of others)
      expect(() => read(other)).toThrow(/budget cannot be .*\. Use a SharedBudget\./);
  });
});
