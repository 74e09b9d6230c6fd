import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { planAttribute } from "./attribute-columns.js";
import { layOut } from "./column-plan.js";
import type { Column, RecordedNode } from "./protocol.js";
import { extraBytes, randomNumbers, randomRecords } from "./record.fixture.js";
import { colourBits, recordedColumn } from "./record-columns.js";

const EXTRA = extraBytes({ name: "id", type: "uint64" }, { name: "exact", type: "float64" });
const SPEC = { scale: [0.01, 0.01, 0.01], offset: [0, 0, 400], rgbBits: 16, ranges: undefined } as const;

/** Value of a point by a column. */
function valueAt({ data, scale, offset, constant, components }: Column, point: number, part: number): number {
  return constant ? constant[part]! : data[components * point + part]! * scale + offset;
}

describe("columns of some of a node's points", () => {
  it("have of each point what the column of all has", () => {
    const cases = fc.tuple(fc.integer(), fc.integer({ min: 1, max: 30 }), fc.nat());
    fc.assert(
      fc.property(cases, ([seed, count, chosen]) => {
        const { attributes, view, recordLength } = randomRecords(7, count, EXTRA, randomNumbers(seed));
        // One class in the first points alone: it is no constant of those that follow.
        for (let point = 0; point < count; point++)
          view.setUint8(point * recordLength + 16, point < count / 2 ? 2 : 6);
        const xyz = Int32Array.from({ length: 3 * count }, (_, at) =>
          view.getInt32(Math.floor(at / 3) * recordLength + 4 * (at % 3), true),
        );
        const records: RecordedNode = { count, xyz, attributes };
        const some = Uint32Array.from({ length: count }, (_, point) => point).filter(
          (point) => ((chosen >> (point % 16)) & 1) === 1 || point === count - 1,
        );
        const all = { count, order: Uint32Array.from({ length: count }, (_, point) => point) };
        for (const attribute of attributes) {
          if (["red", "green", "blue"].includes(attribute.name)) continue;
          let whole: Column | undefined;
          const planned = planAttribute(all, attribute, undefined, (column) => {
            whole = column;
          });
          if (planned) layOut([planned]);
          const column = recordedColumn(attribute.name, records, some, SPEC)!;
          for (const [at, point] of some.entries()) {
            expect(valueAt(column, at, 0)).toBe(valueAt(whole!, point, 0));
          }
        }
        const elevation = recordedColumn("elevation", records, some, SPEC)!;
        for (const [at, point] of some.entries()) {
          expect(valueAt(elevation, at, 0)).toBeCloseTo(xyz[3 * point + 2]! * 0.01 + 400, 4);
        }
        const rgb = recordedColumn("rgb", records, some, { ...SPEC, rgbBits: colourBits(records) })!;
        const red = attributes.find(({ name }) => name === "red")!;
        for (const [at, point] of some.entries()) {
          const bits = red.bytes[point * red.stride + red.at + (colourBits(records) === 16 ? 1 : 0)];
          expect(valueAt(rgb, at, 0)).toBe(bits);
        }
        expect(recordedColumn("no such attribute", records, some, SPEC)).toBeUndefined();
      }),
      { numRuns: 60 },
    );
  });
});
