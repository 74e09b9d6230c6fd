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
export const ASPRS_CLASSES: ClassTable = (() => {
  const table: Record<number, PointClass> = {};
  for (let number = 0; number < 256; number++) {
    table[number] = { name: number < 64 ? "Reserved" : "User definable", color: rgb(UNNAMED), show: true };
  }
  for (const [number, name, hex] of NAMED) table[number] = { name, color: rgb(hex), show: true };
  return table;
})();
