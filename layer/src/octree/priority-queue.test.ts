import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { PriorityQueue } from "./priority-queue.js";

describe("PriorityQueue", () => {
  it("gives every item back once, in falling order of priority", () => {
    fc.assert(
      fc.property(fc.array(fc.double({ noNaN: true }), { maxLength: 3000, size: "max" }), (priorities) => {
        const queue = new PriorityQueue();
        for (const [index, priority] of priorities.entries()) queue.push(index, priority);
        const out: number[] = [];
        for (let item = queue.pop(); item !== undefined; item = queue.pop()) out.push(item);
        expect([...out].sort((a, b) => a - b)).toEqual(priorities.map((_, index) => index));
        // Items of equal priority (0 and −0 among them) come in any order.
        const falls = out.every((item, at) => at === 0 || priorities[out[at - 1]] >= priorities[item]);
        expect(falls, out.join()).toBe(true);
      }),
    );
  });

  it("is empty again after the last item, and once it is cleared", () => {
    const queue = new PriorityQueue();
    queue.push(7, 1);
    expect([queue.pop(), queue.pop()]).toEqual([7, undefined]);
    queue.push(8, 1);
    queue.clear();
    expect(queue.pop()).toBeUndefined();
  });
});
