import { expect, it } from "vitest";
import { wordFaults } from "../../demo/vite/words.js";

it("every word of the page stands in every language, and no other does", async () => {
  const faults = await wordFaults();
  expect([...faults.keys()]).toContain("de");
  for (const [locale, lists] of faults) {
    expect({ locale, ...lists }).toEqual({ locale, missing: [], unused: [], unlike: [] });
  }
});
