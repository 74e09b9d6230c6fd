import { describe, expect, it } from "vitest";
import { bytesAsked } from "./byte-ranges.js";

const SIZE = 100;
const NINES = "9".repeat(400);

describe("bytesAsked", () => {
  it.each<[string | undefined, [number, number][]]>([
    ["bytes=0-0", [[0, 0]]],
    ["bytes=10-19", [[10, 19]]],
    ["bytes=90-", [[90, 99]]],
    ["bytes=90-200", [[90, 99]]],
    [`bytes=90-${NINES}`, [[90, 99]]],
    ["bytes=-10", [[90, 99]]],
    // RFC 9110, 14.1.2: a suffix longer than the file is the whole file.
    ["bytes=-101", [[0, 99]]],
    [`bytes=-${NINES}`, [[0, 99]]],
    [
      "Bytes=0-1, 5-6,,-2",
      [
        [0, 1],
        [5, 6],
        [98, 99],
      ],
    ],
    ["bytes=0-1,200-300", [[0, 1]]],
  ])("%s asks for %j", (header, parts) => {
    expect(bytesAsked(header, SIZE)).toEqual(parts.map(([first, last]) => ({ first, last })));
  });

  it.each([undefined, "", "lines=1-2", "garbage"])("%s asks for the whole file", (header) => {
    expect(bytesAsked(header, SIZE)).toBe("whole");
  });

  it.each([
    "bytes=100-",
    `bytes=${NINES}-`,
    "bytes=-0",
    "bytes=",
    "bytes=-",
    "bytes=0--1",
    "bytes=5-2",
    "bytes=a-b",
    "bytes=0-1,x",
    "bytes=1.5-2",
    "bytes=0-99,0-99",
    `bytes=${Array.from({ length: 17 }, (_, at) => `${2 * at}-${2 * at}`)}`,
  ])("%s cannot be had", (header) => expect(bytesAsked(header, SIZE)).toBe("unsatisfiable"));

  it("no byte of an empty file can be had", () => expect(bytesAsked("bytes=0-", 0)).toBe("unsatisfiable"));
});
