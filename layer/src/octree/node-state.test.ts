import { describe, expect, it } from "vitest";
import { isHeld, isLegal, type NodeState } from "./node-state.js";
import { HierarchyPage, OctreeNode } from "./octree-node.js";

const STATES: NodeState[] = ["page", "opening", "empty", "listed", "queued", "loading", "ready", "failed"];

describe("node states", () => {
  it("goes the whole way from a page to vertices and back", () => {
    const node = new OctreeNode({ depth: 0, x: 0, y: 0, z: 0 }, "page");
    const way: NodeState[] = [
      "opening",
      "listed",
      "queued",
      "loading",
      "ready",
      "listed",
      "queued",
      "loading",
      "failed",
    ];
    for (const state of way) node.become(state);
    expect(node.state).toBe("failed");
  });

  it("refuses what the table does not have, and stays as it was", () => {
    const node = new OctreeNode({ depth: 1, x: 0, y: 1, z: 0 }, "listed");
    expect(() => node.become("ready")).toThrow("node 1-0-1-0 cannot go from listed to ready");
    expect(node.state).toBe("listed");
  });

  it("never counts a failed node as ready", () => {
    expect(isLegal("failed", "ready")).toBe(false);
  });

  it("has no way out of empty but back to its page, so an empty node is never requested", () => {
    expect(STATES.filter((state) => isLegal("empty", state))).toEqual(["page"]);
  });

  it("keeps the page of a node that is waiting, on its way or here, and of no other", () => {
    expect(STATES.filter(isHeld)).toEqual(["opening", "queued", "loading", "ready"]);
    const first = new HierarchyPage(new OctreeNode({ depth: 0, x: 0, y: 0, z: 0 }, "listed"), 1);
    const node = new OctreeNode({ depth: 1, x: 0, y: 0, z: 0 }, "page");
    node.page = first;
    for (const state of ["opening", "listed", "queued", "loading", "ready", "listed", "queued", "listed"]) {
      node.become(state as NodeState);
      expect(first.held, state).toBe(isHeld(node.state));
    }
    node.become("page");
    expect(first.held).toBe(false);
    // As often as was asked for, from the page below too.
    node.page = new HierarchyPage(node, 2);
    first.hold();
    node.page.release();
    expect(first.held).toBe(false);
  });

  it("never forgets a node that is waiting, on its way or here", () => {
    expect(STATES.filter((state) => isHeld(state) && state !== "opening" && isLegal(state, "page"))).toEqual(
      [],
    );
  });

  it("has no state that goes to itself", () => {
    for (const state of STATES) expect(isLegal(state, state)).toBe(false);
  });
});
