import { eastNorthUp, geodeticToEcef } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { Clip, ClipSet, type NodeClips, type SourceSpace } from "../clips/index.js";
import type { NodeBounds } from "../octree/index.js";
import type { NodeVertices } from "../workers/index.js";
import { ClipAnswers } from "./clip-answers.js";
import { FrameAllowance } from "./frame-allowance.js";

const SPACE: SourceSpace = {
  place: (_x, _y, _z, out) => out,
  boundingBox: { min: [0, 0, 0], max: [1, 1, 1] },
};
const [LONGITUDE, LATITUDE] = [0.15, 0.82];

/** Radians per metre to the north. */
const METRE = 1 / 6.37e6;

/** Nodes of 20 m in a row to the north. */
const nodes = Array.from({ length: 9 }, (_, index) => {
  const origin = new Float64Array(3);
  geodeticToEcef(LONGITUDE, LATITUDE + (index - 4) * 20 * METRE, 0, origin);
  return { frame: eastNorthUp(origin), box: [-10, -10, -10, 10, 10, 10] } as unknown as NodeVertices;
});

const box = (north: number) =>
  Clip.box({
    center: { longitude: LONGITUDE, latitude: LATITUDE + north * METRE, height: 0 },
    size: [50, 50, 50],
  });

/** A ring of so many corners around the middle. */
const polygon = (corners: number, radius: number) =>
  Clip.polygon(
    Array.from({ length: corners }, (_, index) => {
      const angle = (2 * Math.PI * index) / corners;
      const east = (radius * Math.cos(angle) * METRE) / Math.cos(LATITUDE);
      return [LONGITUDE + east, LATITUDE + radius * Math.sin(angle) * METRE] as const;
    }),
  );

/** A frame with time for so many steps; for one at least. */
function frame(steps: number): FrameAllowance {
  let now = -1;
  return new FrameAllowance(() => now++, steps);
}

const plenty = () => frame(1e6);

/** What the same volumes make of the nodes at once, of which the set itself learns nothing. */
function whole(set: ClipSet): NodeClips[] {
  const volumes = new ClipSet(set).over(SPACE);
  return nodes.map((node) => volumes.forNode(node));
}

/** One frame of a layer that draws all nodes and needs nothing else. @returns what it draws of each */
function draw(answers: ClipAnswers, set: ClipSet | undefined, allowance: FrameAllowance) {
  answers.follow(set, SPACE, allowance);
  if (answers.form(nodes, allowance) === 0) answers.advance();
  return nodes.map((node) => answers.of(node));
}

