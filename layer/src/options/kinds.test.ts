import fc from "fast-check";
import { describe, expect, it } from "vitest";
import {
  checkSignal,
  colour,
  either,
  flag,
  frozen,
  interval,
  type Kind,
  list,
  number,
  oneOf,
  type Place,
  parts,
  text,
  whole,
  withMethods,
} from "./index.js";

const place: Place = {
  name: "light",
  context: undefined,
  refuse: (cause, fix) => {
    throw new Error(`${cause}; ${fix}`);
  },
};
const read = <Value>(kind: Kind<Value>, given: unknown, present?: Value) => kind.read(given, place, present);

describe("kinds of values", () => {
  it.each<[string, Kind<unknown>, readonly unknown[], readonly unknown[]]>([
    [
      "number",
      number(-1, 2),
      [-1, 0, 2],
      [-1.001, 2.001, Number.NaN, Number.POSITIVE_INFINITY, "1", null, [1]],
    ],
    ["whole", whole(0, 255), [0, 255], [-1, 256, 0.5, Number.NaN, "0", true]],
    ["text", text, ["", "a"], [1, null, ["a"]]],
    ["flag", flag, [true, false], [0, 1, "true", null]],
    [
      "one of",
      oneOf<string | number | boolean>("a", 4, false),
      ["a", 4, false],
      ["A", "4", true, null, "toString", ["a"]],
    ],
    [
      "interval",
      interval({ empty: false }),
      [[-1, 2]],
      [[2, 2], [3, 2], [0, Number.NaN], [0, Number.POSITIVE_INFINITY], [1], [1, 2, 3], "12", ["1", "2"]],
    ],
    [
      "interval that may be empty",
      interval({ empty: true }),
      [
        [2, 2],
        [Number.NEGATIVE_INFINITY, 0],
      ],
      [[3, 2], [Number.NaN, 1], 5],
    ],
    [
      "colour",
      colour,
      [[0, 0.5, 1]],
      [[0, 0], [0, 0, 0, 0], [255, 0, 0], [0, 0, Number.NaN], "red", { 0: 0, 1: 0, 2: 0, length: 3 }],
    ],
    ["list", list(whole(0, 9)), [[], [1, 9]], [[10], 1, "12", { 0: 1, length: 1 }, Array(2)]],
  ])("%s", (_, kind, valid, invalid) => {
    for (const value of valid) expect(read(kind, value)).toEqual(value);
    for (const value of invalid)
      expect(() => read(kind, value), String(value)).toThrow(/^light.* cannot .*; (did|use)/);
  });

  it("refuse pairs and colours that are numbers in part only", () => {
    for (const empty of [true, false]) {
      const kind = interval({ empty });
      for (const value of [
        ["0", 1],
        [0, "1"],
        [null, 1],
        [0, [1]],
        [0, true],
      ]) {
        expect(() => read(kind, value), String(value)).toThrow(
          "light cannot be an array of 2; use two numbers",
        );
      }
    }
    for (const value of [
      [-Infinity, 0],
      [-Infinity, Infinity],
      [0, Number.POSITIVE_INFINITY],
    ]) {
      expect(() => read(interval({ empty: false }), value)).toThrow("cannot run from");
    }
    expect(read(interval({ empty: false }), [-5, -2])).toEqual([-5, -2]);
    for (const value of [
      ["0", 0, 0],
      [0, 0, "1"],
      [0, true, 0],
      [0, [0.5], 0],
      [-0.1, 0, 0],
      [0, 0, 1.1],
    ]) {
      expect(() => read(colour, value), String(value)).toThrow("light cannot be an array of 3");
    }
  });

  it("say what is valid, with one bound or two", () => {
    expect([number(-1, 2).valid, number(0).valid]).toEqual(["a number from -1 to 2", "a number from 0 on"]);
    expect([whole(1, 9).valid, whole(1).valid]).toEqual([
      ...["a whole number from 1 to 9", "a whole number from 1 on"],
    ]);
  });

  it("tell objects by their methods, own or inherited", () => {
    const kind = withMethods<{ read(): void; size(): void }>("a source", "read", "size");
    const size = () => undefined;
    class Source {
      read() {}
      size = size;
    }
    for (const source of [new Source(), { read: size, size }]) expect(read(kind, source)).toBe(source);
    const others = [{ read: size }, { size }, { read: 1, size }, {}, [], null, undefined, "read", size];
    for (const other of others) expect(() => read(kind, other)).toThrow(/light cannot be .*; use a source/);
  });

  it("complete an array in place of a plain value by what stands", () => {
    const kind = either(oneOf("none"), list(number(0)));
    expect(read(kind, [1, 2], "none" as never)).toEqual([1, 2]);
    expect(() => read(kind, [-1])).toThrow("light[0] cannot be -1");
  });

  it("copy what they read", () => {
    const given = [0, 0, 1];
    expect(read(colour, given)).not.toBe(given);
    expect(read(list(colour), [given])[0]).not.toBe(given);
    expect(read(interval({ empty: false }), given.slice(1))).not.toBe(given);
  });
});

