/** Digits that a coordinate in a message has: more are those of its binary form. */
const DIGITS = 12;

/** A coordinate as a message shows it: `580000.41` for 580000.4100000001. */
export function coordinate(value: number): string {
  return String(Number(value.toPrecision(DIGITS)));
}

/** Bounds in source units; of a rectangle those of x and y alone. */
interface Bounds {
  readonly minX: number;
  readonly minY: number;
  readonly minZ?: number;
  readonly maxX: number;
  readonly maxY: number;
  readonly maxZ?: number;
}

/** Bounds as a message shows them: `x 580000.41 … 580199.8, y …`. */
export function boundsInWords({ minX, minY, minZ, maxX, maxY, maxZ }: Bounds): string {
  const axis = (name: string, from: number, to: number) => `${name} ${coordinate(from)} … ${coordinate(to)}`;
  const plane = `${axis("x", minX, maxX)}, ${axis("y", minY, maxY)}`;
  return minZ === undefined || maxZ === undefined ? plane : `${plane}, ${axis("z", minZ, maxZ)}`;
}
