import { execFile } from "node:child_process";
import { chmodSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterEach, beforeEach, describe, expect, it } from "vitest";

const script = fileURLToPath(new URL("../../../scripts/install-proj", import.meta.url));
let folder = "";
beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), "groma-install-"));
});
afterEach(() => rmSync(folder, { recursive: true }));

function stub(name: string, body: string): void {
  writeFileSync(join(folder, name), `#!/bin/sh\n${body}\n`);
  chmodSync(join(folder, name), 0o755);
}

function install(): Promise<{ code: number; stderr: string }> {
  const env = { ...process.env, PATH: `${folder}:/usr/bin:/bin`, XDG_CACHE_HOME: folder };
  return new Promise((resolve) => {
    execFile(script, { env }, (error, _, stderr) =>
      resolve({ code: error ? Number(error.code ?? 1) : 0, stderr }),
    );
  });
}

describe.skipIf(process.platform === "win32")("install-proj", () => {
  it.each([
    ["an older one", "9.5.1", "Darwin", "brew install proj"],
    ["an older one", "8.2", "FreeBSD", "conda install -c conda-forge proj"],
  ])("says beside %s (%s) on %s in one line how a current PROJ is had", async (_, version, system, line) => {
    stub("projinfo", "exit 0");
    stub("cct", `echo 'cct: Rel. ${version}, January 1st, 2025' >&2`);
    stub("uname", `echo ${system}`);
    expect(await install()).toEqual({ code: 1, stderr: `install-proj: ${line}\n` });
  });

  it.each(["9.6.0", "9.10.1", "10.0.0"])("leaves alone PROJ %s", async (version) => {
    stub("projinfo", "exit 0");
    stub("cct", `echo 'cct: Rel. ${version}, January 1st, 2026' >&2`);
    const stderr = `install-proj: PROJ ${version} is there already\n`;
    expect(await install()).toEqual({ code: 0, stderr });
  });
});
