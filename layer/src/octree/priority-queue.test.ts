import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { PriorityQueue } from "./priority-queue.js";

describe("PriorityQueue", () => {
  it("gives items back in falling order of priority", () => {
    fc.assert(
      fc.property(fc.array(fc.double({ noNaN: true })), (priorities) => {
        const queue = new PriorityQueue<number>();
        for (const priority of priorities) queue.push(priority, priority);
        const out: number[] = [];
        for (let item = queue.pop(); item !== undefined; item = queue.pop()) out.push(item);
        expect(out).toEqual([...priorities].sort((a, b) => b - a));
      }),
    );
  });

  it("is empty again after the last item", () => {
    const queue = new PriorityQueue<string>();
    queue.push("a", 1);
    expect([queue.pop(), queue.pop()]).toEqual(["a", undefined]);
  });
});
