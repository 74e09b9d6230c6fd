/** A view that looks down at a place from a height, as the layer's octree takes it. */
export function viewFrom(cloud, { x, y, height, heading, pitch }) {
  const position = cloud.place(x, y, height, new Float64Array(3));
  const at = (east, north, up) => {
    const there = cloud.place(x + east, y + north, height + up, new Float64Array(3));
    return there.map((value, axis) => value - position[axis]);
  };
  const east = unit(at(1, 0, 0));
  const north = unit(at(0, 1, 0));
  const up = unit(at(0, 0, 1));
  const mix = (e, n, u) => [0, 1, 2].map((axis) => e * east[axis] + n * north[axis] + u * up[axis]);
  const level = mix(Math.sin(heading), Math.cos(heading), 0);
  const direction = level.map((value, axis) => value * Math.cos(pitch) + up[axis] * Math.sin(pitch));
  const right = mix(Math.cos(heading), -Math.sin(heading), 0);
  const above = cross(right, direction);
  const halfHeight = FIELD_OF_VIEW / 2;
  const halfWidth = Math.atan(Math.tan(halfHeight) * (16 / 9));
  const side = (axis, angle) =>
    plane(
      direction.map((value, k) => value * Math.sin(angle) + axis[k] * Math.cos(angle)),
      position,
    );
  const planes = [
    ...side(right, halfWidth),
    ...side(
      right.map((value) => -value),
      halfWidth,
    ),
    ...side(above, halfHeight),
    ...side(
      above.map((value) => -value),
      halfHeight,
    ),
  ];
  const projection = { kind: "perspective", fieldOfView: FIELD_OF_VIEW };
  return { position, direction, planes, height: 1080, projection, horizon: true };
}

const FIELD_OF_VIEW = Math.PI / 3;

const plane = (normal, through) => [
  ...normal,
  -(normal[0] * through[0] + normal[1] * through[1] + normal[2] * through[2]),
];
const unit = (vector) => Array.from(vector, (value) => value / Math.hypot(...vector));
const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];
