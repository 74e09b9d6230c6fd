import parse from "wkt-parser/parser.js";
import { unknown } from "./refusal.js";

/** A node of WKT: keyword, then strings (quoted or not), numbers and nodes. */
export type WktNode = readonly [keyword: string, ...content: WktItem[]];
/** What stands between the brackets of a node. */
export type WktItem = string | number | WktNode;

/**
 * The nodes of a WKT text; ESRI writes a compound CRS as two, side by side.
 * @throws Refusal CRS_UNKNOWN when the text is no WKT
 */
export function parseWkt(text: string): readonly WktNode[] {
  try {
    // One node around all: the parser stops at the end of the first, which loses ESRI's VERTCS.
    return children(checked(parse(`ROOT[${text}]`)));
  } catch {
    throw unknown(`"${excerpt(text)}" is no WKT that can be read`);
  }
}

function checked(item: unknown): WktNode {
  if (!Array.isArray(item) || typeof item[0] !== "string") throw new TypeError("no WKT node");
  const [keyword, ...content] = item as [string, ...unknown[]];
  const items = content.map((part) => (Array.isArray(part) ? checked(part) : (part as string | number)));
  return [keyword.toUpperCase(), ...items];
}

/** The beginning of a text, for messages. */
export function excerpt(text: string): string {
  const line = text.replace(/\s+/g, " ").trim();
  return line.length > 40 ? `${line.slice(0, 40)}…` : line;
}

/** Whether an item is a node, and not a text or a number. */
export function isNode(item: WktItem | undefined): item is WktNode {
  return typeof item === "object";
}

/** Child nodes, all or those with one of the keywords. */
export function children(node: WktNode, ...keywords: string[]): WktNode[] {
  return node
    .slice(1)
    .filter((item): item is WktNode => isNode(item) && (keywords.length === 0 || keywords.includes(item[0])));
}

/** First child node with one of the keywords. */
export function child(node: WktNode, ...keywords: string[]): WktNode | undefined {
  return children(node, ...keywords)[0];
}

/** The item at a position, as text; empty when there is none. */
export function text(node: WktNode, position: number): string {
  const item = node[position];
  return typeof item === "string" || typeof item === "number" ? String(item) : "";
}

/** The item at a position, as a number; NaN when it is none. */
export function number(node: WktNode, position: number): number {
  const item = text(node, position);
  return item === "" ? Number.NaN : Number(item);
}

/** EPSG code of a node (`ID` or `AUTHORITY` among its children). */
export function epsgCode(node: WktNode): number | undefined {
  for (const id of children(node, "ID", "AUTHORITY")) {
    const code = number(id, 2);
    if (text(id, 1).toUpperCase() === "EPSG" && Number.isInteger(code)) return code;
  }
  return undefined;
}
