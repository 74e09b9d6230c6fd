import { mkdirSync, mkdtempSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { expandInputs } from "./inputs.js";

const folder = mkdtempSync(join(tmpdir(), "groma-inputs-"));
const at = (name: string) => join(folder, name);
const output = at("tiles/out.laz");

beforeAll(() => {
  for (const name of ["tiles/deep", "tiles/.hidden", "odd [1]"]) mkdirSync(at(name), { recursive: true });
  for (const name of [
    ...["tiles/b.laz", "tiles/a.LAS", "tiles/deep/c.e57", "tiles/notes.txt", "tiles/.hidden/d.las"],
    ...["tiles/.e.las", "tiles/out.laz", "odd [1]/f.las", "tiles/[g].las"],
  ]) {
    writeFileSync(at(name), "");
  }
});
afterAll(() => rmSync(folder, { recursive: true }));

const names = async (...args: string[]) =>
  (await expandInputs(args.map(at), output)).map((file) => basename(file));

describe("the inputs of a conversion", () => {
  it("are all scans of a folder and the folders below, sorted, but neither hidden ones nor the output", async () => {
    expect(await names("tiles")).toEqual(["[g].las", "a.LAS", "b.laz", "c.e57"]);
    expect(await names("tiles/")).toEqual(["[g].las", "a.LAS", "b.laz", "c.e57"]);
    expect(await names("odd [1]")).toEqual(["f.las"]);
  });

  it("are what a pattern matches, whatever the shell did not expand", async () => {
    expect(await names("tiles/*.la[sz]")).toEqual(["[g].las", "a.LAS", "b.laz"]);
    expect(await names("tiles/**/*.{laz,e57}")).toEqual(["b.laz", "c.e57"]);
  });

  it("are the file itself where one has the name of a pattern", async () => {
    expect(await names("tiles/[g].las")).toEqual(["[g].las"]);
  });

  it("are each taken once, in the order of the arguments", async () => {
    expect(await names("tiles/b.laz", "tiles/*.la?", "tiles/../tiles/b.laz")).toEqual([
      "b.laz",
      "[g].las",
      "a.LAS",
    ]);
  });

  it("are taken once, however many links lead to them", async () => {
    mkdirSync(at("linked"));
    for (const name of ["b.las", "z.las"]) writeFileSync(at(`linked/${name}`), "");
    symlinkSync(".", at("linked/loop"));
    symlinkSync("z.las", at("linked/other name.las"));
    expect(await expandInputs([at("linked")], output)).toEqual([at("linked/b.las"), at("linked/z.las")]);
    expect(await names("linked/loop/z.las", "linked/*.las")).toEqual(["z.las", "b.las"]);
    expect(await expandInputs([at("linked")], at("linked/loop/b.las"))).toEqual([at("linked/z.las")]);
  });

  it("are links to nothing too, and what is no regular file, which whoever opens them tells", async () => {
    mkdirSync(at("strange"));
    symlinkSync("/nowhere/tile.laz", at("strange/gone.laz"));
    symlinkSync("/nowhere/tiles", at("strange/gone"));
    symlinkSync(".", at("strange/loop"));
    const server = createServer().listen(at("strange/socket.las"));
    await new Promise((listening) => server.once("listening", listening));
    expect(await names("strange")).toEqual(["gone.laz", "socket.las"]);
    expect(await names("strange/*.la[sz]")).toEqual(["gone.laz", "socket.las"]);
    expect(await names("strange/**/*.las")).toEqual(["socket.las"]);
    await new Promise((closed) => server.close(closed));
  });

  it("leave files that are not there, and addresses, to who opens them", async () => {
    expect(await expandInputs(["nowhere.las", "https://example.org/ept.json"], output)).toEqual([
      "nowhere.las",
      "https://example.org/ept.json",
    ]);
  });

  it("are refused by name where there is none", async () => {
    await expect(names("tiles/*.pcd")).rejects.toMatchObject({
      code: "INPUT_NOT_FOUND",
      file: at("tiles/*.pcd"),
    });
    mkdirSync(at("empty"));
    await expect(names("empty")).rejects.toMatchObject({ code: "INPUT_NOT_FOUND" });
  });
});
