import {
  type AreaOfUse,
  type Domain,
  ecefToGeodetic,
  extentOf,
  GromaError,
  isInside,
  spread,
} from "@groma/georef";
import { type Candidate, tryOperation } from "./candidate.js";
import { type DegreeBox, type Operation, operationAreas } from "./operation.js";
import type { Proj } from "./program/find.js";
import type { CrsText } from "./source.js";

/** Parts of a data set that PROJ would place by another operation. */
export interface Elsewhere {
  /** The one that leads farthest away. */
  readonly operation: string;
  /** Greatest distance between the two ways, metres. */
  readonly metres: number;
  /** The same with the accuracy that is published for the other operation. */
  readonly worth: number;
  /** Share of the data set's bounds that other operations are for. */
  readonly share: number;
}

/** A list of operations, and what it was asked for. */
export interface Listed {
  readonly source: CrsText;
  readonly operations: readonly Operation[];
}

/** What a reader has to know of it. */
export function elsewhereNote({ operation, metres, share }: Elsewhere): string {
  const percent = Math.max(1, Math.round(100 * share));
  const far = (Math.ceil(metres * 100) / 100).toFixed(2);
  return `for ${percent} % of the data set's bounds PROJ has another operation, up to ${far} m from this one, which the accuracy counts: ${operation}`;
}

const DEGREE = Math.PI / 180;

/**
 * How far a data set that is placed by one operation lies from where PROJ puts its points one by one: each by the most
 * accurate operation whose area of use the point lies in and that has a place for it (`pj_get_suggested_operation`).
 *
 * @param box where the data are, as the operations were listed for
 * @param metresPerUnit of the source's z
 * @returns nothing where PROJ takes the same operation everywhere, or all of them lead to the same places
 * @throws ProjError PROJ_FAILED, PROJ_OUTPUT
 */
export async function placedElsewhere(
  proj: Proj,
  { source, operations }: Listed,
  candidate: Candidate,
  domain: Domain,
  box: DegreeBox | undefined,
  metresPerUnit: number,
  signal?: AbortSignal,
): Promise<Elsewhere | undefined> {
  const usable = (one: Operation) =>
    !one.ballpark && one.missingGrids.length === 0 && one.pipeline !== undefined;
  if (candidate.operation.ballpark || operations.filter(usable).length < 2) return undefined;
  const areas = await operationAreas(proj, source, { box, signal });
  const { places: own } = candidate;
  const count = spread(domain).length / 3;
  const where = Array.from({ length: count }, (_, i) => placeOf(own, i));
  // Points that no operation has placed as PROJ would, so far.
  const open = new Set(where.flatMap((place, i) => (place ? [i] : [])));
  const total = open.size;
  let farthest: Elsewhere | undefined;
  let elsewhere = 0;
  for (const { operation, area } of ranked(operations.filter(usable), areas)) {
    const inside = [...open].filter((i) => isInside(area, where[i]!));
    if (inside.length === 0) continue;
    const its = operation === candidate.operation ? candidate : await other(operation);
    if (!its) continue;
    const { places } = its;
    for (const i of inside) {
      if (!Number.isFinite(places[3 * i]!)) continue;
      open.delete(i);
      const [x, y, z] = [0, 1, 2].map((axis) => places[3 * i + axis]! - own[3 * i + axis]!) as [
        number,
        number,
        number,
      ];
      const metres = Math.hypot(x, y, z);
      if (its !== candidate) elsewhere++;
      const worth = metres + (operation.accuracy ?? 0);
      if (metres <= SAME || worth <= (farthest?.worth ?? 0)) continue;
      farthest = { operation: operation.name, metres, worth, share: 0 };
    }
  }
  return farthest && { ...farthest, share: elsewhere / total };

  async function other(operation: Operation): Promise<Candidate | undefined> {
    try {
      return await tryOperation(proj, operation, domain, metresPerUnit, signal);
    } catch (error) {
      // It is not for this place, or its steps are not understood: then it is named among those passed over.
      if (error instanceof GromaError && error.code !== "PROJ_OUTPUT") return undefined;
      throw error;
    }
  }
}

/**
 * In the order in which PROJ takes them for a point within: by accuracy, the smaller area first; then those of unknown
 * accuracy, and those for the sea alone.
 */
function ranked(operations: readonly Operation[], areas: ReadonlyMap<string, AreaOfUse>) {
  const last = ({ accuracy, area }: Operation) => accuracy === null || area.includes("- offshore");
  return operations
    .flatMap((operation) => {
      const area = areas.get(operation.name);
      return area ? [{ operation, area }] : [];
    })
    .sort((a, b) => {
      const [first, second] = [last(a.operation), last(b.operation)];
      if (first || second) return Number(first) - Number(second);
      return a.operation.accuracy! - b.operation.accuracy! || extentOf(a.area) - extentOf(b.area);
    });
}

/** Metres; two ways that are closer lead to the same place. */
const SAME = 1e-3;

function placeOf(ecef: Float64Array, i: number) {
  const [x, y, z] = ecef.subarray(3 * i, 3 * i + 3);
  if (!Number.isFinite(x! + y! + z!)) return undefined;
  const out = new Float64Array(3);
  ecefToGeodetic(x!, y!, z!, out);
  return { longitude: out[0]! / DEGREE, latitude: out[1]! / DEGREE };
}
