import { mkdirSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join, relative } from "node:path";
import ts from "typescript";
import { describe, expect, it } from "vitest";
import { projectRoot } from "../project.js";

/**
 * Rooms that get names from files and servers. `object[name]` with such a name finds, and changes, what every object
 * inherits (`__proto__`, `constructor`): names are looked up in a `Map`. An object that has no prototype, or whose names
 * are this project's own, may be marked with a remark on its line or above it: `// Own names: why`.
 */
const ROOMS = ["converter/cli", "demo/src", "demo/sample"];
const MARK = /\/\/ Own names: \w/;

/** Sources of a room without its tests. */
function sources(room: string): string[] {
  return readdirSync(join(projectRoot, room), { recursive: true, encoding: "utf8" })
    .filter(
      (name) => /\.ts$/.test(name) && !/(\.test|\.fixture|\.d)\.ts$|(^|\/)(dist|node_modules)\//.test(name),
    )
    .map((name) => join(projectRoot, room, name));
}

/** Uses of a name that the compiler knows only as some text, as `file:line: source text`. */
function lookupsByName(files: readonly string[]): string[] {
  const { config } = ts.readConfigFile(join(projectRoot, "tests/tsconfig.json"), ts.sys.readFile);
  const { options } = ts.parseJsonConfigFileContent(config, ts.sys, join(projectRoot, "tests"));
  const program = ts.createProgram([...files], options);
  const checker = program.getTypeChecker();
  const found: string[] = [];
  const isSomeText = (type: ts.Type): boolean => {
    const known = checker.getBaseConstraintOfType(type) ?? type;
    if (known.isUnion()) return known.types.some(isSomeText);
    return (
      (known.flags &
        (ts.TypeFlags.String | ts.TypeFlags.TemplateLiteral | ts.TypeFlags.Any | ts.TypeFlags.Unknown)) !==
      0
    );
  };
  for (const file of files) {
    const source = program.getSourceFile(file)!;
    const lines = source.text.split("\n");
    const visit = (node: ts.Node): void => {
      const name = nameUsed(node);
      const { line } = source.getLineAndCharacterOfPosition(node.getStart());
      const marked = MARK.test(lines[line]!) || MARK.test(lines[line - 1] ?? "");
      if (name && !marked && isSomeText(checker.getTypeAtLocation(name))) {
        found.push(`${relative(projectRoot, file)}:${line + 1}: ${node.getText()}`);
      }
      ts.forEachChild(node, visit);
    };
    visit(source);
  }
  return found;
}

/** The name of `object[name]`, `name in object` and `{ [name]: value } = object`. */
function nameUsed(node: ts.Node): ts.Expression | undefined {
  if (ts.isElementAccessExpression(node)) return node.argumentExpression;
  if (ts.isBinaryExpression(node) && node.operatorToken.kind === ts.SyntaxKind.InKeyword) {
    return ts.isPrivateIdentifier(node.left) ? undefined : node.left;
  }
  if (ts.isBindingElement(node) && node.propertyName && ts.isComputedPropertyName(node.propertyName)) {
    return node.propertyName.expression;
  }
  return undefined;
}

describe("names from files and servers", { timeout: 120_000 }, () => {
  it("are looked up in no plain object", () => {
    const files = ROOMS.flatMap(sources);
    expect(files.length).toBeGreaterThan(100);
    expect(lookupsByName(files)).toEqual([]);
  });

  it("are seen in a plain object (negative control)", () => {
    mkdirSync(join(projectRoot, "tests/artifacts"), { recursive: true });
    const folder = mkdtempSync(join(projectRoot, "tests/artifacts/names-"));
    const file = join(folder, "a.ts");
    const lines = [
      "export function f(plain: Record<string, number>, list: number[], name: string, own: 'a' | 'b') {",
      "  plain[name] = 1;",
      "  const { [name]: value } = plain;",
      "  const there = name in plain;",
      "  const part = plain['u_' + name];",
      "  // Own names: made here.",
      "  const marked = plain[name];",
      "  return [list[0], { a: 1, b: 2 }[own], 'a' in plain, value, there, part, marked];",
      "}",
    ];
    writeFileSync(file, lines.join("\n"));
    try {
      const found = lookupsByName([file]).map((text) => Number(text.split(":")[1]));
      expect(found).toEqual([2, 3, 4, 5]);
    } finally {
      rmSync(folder, { recursive: true });
    }
  });
});
