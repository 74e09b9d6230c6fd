import { geodeticToEcef } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { random } from "../../../georef/src/cartesian/points.fixture.js";
import { OFFSET } from "../effects/index.js";
import { recordNumbers } from "../query/index.js";
import type { ProfilePoints } from "../tools/cut/profile.js";
import { geodeticOf, type PlottedCloud, SectionVertices } from "./section-vertices.js";

const SCALE = [0.001, 0.001, 0.001] as const;

/** A scan over a geoid that leans and bends, along and across the line. */
const cloud: PlottedCloud = {
  name: "scan",
  attributes: [],
  scale: SCALE,
  offset: [0, 0, 0],
  bounds: { x: 0, y: 0, z: 0, radius: 1000, spacing: 8 },
  appearance: undefined,
  place(x: number, y: number, z: number, out = new Float64Array(3)) {
    geodeticToEcef(0.1 + x / 6.4e6, 0.8 + y / 6.4e6, z + 40 + 1e-4 * x + 3e-5 * y + 2e-8 * x * x, out);
    return out;
  },
};

/** Points of a strip 200 m wide along the x axis, 2 km long. */
function strip(count: number): ProfilePoints {
  const next = random(17);
  const xyz = Int32Array.from({ length: 3 * count }, (_, i) =>
    Math.round([2e6, 2e5, 5e4][i % 3]! * next() - [0, 1e5, 0][i % 3]!),
  );
  const column = (axis: number) => Float64Array.from({ length: count }, (_, i) => xyz[3 * i + axis]! / 1000);
  const batch = {
    ...{ node: "0-0-0-0", key: { depth: 0, x: 0, y: 0, z: 0 } },
    records: { count, xyz, attributes: [] },
    inside: Uint32Array.from({ length: count }, (_, i) => i),
  } as unknown as ProfilePoints["batch"];
  return { batch, chainage: column(0), offset: column(1), height: column(2) };
}

describe("the columns of a section", () => {
  it.each([1, 50, 5000])("say how far they are from the records' values, of %i points", (count) => {
    const points = strip(count);
    const { columns } = new SectionVertices(cloud, points, () => 8);
    const geodetic = geodeticOf(cloud);
    const exact = recordNumbers("ellipsoidalHeight", points.batch.records, cloud, geodetic)!;
    for (const [name, value, most] of [
      ["ellipsoidalHeight", exact.value, 0.05],
      [OFFSET, (index: number) => points.offset[index]!, 1e-5],
    ] as const) {
      const { data, offset, bound } = columns.get(name)!;
      const errors = Array.from(data, (stored, index) => Math.abs(stored + offset - value(index)));
      expect(Math.max(...errors)).toBeLessThanOrEqual(bound);
      expect(bound).toBeLessThan(most);
    }
  });
});
