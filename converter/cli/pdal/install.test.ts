import { execFile } from "node:child_process";
import { chmodSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterEach, beforeEach, describe, expect, it } from "vitest";

const script = fileURLToPath(new URL("../../scripts/install-pdal", import.meta.url));
let folder = "";
beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), "groma-install-"));
});
afterEach(() => rmSync(folder, { recursive: true }));

/** A program, the only one besides the shell. */
function stub(name: string, body: string): void {
  writeFileSync(join(folder, name), `#!/bin/sh\n${body}\n`);
  chmodSync(join(folder, name), 0o755);
}

function install(): Promise<{ code: number; stderr: string }> {
  const env = { ...process.env, PATH: folder, XDG_CACHE_HOME: folder };
  return new Promise((resolve) => {
    execFile(script, { env }, (error, _, stderr) =>
      resolve({ code: error ? Number(error.code ?? 1) : 0, stderr }),
    );
  });
}

describe.skipIf(process.platform === "win32")("install-pdal", () => {
  it.each([
    ["Darwin", "brew install pdal"],
    ["FreeBSD", "conda install -c conda-forge pdal"],
  ])("says on %s in one line how PDAL is had", async (system, line) => {
    stub("uname", `echo ${system}`);
    expect(await install()).toEqual({ code: 1, stderr: `install-pdal: ${line}\n` });
  });

  it("leaves alone a PDAL that is there", async () => {
    stub("pdal", "exit 0");
    expect(await install()).toEqual({
      ...{ code: 0, stderr: `install-pdal: there is one already: ${join(folder, "pdal")}\n` },
    });
  });
});
