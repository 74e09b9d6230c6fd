import { chmodSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, describe, expect, it } from "vitest";
import { findProj } from "./find.js";

const folder = mkdtempSync(join(tmpdir(), "groma-find-"));
afterAll(() => rmSync(folder, { recursive: true, force: true }));
const here = (await findProj()) !== undefined;
/** Programs that say the same whatever they are asked. */
function stubs(where: string, says: string): void {
  mkdirSync(where, { recursive: true });
  for (const name of ["cct", "projinfo"]) {
    writeFileSync(join(where, name), `#!/bin/sh\necho '${says}'\n`);
    chmodSync(join(where, name), 0o755);
  }
}
const absent = here ? "" : " (skipped: PROJ is not installed)";

describe("PROJ", () => {
  it("is not found on an empty PATH, and that is no error", async () => {
    expect(await findProj({ environment: { PATH: folder, XDG_CACHE_HOME: folder } })).toBeUndefined();
  });

  it("has to be in a folder that was given", async () => {
    await expect(findProj({ folder })).rejects.toMatchObject({ code: "PROJ_MISSING" });
  });

  it.skipIf(process.platform === "win32").each([
    ["too old", "cct: Rel. 8.2.1, January 1st, 2022", "PROJ_VERSION"],
    ["something else", "hello", "PROJ_FAILED"],
  ])("is refused when it is %s", async (_, says, code) => {
    stubs(folder, says);
    await expect(findProj({ folder })).rejects.toMatchObject({ code });
    for (const name of ["cct", "projinfo"]) rmSync(join(folder, name));
  });

  it.skipIf(process.platform === "win32").each([
    ["that of install-proj before an older one of PATH", "9.1.1", "9.6.0", "9.6.0"],
    ["one of PATH that is as new", "9.7.0", "9.6.0", "9.7.0"],
    ["that of install-proj where PATH has none that runs", "8.0.0", "9.6.0", "9.6.0"],
  ])("is %s", async (_, ofPath, installed, version) => {
    const place = mkdtempSync(join(folder, "both-"));
    stubs(join(place, "path"), `cct: Rel. ${ofPath}, 2025`);
    stubs(join(place, "groma/proj/bin"), `cct: Rel. ${installed}, 2025`);
    const environment = { PATH: join(place, "path"), XDG_CACHE_HOME: place, PROJ_DATA: "/mine" };
    const proj = await findProj({ environment });
    expect(proj?.version).toBe(version);
    const own = join(place, "groma/proj/usr/share/proj");
    const data = proj?.environment.PROJ_DATA?.split(":").slice(0, 2);
    expect(data).toEqual(version === installed ? [own, "/mine"] : ["/mine"]);
  });

  it.skipIf(process.platform === "win32").each([
    ["that of the package where there is no other", undefined, undefined, "9.6.2"],
    ["that of the package before an older one of PATH", "9.1.1", undefined, "9.6.2"],
    ["that of install-proj before that of the package", undefined, "9.6.0", "9.6.0"],
    ["one of PATH that is current before that of the package", "9.6.1", undefined, "9.6.1"],
  ])("is %s", async (_, ofPath, installed, version) => {
    const place = mkdtempSync(join(folder, "packaged-"));
    const packaged = join(place, "package/proj");
    stubs(join(packaged, "bin"), "cct: Rel. 9.6.2, 2025");
    if (ofPath) stubs(join(place, "path"), `cct: Rel. ${ofPath}, 2025`);
    if (installed) stubs(join(place, "groma/proj/bin"), `cct: Rel. ${installed}, 2025`);
    const environment = { PATH: join(place, "path"), XDG_CACHE_HOME: place };
    const proj = await findProj({ environment, packaged });
    expect(proj?.version).toBe(version);
    const own = proj?.environment.PROJ_DATA?.split(":")[0] === join(packaged, "share/proj");
    expect(own).toBe(version === "9.6.2");
  });

  it.skipIf(process.platform === "win32")("is the one that GROMA_PROJ names", async () => {
    const place = mkdtempSync(join(folder, "named-"));
    stubs(place, "cct: Rel. 9.2.0, 2023");
    const environment = { ...process.env, GROMA_PROJ: place };
    expect(await findProj({ environment })).toMatchObject({ version: "9.2.0", cct: join(place, "cct") });
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
