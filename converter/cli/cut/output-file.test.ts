import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { OutputError } from "../given/output-place.js";
import { writeWhole } from "./output-file.js";

describe("a file that is written whole", () => {
  let folder: string;
  beforeEach(() => {
    folder = mkdtempSync(join(tmpdir(), "groma-whole-"));
  });
  afterEach(() => rmSync(folder, { recursive: true, force: true }));

  it("stands once all of it is there", async () => {
    const output = join(folder, "cut.las");
    await writeWhole(output, false, async (unfinished) => {
      await writeFile(unfinished, "whole");
      expect(readdirSync(folder)).not.toContain("cut.las");
    });
    expect(readFileSync(output, "utf8")).toBe("whole");
    expect(readdirSync(folder)).toEqual(["cut.las"]);
  });

  it("is told by its own name where the disk is full, and leaves nothing", async () => {
    const output = join(folder, "cut.las");
    const full = Object.assign(new Error("ENOSPC: no space left on device, write"), { syscall: "write" });
    const written = writeWhole(output, false, async (unfinished) => {
      await writeFile(unfinished, "half");
      throw full;
    });
    await expect(written).rejects.toThrow(OutputError);
    await expect(written).rejects.toMatchObject({ code: "OUTPUT_WRITE", file: output });
    expect(readdirSync(folder)).toEqual([]);
  });

  it("leaves nothing where its contents fail, and says why", async () => {
    const thrown = new RangeError("no points");
    await expect(writeWhole(join(folder, "cut.las"), false, () => Promise.reject(thrown))).rejects.toBe(
      thrown,
    );
    expect(readdirSync(folder)).toEqual([]);
  });
});
