/** Place of a node in an octree: depth 0 is the root; at depth d each index lies in [0, 2^d). */
export interface VoxelKey {
  readonly depth: number;
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

/** Key of the root. */
export const ROOT_KEY: VoxelKey = { depth: 0, x: 0, y: 0, z: 0 };

/** A key as COPC writes it in words: `depth-x-y-z`. */
export function keyName(key: VoxelKey): string {
  return `${key.depth}-${key.x}-${key.y}-${key.z}`;
}

/** The key that {@link keyName} wrote; undefined where the text is not one. */
export function parseKey(name: string): VoxelKey | undefined {
  const match = /^(\d{1,2})-(\d+)-(\d+)-(\d+)$/.exec(name);
  if (!match) return undefined;
  const [depth, x, y, z] = match.slice(1).map(Number) as [number, number, number, number];
  const edge = 2 ** depth;
  return depth <= 31 && x < edge && y < edge && z < edge ? { depth, x, y, z } : undefined;
}

/** Key of the ancestor at a depth not below the key's own; the key itself at its own depth. */
export function ancestorAt(key: VoxelKey, depth: number): VoxelKey {
  const shift = key.depth - depth;
  return { depth, x: key.x >>> shift, y: key.y >>> shift, z: key.z >>> shift };
}

/** True where both name the same node. */
export function sameKey(a: VoxelKey, b: VoxelKey): boolean {
  return a.depth === b.depth && a.x === b.x && a.y === b.y && a.z === b.z;
}

/** True where `key` is `ancestor` or lies below it. */
export function isWithin(key: VoxelKey, ancestor: VoxelKey): boolean {
  const shift = key.depth - ancestor.depth;
  return (
    shift >= 0 &&
    key.x >>> shift === ancestor.x &&
    key.y >>> shift === ancestor.y &&
    key.z >>> shift === ancestor.z
  );
}

/**
 * Number of a node among its siblings, 0 to 7: x in bit 0, y in bit 1, z in bit 2.
 * @param of depth of the ancestor that is meant instead of the node itself
 */
export function octant({ depth, x, y, z }: VoxelKey, of: number = depth): number {
  const shift = depth - of;
  return ((x >>> shift) & 1) | (((y >>> shift) & 1) << 1) | (((z >>> shift) & 1) << 2);
}
