import fc from "fast-check";
import { describe, expect, it } from "vitest";
import {
  decodeTransformation,
  encodeTransformation,
  type GridWindow,
  RecordError,
  type ShiftStep,
  type Step,
  type Transformation,
} from "../index.js";

const number = fc.double({ noNaN: true, noDefaultInfinity: true, min: -1e9, max: 1e9 });
const positive = fc.double({ noNaN: true, min: 1e-9, max: 1e9 });
const axes = fc.record({ a: positive, f: fc.double({ noNaN: true, min: 0, max: 0.5 }) });

/** Values as grids have them: decimals, any bits, or with nodes without data. */
const value = (decimals: number) =>
  fc.oneof(
    fc.integer({ min: -99999, max: 99999 }).map((integer) => integer / 10 ** decimals),
    fc.constant(0),
  );
const anyValue = fc.oneof(fc.float(), fc.constantFrom(Number.NaN, -0, -32768, Number.POSITIVE_INFINITY));

const gridWindow: fc.Arbitrary<GridWindow> = fc
  .record({
    columns: fc.integer({ min: 2, max: 9 }),
    rows: fc.integer({ min: 2, max: 9 }),
    channels: fc.integer({ min: 2, max: 4 }),
    content: fc.oneof(fc.constant(anyValue), fc.integer({ min: 0, max: 5 }).map(value)),
  })
  .chain(({ columns, rows, channels, content }) =>
    fc.record({
      grid: fc.string({ unit: "grapheme", maxLength: 30 }),
      west: number,
      south: number,
      stepLongitude: positive,
      stepLatitude: positive,
      columns: fc.constant(columns),
      rows: fc.constant(rows),
      channels: fc.constant(channels),
      values: fc
        .array(content, { minLength: columns * rows * channels, maxLength: columns * rows * channels })
        .map((values) => Float32Array.from(values)),
      unit: positive,
      noData: fc.constant(-32768),
    }),
  );

const patch = fc
  .record({
    minX: number,
    minY: number,
    width: positive,
    height: positive,
    degree: fc.integer({ min: 1, max: 8 }),
  })
  .chain(({ minX, minY, width, height, degree }) => {
    const terms = 2 * (degree + 1) ** 2;
    const coefficients = fc.array(number, { minLength: terms, maxLength: terms });
    // Widths below the spacing of doubles would leave no area.
    const [maxX, maxY] = [minX + Math.max(width, 1e-3), minY + Math.max(height, 1e-3)];
    return coefficients.map((all) => ({
      minX,
      minY,
      maxX,
      maxY,
      degree,
      coefficients: Float64Array.from(all),
    }));
  });

const shift: fc.Arbitrary<ShiftStep> = fc.oneof(
  fc.record({ kind: fc.constant("height" as const), metresPerUnit: positive }),
  fc.record({
    kind: fc.constant("horizontalShift" as const),
    direction: fc.constantFrom("forward" as const, "inverse" as const),
    window: gridWindow,
  }),
  fc.record({ kind: fc.constant("verticalShift" as const), multiplier: number, window: gridWindow }),
  fc.record({
    kind: fc.constant("datumShift" as const),
    from: axes,
    to: axes,
    translation: fc.tuple(number, number, number),
    matrix: fc.array(number, { minLength: 9, maxLength: 9 }),
    keepHeight: fc.boolean(),
  }),
);

const way = fc
  .record({ minX: number, minY: number, steps: fc.array(shift, { maxLength: 3 }) })
  .map(({ minX, minY, steps }) => ({
    area: { minX, minY, maxX: minX + 1 + Math.abs(minX), maxY: minY + 1 + Math.abs(minY) },
    steps,
  }));
const choice: fc.Arbitrary<Step> = fc.record({
  kind: fc.constant("choice" as const),
  ways: fc.array(way, { minLength: 1, maxLength: 3 }),
});

