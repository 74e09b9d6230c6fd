import { describe, expect, it } from "vitest";
import { checkNodeSize } from "./node-size.js";

const check = (pointCount: number, bytesPerPoint: number) => () =>
  checkNodeSize({ file: "a.copc.laz", node: "0-0-0-0", pointCount, bytesPerPoint });
const refused = expect.objectContaining({ code: "DECODE_TOO_LARGE", file: "a.copc.laz" });

describe("checkNodeSize", () => {
  it("lets nodes through that converters make", () => {
    expect(check(200_000, 100)).not.toThrow();
    expect(check(2 ** 21, 32)).not.toThrow();
  });

  it("refuses too many points, and points of too many bytes, by the node's name", () => {
    expect(check(2 ** 21 + 1, 1)).toThrow(refused);
    expect(check(2 ** 24, 30)).toThrow(refused);
    expect(check(2000, 65_535)).toThrow(refused);
    expect(check(2 ** 24, 30)).toThrow(/node 0-0-0-0 .* at most 2097152 points/);
  });
});
