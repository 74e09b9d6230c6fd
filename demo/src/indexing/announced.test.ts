import { describe, expect, it } from "vitest";
import { checkAnnounced } from "./announced.js";

/** The head of a file that announces points in both places: 32 bits of LAS 1.0 on, 64 bits of LAS 1.4. */
function scan(minor: number, recordLength: number, { legacy = 0, points = 0n }): File {
  const bytes = new Uint8Array(minor < 4 ? 227 : 375);
  const header = new DataView(bytes.buffer);
  bytes.set([1, minor], 24);
  header.setUint16(105, recordLength, true);
  header.setUint32(107, legacy, true);
  if (minor >= 4) header.setBigUint64(247, points, true);
  return new File([bytes], "a.las");
}

describe("what a header announces", () => {
  it.each([
    ["as many points as are taken, LAS 1.2", scan(2, 34, { legacy: 10_000_000 })],
    ["as many as are taken, LAS 1.4", scan(4, 36, { points: 10_000_000n })],
    ["as many bytes as are taken", scan(4, 1024, { points: 1_048_576n })],
    ["too little for a header, which the core refuses", new File(["LASF"], "a.las")],
  ])("may be %s", async (_, file) => {
    await expect(checkAnnounced(file)).resolves.toBeUndefined();
  });

  it.each([
    ["a point more, LAS 1.2", scan(2, 34, { legacy: 10_000_001 }), /10,000,001 points;/],
    ["a point more, LAS 1.4", scan(4, 36, { points: 10_000_001n }), /10,000,001 points;/],
    ["points where old readers look alone", scan(4, 36, { legacy: 20_000_000 }), /20,000,000 points;/],
    [
      "more than any file holds",
      scan(4, 36, { points: 2n ** 64n - 1n }),
      /18,446,744,073,709,551,615 points;/,
    ],
    ["a byte more in few points", scan(4, 1025, { points: 1_048_576n }), /1,074,790,400 bytes of points;/],
  ])("must not be %s", async (_, file, cause) => {
    await expect(checkAnnounced(file)).rejects.toMatchObject({
      ...{ code: "INDEX_POINTS", file: "a.las", cause: expect.stringMatching(cause) },
      fix: "Convert it: groma convert IN OUT.copc.laz",
    });
  });
});
