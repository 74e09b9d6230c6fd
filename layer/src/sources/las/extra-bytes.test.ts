import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { parseExtraBytes } from "./extra-bytes.js";

interface Descriptor {
  readonly code: number;
  readonly options?: number;
  readonly name?: string;
  readonly scale?: number;
  readonly offset?: number;
  readonly noData?: bigint;
  readonly noDataFloat?: number;
}

function bytesOf(...descriptors: readonly Descriptor[]): Uint8Array {
  const bytes = new Uint8Array(192 * descriptors.length);
  descriptors.forEach((given, index) => {
    const view = new DataView(bytes.buffer, 192 * index);
    bytes.set([given.code, given.options ?? 0], 192 * index + 2);
    bytes.set(new TextEncoder().encode(given.name ?? ""), 192 * index + 4);
    bytes.set(new TextEncoder().encode("what it is"), 192 * index + 160);
    view.setBigInt64(40, given.noData ?? 0n, true);
    if (given.noDataFloat !== undefined) view.setFloat64(40, given.noDataFloat, true);
    view.setFloat64(112, given.scale ?? 99, true);
    view.setFloat64(136, given.offset ?? 99, true);
  });
  return bytes;
}

describe("parseExtraBytes", () => {
  it("reads names that are not UTF-8 as Latin-1, so that different names stay different", () => {
    const named = (...name: number[]) => {
      const bytes = bytesOf({ code: 9 });
      bytes.set(name, 4);
      return parseExtraBytes(bytes, 4)[0]?.name;
    };
    expect(named(0x48, 0xf6, 0x68, 0x65)).toBe("Höhe");
    expect(named(0x48, 0xf5, 0x68, 0x65)).toBe("Hõhe");
    expect(named(0x80)).toBe("\u0080");
    expect(named(0x48, 0xc3, 0xb6)).toBe("Hö");
  });

  it("reads types, places, scales, offsets and what means no value", () => {
    const found = parseExtraBytes(
      bytesOf(
        { code: 9, name: "height" },
        { code: 0, options: 5, name: "undocumented" },
        { code: 4, name: "scaled", options: 8 + 16 + 1, scale: 0.5, offset: -2, noData: -9999n },
        { code: 13, name: "pair" },
        { code: 7, name: "id", options: 1, noData: -1n },
        { code: 10, name: "exact", options: 1, noDataFloat: -1.5 },
      ),
      100,
    );
    expect(found.map(({ name, type, at, components }) => [name, type, at, components])).toEqual([
      ["height", "float32", 0, 1],
      ["scaled", "int16", 9, 1],
      ["pair", "uint16", 11, 2],
      ["id", "uint64", 15, 1],
      ["exact", "float64", 23, 1],
    ]);
    expect(found[0]).toMatchObject({ scale: [1, 1, 1], offset: [0, 0, 0], description: "what it is" });
    expect(found[1].scale[0]).toBe(0.5);
    expect(found[1].offset[0]).toBe(-2);
    expect(found.map(({ noData }) => noData)).toEqual([undefined, -9999, undefined, 2n ** 64n - 1n, -1.5]);
  });

  it("ends where a record has no more bytes, and at types that no standard knows", () => {
    expect(parseExtraBytes(bytesOf({ code: 9 }, { code: 9 }), 7)).toHaveLength(1);
    expect(parseExtraBytes(bytesOf({ code: 1 }, { code: 31 }, { code: 1 }), 9)).toHaveLength(1);
    expect(parseExtraBytes(bytesOf({ code: 1 }).subarray(0, 191), 9)).toHaveLength(0);
  });

  it("takes a scale that is no number for none, and stands any bytes", () => {
    const [odd] = parseExtraBytes(bytesOf({ code: 3, options: 8, scale: Number.NaN }), 2);
    expect(odd.scale[0]).toBe(1);
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 600 }), fc.nat(64), (bytes, available) => {
        for (const { at, scale } of parseExtraBytes(bytes, available)) {
          expect(at).toBeLessThan(available);
          expect(scale.every(Number.isFinite)).toBe(true);
        }
      }),
    );
  });
});
