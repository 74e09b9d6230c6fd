import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { MeasureError } from "../../errors/index.js";
import { cloudOf, UTM } from "../measure/cloud.fixture.js";
import {
  type Measurement,
  MeasureUnits,
  placeVertex,
  sourceVertex,
  type Vertex,
  valuesOf,
  type WorthOptions,
} from "../measure/index.js";
import { Awaited } from "./awaited.js";
import { figuresOf } from "./figures.js";
import { checkChange, checkKind, checkMeasurement } from "./given.js";
import { freshName, grown, History, isSame, withAdded, withChange } from "./history.js";
import { KnownValues } from "./known-values.js";
import { Placing } from "./placing.js";
import { aroundPole } from "./pole-ring.js";
import { snapsOf } from "./snapping.js";
import type { ScreenPoint, ViewAdapter } from "./view-adapter.js";
import { measureWords } from "./words.js";

const cloud = cloudOf(UTM);
const [a, b, c, d] = [0, 10, 20, 30].map((x) => cloud.vertex(500000 + x, 5300000 + (x % 20), 1)) as [
  Vertex,
  Vertex,
  Vertex,
  Vertex,
];
const line: Measurement = { id: "1", kind: "polyline", name: "Line 1", vertices: [a, b, c] };

describe("the way back and forth", () => {
  it("leads through every state, whatever is done in between", () => {
    fc.assert(
      fc.property(fc.array(fc.constantFrom("go", "undo", "redo"), { maxLength: 60 }), (steps) => {
        const history = new History();
        const known = [history.present];
        let at = 0;
        for (const step of steps) {
          if (step === "go") {
            const next = { measurements: [], draft: { kind: "area" as const, vertices: [] } };
            history.go(next);
            known.splice(at + 1, known.length, next);
            at++;
          } else if (step === "undo") {
            expect(history.undo()).toBe(at > 0);
            at = Math.max(0, at - 1);
          } else {
            expect(history.redo()).toBe(at < known.length - 1);
            at = Math.min(known.length - 1, at + 1);
          }
          expect(history.present).toBe(known[at]);
          expect([history.canUndo, history.canRedo]).toEqual([at > 0, at < known.length - 1]);
        }
      }),
    );
  });

  it("adds each measurement under an id of its own, those of one file too", () => {
    const all = withAdded([line], [line, { ...line, id: "2" }, { ...line, id: "2", name: "Line 3" }]);
    expect(all.map(({ name }) => name)).toEqual(["Line 1", "Line 1", "Line 1", "Line 3"]);
    expect([all[0]!.id, all[2]!.id, new Set(all.map(({ id }) => id)).size]).toEqual(["1", "2", 4]);
  });

  it("has no step for a figure without a vertex", () => {
    const history = new History();
    history.go({ measurements: [line], draft: undefined });
    history.begin("area");
    expect(history.present).toEqual({ measurements: [line], draft: { kind: "area", vertices: [] } });
    history.giveUp();
    expect(history.undo()).toBe(true);
    expect([history.present, history.canUndo]).toEqual([{ measurements: [], draft: undefined }, false]);
    expect(history.redo()).toBe(true);
    expect(history.present).toEqual({ measurements: [line], draft: undefined });
  });

  it("has other vertices throughout once a data set is opened anew", () => {
    const history = new History();
    history.go({ measurements: [line], draft: undefined });
    history.go({
      measurements: withChange([line], "1", { vertices: [a, d] }),
      draft: { kind: "point", vertices: [b] },
    });
    history.undo();
    history.replaceVertices((vertex) => (vertex === a ? c : vertex));
    expect(history.present.measurements[0].vertices).toEqual([c, b, c]);
    history.redo();
    expect(history.present.measurements[0].vertices).toEqual([c, d]);
    expect(history.present.draft?.vertices).toEqual([b]);
  });

  it("ends a figure in one place twice, at the beginning of an area, and with its last vertex", () => {
    const [p, q, r] = [a, b, c].map((vertex, index) => ({ ...vertex, record: { ...vertex.record!, index } }));
    expect(grown({ kind: "polyline", vertices: [p, q] }, q)).toEqual({ vertices: [p, q], ends: true });
    expect(grown({ kind: "area", vertices: [p, q, r] }, p)).toEqual({ vertices: [p, q, r], ends: true });
    expect(grown({ kind: "polyline", vertices: [p, q, r] }, p).vertices.length).toBe(4);
    expect(grown({ kind: "area", vertices: [p, q] }, r)).toEqual({ vertices: [p, q, r], ends: false });
    expect(grown({ kind: "distance", vertices: [p] }, q)).toEqual({ vertices: [p, q], ends: true });
  });

  it("gives names that are free", () => {
    expect(freshName([line], "Line")).toBe("Line 2");
    expect(freshName([line], "Area")).toBe("Area 1");
  });
});

