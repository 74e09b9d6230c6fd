import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import ts from "typescript";
import { describe, expect, it } from "vitest";
import { projectRoot } from "../project.js";

/** What an example takes from the application around it, by name and type. */
const AROUND = new Map([
  ["viewer", 'import("cesium").Viewer'],
  ["map", 'import("ol").Map'],
  ["layer", 'import("@groma/layer/cesium").PointCloudLayer'],
  ["cloud", 'import("@groma/layer").PointCloud'],
  ["windowPosition", 'import("cesium").Cartesian2'],
  ["ring", "[longitude: number, latitude: number][]"],
  ["line", "[longitude: number, latitude: number][]"],
  ["longitude", "number"],
  ["latitude", "number"],
  ["height", "number"],
  ["signal", "AbortSignal"],
  ["token", "() => Promise<string>"],
]);

/** The TypeScript examples of a page of Markdown, each with the line it begins in, counted from 1. */
function examples(page: string): { line: number; code: string }[] {
  return [...page.matchAll(/^```ts\n([\s\S]*?)^```$/gm)].map(({ index, 1: code = "" }) => ({
    line: page.slice(0, index).split("\n").length + 1,
    code,
  }));
}

/** What the compiler says of examples, each a module of its own with `AROUND` about it: `file(line): message`. */
function complaints(codes: ReadonlyMap<string, string>): string[] {
  const config = ts.getParsedCommandLineOfConfigFile(
    join(projectRoot, "tests/tsconfig.json"),
    { types: ["node"], noUnusedLocals: false, noUnusedParameters: false },
    { ...ts.sys, onUnRecoverableConfigFileDiagnostic: () => {} },
  )!;
  const host = ts.createCompilerHost(config.options);
  const files = new Map<string, string>();
  for (const [name, code] of codes) {
    // One that the example declares itself shadows what is around it.
    files.set(join(projectRoot, "tests/architecture", name), `${code}\nexport {};\n`);
  }
  const around = join(projectRoot, "tests/architecture/around.d.ts");
  files.set(around, [...AROUND].map(([name, type]) => `declare const ${name}: ${type};`).join("\n"));
  const read = host.getSourceFile.bind(host);
  host.getSourceFile = (file, ...rest) => {
    const text = files.get(file);
    return text === undefined ? read(file, ...rest) : ts.createSourceFile(file, text, rest[0]);
  };
  host.fileExists = (file) => files.has(file) || ts.sys.fileExists(file);
  const program = ts.createProgram([...files.keys()], config.options, host);
  return [...files.keys()]
    .flatMap((file) => {
      const source = program.getSourceFile(file)!;
      return [...program.getSyntacticDiagnostics(source), ...program.getSemanticDiagnostics(source)];
    })
    .map(({ file, start, messageText }) => {
      const line = file!.getLineAndCharacterOfPosition(start!).line + 1;
      const name = file!.fileName.slice(join(projectRoot, "tests/architecture/").length);
      return `${name}(${line}): ${ts.flattenDiagnosticMessageText(messageText, " ")}`;
    });
}

describe("the examples of README and docs", () => {
  it("compile as they stand", { timeout: 60_000 }, () => {
    const pages = ["README.md", "layer/README.md", "georef/README.md", "converter/README.md"];
    for (const folder of ["docs", "docs/manual"]) {
      pages.push(...readdirSync(join(projectRoot, folder)).map((name) => `${folder}/${name}`));
    }
    const codes = new Map<string, string>();
    for (const page of pages.filter((name) => name.endsWith(".md"))) {
      const text = readFileSync(join(projectRoot, page), "utf8");
      for (const { line, code } of examples(text)) {
        codes.set(`${page.replaceAll("/", "-")}-${line}.ts`, code);
      }
    }
    expect(codes.size).toBeGreaterThanOrEqual(7);
    expect(complaints(codes)).toEqual([]);
  });

  it("are refused where they are wrong (negative control)", { timeout: 60_000 }, () => {
    const code =
      'import { PointCloudLayer } from "@groma/layer/cesium";\nconst it: PointCloudLayer = 1;\nnone;\n';
    expect(complaints(new Map([["wrong.ts", code]]))).toEqual([
      "wrong.ts(2): Type 'number' is not assignable to type 'PointCloudLayer'.",
      "wrong.ts(3): Cannot find name 'none'.",
    ]);
    expect(examples("a\n```ts\nb;\n```\n```sh\nc\n```\n")).toEqual([{ line: 3, code: "b;\n" }]);
  });
});