const transformation: fc.Arbitrary<Transformation> = fc
  .record({
    patches: fc.array(patch, { minLength: 1, maxLength: 4 }),
    bound: positive,
    centre: fc.option(
      fc.tuple(
        fc.double({ min: -7, max: 7, noNaN: true }),
        fc.double({ min: -Math.PI / 2, max: Math.PI / 2, noNaN: true }),
      ),
      { nil: undefined },
    ),
    choice: fc.option(choice, { nil: undefined }),
    others: fc.array(shift, { maxLength: 4 }),
    ellipsoid: axes,
  })
  .map(({ patches, bound, centre, choice, others, ellipsoid }) => ({
    steps: [
      { kind: "projection", patchwork: { patches, bound, ...(centre && { centre }) } },
      ...(choice ? [choice] : []),
      ...others,
      { kind: "geocentric", ellipsoid },
    ],
  }));

function codeOf(bytes: Uint8Array): string | undefined {
  try {
    decodeTransformation(bytes, "hostile.copc.laz");
    return undefined;
  } catch (error) {
    if (error instanceof RecordError) return error.code;
    throw error;
  }
}

describe("encoded transformation", () => {
  it("comes back bit for bit", () => {
    fc.assert(
      fc.property(transformation, (given) => {
        expect(decodeTransformation(encodeTransformation(given), "file")).toEqual(given);
      }),
      { numRuns: 200, seed: 4 },
    );
  });

  it("is refused by name when it ends early, at whatever byte", () => {
    fc.assert(
      fc.property(transformation, fc.nat(), (given, at) => {
        const bytes = encodeTransformation(given);
        expect(codeOf(bytes.slice(0, at % bytes.length))).toBe("RECORD_TRUNCATED");
        expect(codeOf(Uint8Array.of(...bytes, 0))).toBe("RECORD_INVALID");
      }),
      { numRuns: 200, seed: 5 },
    );
  });

  it("is read or refused by name, whatever its bytes", () => {
    fc.assert(
      fc.property(
        transformation,
        fc.array(fc.tuple(fc.nat(), fc.nat(255)), { minLength: 1, maxLength: 5 }),
        (given, changes) => {
          const bytes = encodeTransformation(given);
          for (const [at, byte] of changes) bytes[at % bytes.length] = byte;
          expect([undefined, "RECORD_INVALID", "RECORD_TRUNCATED", "RECORD_VERSION"]).toContain(
            codeOf(bytes),
          );
        },
      ),
      { numRuns: 500, seed: 6 },
    );
    expect(codeOf(new Uint8Array(0))).toBe("RECORD_TRUNCATED");
    expect(codeOf(new TextEncoder().encode("GTRF\x02\x01"))).toBe("RECORD_VERSION");
    expect(codeOf(new TextEncoder().encode("LASF_Projection"))).toBe("RECORD_INVALID");
    expect(codeOf(new TextEncoder().encode("GTRF\x01\x00"))).toBe("RECORD_INVALID");
  });

  it("does not allocate what its bytes cannot hold", () => {
    const steps: Step[] = [
      {
        kind: "projection",
        patchwork: {
          patches: [{ minX: 0, minY: 0, maxX: 1, maxY: 1, degree: 1, coefficients: new Float64Array(8) }],
          bound: 1e-5,
        },
      },
      { kind: "geocentric", ellipsoid: { a: 1, f: 0 } },
    ];
    const window = {
      grid: "g",
      west: 0,
      south: 0,
      stepLongitude: 1,
      stepLatitude: 1,
      columns: 2,
      rows: 2,
      channels: 1,
    };
    const shift: Step = {
      kind: "verticalShift",
      multiplier: 1,
      window: { ...window, values: new Float32Array(4), unit: 1 },
    };
    const bytes = encodeTransformation({ steps: [steps[0], shift, steps[1]] });
    const at = bytes.findLastIndex((byte, i) => byte === 2 && bytes[i + 4] === 2);
    new DataView(bytes.buffer).setUint32(at, 0xffffffff, true);
    new DataView(bytes.buffer).setUint32(at + 4, 0xffffffff, true);
    expect(codeOf(bytes)).toBe("RECORD_TRUNCATED");
  });
});
