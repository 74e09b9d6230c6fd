import { frozen } from "../../options/index.js";
import type { TextureData } from "./shader.js";

/** A class of points. */
export interface PointClass {
  readonly name: string;
  /** sRGB, 0 to 1. */
  readonly color: readonly [number, number, number];
  readonly show: boolean;
}

/** Classes by their number, 0 to 255. */
export type ClassTable = Readonly<Record<number, PointClass>>;

/** Names as in ASPRS LAS 1.4 R15, table 17 (point formats 6 to 10); the colours are this project's own. */
const NAMED: readonly (readonly [number, string, number])[] = [
  [0, "Created, never classified", 0x9a9a9a],
  [1, "Unclassified", 0xb4b4b4],
  [2, "Ground", 0xa5703c],
  [3, "Low vegetation", 0xb4dc6e],
  [4, "Medium vegetation", 0x64b43c],
  [5, "High vegetation", 0x1e7828],
  [6, "Building", 0xe08214],
  [7, "Low point (noise)", 0xc81e5a],
  [8, "Reserved", 0x787878],
  [9, "Water", 0x2878c8],
  [10, "Rail", 0x6e4b8c],
  [11, "Road surface", 0x505a64],
  [12, "Reserved", 0x6e6e6e],
  [13, "Wire – guard (shield)", 0xf0e628],
  [14, "Wire – conductor (phase)", 0xf0b428],
  [15, "Transmission tower", 0xdc503c],
  [16, "Wire-structure connector", 0xbe783c],
  [17, "Bridge deck", 0xc8a0b4],
  [18, "High noise", 0xff3ca0],
  [19, "Overhead structure", 0xa050a0],
  [20, "Ignored ground", 0x8c8264],
  [21, "Snow", 0xe6f0ff],
  [22, "Temporal exclusion", 0x50c8c8],
];

const UNNAMED = 0x828282;

function rgb(hex: number): readonly [number, number, number] {
  return [(hex >> 16) / 255, ((hex >> 8) & 255) / 255, (hex & 255) / 255];
}

/** All 256 classes: 0 to 22 as ASPRS names them, 23 to 63 reserved, 64 to 255 the user's. */
export const ASPRS_CLASSES: ClassTable = frozen(asprsClasses());

function asprsClasses(): ClassTable {
  const table: Record<number, PointClass> = {};
  for (let number = 0; number < 256; number++) {
    table[number] = { name: number < 64 ? "Reserved" : "User definable", color: rgb(UNNAMED), show: true };
  }
  for (const [number, name, hex] of NAMED) table[number] = { name, color: rgb(hex), show: true };
  return table;
}

/** The part of a style that says how classes look. */
export interface ClassStyle {
  /** Names, colours and visibility of classes; those given replace single ones of ASPRS' table. */
  readonly classes: ClassTable;
}

/** What a filter says of classes: the numbers that pass; undefined: all. */
interface ClassFilter {
  readonly classes?: readonly number[] | undefined;
}

/** Whether a class is shown: by the style's table and by the filter. */
export function showsClass(
  { classes }: ClassStyle,
  filter: ClassFilter | undefined,
  number: number,
): boolean {
  return classes[number]?.show !== false && (filter?.classes?.includes(number) ?? true);
}

/** Whether any class is hidden. */
export function hidesClasses({ classes }: ClassStyle, filter: ClassFilter | undefined): boolean {
  return filter?.classes !== undefined || Object.values(classes).some(({ show }) => !show);
}

/** GLSL: colour of a class, and in alpha whether it is shown. */
export const CLASS_ENTRY = `
vec4 classEntry(float number) {
  return texelFetch(u_classes, ivec2(int(number + 0.5), 0), 0);
}
`;

/** Colours of the 256 classes; alpha says which are shown. */
export function classTexture(style: ClassStyle, filter: ClassFilter | undefined): TextureData {
  const data = new Uint8Array(4 * 256);
  for (let number = 0; number < 256; number++) {
    const color = style.classes[number].color.map((part) => Math.round(255 * part));
    data.set([...color, showsClass(style, filter, number) ? 255 : 0], 4 * number);
  }
  return { name: "u_classes", width: 256, height: 1, data };
}
