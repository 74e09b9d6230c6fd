import { describe, expect, it } from "vitest";
import { Replay, SharedReads } from "./shared-reads.js";

/** Reads that end when they are told to. */
function source() {
  const asked: { key: string; signal: AbortSignal; end: (value: string) => void }[] = [];
  const reads = new SharedReads<string>(10, (value) => value.length);
  const read = (key: string, signal?: AbortSignal) =>
    reads.read(key, signal, (until) => new Promise((end) => asked.push({ key, signal: until, end })));
  return { asked, reads, read };
}

describe("shared reads", () => {
  it("asks once for what two want, and keeps it up to its limit", async () => {
    const { asked, read } = source();
    const both = [read("a"), read("a")];
    asked[0].end("12345");
    expect(await Promise.all(both)).toEqual(["12345", "12345"]);
    expect(await read("a")).toBe("12345");
    expect(asked.length).toBe(1);
    const other = read("b");
    asked[1].end("1234567");
    await other;
    void read("a");
    expect(asked.map(({ key }) => key)).toEqual(["a", "b", "a"]);
  });

  it("goes on while one waits, and stops once nobody does", async () => {
    const { asked, read } = source();
    const [one, other] = [new AbortController(), new AbortController()];
    const first = read("a", one.signal);
    const second = read("a", other.signal);
    one.abort(new Error("one"));
    await expect(first).rejects.toThrow("one");
    expect(asked[0].signal.aborted).toBe(false);
    other.abort(new Error("other"));
    await expect(second).rejects.toThrow("other");
    expect(asked[0].signal.aborted).toBe(true);
    void read("a");
    expect(asked.length).toBe(2);
  });

  it("forgets what was damaged", async () => {
    const { asked, reads, read } = source();
    const first = read("a");
    asked[0].end("1");
    await first;
    reads.forget("a");
    void read("a");
    expect(asked.length).toBe(2);
  });

  it("replays items for each who asks, and the error that ends them", () => {
    let taken = 0;
    let failures = 0;
    const items = new Replay(
      (function* () {
        for (; taken < 3; taken++) yield taken;
        throw new Error("damaged");
      })(),
      () => failures++,
    );
    const first = items[Symbol.iterator]();
    expect(first.next().value).toBe(0);
    expect(() => [...items]).toThrow("damaged");
    expect(() => [...items]).toThrow("damaged");
    expect([taken, failures]).toEqual([3, 1]);
    expect(first.next().value).toBe(1);
  });
});
