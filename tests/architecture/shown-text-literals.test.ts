import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import ts from "typescript";
import { describe, expect, it } from "vitest";
import { projectRoot } from "../project.js";

const room = join(projectRoot, "demo/src");

/** Functions of which an argument is shown, by its place; and attributes and properties that are. */
const CALLS: ReadonlyMap<string, number> = new Map([
  ["setText", 1],
  ["textElement", 1],
  ["append", 0],
  ["text", 0],
]);
const SHOWN =
  /^(aria-?(label|description|valuetext)|title|placeholder|alt|label|words|cause|fix|note|caption)$/i;

/** Names, the same in every language; the last is that of a coordinate system, written to files. */
const NAMES = new Set(["LandXML", "Natural Earth", "Groma", "transverse Mercator plane of WGS 84 about"]);
/** What takes selectors, classes, styles, tags and media, which nobody reads. */
const UNSEEN_CALLS = /^(querySelector(All)?|matches|closest|matchMedia|setProperty|getPropertyValue|byId)$/;
const UNSEEN_PROPERTIES = /^(className|cssText)$/;
/** What `append` of D3 is given. */
const TAGS = new Set(["circle", "path", "polygon", "polyline", "svg", "text"]);

/** Literals of a source that people would read, and no catalogue has: whoever reads another language reads English there. */
function bypassing(text: string): string[] {
  const source = ts.createSourceFile("page.ts", text, ts.ScriptTarget.Latest, true);
  const found: string[] = [];
  const visit = (node: ts.Node): void => {
    if (ts.isImportDeclaration(node) || ts.isTypeNode(node)) return;
    if (isTranslated(node, text) || isUnseen(node)) return;
    const words = wordsOf(node);
    if (words !== undefined && (isProse(words) || (isWord(words) && isShown(node)))) found.push(words);
    ts.forEachChild(node, visit);
  };
  visit(source);
  return found;
}

/** A literal as text, of a template what is not filled in; undefined where it is a name. */
function wordsOf(node: ts.Node): string | undefined {
  const parts = ts.isTemplateExpression(node)
    ? [node.head, ...node.templateSpans.map(({ literal }) => literal)]
    : ts.isStringLiteral(node) || ts.isNoSubstitutionTemplateLiteral(node)
      ? [node]
      : [];
  const text = parts.map((part) => part.text).join(" ");
  return NAMES.has(text.replace(/^\P{L}+|\P{L}+$/gu, "")) ? undefined : text;
}

/** Words of one language: three small letters are no unit, and no name of a format. */
const isWord = (words: string) => /\p{Ll}{3,}/u.test(words);
/** Words with a space between them are a sentence wherever they stand; a selector, a path of SVG or a style has other signs. */
const isProse = (words: string) =>
  /(^|[^\p{L}#.:_-])\p{L}\p{Ll}+[,:]? \p{Ll}{2,}/u.test(words) &&
  !/[<>[\]#=]|\d\w*\(|: [\w-]+(;|$)/.test(words);

/** Whether it is handed to the catalogue, kept for it by a comment, or says what a mistake of the page itself is. */
function isTranslated(node: ts.Node, text: string): boolean {
  if (ts.isCallExpression(node) && node.expression.getText() === "i18n.t") return true;
  // Those of the libraries are English, with a sentence of the page above them.
  if (ts.isNewExpression(node) && /^(?!Page)\w*Error$/.test(node.expression.getText())) return true;
  return ts.isStringLiteral(node) && /\/\*i18n\*\/\s*$/.test(text.slice(0, node.getStart()));
}

/** Whether nobody reads it: a selector, classes, the name of a property. */
function isUnseen(node: ts.Node): boolean {
  const { parent } = node;
  if (ts.isCallExpression(node)) return UNSEEN_CALLS.test(nameOf(node));
  if (ts.isPropertyAssignment(parent ?? node)) return (parent as ts.PropertyAssignment).name === node;
  return (
    ts.isBinaryExpression(node) &&
    ts.isPropertyAccessExpression(node.left) &&
    UNSEEN_PROPERTIES.test(node.left.name.text)
  );
}

function nameOf({ expression }: ts.CallExpression): string {
  return ts.isPropertyAccessExpression(expression) ? expression.name.text : expression.getText();
}

/** Whether a literal, or what it is a part of, is written on the page. */
function isShown(node: ts.Node): boolean {
  const { parent } = node;
  if (ts.isConditionalExpression(parent) && parent.condition !== node) return isShown(parent);
  if (ts.isParenthesizedExpression(parent) || ts.isArrayLiteralExpression(parent)) return isShown(parent);
  if (ts.isBinaryExpression(parent)) {
    if (parent.operatorToken.kind !== ts.SyntaxKind.EqualsToken) {
      return /^(\+|\?\?|\|\|)$/.test(parent.operatorToken.getText()) && isShown(parent);
    }
    return ts.isPropertyAccessExpression(parent.left) && SHOWN.test(parent.left.name.text);
  }
  if (ts.isPropertyAssignment(parent)) return SHOWN.test(parent.name.getText());
  if (!ts.isCallExpression(parent)) return false;
  const name = nameOf(parent);
  const place = parent.arguments.indexOf(node as ts.Expression);
  if (name === "setAttribute" || name === "attr") {
    const [attribute] = parent.arguments;
    return place === 1 && ts.isStringLiteral(attribute!) && SHOWN.test(attribute.text);
  }
  return CALLS.get(name) === place && !(name === "append" && TAGS.has(wordsOf(node) ?? ""));
}

describe("text of the page", () => {
  const files = readdirSync(room, { recursive: true, encoding: "utf8" }).filter((name) =>
    /(?<!\.test|\.d)\.ts$/.test(name),
  );

  it("is in the catalogues, all of it", () => {
    expect(files.length).toBeGreaterThan(50);
    const found = files.flatMap((name) =>
      bypassing(readFileSync(join(room, name), "utf8")).map((words) => `${name}: ${words}`),
    );
    expect(found).toEqual([]);
  });

  it.each([
    'setText(note, "reading");',
    'setText(note, busy ? "busy" : i18n.t("free"));',
    'row.append(textElement("dt", "record"));',
    "element.title = `$" + "{count} points`;",
    'element.setAttribute("aria-label", "Close");',
    'optionElement({ value, label: "metres" });',
    'const GROUPS = [{ title: "Light", fields }];',
    'throw new PageError({ code, file, cause: "lost", fix });',
    'const HINT = "Click two places";',
    "return `$" + "{metres} m above the ground`;",
    'throw new PageError({ code, file: name, cause, fix: "Choose another name" });',
  ])("that bypasses them is found: %s", (source) => {
    expect(bypassing(source)).toHaveLength(1);
  });

  it.each([
    'setText(note, i18n.t("reading {name}…", { name }));',
    'const WORDS = new Set([/*i18n*/ "straight", /*i18n*/ "in its plane"]);',
    'element.setAttribute("aria-pressed", "true");',
    'element.className = "quiet wide";',
    'page.querySelector("details summary");',
    'throw new Error("a mistake of the page itself");',
    'const FORMATS = [{ label: "GeoJSON" }, { label: "LAS" }];',
    'canvas.style.cssText = "position: absolute; inset: 0";',
  ])("that is none of people's is left alone: %s", (source) => {
    expect(bypassing(source)).toEqual([]);
  });
});
