import { mkdirSync, rmSync } from "node:fs";
import { join } from "node:path";
import { afterAll, expect, test } from "vitest";
import { compareAll, convertAndCompare, refereesMissing, titled } from "../interop/comparison.js";
import { filesOf, makeFolder, type Outcome } from "../interop/core.js";
import { runPython } from "../python.js";

interface Case {
  readonly name: string;
  readonly inputs: string[];
  readonly codes: string[] | null;
}

const folder = makeFolder();
afterAll(() => rmSync(folder, { recursive: true, force: true }));

/** Expects one error, told in full and last, and no sign of a crash. */
function expectRefused({ status, signal, events, complaint }: Outcome, name: string): string | undefined {
  expect.soft({ status, signal }, name).toEqual({ status: 1, signal: null });
  expect.soft(complaint, name).not.toMatch(/panicked|RUST_BACKTRACE/);
  expect
    .soft(
      events.filter(({ event }) => event === "error"),
      name,
    )
    .toHaveLength(1);
  expect.soft(events.at(-1), name).toMatchObject({
    code: expect.stringMatching(/^[A-Z]+_[A-Z_]+$/),
    file: expect.any(String),
    cause: expect.any(String),
    fix: expect.any(String),
  });
  return events.at(-1)?.code;
}

test.skipIf(refereesMissing)(
  titled("a scan that lies, is cut or has bytes changed gives one error or the right file", refereesMissing),
  { timeout: 240_000 },
  async () => {
    const input = join(folder, "in");
    const output = join(folder, "out");
    for (const name of [input, output]) mkdirSync(name);
    const cases = runPython<Case[]>("faults/lies.py", [input]);
    expect(cases.length).toBeGreaterThan(400);
    // What is lost may be left out with a warning; strictly, it is refused.
    const alone = cases.map(({ inputs }) => ({ inputs, references: [], options: ["--strict"] }));
    const results = await convertAndCompare(output, alone, { memory: 1024, timeout: 20_000 });
    const accepted = cases.flatMap(({ name, inputs, codes }, index) => {
      const { outcome, output, found } = results[index]!;
      if (codes || outcome.status !== 0) {
        const code = expectRefused(outcome, name);
        if (codes) expect.soft(codes, name).toContain(code);
        else expect.soft(code, name).toMatch(/^INPUT_/);
        return [];
      }
      expect.soft(found?.error, name).toBeUndefined();
      expect.soft(found, name).toMatchObject({ broken: [], outsideCube: 0, sameBounds: true, copclib: true });
      return { name, inputs, output };
    });
    const successes = results.filter(({ outcome }) => outcome.status === 0);
    expect(filesOf(output)).toHaveLength(successes.length);
    // Whoever has to sort out coordinate reference systems needs to know all of them.
    const systems = cases.findIndex(({ name }) => name === "three coordinate reference systems");
    const { file, cause } = results[systems]!.outcome.events.at(-1)!;
    for (const name of cases[systems]!.inputs) expect.soft(`${file} ${cause}`).toContain(name);
    // What laspy makes of the changed bytes, where it can read them, is what has to be in the file.
    // Some inputs lead laspy astray, which may not take the others' time.
    const compared = compareAll(
      accepted.map(({ output, inputs }) => [output, inputs] as const),
      5,
    );
    const readable = compared.filter(({ error }) => error === undefined);
    expect.soft(readable.length).toBeGreaterThan(20);
    for (const [index, { name }] of accepted.entries()) {
      if (compared[index]!.error === undefined)
        expect.soft(compared[index], name).toMatchObject({ sameRecords: true });
    }
  },
);