describe("rings around a pole", () => {
  /** Mercator, ten pixels a degree, the world nearest to a place. */
  const mercator = ({ longitude, latitude }: Vertex, near?: ScreenPoint): ScreenPoint => {
    const x = (1800 * longitude) / Math.PI;
    const turns = near ? Math.round((near.x - x) / 3600) : 0;
    return { x: x + 3600 * turns, y: (-1800 / Math.PI) * Math.log(Math.tan(Math.PI / 4 + latitude / 2)) };
  };
  const wayOfRing = (vertices: readonly Vertex[]) => {
    let near: ScreenPoint | undefined;
    return [...vertices, vertices[0]!].map((vertex) => {
      near = mercator(vertex, near);
      return near;
    });
  };

  it.each([75, -75])("enclose what lies between them and the pole: %d°", (latitude) => {
    const cap = [0, 120, 240].map((longitude) =>
      placeVertex((longitude * Math.PI) / 180, (latitude * Math.PI) / 180, 0),
    );
    const inside = aroundPole(cap, wayOfRing(cap), mercator)!;
    const ys = inside.map(({ y }) => y);
    const xs = inside.map(({ x }) => x);
    expect([Math.min(...xs), Math.max(...xs)]).toEqual([expect.closeTo(0, 6), expect.closeTo(3600, 6)]);
    expect(latitude > 0 ? Math.min(...ys) < -1e4 : Math.max(...ys) > 1e4).toBe(true);
    expect(latitude > 0 ? Math.max(...ys) < 0 : Math.min(...ys) > 0).toBe(true);
  });

  it("are rings like any other where they come back to where they began", () => {
    const ring = [a, b, d];
    expect(aroundPole(ring, wayOfRing(ring), mercator)).toBeUndefined();
    expect(aroundPole(ring, [undefined], mercator)).toBeUndefined();
  });
});

describe("values that are known", () => {
  it("are worked out once for a measurement, and anew where its vertices or what is known of points change", () => {
    let asked = 0;
    const counted = (): WorthOptions => ({
      precision: () => {
        asked++;
        return 0.01;
      },
    });
    const known = new KnownValues(counted());
    const first = known.of(line);
    const once = asked;
    expect(known.of(line)).toBe(first);
    expect(asked).toBe(once);
    expect(known.of({ ...line, vertices: [a, c] })).not.toBe(first);
    known.worth = counted();
    expect(known.of(line)).not.toBe(first);
    expect(known.of(line)).toEqual(first);
    // Why there is none is worked out once too.
    const bow: Measurement = { id: "2", kind: "circle", name: "Circle 1", vertices: [a, b, a] };
    const thrown = [1, 2].map(() => {
      try {
        return known.of(bow);
      } catch (error) {
        return error;
      }
    });
    expect(thrown[0]).toBeInstanceOf(MeasureError);
    expect(thrown[1]).toBe(thrown[0]);
  });
});

