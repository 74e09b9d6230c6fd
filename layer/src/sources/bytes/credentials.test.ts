import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { Credentials, expiryOf } from "./credentials.js";
import type { RenewalContext } from "./renewable.js";

beforeEach(() => vi.useFakeTimers({ now: 1_000_000 }));
afterEach(() => vi.useRealTimers());

describe("Credentials", () => {
  it("asks once for all who wait, and again when the server refuses what it gave", async () => {
    const asked: RenewalContext[] = [];
    const address = async (context: RenewalContext) => `http://a/?${asked.push(context)}`;
    const credentials = new Credentials(address, { a: "1" }, "a");
    const [first, same] = await Promise.all([credentials.get(), credentials.get()]);
    expect(first).toEqual({ address: "http://a/?1", headers: { a: "1" } });
    expect(same).toEqual(first);
    const renewed = await Promise.all([credentials.replace(first, 403), credentials.replace(first, 403)]);
    expect(renewed).toEqual([true, true]);
    expect((await credentials.get()).address).toBe("http://a/?2");
    // What was refused has been replaced already.
    expect(await credentials.replace(first, 403)).toBe(true);
    expect(asked).toEqual([{ reason: "open" }, { reason: "denied", status: 403 }]);
  });

  it("has nothing else to try where nothing is a function", async () => {
    const credentials = new Credentials("http://a", undefined, "a");
    expect(await credentials.replace(await credentials.get(), 401)).toBe(false);
  });

  it("asks again once the time is over, a little before", async () => {
    const reasons: string[] = [];
    const headers = ({ reason }: RenewalContext) => {
      reasons.push(reason);
      return { headers: { n: String(reasons.length) }, expires: new Date(Date.now() + 60_000) };
    };
    const credentials = new Credentials("http://a", headers, "a");
    expect((await credentials.get()).headers).toEqual({ n: "1" });
    vi.advanceTimersByTime(54_000);
    expect((await credentials.get()).headers).toEqual({ n: "1" });
    vi.advanceTimersByTime(2_000);
    expect((await credentials.get()).headers).toEqual({ n: "2" });
    expect(reasons).toEqual(["open", "expired"]);
  });

  it("reads from a signed address when it ends", async () => {
    let signed = 0;
    const address = () => `https://a.example/a?Expires=${Date.now() / 1000 + 60}&Signature=${++signed}`;
    const credentials = new Credentials(address, undefined, "a");
    for (const [milliseconds, expected] of [
      [0, 1],
      [54_000, 1],
      [2_000, 2],
    ]) {
      vi.advanceTimersByTime(milliseconds);
      expect((await credentials.get()).address).toMatch(new RegExp(`Signature=${expected}$`));
    }
  });

  it("names a function that fails, and asks it again later", async () => {
    let failing = true;
    const address = () => {
      if (failing) throw new Error("no token");
      return "http://a";
    };
    const credentials = new Credentials(address, undefined, "a");
    await expect(credentials.get()).rejects.toMatchObject({
      ...{
        code: "SOURCE_RENEWAL",
        outage: "failing",
        cause: "the function that gives the address failed: no token",
      },
    });
    failing = false;
    expect((await credentials.get()).address).toBe("http://a");
  });
});

describe("expiryOf", () => {
  const end = Date.UTC(2026, 0, 2, 3, 4, 5) + 3_600_000;

  it.each([
    [
      "https://b.s3.amazonaws.com/a.laz?X-Amz-Date=20260102T030405Z&X-Amz-Expires=3600&X-Amz-Signature=0",
      end,
    ],
    ["https://storage.googleapis.com/b/a?X-Goog-Date=20260102T030405Z&X-Goog-Expires=3600#x", end],
    [`https://d.cloudfront.net/a?Expires=${end / 1000}&Signature=0`, end],
    ["https://x.blob.core.windows.net/a?se=2026-01-02T04%3A04%3A05Z&sig=0", end],
    ["https://a.example/a?se=2026", undefined],
    ["https://a.example/a?Expires=never", undefined],
    ["https://a.example/a?X-Amz-Date=20260102T030405Z", undefined],
    ["https://a.example/a", undefined],
  ])("of %s", (address, expected) => expect(expiryOf(address)).toBe(expected));
});
