import { readdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, dirname, join } from "node:path";
import { cruise, type IConfiguration, type ICruiseResult } from "dependency-cruiser";
import { describe, expect, it } from "vitest";
import { projectRoot } from "../project.js";

const { options } = createRequire(import.meta.url)("../../.ci/arrows.cjs") as IConfiguration;

/** Import of one file by another, paths from the root. */
interface Import {
  readonly from: string;
  readonly to: string;
}

/** The imports between a package's sources, type-only ones included. */
async function importsWithin(place: string): Promise<Import[]> {
  const { output } = await cruise([place], { ...options, baseDir: projectRoot });
  return (output as ICruiseResult).modules
    .flatMap(({ source, dependencies }) =>
      dependencies.map(({ resolved }) => ({ from: source, to: resolved })),
    )
    .filter(({ from, to }) =>
      [from, to].every((file) => file.startsWith(`${place}/`) && !file.includes("/dist/")),
    );
}

const CORE = "converter/src";

/** The imports between rooms of the core by a text of its sources, unit tests and comments left out; a room is a folder or a file. */
function importsOfCore(file: string, text: string): Import[] {
  const [, room] = /^([a-z_]+)/.exec(file)!;
  const code = text.replace(/#\[cfg\(test\)\][\s\S]*$/, "").replace(/\/\/.*$/gm, "");
  return [...code.matchAll(/\bcrate::([a-z_]+)/g)].map(([, to]) => {
    return { from: `${CORE}/${room}/${basename(file)}`, to: `${CORE}/${to}/mod.rs` };
  });
}

/** Imports between folders that lie on a circle of folders, one import per pair of folders. */
function foldersInCircles(imports: readonly Import[]): string[] {
  const arrows = new Map<string, Map<string, Import>>();
  for (const one of imports) {
    const [from, to] = [dirname(one.from), dirname(one.to)];
    if (from === to) continue;
    if (!arrows.has(from)) arrows.set(from, new Map());
    arrows.get(from)?.set(to, one);
  }
  const reachable = (start: string): Set<string> => {
    const seen = new Set<string>();
    const open = [start];
    for (let folder = open.pop(); folder !== undefined; folder = open.pop()) {
      for (const next of arrows.get(folder)?.keys() ?? []) {
        if (seen.has(next)) continue;
        seen.add(next);
        open.push(next);
      }
    }
    return seen;
  };
  return [...arrows].flatMap(([folder, targets]) =>
    [...targets]
      .filter(([target]) => reachable(target).has(folder))
      .map(([, { from, to }]) => `${from} -> ${to}`),
  );
}

describe("the folders of each package", () => {
  for (const place of ["georef", "layer", "converter/cli"]) {
    it(`import each other one way in ${place}`, { timeout: 60_000 }, async () => {
      const imports = await importsWithin(place);
      expect(imports.length).toBeGreaterThan(20);
      expect(foldersInCircles(imports)).toEqual([]);
    });
  }

  it(`import each other one way in ${CORE}`, () => {
    const imports = readdirSync(join(projectRoot, CORE), { recursive: true, encoding: "utf8" })
      .filter((file) => file.endsWith(".rs") && !/^(lib|main)\.rs$/.test(file))
      .flatMap((file) => importsOfCore(file, readFileSync(join(projectRoot, CORE, file), "utf8")));
    expect(imports.length).toBeGreaterThan(100);
    expect(foldersInCircles(imports)).toEqual([]);
  });

  it("stand in docs/architecture.md, each by its name", () => {
    const page = readFileSync(join(projectRoot, "docs/architecture.md"), "utf8");
    const rooms = ["georef/src", "layer/src", "converter/cli", CORE, "demo/src"].flatMap((place) =>
      readdirSync(join(projectRoot, place), { withFileTypes: true }).flatMap((entry) =>
        entry.isDirectory() ? `${place}/${entry.name}` : [],
      ),
    );
    expect(rooms.length).toBeGreaterThan(60);
    const isNamed = (room: string) =>
      page.includes(`\`${room}`) || page.includes(`\`${room.split("/").at(-1)}\``);
    expect(rooms.filter((room) => !isNamed(room))).toEqual([]);
  });

  it("are found in a circle of three, and of a folder with the one inside it (negative control)", () => {
    const three = [
      { from: "p/a/1.ts", to: "p/b/1.ts" },
      { from: "p/b/2.ts", to: "p/c/1.ts" },
      { from: "p/c/2.ts", to: "p/a/2.ts" },
      { from: "p/c/2.ts", to: "p/d/1.ts" },
    ];
    expect(foldersInCircles(three)).toEqual([
      "p/a/1.ts -> p/b/1.ts",
      "p/b/2.ts -> p/c/1.ts",
      "p/c/2.ts -> p/a/2.ts",
    ]);
    const nested = [
      { from: "p/a/1.ts", to: "p/a/in/1.ts" },
      { from: "p/a/in/2.ts", to: "p/a/2.ts" },
    ];
    expect(foldersInCircles(nested)).toHaveLength(2);
    const core = [
      ...importsOfCore("a/x.rs", "use crate::b::Y; // crate::c\n"),
      ...importsOfCore("b.rs", "use crate::a::X;\n#[cfg(test)]\nuse crate::d;"),
    ];
    expect(core.map(({ to }) => to)).toEqual(["converter/src/b/mod.rs", "converter/src/a/mod.rs"]);
    expect(foldersInCircles(core)).toHaveLength(2);
  });
});
