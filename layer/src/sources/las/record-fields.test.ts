import { describe, expect, it } from "vitest";
import { DERIVED_COLUMNS } from "../contract/point-attribute.js";
import type { ExtraBytes } from "./extra-bytes.js";
import { recordFields } from "./record-fields.js";

describe("names of attributes", () => {
  it("are none that mean something else: an extra attribute called so gets a number", () => {
    const names = ["rgb", "position", "levelOfDetail", "elevation", "ellipsoidalHeight", "x", "intensity"];
    expect(DERIVED_COLUMNS).toEqual(expect.arrayContaining(names.slice(0, -1)));
    const extra = names.map((name) => ({ name, at: 0 }) as ExtraBytes);
    const fields = recordFields(7, extra);
    expect(fields.slice(-names.length).map(({ name }) => name)).toEqual(names.map((name) => `${name} 2`));
  });
});
