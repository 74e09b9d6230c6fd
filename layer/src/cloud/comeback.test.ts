import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { SourceError } from "../errors/index.js";
import { OctreeNode } from "../octree/index.js";
import { Comeback } from "./comeback.js";

const fault = new SourceError({
  code: "SOURCE_HTTP",
  file: "a",
  cause: "it fails",
  fix: "Wait",
  outage: "busy",
});
const node = (x = 0) => new OctreeNode({ depth: 1, x, y: 0, z: 0 }, "listed");

beforeEach(() => {
  vi.useFakeTimers();
  vi.spyOn(Math, "random").mockReturnValue(0.5);
});
afterEach(() => {
  vi.useRealTimers();
  vi.restoreAllMocks();
});

describe("Comeback", () => {
  it("asks again for what is missing, after pauses that double up to a minute, for as long as it is wanted", () => {
    const asked: OctreeNode[] = [];
    let wanted = true;
    const comeback = new Comeback((again) => wanted && asked.push(again) > 0);
    const missing = node();
    for (let failures = 1; failures <= 20; failures++) {
      expect(comeback.add(missing, fault)).toBe(true);
      const pause = Math.min(1000 * 2 ** (failures - 1), 60_000);
      expect(comeback.wait).toEqual({
        ...{ outage: "busy", code: "SOURCE_HTTP", cause: "it fails", until: Date.now() + pause },
      });
      vi.advanceTimersByTime(pause - 1);
      expect([comeback.has(missing), asked.length]).toEqual([true, failures - 1]);
      wanted = failures < 20;
      vi.advanceTimersByTime(1);
      expect([comeback.has(missing), comeback.wait]).toEqual([false, undefined]);
    }
    expect(asked.length).toBe(19);
    expect(vi.getTimerCount()).toBe(0);
  });

  it("waits until the server may be asked", () => {
    const comeback = new Comeback(() => true);
    comeback.add(node(), fault, Date.now() + 5000);
    expect(comeback.wait?.until).toBe(Date.now() + 5000);
  });

  it("asks at once for all that failed with the server when something comes from it", () => {
    const asked: OctreeNode[] = [];
    const comeback = new Comeback((again) => asked.push(again) > 0);
    const missing = [node(0), node(1)];
    for (const each of missing) comeback.add(each, fault, Date.now() + 50_000);
    comeback.arrived(node(2));
    vi.advanceTimersByTime(0);
    expect(asked).toEqual(missing);
  });

  it("gives up a node that fails while others come, never one that fails with all others", () => {
    const comeback = new Comeback(() => true);
    const bad = node();
    const outcomes: boolean[] = [];
    for (let time = 0; time < 5; time++) {
      outcomes.push(comeback.add(bad, fault));
      vi.advanceTimersByTime(60_000);
      comeback.arrived(node(1));
    }
    expect(outcomes).toEqual([true, true, true, true, false]);
    // Given up, it begins anew when it is asked for again.
    expect(comeback.add(bad, fault)).toBe(true);
    comeback.clear();
    expect([comeback.has(bad), vi.getTimerCount()]).toEqual([false, 0]);
  });
});
