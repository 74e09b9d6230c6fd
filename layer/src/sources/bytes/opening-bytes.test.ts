import { describe, expect, it } from "vitest";
import { OpeningBytes } from "./opening-bytes.js";

/** A request for bytes that are worth their place in the file, answered by the test. */
function asked(end = 100) {
  let tell: (bytes: Uint8Array, length: number) => void = () => undefined;
  let finish: (bytes: Uint8Array) => void = () => undefined;
  let fail: (thrown: unknown) => void = () => undefined;
  const bytes = Uint8Array.from({ length: end }, (_, at) => at);
  const opening = new OpeningBytes(end, (arrived) => {
    tell = arrived;
    return new Promise((resolve, reject) => {
      finish = resolve;
      fail = reject;
    });
  });
  return {
    opening,
    /** So many bytes have come. */
    come: (length: number) => tell(bytes, length),
    /** The answer ends with so many. */
    done: (length = end) => finish(bytes.subarray(0, length)),
    fail: (thrown: unknown) => fail(thrown),
  };
}

/** What a promise has come to by now. */
async function now<T>(promise: Promise<T>): Promise<T | "open"> {
  await new Promise((resolve) => setTimeout(resolve));
  return Promise.race([promise, Promise.resolve("open" as const)]);
}

describe("the bytes that a file begins with", () => {
  it("are given as they come", async () => {
    const { opening, come, done } = asked();
    const [front, back] = [opening.read(2, 5), opening.read(90, 93)];
    expect(await now(opening.begun)).toBe("open");
    come(4);
    expect(await now(opening.begun)).toBeUndefined();
    expect(await now(front)).toBe("open");
    come(8);
    expect(await now(front)).toEqual(Uint8Array.of(2, 3, 4));
    expect(await now(back)).toBe("open");
    done();
    expect(await back).toEqual(Uint8Array.of(90, 91, 92));
    expect(await opening.read(0, 1)).toEqual(Uint8Array.of(0));
  });

  it("stay where the request is repeated from the start", async () => {
    const { opening, come } = asked();
    come(50);
    come(10);
    expect(await now(opening.read(40, 42))).toEqual(Uint8Array.of(40, 41));
  });

  it("end with the file", async () => {
    const { opening, done } = asked();
    const beyond = opening.read(15, 30);
    expect(opening.end).toBe(100);
    done(20);
    expect(await beyond).toEqual(Uint8Array.of(15, 16, 17, 18, 19));
    expect(opening.end).toBe(20);
  });

  it("are not to be had: whoever waits hears why, and what is here stays", async () => {
    const refused = asked();
    refused.fail(new Error("refused"));
    await expect(refused.opening.begun).rejects.toThrow("refused");
    const broken = asked();
    broken.come(30);
    await broken.opening.begun;
    const waiting = broken.opening.read(50, 60);
    broken.fail(new Error("broke off"));
    await expect(waiting).rejects.toThrow("broke off");
    expect(broken.opening.end).toBe(30);
    expect(await broken.opening.read(28, 30)).toEqual(Uint8Array.of(28, 29));
  });
});