describe("ClipAnswers", () => {
  it("draws nothing before the first volumes hold, and then what they make of each node", () => {
    const set = new ClipSet([polygon(500, 30)]);
    const answers = new ClipAnswers();
    let frames = 0;
    let drawn: (NodeClips | undefined)[] = [];
    for (; frames < 1000 && drawn.every((clips) => clips === undefined); frames++) {
      drawn = draw(answers, set, frame(3));
    }
    expect(frames).toBeGreaterThan(10);
    expect(frames).toBeLessThan(1000);
    expect(drawn).toEqual(whole(set));
    // The frame in which they came to hold chose its nodes without them.
    expect(answers.pending).toBe(true);
    draw(answers, set, frame(3));
    expect(answers.pending).toBe(false);
  });

  it("keeps the former volumes for the whole picture until the new ones are worked out, then changes at once", () => {
    const set = new ClipSet([box(-20)]);
    const answers = new ClipAnswers();
    draw(answers, set, plenty());
    const before = whole(set);
    set.clear();
    set.add(polygon(300, 50));
    const after = whole(set);
    expect(after).not.toEqual(before);
    const pictures: unknown[] = [];
    for (let at = 0; at < 1000 && pictures.at(-1) !== "after"; at++) {
      const drawn = draw(answers, set, frame(2));
      expect([before, after]).toContainEqual(drawn);
      expect(answers.pending).toBe(true);
      pictures.push(JSON.stringify(drawn) === JSON.stringify(before) ? "before" : "after");
    }
    expect(pictures.slice(0, -1)).toEqual(Array(pictures.length - 1).fill("before"));
    expect(pictures.length).toBeGreaterThan(5);
  });

  it("tells the effects of a frame from the volumes that are to hold next", () => {
    const set = new ClipSet();
    const answers = new ClipAnswers();
    draw(answers, set, plenty());
    expect(answers.volumes).toBeUndefined();
    set.add(box(0));
    set.add(Clip.box({ ...box(0), mode: "highlight" }));
    answers.follow(set, SPACE, plenty());
    expect([answers.volumes?.cutting, answers.volumes?.highlighting]).toEqual([1, 1]);
    // Nothing of them shows before the layer lets them hold.
    expect(answers.of(nodes[0])?.state).toBe("in");
  });

  it("has a node that comes anew wait for the volumes that hold", () => {
    const set = new ClipSet([box(0)]);
    const answers = new ClipAnswers();
    draw(answers, set, plenty());
    const fresh = { ...nodes[8] };
    const spent = frame(0);
    answers.follow(set, SPACE, spent);
    spent.grants();
    expect(answers.form([...nodes, fresh], spent)).toBe(1);
    expect(answers.of(fresh)).toBeUndefined();
    expect(answers.form([...nodes, fresh], plenty())).toBe(0);
    expect(answers.of(fresh)).toEqual(whole(set)[8]);
  });

  it("shows some of the places of volumes that are dragged faster than they are worked out", () => {
    const set = new ClipSet([polygon(200, 20)]);
    const answers = new ClipAnswers();
    draw(answers, set, plenty());
    const seen = new Set<string>();
    for (let step = 0; step < 400; step++) {
      set.replace([...set][0]!, polygon(200, 20 + 0.1 * step));
      seen.add(JSON.stringify(draw(answers, set, frame(4))));
    }
    expect(seen.size).toBeGreaterThan(3);
    for (let at = 0; at < 1000 && (at === 0 || answers.pending); at++) draw(answers, set, frame(4));
    expect(nodes.map((node) => answers.of(node))).toEqual(whole(set));
  });

  it("lets a traversal do with outdated answers where there is no time, and says so", () => {
    const set = new ClipSet([box(0)]);
    const answers = new ClipAnswers();
    draw(answers, set, plenty());
    const bounds = [8, 7].map((index) => {
      const [x, y, z] = nodes[index].frame.origin;
      return { x, y, z, radius: 15, spacing: 1 } as NodeBounds;
    });
    const ask = (allowance: FrameAllowance) => {
      answers.follow(set, SPACE, plenty());
      return bounds.map((sphere) => answers.rejects(sphere, allowance));
    };
    // One in each frame is answered at any rate.
    expect([ask(frame(0)), answers.pending]).toEqual([[true, false], true]);
    expect([ask(frame(0)), answers.pending]).toEqual([[true, true], false]);
    set.replace([...set][0]!, box(80));
    draw(answers, set, plenty());
    expect([ask(frame(0)), answers.pending]).toEqual([[false, true], true]);
    expect([ask(frame(0)), answers.pending]).toEqual([[false, false], false]);
  });

  it("keeps nothing of former volumes where nothing was drawn meanwhile", () => {
    const set = new ClipSet([box(0)]);
    const answers = new ClipAnswers();
    draw(answers, set, plenty());
    answers.rest();
    draw(answers, set, frame(0));
    expect(answers.of(nodes[4])).toEqual(whole(set)[4]);
    answers.rest();
    set.replace([...set][0]!, polygon(300, 40));
    expect(draw(answers, set, frame(0))).toEqual(nodes.map(() => undefined));
  });

  it("passes over volumes that cannot be prepared, tells it once, and goes on with the former ones", () => {
    const answers = new ClipAnswers();
    const good = new ClipSet([box(0)]);
    draw(answers, good, plenty());
    const drawn = draw(answers, good, plenty());
    const set = new ClipSet([Clip.box({ center: { source: [2, 2, 2] }, size: [1, 1, 1] })]);
    const placeless = { ...SPACE, place: () => fail("no place there") };
    const follow = () => {
      answers.follow(set, placeless, plenty());
      if (answers.form(nodes, plenty()) === 0) answers.advance();
    };
    follow();
    expect(answers.takeFailure()).toEqual(new Error("no place there"));
    follow();
    expect([answers.takeFailure(), answers.pending, answers.blocked]).toEqual([undefined, false, false]);
    expect(nodes.map((node) => answers.of(node))).toEqual(drawn);
    set.clear();
    set.add(box(40));
    draw(answers, set, plenty());
    expect(draw(answers, set, plenty())).toEqual(whole(set));
  });

  it("draws nothing where the first volumes cannot be prepared", () => {
    const answers = new ClipAnswers();
    const set = new ClipSet([Clip.box({ center: { source: [2, 2, 2] }, size: [1, 1, 1] })]);
    answers.follow(set, { ...SPACE, place: () => fail("no place there") }, plenty());
    expect([answers.blocked, answers.of(nodes[0])]).toEqual([true, undefined]);
    answers.follow(undefined, SPACE, plenty());
    expect(answers.blocked).toBe(false);
    expect(answers.of(nodes[0])).toMatchObject({ state: "in" });
  });

  it("leaves out a node that the volumes fail on, and keeps the former volumes where new ones fail", () => {
    const answers = new ClipAnswers();
    const set = new ClipSet([box(0)]);
    draw(answers, set, plenty());
    const broken = { frame: undefined, box: [0, 0, 0, 1, 1, 1] } as unknown as NodeVertices;
    expect(answers.form([broken], plenty())).toBe(0);
    expect(answers.of(broken)).toMatchObject({ state: "out" });
    expect(answers.takeFailure()).toBeInstanceOf(TypeError);
    answers.follow(new ClipSet([box(40)]), SPACE, plenty());
    const other = { ...broken } as NodeVertices;
    answers.form([...nodes, other], plenty());
    answers.advance();
    expect(answers.takeFailure()).toBeInstanceOf(TypeError);
    expect(nodes.map((node) => answers.of(node))).toEqual(whole(set));
  });
});

function fail(message: string): never {
  throw new Error(message);
}
