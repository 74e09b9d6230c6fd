import { join } from "node:path";
import ts from "typescript";
import { describe, expect, it } from "vitest";
import { projectRoot } from "../project.js";

/** What applications import. */
const ENTRIES = [
  "index.ts",
  "cesium/index.ts",
  "openlayers/index.ts",
  "link/index.ts",
  "navigation/index.ts",
  "tools/index.ts",
  "plot/index.ts",
].map((entry) => `layer/src/${entry}`);
const OURS = /\/(georef|layer)\/(src|dist)\//;

/**
 * Names of the project's own types that an entry's declarations mention in what they let others see, but that the entry
 * does not export: an application could use such a value and not write down its type.
 */
function unnameable(program: ts.Program, entry: string): string[] {
  const checker = program.getTypeChecker();
  const module = checker.getSymbolAtLocation(program.getSourceFile(entry)!)!;
  const resolved = (symbol: ts.Symbol) =>
    symbol.flags & ts.SymbolFlags.Alias ? checker.getAliasedSymbol(symbol) : symbol;
  const exported = new Set(checker.getExportsOfModule(module).map(resolved));
  const missing = new Set<string>();
  const known = new Set<ts.Symbol>();
  const look = (node: ts.Node): void => {
    // Neither bodies nor private or internal members are seen by others.
    if (ts.isBlock(node) || isPrivate(node) || isInternal(node)) return;
    if (ts.isPropertyDeclaration(node) && node.type === undefined) return;
    // What a type is compared with decides which branch is seen, and is not seen itself.
    if (ts.isConditionalTypeNode(node)) {
      for (const part of [node.checkType, node.trueType, node.falseType]) look(part);
      return;
    }
    const name = ts.isTypeReferenceNode(node)
      ? node.typeName
      : ts.isExpressionWithTypeArguments(node)
        ? node.expression
        : undefined;
    const symbol = name && checker.getSymbolAtLocation(name);
    const target = symbol && resolved(symbol);
    if (target && !(target.flags & ts.SymbolFlags.TypeParameter)) {
      const ours = target.declarations?.find((one) => OURS.test(one.getSourceFile().fileName));
      if (ours && !exported.has(target) && !known.has(target)) {
        known.add(target);
        // An alias that its file keeps to itself is a way of writing; what it is made of is what others meet.
        if (ts.isTypeAliasDeclaration(ours) && !isExported(ours)) look(ours.type);
        else missing.add(target.name);
      }
    }
    ts.forEachChild(node, look);
  };
  for (const symbol of exported) {
    for (const declaration of symbol.declarations ?? []) {
      if (OURS.test(declaration.getSourceFile().fileName)) look(seenPart(declaration));
    }
  }
  return [...missing].sort();
}

/** Of a constant only its type is seen, if it has one written down. */
function seenPart(declaration: ts.Declaration): ts.Node {
  return ts.isVariableDeclaration(declaration) && declaration.type ? declaration.type : declaration;
}

function isExported(declaration: ts.TypeAliasDeclaration): boolean {
  return declaration.modifiers?.some(({ kind }) => kind === ts.SyntaxKind.ExportKeyword) ?? false;
}

function isPrivate(node: ts.Node): boolean {
  if (!ts.isClassElement(node)) return false;
  if (node.name && ts.isPrivateIdentifier(node.name)) return true;
  return ts.canHaveModifiers(node)
    ? (ts.getModifiers(node) ?? []).some(({ kind }) => kind === ts.SyntaxKind.PrivateKeyword)
    : false;
}

/** What `stripInternal` leaves out of the declarations. */
function isInternal(node: ts.Node): boolean {
  return ts.getJSDocTags(node).some(({ tagName }) => tagName.text === "internal");
}

describe("every type that an entry's declarations mention", () => {
  const files = ENTRIES.map((entry) => join(projectRoot, entry));
  const config = ts.readConfigFile(join(projectRoot, "layer/tsconfig.json"), ts.sys.readFile).config;
  const { options } = ts.parseJsonConfigFileContent(config, ts.sys, join(projectRoot, "layer"));
  const program = ts.createProgram(files, { ...options, noEmit: true, composite: false, incremental: false });

  it.each(ENTRIES)("is exported by %s", { timeout: 120_000 }, (entry) => {
    expect(unnameable(program, join(projectRoot, entry))).toEqual([]);
  });
});

it("the declarations that are given away name nothing that they lack", { timeout: 120_000 }, () => {
  const built = ENTRIES.map((entry) =>
    join(projectRoot, entry.replace("/src/", "/dist/").replace(/ts$/, "d.ts")),
  );
  const { options } = ts.convertCompilerOptionsFromJson(
    { strict: true, noEmit: true, target: "es2023", module: "nodenext", types: [], skipLibCheck: false },
    projectRoot,
  );
  const program = ts.createProgram(built, options);
  const said = program
    .getSourceFiles()
    .filter(({ fileName }) => OURS.test(fileName))
    .flatMap((file) => program.getSemanticDiagnostics(file))
    .map(({ file, messageText }) => [
      file?.fileName.slice(projectRoot.length),
      ts.flattenDiagnosticMessageText(messageText, " "),
    ]);
  expect(said).toEqual([]);
});