describe("what a tool is given", () => {
  it.each<[string, () => void, string]>([
    ["a kind that there is not", () => checkKind("nope" as never), "MEASURE_OPTION"],
    ["a kind by inheritance", () => checkKind("toString" as never), "MEASURE_OPTION"],
    [
      "a measurement of no kind",
      () => checkMeasurement({ ...line, kind: "nope" as never }),
      "MEASURE_OPTION",
    ],
    ["a line of one vertex", () => checkMeasurement({ ...line, vertices: [a] }), "MEASURE_VERTICES"],
    ["no vertices", () => checkChange("area", { vertices: [] }, "Area 1"), "MEASURE_VERTICES"],
    ["too many", () => checkChange("angle", { vertices: [a, b, c, d] }, "Angle 1"), "MEASURE_VERTICES"],
    [
      "a height that is none",
      () => checkChange("volume", { volume: { base: { kind: "height", height: Number.NaN } } }, "Volume 1"),
      "MEASURE_OPTION",
    ],
  ])("is refused by name: %s", (_, check, code) => {
    expect(check).toThrow(new RegExp(`^${code}: .*([Gg]ive|[Uu]se|mean) `));
  });

  it("is taken where it is one", () => {
    checkMeasurement(line);
    checkChange(
      "volume",
      { name: "Heap", volume: { base: { kind: "height", height: 3 }, classes: [2] } },
      "Volume 1",
    );
  });

  it("is awaited until it is there, given up, or aborted with the reason", async () => {
    const [done, left, stopped] = [new AbortController(), new AbortController(), new AbortController()];
    const finished = new Awaited(done.signal, () => expect.unreachable());
    finished.resolve(line);
    done.abort();
    expect(await finished.done).toBe(line);
    const givenUp = new Awaited(left.signal, () => undefined);
    givenUp.resolve(undefined);
    expect(await givenUp.done).toBeUndefined();
    // Giving the figure up, as the tool does then, does not pass for the reader's Escape.
    const aborted: Awaited = new Awaited(stopped.signal, () => aborted.resolve(undefined));
    stopped.abort(new Error("mid"));
    await expect(aborted.done).rejects.toThrow("mid");
  });
});

const inCloud = (of: readonly number[]) => sourceVertex(cloud, [of[0]!, of[1]!, of[2]!]);
const NOTHING = { vertices: [], edges: [] };

/** A view that shows vertices where it is told, and finds points one pick after the other. */
function viewOf(
  picks: readonly (Promise<Vertex | undefined> | undefined)[],
  shown = new Map<Vertex, ScreenPoint>(),
) {
  let next = 0;
  const view: Pick<ViewAdapter, "pick" | "project"> = {
    pick: async () => picks[next++],
    project: (vertex) => shown.get(vertex),
  };
  return new Placing(view as ViewAdapter, { last: Promise.resolve() }, new AbortController().signal);
}

describe("placing", () => {
  it("keeps the order of clicks, however long their records take", async () => {
    let first: (vertex: Vertex) => void = () => undefined;
    const placing = viewOf([new Promise((resolve) => (first = resolve)), Promise.resolve(b)]);
    const placed: (Vertex | undefined)[] = [];
    const both = [1, 2].map((x) => placing.place({ x, y: 0 }, NOTHING, (vertex) => placed.push(vertex)));
    await Promise.resolve();
    first(a);
    await Promise.all(both);
    expect(placed).toEqual([a, b]);
  });

  it("goes on after one that failed", async () => {
    const placing = viewOf([Promise.reject(new Error("offline")), Promise.resolve(b)]);
    const placed: (Vertex | undefined)[] = [];
    const work = (vertex: Vertex | undefined) => placed.push(vertex);
    const [first, second] = [
      placing.place({ x: 0, y: 0 }, NOTHING, work),
      placing.place({ x: 1, y: 0 }, NOTHING, work),
    ];
    await expect(first).rejects.toThrow("offline");
    await second;
    expect(placed).toEqual([b]);
  });

  it("takes a vertex that is there, and the nearest of several", async () => {
    const shown = new Map([
      [a, { x: 100, y: 100 }],
      [b, { x: 104, y: 100 }],
    ]);
    const placing = viewOf([Promise.resolve(d)], shown);
    const near = { vertices: [a, b, c], edges: [] };
    expect(await placing.look({ x: 103, y: 100 }, near)).toBe(b);
    expect(await placing.look({ x: 150, y: 100 }, near)).toBe(d);
  });

  it("knows a record again", () => {
    expect(isSame(a, { ...a })).toBe(true);
    expect(isSame(a, { ...a, record: { ...a.record!, index: 7 } })).toBe(false);
  });
});

