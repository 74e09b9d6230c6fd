import { describe, expect, it } from "vitest";
import { LruCache } from "./lru-cache.js";

function filled(count: number): LruCache<number, string> {
  const cache = new LruCache<number, string>({ points: 1000, bytes: 100, low: 0.5 });
  for (let key = 0; key < count; key++) cache.set(key, `node ${key}`, { points: 1, bytes: 10 });
  return cache;
}

const none = () => false;

describe("LruCache", () => {
  it("keeps everything up to its limit", () => {
    expect(filled(10).trim(none)).toEqual([]);
  });

  it("goes down to the low mark once a limit is passed, oldest first", () => {
    const cache = filled(11);
    expect(cache.trim(none).map(([key]) => key)).toEqual([0, 1, 2, 3, 4, 5]);
    expect([cache.bytes, cache.points]).toEqual([50, 5]);
    expect(cache.trim(none)).toEqual([]);
  });

  it("goes down to 80 % where no low mark is given, and to the limit alone where only an excess must go", () => {
    const cache = new LruCache<number, number>({ points: 1000, bytes: 100 });
    for (let key = 0; key < 11; key++) cache.set(key, key, { points: 1, bytes: 10 });
    expect(cache.trim(none).map(([key]) => key)).toEqual([0, 1, 2]);
    expect(cache.bytes).toBe(80);
    expect(cache.trim(none, 15).map(([key]) => key)).toEqual([3, 4]);
    expect(cache.bytes).toBe(60);
  });

  it("goes by the low mark of points as well", () => {
    const cache = new LruCache<number, number>({ points: 10, bytes: 1e9, low: 0.5 });
    for (let key = 0; key < 11; key++) cache.set(key, key, { points: 1, bytes: 1 });
    expect(cache.trim(none)).toHaveLength(6);
    expect(cache.points).toBe(5);
  });

  it("takes out no more for an excess than that, where a limit is passed too", () => {
    const cache = filled(11);
    expect(cache.trim(none, 80).map(([key]) => key)).toEqual([0, 1, 2, 3, 4, 5, 6, 7]);
  });

  it("counts a use, and no peek", () => {
    const cache = filled(11);
    cache.use(0);
    cache.peek(1);
    expect(cache.trim(none).map(([key]) => key)).toEqual([1, 2, 3, 4, 5, 6]);
  });

  it("leaves what is in use, even above the limit", () => {
    const cache = filled(20);
    expect(cache.trim((key) => key < 18).map(([key]) => key)).toEqual([18, 19]);
    expect(cache.bytes).toBe(180);
  });

  it("goes no lower for an excess than that, however full it is up to its limits", () => {
    for (const [points, bytes] of [
      [1000, 100],
      [10, 1000],
    ]) {
      const cache = new LruCache<number, number>({ points, bytes });
      for (let key = 0; key < 10; key++) cache.set(key, key, { points: 1, bytes: 10 });
      expect(cache.trim(none, 10).map(([key]) => key)).toEqual([0]);
      expect([cache.points, cache.bytes]).toEqual([9, 90]);
      expect(cache.trim(none, 5).map(([key]) => key)).toEqual([1]);
    }
  });

  it("gives what it holds, in the order of use, and undefined for the rest", () => {
    const cache = filled(3);
    expect([cache.use(0), cache.peek(1), cache.peek(7), cache.use(7)]).toEqual([
      ...["node 0", "node 1", undefined, undefined],
    ]);
    expect([...cache.values()]).toEqual(["node 1", "node 2", "node 0"]);
  });

  it("keeps its sums when a value is replaced or removed", () => {
    const cache = filled(2);
    cache.set(0, "larger", { points: 5, bytes: 30 });
    expect([cache.bytes, cache.points]).toEqual([40, 6]);
    expect([cache.delete(0), cache.delete(0)]).toEqual([true, false]);
    expect([cache.bytes, cache.points]).toEqual([10, 1]);
  });

  it("holds the limit of points by itself", () => {
    const cache = new LruCache<string, number>({ points: 10, bytes: Number.POSITIVE_INFINITY });
    cache.set("a", 1, { points: 6, bytes: 1 });
    cache.set("b", 2, { points: 6, bytes: 1 });
    expect(cache.trim(none)).toEqual([["a", 1]]);
  });
});
