import { decode } from "fast-png";
import { expect, it } from "vitest";
import { OFFSET } from "../effects/index.js";
import { richFacts, styleOf } from "../effects/scene.fixture.js";
import { Corridor } from "../tools/profile/corridor.js";
import { MemorySink } from "./byte-sink.js";
import { exportPicture } from "./documents.js";
import { narrowed } from "./narrowed.js";
import { scanOf } from "./scan.fixture.js";

const line = new Corridor(
  [
    [0, 0],
    [100, 0],
  ],
  4,
);
/** Points every 10 m: class 2 on the left of the line, class 6 on its right. */
const points = Array.from({ length: 10 }, (_, step) => ({
  xyz: [1000 * step + 200, step % 2 === 0 ? 100 : -100, 300 + 10 * step] as const,
  classification: step % 2 === 0 ? 2 : 6,
  colour: [40, 50, 60] as const,
}));
const UNIT = { text: "m", size: 1 };

/** Colours that the picture of the profile has, each once. */
async function colours(paint: object | undefined, classes?: number[]): Promise<string[]> {
  const sink = new MemorySink();
  const origin = scanOf(points);
  const selection = await narrowed({ origin, volume: line, along: line }, { filter: classes && { classes } });
  const facts = { title: "paint", unit: UNIT, heightUnit: UNIT };
  await exportPicture([selection], sink, { facts, format: "svg", scale: 200, paint: paint as never });
  const svg = new TextDecoder().decode(sink.bytes());
  const found = new Set<string>();
  for (const [, base64] of svg.matchAll(/data:image\/png;base64,([^"]+)/g)) {
    const { data, width, height } = decode(Uint8Array.from(atob(base64!), (one) => one.charCodeAt(0)));
    for (let at = 0; at < 4 * width * height; at += 4) {
      if (data[at + 3]! > 0) found.add([...data.subarray(at, at + 3)].join());
    }
  }
  return [...found].sort();
}

it("pictures on paper have the colours of a layer's style, and what its filter leaves", async () => {
  const { attributes } = richFacts();
  const classes = { ...styleOf().classes, 2: { name: "ground", color: [1, 0, 0], show: true } } as const;
  const byClass = { style: styleOf({ color: "classification", classes }), attributes };
  expect(await colours(undefined)).toEqual(["40,50,60"]);
  expect(await colours(byClass)).toEqual(["224,130,20", "255,0,0"]);
  expect(await colours(byClass, [6])).toEqual(["224,130,20"]);
  const gradient = [
    { at: 0, color: [0, 0, 1] },
    { at: 1, color: [0, 1, 0] },
  ] as const;
  const sides = { name: OFFSET, kind: "scalar", range: [-1, 1] } as const;
  const bySide = { style: styleOf({ color: OFFSET, gradient }), attributes: [sides, ...attributes] };
  expect(await colours(bySide)).toEqual(["0,0,255", "0,255,0"]);
  // Heights of 3 to 3.9 m in a range from there on, ten shades; and of the scan's own colours three fifths.
  const byHeight = styleOf({ color: "elevation", gradient, range: [3, 3.9] });
  expect((await colours({ style: byHeight, attributes })).length).toBe(10);
  const blend = { color: "classification", share: 0.4 };
  const mixed = { style: styleOf({ color: "rgb", blend, classes }), attributes };
  expect(await colours(mixed, [2])).toEqual(["126,30,36"]);
});
