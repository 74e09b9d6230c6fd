import { describe, expect, it } from "vitest";
import { SourceError } from "../../errors/index.js";
import { BlobSource } from "./blob-source.js";

describe("BlobSource", () => {
  it.each([undefined, null, "", "scan.copc.laz", -1, {}])(
    "SOURCE_ADDRESS for %o, which is no Blob",
    (what) => {
      const make = () => new BlobSource(what as unknown as Blob);
      expect(make).toThrow(SourceError);
      expect(make).toThrow(/^SOURCE_ADDRESS: /);
    },
  );

  it("has the name that is given, else the file's own, else none", () => {
    const names = [new Blob(["a"]), new File(["a"], "scan.copc.laz")].map(
      (blob) => new BlobSource(blob).name,
    );
    expect(names).toEqual(["file", "scan.copc.laz"]);
    expect(new BlobSource(new Blob(["a"]), "other").name).toBe("other");
  });
});
