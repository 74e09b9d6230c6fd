import { letters } from "./parameters.js";
import { unsupported } from "./refusal.js";
import { child, children, epsgCode, number, text, type WktNode } from "./tree.js";

/** EPSG parameters of a Helmert transformation in the order of `+towgs84`, codes and names. */
const ORDER: readonly (readonly [code: number, name: string])[] = [
  [8605, "xaxistranslation"],
  [8606, "yaxistranslation"],
  [8607, "zaxistranslation"],
  [8608, "xaxisrotation"],
  [8609, "yaxisrotation"],
  [8610, "zaxisrotation"],
  [8611, "scaledifference"],
];

const ARC_SECOND = Math.PI / 648000;

/**
 * The parameters of an abridged transformation (WKT2 BOUNDCRS) as `+towgs84`: metres, arc-seconds, ppm, position
 * vector convention. EPSG methods 9603/1031 (translations), 9606/1033 (position vector), 9607/1032 (coordinate frame,
 * whose rotations turn the other way).
 * @throws Refusal CRS_UNSUPPORTED for any other method
 */
export function bursaWolf(transformation: WktNode): readonly number[] {
  const method = child(transformation, "METHOD");
  const name = method ? letters(text(method, 1)) : "";
  const translations = name.includes("geocentrictranslations");
  const frame = name.includes("coordinateframe");
  if (!translations && !frame && !name.includes("positionvector")) {
    throw unsupported(`its datum shift is of the kind "${method ? text(method, 1) : "unnamed"}"`);
  }
  const values = ORDER.map(() => 0);
  for (const item of children(transformation, "PARAMETER")) {
    const code = epsgCode(item);
    const plain = letters(text(item, 1));
    const position = ORDER.findIndex(([known, spelled]) => known === code || spelled === plain);
    if (position < 0) throw unsupported(`parameter "${text(item, 1)}" of its datum shift is not known`);
    values[position] = parameterValue(item, position);
  }
  if (translations) return values.slice(0, 3);
  return values.map((value, position) => (frame && position >= 3 && position < 6 ? 0 - value : value));
}

function parameterValue(item: WktNode, position: number): number {
  const value = number(item, 2);
  const unit = child(item, "UNIT", "LENGTHUNIT", "ANGLEUNIT", "SCALEUNIT");
  const size = unit && number(unit, 2);
  if (position < 3) return value * (size ?? 1);
  if (position < 6) return size === undefined ? value : (value * size) / ARC_SECOND;
  // WKT2 writes the factor (1.0000024), PROJJSON the difference with its unit.
  if (size === undefined || size === 1) return Math.abs(value - 1) < 1e-3 ? (value - 1) * 1e6 : value * 1e6;
  return value * size * 1e6;
}
