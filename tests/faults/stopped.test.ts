import type { ChildProcess } from "node:child_process";
import { mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { setTimeout as sleep } from "node:timers/promises";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { compareAll, expectFaithful } from "../interop/comparison.js";
import { convert, coreMissing, filesOf, makeFolder } from "../interop/core.js";
import { pythonMissing } from "../python.js";
import { lasOf } from "./las-bytes.js";

const folder = makeFolder();
const temporary = join(folder, "temporary");
const [input, output] = [join(folder, "in.las"), join(folder, "out.copc.laz")];
const OLD = "the old file";
/** Little memory, so that there are files in the temporary folder to be left behind. */
const args = [input, output, "--overwrite", "--temp-dir", temporary, "--memory", "256MB"];

/** Milliseconds of a whole run. */
let whole = 0;
let good = Buffer.alloc(0);

beforeAll(async () => {
  if (coreMissing) return;
  mkdirSync(temporary);
  writeFileSync(input, lasOf(700_000));
  const began = performance.now();
  expect((await convert(args)).status).toBe(0);
  whole = performance.now() - began;
  good = readFileSync(output);
}, 60_000);
afterAll(() => rmSync(folder, { recursive: true, force: true }));

/** Bytes of everything that a folder holds, without what is known to be there. */
const leftovers = (): string[] => [
  ...filesOf(folder).filter((name) => !["in.las", "out.copc.laz", "temporary"].includes(name)),
  ...readdirSync(temporary, { recursive: true }).map((name) => `temporary/${name}`),
];

/** Runs a conversion over an old file and sends it a signal after a share of a whole run's time. */
async function stopped(signal: NodeJS.Signals, share: number) {
  writeFileSync(output, OLD);
  let child: ChildProcess | undefined;
  const outcome = convert(args, {
    onStart: (process) => {
      child = process;
    },
  });
  await sleep(whole * share);
  child?.kill(signal);
  return await outcome;
}

/** What stands where the output belongs: never a part of one. */
function expectWholeOrOld(): void {
  const bytes = readFileSync(output);
  if (bytes.toString("latin1", 0, OLD.length) === OLD) expect(bytes).toHaveLength(OLD.length);
  else expect(bytes.equals(good)).toBe(true);
}

describe.skipIf(coreMissing || process.platform === "win32")("a conversion that is stopped", () => {
  it("by SIGKILL at any moment leaves the old file or the new one; the next run removes the rest", async () => {
    let left = 0;
    for (let time = 0; time < 10; time++) {
      const share = (time + Math.random()) / 10;
      await stopped("SIGKILL", share);
      expectWholeOrOld();
      left += leftovers().length;
    }
    // Else the runs were over before they were stopped, and this tests nothing.
    expect(left).toBeGreaterThan(0);
    expect((await convert(args)).status).toBe(0);
    expect(leftovers()).toEqual([]);
    expect(readFileSync(output).equals(good)).toBe(true);
  }, 60_000);

  it.each(["SIGINT", "SIGTERM", "SIGHUP"] as const)(
    "by %s leaves nothing behind",
    async (signal) => {
      let interrupted = 0;
      for (const share of [0.1, 0.3, 0.5, 0.7, 0.9]) {
        const { status, events } = await stopped(signal, share);
        expectWholeOrOld();
        expect(leftovers()).toEqual([]);
        if (status === 0) continue;
        interrupted++;
        expect(status).toBe(130);
        expect(events.at(-1)).toMatchObject({ event: "error", code: "INTERRUPTED" });
      }
      expect(interrupted).toBeGreaterThan(0);
    },
    60_000,
  );

  it("leaves the files of a run that lives", async () => {
    const other = join(folder, "other.copc.laz");
    const running = convert([input, other, ...args.slice(2)]);
    expect((await convert(args)).status).toBe(0);
    const { status, events } = await running;
    expect(events.at(-1)).toMatchObject({ event: "done" });
    expect(status).toBe(0);
    expect(readFileSync(other).equals(good)).toBe(true);
    rmSync(other);
    expect(leftovers()).toEqual([]);
  }, 60_000);

  it.skipIf(pythonMissing)("had nothing wrong with it", () => {
    expectFaithful(compareAll([[output, [input]]])[0]);
  });
});
