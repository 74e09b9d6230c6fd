import { CrsError, GromaError } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { DecodeError, fromWire, isAbort, MeasureError, SourceError, toWire } from "./index.js";

const fallback = { code: "DECODE_FAILED", file: "node 0-0-0-0", fix: "Open the file again" };
const fault = { code: "SOURCE_HTTP", file: "a.copc.laz", cause: "it failed", fix: "Look" };

describe("errors across the worker boundary", () => {
  it.each([SourceError, DecodeError, CrsError, MeasureError])(
    "%o keeps its class and all four fields",
    (Kind) => {
      const error = fromWire(structuredClone(toWire(new Kind(fault), fallback)));
      expect(error).toBeInstanceOf(Kind);
      expect(error).toMatchObject(fault);
      expect(error.message).toBe("SOURCE_HTTP: a.copc.laz: it failed. Look.");
    },
  );

  it("gives a code to what has none", () => {
    const error = fromWire(toWire(new RangeError("out of memory"), fallback));
    expect(error).toBeInstanceOf(DecodeError);
    expect(error).toMatchObject({ ...fallback, cause: "out of memory" });
  });

  it("is a GromaError at least, whatever its kind", () => {
    expect(fromWire({ ...fault, kind: "FutureError" })).toBeInstanceOf(GromaError);
  });
});

describe("isAbort", () => {
  it("knows a caller's wish from a fault", () => {
    expect(isAbort(AbortSignal.abort().reason)).toBe(true);
    expect(isAbort(new SourceError(fault))).toBe(false);
    expect(isAbort(undefined)).toBe(false);
  });
});