describe("figures", () => {
  const showing = {
    ...{ edited: undefined, drag: undefined, ahead: undefined, missed: false },
    ...{
      ...{ units: new MeasureUnits({ locale: "en" }), words: measureWords() },
      worth: { precision: 0.01 },
      valuesOf: (of: Measurement) => valuesOf(of, { precision: 0.01 }),
      readingOf: () => undefined,
    },
  };

  it("are labelled with their value and worth, or with what keeps them from having one", () => {
    const bow: Measurement = { id: "2", kind: "area", name: "Area 1", vertices: [a, c, b, d] };
    const crossed = [a, b, c, d].map((vertex, i) =>
      cloud.vertex(500000 + [0, 9, 9, 0][i], 5300000 + [0, 9, 0, 9][i], vertex.height),
    );
    const [one, other] = figuresOf(
      { measurements: [line, { ...bow, vertices: crossed }], draft: undefined },
      showing,
    );
    expect(one.label).toMatch(/^\d+\.\d+\sm\n± 0\.0\d+\sm$/);
    expect(other).toMatchObject({ wrong: true, label: expect.stringContaining("cross") });
  });

  it("show a vertex that is on its way, and in between where it comes to stand", () => {
    const drawn = { measurements: [line], draft: undefined };
    const moved = { grip: { id: "1", vertex: 1, between: false }, vertex: d };
    expect(figuresOf(drawn, { ...showing, edited: "1", drag: moved })[0].vertices).toEqual([a, d, c]);
    const added = { grip: { id: "1", vertex: 1, between: true }, vertex: d };
    expect(figuresOf(drawn, { ...showing, edited: "1", drag: added })[0].vertices).toEqual([a, b, d, c]);
  });

  it("tell the value to come, and where there is no point", () => {
    const drawn = { measurements: [], draft: { kind: "distance" as const, vertices: [a] } };
    expect(figuresOf(drawn, showing)[0].label).toBe("");
    expect(figuresOf(drawn, { ...showing, ahead: b })[0].label).toContain("m\n± ");
    expect(figuresOf(drawn, { ...showing, missed: true })[0]).toMatchObject({
      label: "no point here",
      wrong: true,
    });
  });
});

describe("edges", () => {
  /** A view from above, in perspective: what lies to the north is farther away. */
  const from: ViewAdapter["project"] = ({ ecef }) => {
    const [x, y] = [0, 1].map(
      (axis) =>
        (ecef[0] - a.ecef[0]) * EAST[axis]! +
        (ecef[1] - a.ecef[1]) * NORTH[axis]! +
        (ecef[2] - a.ecef[2]) * UP[axis]!,
    ) as [number, number];
    const away = 1 + 0.05 * y;
    return { x: 100 + (10 * x) / away, y: 200 - (10 * y) / away };
  };
  // Axes of the first vertex's horizon: east and north, per axis of ECEF.
  const { longitude: l, latitude: p } = a;
  const EAST = [-Math.sin(l), -Math.sin(p) * Math.cos(l)];
  const NORTH = [Math.cos(l), -Math.sin(p) * Math.sin(l)];
  const UP = [0, Math.cos(p)];
  const view = { pick: async () => undefined, project: from } as unknown as ViewAdapter;
  const edge: Measurement = { id: "3", kind: "distance", name: "Distance 1", vertices: [a, c] };

  it("are taken where there is no point, at the place that is seen there", async () => {
    const snaps = snapsOf([edge], undefined);
    const placing = new Placing(view, { last: Promise.resolve() }, new AbortController().signal);
    for (const share of [0.2, 0.5, 0.85]) {
      const truth = [0, 1, 2].map((axis) => a.source![axis]! + share * (c.source![axis]! - a.source![axis]!));
      const at = from(inCloud(truth))!;
      const found = await placing.look({ x: at.x, y: at.y }, snaps);
      for (const axis of [0, 1, 2]) expect(found!.source![axis]!).toBeCloseTo(truth[axis]!, 1);
      // It is a place of the data set, and no record of it.
      expect([found!.cloud, found!.record]).toEqual([cloud, undefined]);
    }
    const far = from(b)!;
    expect(await placing.look({ x: far.x + 40, y: far.y }, snaps)).toBeUndefined();
  });

  it("of what is being moved are not taken, and points go before them", async () => {
    expect(snapsOf([edge], undefined, a)).toEqual({ vertices: [c], edges: [] });
    const ring: Measurement = { ...edge, kind: "area", vertices: [a, b, c] };
    expect(snapsOf([ring], undefined).edges).toEqual([
      [a, b],
      [b, c],
      [c, a],
    ]);
    expect(snapsOf([{ ...edge, kind: "point", vertices: [a] }], undefined).edges).toEqual([]);
    const seen = { ...view, pick: async () => d } as unknown as ViewAdapter;
    const placing = new Placing(seen, { last: Promise.resolve() }, new AbortController().signal);
    const middle = from(inCloud([0, 1, 2].map((axis) => (a.source![axis]! + c.source![axis]!) / 2)))!;
    expect(await placing.look(middle, snapsOf([edge], undefined))).toBe(d);
  });
});
