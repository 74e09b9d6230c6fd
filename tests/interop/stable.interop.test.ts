import { createHash } from "node:crypto";
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { lasOf } from "../faults/las-bytes.js";
import { convert, coreMissing, inPairs, makeFolder } from "./core.js";

const folder = makeFolder();
const input = join(folder, "in.las");
beforeAll(() => writeFileSync(input, lasOf(400_000)));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

/** Digests of the same conversion under several options. */
async function digests(
  common: readonly string[],
  variants: readonly (readonly string[])[],
): Promise<string[]> {
  const numbered = variants.map((options, index) => ({ options, out: join(folder, `${index}.copc.laz`) }));
  return inPairs(numbered, async ({ options, out }) => {
    const { status, events } = await convert([input, out, "--overwrite", ...common, ...options]);
    expect(events.at(-1), options.join(" ")).toMatchObject({ event: "done" });
    expect(status).toBe(0);
    return createHash("sha256").update(readFileSync(out)).digest("hex");
  });
}

describe.skipIf(coreMissing)("the same input and options give the same file", () => {
  it.each(["poisson", "grid", "random", "first"])("with sampling %s on any machine", async (sampling) => {
    const variants = [[], ["--threads", "1"], ["--threads", "2"], ["--threads", "5"], ["--memory", "256MB"]];
    const found = await digests(["--sampling", sampling], variants);
    expect(new Set(found).size).toBe(1);
  });

  it("with mean colours, little memory and many threads", async () => {
    const variants = [[], ["--threads", "7", "--memory", "256MB"]];
    const found = await digests(["--sampling", "poisson", "--average-colors"], variants);
    expect(new Set(found).size).toBe(1);
  });

  it("which differs with the sampling", async () => {
    const found = await digests(
      [],
      [
        ["--sampling", "poisson"],
        ["--sampling", "random"],
      ],
    );
    expect(new Set(found).size).toBe(2);
  });
});
