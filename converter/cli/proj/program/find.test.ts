import { chmodSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, describe, expect, it } from "vitest";
import { findProj } from "./find.js";

const folder = mkdtempSync(join(tmpdir(), "groma-find-"));
afterAll(() => rmSync(folder, { recursive: true, force: true }));
const here = (await findProj()) !== undefined;
const absent = here ? "" : " (skipped: PROJ is not installed)";

describe("PROJ", () => {
  it("is not found on an empty PATH, and that is no error", async () => {
    expect(await findProj({ environment: { PATH: folder } })).toBeUndefined();
  });

  it("has to be in a folder that was given", async () => {
    await expect(findProj({ folder })).rejects.toMatchObject({ code: "PROJ_MISSING" });
  });

  it.skipIf(process.platform === "win32").each([
    ["too old", "cct: Rel. 8.2.1, January 1st, 2022", "PROJ_VERSION"],
    ["something else", "hello", "PROJ_FAILED"],
  ])("is refused when it is %s", async (_, says, code) => {
    for (const name of ["cct", "projinfo"]) {
      writeFileSync(join(folder, name), `#!/bin/sh\necho '${says}'\n`);
      chmodSync(join(folder, name), 0o755);
    }
    await expect(findProj({ folder })).rejects.toMatchObject({ code });
    for (const name of ["cct", "projinfo"]) rmSync(join(folder, name));
  });

  it.skipIf(!here)(`keeps its own folders behind the one that is given${absent}`, async () => {
    const plain = await findProj();
    const proj = await findProj({ grids: folder });
    expect(proj?.version).toMatch(/^\d+\.\d+\.\d+$/);
    expect(proj?.directories).toContain(folder);
    expect(proj?.directories).toEqual(expect.arrayContaining([...(plain?.directories ?? [])]));
    expect(proj?.environment.PROJ_NETWORK).toBe(process.env.PROJ_NETWORK ?? "OFF");
  });

  it.skipIf(!here)(`goes to the network only when the user's environment says so${absent}`, async () => {
    const proj = await findProj({ environment: { ...process.env, PROJ_NETWORK: "ON" } });
    expect(proj?.environment.PROJ_NETWORK).toBe("ON");
  });

  it.skipIf(!here)(`refuses a folder of grids that is none${absent}`, async () => {
    await expect(findProj({ grids: join(folder, "nowhere") })).rejects.toMatchObject({ code: "PROJ_GRID" });
  });
});
