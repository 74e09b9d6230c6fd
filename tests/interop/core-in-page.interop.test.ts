import { createHash } from "node:crypto";
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { type CoreEvent, CoreProgram } from "../../demo/src/indexing/core-run.js";
import { lasOf } from "../faults/las-bytes.js";
import { data, projectRoot } from "../project.js";
import { coreMissing, makeFolder, runCore } from "./core.js";

/** Of each kind that there is: LAS and LAZ, chunked and layered, point formats 0 to 8, extra bytes, doubtful headers. */
const SCANS = [
  ...["permutations__1.2_0", "permutations__1.0_1", "permutations__1.2_2", "1.2-with-color-clipped"].map(
    (name) => `las-variants/las__${name}.las`,
  ),
  ...["las__test1_4.las", "las__spurious.las", "laz__simple.laz", "las__no-points.las"].map(
    (name) => `las-variants/${name}`,
  ),
  ...["las-variants/laz__las_with_several_extra_byte_bloc.laz", "reports/c13_latin1_extra_names.las"],
  ...["reports/k26_table_short.copc.laz", "hostile/bomb.copc.laz"],
];

const folder = makeFolder();
const made = join(folder, "scan.copc.laz");
const digest = (bytes: Uint8Array) => createHash("sha256").update(bytes).digest("hex");
afterAll(() => rmSync(folder, { recursive: true, force: true }));

describe.skipIf(coreMissing)(`the core in the page${coreMissing ? ` (skipped: ${coreMissing})` : ""}`, () => {
  let program: CoreProgram;

  beforeAll(async () => {
    const file = join(projectRoot, "converter/target/wasm32-wasip1/release/groma-core.wasm");
    program = new CoreProgram(await WebAssembly.compile(readFileSync(file)));
  });

  /** What the page makes of a scan, and what it says: a digest of the bytes or an error, warnings, and the stages in order. */
  async function inPage(scan: Uint8Array) {
    const events: CoreEvent[] = [];
    const read = (begin: number, end: number) => scan.subarray(begin, end);
    const outcome = await program.convert({ size: scan.length, read }, (event) => events.push(event));
    const stages = events.flatMap((one) => (one.event === "progress" ? [one.stage] : []));
    return {
      ...("copc" in outcome ? { copc: digest(outcome.copc.read(0, outcome.copc.size)) } : outcome),
      warnings: events.flatMap((one) => (one.event === "warning" ? [one.text] : [])),
      stages: [...new Set(stages)],
    };
  }

  /** The same by the core of the command. */
  async function inCommand(path: string) {
    rmSync(made, { force: true });
    const { status, events } = await runCore(["convert", path, made]);
    const { code, cause, fix } = events.at(-1)!;
    const result = status === 0 ? { copc: digest(readFileSync(made)) } : { fault: { code, cause, fix } };
    const warnings = events.flatMap(({ event, text }) => (event === "warning" ? [text!] : []));
    return { ...result, warnings: warnings.map((text) => text.replace(path, "scan")) };
  }

  it.each(SCANS)("makes of %s what the command does, byte for byte", async (name) => {
    const { path, missing } = data(name);
    if (missing) return;
    const { stages: _, ...page } = await inPage(readFileSync(path));
    expect(page).toMatchObject(await inCommand(path));
  });

  it("divides many points as the command does, and tells how far it is", async () => {
    const path = join(folder, "many.las");
    const scan = lasOf(300_000);
    writeFileSync(path, scan);
    const { stages, ...page } = await inPage(scan);
    expect(stages).toEqual(["read", "build", "write"]);
    expect(page).toEqual(await inCommand(path));
  });

  it("tells of a core that breaks off what it said last", async () => {
    // (module (memory (export "memory") 1) (func (export "_start") unreachable))
    const broken = new CoreProgram(
      await WebAssembly.compile(
        Uint8Array.from([
          ...[0, 0x61, 0x73, 0x6d, 1, 0, 0, 0, 1, 4, 1, 0x60, 0, 0, 3, 2, 1, 0, 5, 3, 1, 0, 1],
          ...[7, 19, 2, 6, ...Buffer.from("memory"), 2, 0, 6, ...Buffer.from("_start"), 0, 0],
          ...[10, 5, 1, 3, 0, 0, 0x0b],
        ]),
      ),
    );
    const scan = { size: 0, read: () => new Uint8Array() };
    expect(await broken.convert(scan, () => undefined)).toEqual({ complaint: "unreachable" });
  });

  it("says why where a file ends too early, and has made nothing", async () => {
    const { path, missing } = data("las-variants/laz__simple.laz");
    if (missing) return;
    const cut = readFileSync(path).subarray(0, 9000);
    const short = join(folder, "short.laz");
    writeFileSync(short, cut);
    const { stages: _, ...page } = await inPage(cut);
    expect(page).toMatchObject(await inCommand(short));
    expect(page).toHaveProperty("fault");
  });
});
