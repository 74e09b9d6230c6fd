/** x, y, z of each plain record as LAS integers. */
export function readCoordinates(bytes: Uint8Array, recordLength: number): Int32Array {
  const count = Math.floor(bytes.length / recordLength);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const xyz = new Int32Array(3 * count);
  for (let to = 0, at = 0; to < xyz.length; to += 3, at += recordLength) {
    xyz[to] = view.getInt32(at, true);
    xyz[to + 1] = view.getInt32(at + 4, true);
    xyz[to + 2] = view.getInt32(at + 8, true);
  }
  return xyz;
}

/** Least and greatest LAS integer per axis: min x, y, z, max x, y, z. */
export function integerBox(xyz: Int32Array): Int32Array {
  const box = Int32Array.of(2147483647, 2147483647, 2147483647, -2147483648, -2147483648, -2147483648);
  return grow(box, xyz);
}

/** Least and greatest position: min x, y, z, max x, y, z, metres in the node frame. */
export function positionBox(positions: Float32Array): Float32Array {
  const box = Float32Array.of(Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity);
  return grow(box, positions);
}

function grow<T extends Int32Array | Float32Array>(box: T, values: T): T {
  let [minX, minY, minZ, maxX, maxY, maxZ] = box;
  for (let at = 0; at < values.length; at += 3) {
    const x = values[at];
    const y = values[at + 1];
    const z = values[at + 2];
    if (x < minX) minX = x;
    if (y < minY) minY = y;
    if (z < minZ) minZ = z;
    if (x > maxX) maxX = x;
    if (y > maxY) maxY = y;
    if (z > maxZ) maxZ = z;
  }
  box.set([minX, minY, minZ, maxX, maxY, maxZ]);
  return box;
}
