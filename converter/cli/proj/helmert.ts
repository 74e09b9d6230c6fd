import { refuseStep } from "./refuse.js";
import type { StepText } from "./step-text.js";

/** X' = translation + matrix · X: metres, matrix row-major 3 × 3. */
export interface LinearMap {
  readonly translation: readonly [number, number, number];
  readonly matrix: readonly number[];
}

/** The map that moves nothing. */
export const IDENTITY: LinearMap = { translation: [0, 0, 0], matrix: [1, 0, 0, 0, 1, 0, 0, 0, 1] };

const ARC_SECOND = Math.PI / 648_000;
const KNOWN = new Set(["x", "y", "z", "rx", "ry", "rz", "s", "convention", "exact"]);
const PIVOT = new Set(["px", "py", "pz"]);

/**
 * Linear map of PROJ's `helmert` (3 and 7 parameters, not those that change with time) and `molobadekas`:
 * translations in metres, rotations in arc-seconds, scale in parts per million (EPSG methods 1031, 1032, 1033, 1034,
 * 1061; PROJ, helmert.cpp). PROJ takes small angles for their sines unless `+exact` is given, and inverts the
 * rotation by transposing it, which then is not quite its inverse; both are done here likewise.
 *
 * @throws CrsError CRS_OPERATION_UNSUPPORTED for parameters that are not known here
 */
export function helmertMap(step: StepText): LinearMap {
  const { parameters } = step;
  for (const key of parameters.keys()) {
    if (!KNOWN.has(key) && !(step.name === "molobadekas" && PIVOT.has(key))) {
      throw refuseStep(step, `its parameter +${key}`);
    }
  }
  const number = (key: string) => {
    const text = parameters.get(key);
    if (text === undefined) return 0;
    const value = Number(text);
    if (text === "" || !Number.isFinite(value)) throw refuseStep(step, `its parameter +${key}=${text}`);
    return value;
  };
  const angles = [number("rx"), number("ry"), number("rz")].map((seconds) => seconds * ARC_SECOND);
  const rotation = rotationOf(step, angles);
  const scale = 1 + number("s") * 1e-6;
  const shift = [number("x"), number("y"), number("z")];
  const pivot = [number("px"), number("py"), number("pz")];

  if (step.inverse) {
    // X = pivot + Rᵀ (X' − shift − pivot) / scale
    const matrix = transposed(rotation).map((value) => value / scale);
    const moved = times(
      matrix,
      shift.map((value, i) => value + pivot[i]),
    );
    return { translation: [pivot[0] - moved[0], pivot[1] - moved[1], pivot[2] - moved[2]], matrix };
  }
  // X' = shift + pivot + scale · R (X − pivot)
  const matrix = rotation.map((value) => value * scale);
  const moved = times(matrix, pivot);
  return {
    translation: [
      shift[0] + pivot[0] - moved[0],
      shift[1] + pivot[1] - moved[1],
      shift[2] + pivot[2] - moved[2],
    ],
    matrix,
  };
}

/** First `first`, then `second`. */
export function compose(first: LinearMap, second: LinearMap): LinearMap {
  const matrix: number[] = [];
  for (let i = 0; i < 3; i++) {
    for (let j = 0; j < 3; j++) {
      let sum = 0;
      for (let k = 0; k < 3; k++) sum += second.matrix[3 * i + k] * first.matrix[3 * k + j];
      matrix.push(sum);
    }
  }
  const moved = times(second.matrix, first.translation);
  const [x, y, z] = second.translation;
  return { translation: [x + moved[0], y + moved[1], z + moved[2]], matrix };
}

/** Whether a map moves nothing. */
export function isIdentity({ translation, matrix }: LinearMap): boolean {
  return translation.every((t) => t === 0) && matrix.every((value, i) => value === IDENTITY.matrix[i]);
}

/** Rotation of the coordinate frame, or of the position vector, which is its transpose. */
function rotationOf(step: StepText, [rx, ry, rz]: readonly number[]): number[] {
  const convention = step.parameters.get("convention");
  if (rx === 0 && ry === 0 && rz === 0) return [...IDENTITY.matrix];
  if (convention !== "position_vector" && convention !== "coordinate_frame") {
    throw refuseStep(step, `its convention "${convention ?? "none"}"`);
  }
  const frame = step.parameters.has("exact") ? exactFrame(rx, ry, rz) : [1, rz, -ry, -rz, 1, rx, ry, -rx, 1];
  return convention === "coordinate_frame" ? frame : transposed(frame);
}

/** R_z(rz) · R_y(ry) · R_x(rx) of the coordinate frame. */
function exactFrame(rx: number, ry: number, rz: number): number[] {
  const [cx, cy, cz] = [Math.cos(rx), Math.cos(ry), Math.cos(rz)];
  const [sx, sy, sz] = [Math.sin(rx), Math.sin(ry), Math.sin(rz)];
  return [
    cy * cz,
    cx * sz + sx * sy * cz,
    sx * sz - cx * sy * cz,
    -cy * sz,
    cx * cz - sx * sy * sz,
    sx * cz + cx * sy * sz,
    sy,
    -sx * cy,
    cx * cy,
  ];
}

function transposed(m: readonly number[]): number[] {
  return [m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]];
}

function times(m: readonly number[], v: readonly number[]): [number, number, number] {
  return [
    m[0] * v[0] + m[1] * v[1] + m[2] * v[2],
    m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
    m[6] * v[0] + m[7] * v[1] + m[8] * v[2],
  ];
}
