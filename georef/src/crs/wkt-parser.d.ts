declare module "wkt-parser/parser.js" {
  /** Nested arrays: keyword, then strings, numbers and nodes. Throws on text that does not close. */
  type Node = (string | number | Node)[];
  export default function parse(text: string): Node;
}
