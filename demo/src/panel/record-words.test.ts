import { describe, expect, it } from "vitest";
import { coordinateWords, degreeWords, valueWords } from "./record-words.js";

describe("words for a record", () => {
  it("writes as many digits as the integers hold", () => {
    expect(coordinateWords([636_000.1 + 0.2, 849_000, 430.07], [0.01, 0.001, 0.0025])).toBe(
      "636000.30, 849000.000, 430.0700",
    );
    expect(coordinateWords([12_000, 1, 0.000_000_001], [1000, 1, 1e-9])).toBe("12000, 1, 0.000000001");
  });

  it("writes degrees to a millimetre and values as they are", () => {
    expect(degreeWords(Math.PI / 4)).toBe("45.00000000°");
    expect(valueWords(18_446_744_073_709_551_615n)).toBe("18446744073709551615");
    expect(valueWords([1, 2.5])).toBe("1, 2.5");
  });
});