interface Light {
  readonly strength: number;
  readonly kind: "sun" | "lamp";
}

const light = parts<Light>(
  { strength: number(0, 10), kind: oneOf("sun", "lamp") },
  { strength: 1, kind: "sun" },
);

describe("objects in parts", () => {
  it("are completed from the present value, else by default", () => {
    expect(read(light, {})).toEqual({ strength: 1, kind: "sun" });
    expect(read(light, { strength: 3 })).toEqual({ strength: 3, kind: "sun" });
    expect(read(light, { strength: 3, kind: undefined }, { strength: 9, kind: "lamp" })).toEqual({
      strength: 3,
      kind: "lamp",
    });
  });

  it("are refused where a part is missing that has no default, and by name where one is wrong", () => {
    expect(() =>
      read(parts<Light>({ strength: number(0, 10), kind: oneOf("sun", "lamp") }), { strength: 1 }),
    ).toThrow("light.kind cannot be undefined; use sun or lamp");
    expect(() => read(light, { strength: 11 })).toThrow(
      "light.strength cannot be 11; use a number from 0 to 10",
    );
    expect(() => read(light, { strenght: 1 })).toThrow(
      'light has no "strenght"; did you mean "strength"? Otherwise use strength or kind',
    );
    for (const none of [null, 3, "sun", [1]]) expect(() => read(light, none)).toThrow("use an object with");
  });

  it("have no properties of prototypes", () => {
    for (const key of ["__proto__", "constructor", "toString", "hasOwnProperty"]) {
      expect(() => read(light, JSON.parse(`{ "${key}": 1 }`))).toThrow(`light has no "${key}"`);
    }
    expect(Object.getPrototypeOf(read(light, Object.create({ strength: 5 })))).toBe(Object.prototype);
    expect(read(light, Object.create({ strength: 5 })).strength).toBe(1);
  });

  it("may be given in place of a plain value, and complete the object that stands", () => {
    const kind = either(oneOf("off"), light);
    expect(read<"off" | Light>(kind, { strength: 2 }, "off")).toEqual({ strength: 2, kind: "sun" });
    expect(read<"off" | Light>(kind, { strength: 2 }, { strength: 1, kind: "lamp" })).toEqual({
      strength: 2,
      kind: "lamp",
    });
    expect(read<"off" | Light>(kind, "off")).toBe("off");
    expect(() => read(kind, "of")).toThrow('did you mean "off"');
  });
});

describe("what stops a call", () => {
  it("is the signal given, else one that is never aborted", () => {
    const { signal } = new AbortController();
    expect(checkSignal({ signal }, "scan")).toBe(signal);
    for (const none of [{}, { signal: undefined }]) {
      expect(checkSignal(none, "scan")).toBeInstanceOf(AbortSignal);
      expect(checkSignal(none, "scan").aborted).toBe(false);
    }
    for (const wrong of [{ signal: {} }, { singal: signal }, null, 5, { signal: new AbortController() }]) {
      expect(() => checkSignal(wrong as never, "scan")).toThrow("STYLE_OPTION: scan: options");
    }
  });
});

describe("frozen", () => {
  it("leaves what is frozen as it is, and what cannot be", () => {
    const inner = { open: true };
    const outer = Object.freeze({ inner });
    expect(frozen(outer)).toBe(outer);
    expect(Object.isFrozen(inner)).toBe(false);
    const method = Object.assign(() => 1, { part: {} });
    expect(frozen({ method }).method).toBe(method);
    expect([Object.isFrozen(method), Object.isFrozen(method.part)]).toEqual([false, false]);
    for (const plain of [null, undefined, 5, "a", true]) expect(frozen(plain)).toBe(plain);
  });

  it("is what is in it too, whatever its depth", () => {
    fc.assert(
      fc.property(fc.jsonValue(), (value) => {
        const all = frozen(structuredClone(value));
        expect(all).toEqual(value);
        const check = (part: unknown): void => {
          expect(Object.isFrozen(part)).toBe(true);
          if (typeof part === "object" && part !== null) Object.values(part).forEach(check);
        };
        check(all);
      }),
    );
  });
});
