import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { type DrawnPoints, isConstant, planAttribute } from "./attribute-columns.js";
import { layOut } from "./column-plan.js";
import { coloursOf, greatestColour, planColour } from "./derived-columns.js";
import type { Column } from "./protocol.js";
import { extraBytes, randomNumbers, randomRecords } from "./record.fixture.js";
import { exactValue, type StoredAttribute } from "./stored-attribute.js";

type Records = ReturnType<typeof randomRecords>;

/** Drawn last first. */
const reversed = ({ count }: Records): DrawnPoints => ({
  count,
  order: Uint16Array.from({ length: count }, (_, point) => count - 1 - point),
});

/** Column of one attribute. */
function columnOf(records: Records, attribute: StoredAttribute, origin?: number): Column {
  const made: Column[] = [];
  const planned = planAttribute(reversed(records), attribute, origin, (column) => made.push(column));
  if (planned) layOut([planned]);
  return made[0];
}

/** Value of a drawn point by the column; NaN where it has none. */
function columnValue(
  { data, scale, offset, constant, noData, components }: Column,
  point: number,
  component: number,
) {
  if (constant) return constant[component];
  const stored = data[components * point + component];
  return stored === noData ? Number.NaN : stored * scale + offset;
}

const every = extraBytes(
  { name: "height", type: "float32" },
  { name: "thousandths", type: "int16", scale: [0.001, 0.001, 0.001], offset: [5, 5, 5], noData: -7 },
  { name: "count", type: "uint32" },
  { name: "signed", type: "int32", scale: [0.01, 0.01, 0.01], offset: [-3, -3, -3] },
  { name: "id", type: "uint64" },
  { name: "balance", type: "int64", scale: [1e-6, 1e-6, 1e-6] },
  { name: "exact", type: "float64" },
  { name: "tiny", type: "int8" },
  { name: "pair", type: "uint8", components: 2 },
  { name: "normal", type: "int16", components: 3, scale: [0.1, 0.2, 0.3] },
  { name: "intensity", type: "uint8" },
  { name: "", type: "uint8" },
);

describe("columns of recorded attributes", () => {
  it.each([6, 7, 8])("hold every attribute of format %i within their bound", (pointFormat) => {
    fc.assert(
      fc.property(fc.integer(), fc.integer({ min: 1, max: 40 }), (seed, count) => {
        const records = randomRecords(pointFormat, count, every, randomNumbers(seed));
        for (const attribute of records.attributes) {
          const column = columnOf(records, attribute);
          for (let point = 0; point < count; point++) {
            const record = count - 1 - point;
            for (let component = 0; component < attribute.components; component++) {
              const exact = Number(exactValue(attribute, record, component));
              const value = columnValue(column, point, component);
              // What is not finite has no value that a GPU could show.
              if (Number.isFinite(exact)) {
                expect(Math.abs(value - exact), attribute.name).toBeLessThanOrEqual(column.bound);
              } else if (!column.constant) expect(value, attribute.name).toBeNaN();
            }
          }
        }
      }),
      { numRuns: 40 },
    );
  });

  it("are exact up to 16 bits and as float32, and count wider numbers from the data set's least", () => {
    const records = randomRecords(6, 50, every, randomNumbers(7));
    const column = (name: string, origin?: number) =>
      columnOf(records, records.attributes.find((attribute) => attribute.name === name)!, origin);
    for (const name of ["intensity", "scanAngle", "thousandths", "height", "flags"]) {
      expect(column(name).bound, name).toBe(0);
    }
    expect(column("scanAngle")).toMatchObject({ scale: 0.006, data: expect.any(Int16Array) });
    expect(column("thousandths")).toMatchObject({ scale: 0.001, offset: 5, noData: -7 });
    const time = column("gpsTime", 2.9e8);
    expect([time.offset, time.data.constructor]).toEqual([2.9e8, Float32Array]);
    // Thirty million seconds in 24 bits.
    expect(time.bound).toBeGreaterThan(0.1);
    expect(time.bound).toBeLessThanOrEqual(2.001);
  });

  it("keep names apart: those taken get a number, those missing their place", () => {
    const { attributes } = randomRecords(7, 1, every, randomNumbers(1));
    expect(attributes.slice(-2).map(({ name }) => name)).toEqual(["intensity 2", "extra 12"]);
  });

  it("take nothing where all points have one value, and say which", () => {
    const records = randomRecords(7, 30, every, randomNumbers(3));
    for (let record = 0; record < 30; record++) {
      const at = record * records.recordLength;
      records.view.setUint16(at + 12, 770, true);
      // Returns share a byte: 2 of whatever.
      records.bytes[at + 14] = (records.bytes[at + 14] & 0xf0) | 2;
      records.view.setInt16(at + 36 + 4, -7, true);
    }
    const column = (name: string) =>
      columnOf(records, records.attributes.find((attribute) => attribute.name === name)!);
    expect(column("intensity")).toMatchObject({ constant: [770], bound: 0, data: new Uint8Array(0) });
    expect(column("returnNumber").constant).toEqual([2]);
    expect(column("numberOfReturns").constant).toBeUndefined();
    expect(column("thousandths").constant).toEqual([Number.NaN]);
  });

  it("are found constant only where every record says so", () => {
    const one = (records: Records) => isConstant(records.count, records.attributes[0]);
    const records = randomRecords(6, 9, [], randomNumbers(5));
    for (let record = 0; record < 9; record++) records.view.setUint16(30 * record + 12, 513, true);
    expect(one(records)).toBe(true);
    records.bytes[30 * 8 + 13] = 3;
    expect(one(records)).toBe(false);
  });
});

describe("the column of colours", () => {
  const colourOf = (records: Records, rgbBits: 8 | 16) => {
    const made: Column[] = [];
    const planned = planColour(reversed(records), coloursOf(records.attributes)!, rgbBits, (column) =>
      made.push(column),
    );
    if (planned) layOut([planned]);
    return made[0];
  };
  const painted = (colours: readonly number[][]) => {
    const records = randomRecords(7, colours.length, [], randomNumbers(2));
    colours.forEach((colour, record) => {
      for (const [channel, value] of colour.entries()) {
        records.view.setUint16(36 * record + 30 + 2 * channel, value, true);
      }
    });
    return records;
  };

  it("takes 8-bit colours as they are and the upper byte of 16-bit ones", () => {
    const records = painted([
      [1, 2, 255],
      [256, 511, 65535],
    ]);
    expect([...colourOf(records, 8).data]).toEqual([0, 255, 255, 255, 1, 2, 255, 255]);
    expect([...colourOf(records, 16).data]).toEqual([1, 1, 255, 255, 0, 0, 0, 255]);
    expect(greatestColour(2, coloursOf(records.attributes)!)).toBe(65535);
    expect(coloursOf(randomRecords(6, 2, [], randomNumbers(2)).attributes)).toBeUndefined();
  });

  it("is one colour where all points have it, as far as it is shown", () => {
    const records = painted([
      [256, 512, 0],
      [257, 513, 1],
    ]);
    expect(colourOf(records, 16).constant).toEqual([1, 2, 0, 255]);
    expect(colourOf(records, 8).constant).toBeUndefined();
  });
});
