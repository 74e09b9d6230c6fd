import { type AreaOfUse, type Domain, GromaError, type Rectangle, spread } from "@groma/georef";
import { type Candidate, tryOperation } from "./candidate.js";
import { faultOf } from "./faulty.js";
import { type DegreeBox, listOperations, type Operation, operationAreas } from "./operation.js";
import type { Proj } from "./program/find.js";
import type { CrsText } from "./source.js";
import { rectanglesOf } from "./source-areas.js";
import { holds, type Proposal, takenAreas } from "./taken-areas.js";

/** An operation, and where PROJ takes it. */
export interface TakenWay {
  readonly candidate: Candidate;
  /** Source units; several where its area of use goes across the antimeridian. */
  readonly areas: readonly Rectangle[];
  /** Share of the data set's bounds for which PROJ takes it. */
  readonly share: number;
}

/** What PROJ does with a data set that it places point by point. */
export interface PointByPoint {
  /** In the order in which PROJ takes them. */
  readonly ways: readonly TakenWay[];
  /** The one that leads farthest away from the way that was chosen for all; nothing where no point has a place by both. */
  readonly farthest?: Farthest | undefined;
}

/** The other way that leads farthest from the one that was chosen. */
export interface Farthest {
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
  /** Where the data are, if the list is for that place. */
  readonly box: DegreeBox | undefined;
}

/** What a reader has to know where PROJ's other operations are not followed. */
export function elsewhereNote({ operation, metres, share }: Farthest): string {
  const far = (Math.ceil(metres * 100) / 100).toFixed(2);
  return `for ${percent(share)} % of the data set's bounds PROJ has another operation, up to ${far} m from this one, which the accuracy counts: ${operation}`;
}

/** What a reader has to know where they are. */
export function severalNote(ways: readonly TakenWay[], main: TakenWay): string {
  const others = ways.filter(({ candidate }) => candidate !== main.candidate);
  const operations = new Set(others.map(({ candidate }) => candidate.operation));
  const named = [...operations].map(({ name, accuracy }) => {
    return `${name} (${accuracy === null ? "unknown accuracy" : `${accuracy} m`})`;
  });
  const share = percent(others.reduce((sum, way) => sum + way.share, 0));
  return `in ${share} % of the data set's bounds points are placed by another operation, as PROJ does: ${named.join("; ")}`;
}

function percent(share: number): number {
  return Math.max(1, Math.round(100 * share));
}

/**
 * By which operations PROJ places the points of a data set one by one: each by the most accurate whose area of use the
 * point lies in and that has a place for it (`pj_get_suggested_operation`).
 *
 * @param candidate the one that was chosen for all of them
 * @param metresPerUnit of the source's z
 * @returns nothing where that is the chosen one everywhere, or all of them lead to the same places
 * @throws ProjError PROJ_FAILED, PROJ_OUTPUT
 */
export async function pointByPoint(
  proj: Proj,
  { source, operations, box }: Listed,
  candidate: Candidate,
  domain: Domain,
  metresPerUnit: number,
  signal?: AbortSignal,
): Promise<PointByPoint | undefined> {
  const isUsable = (one: Operation) =>
    !one.ballpark && one.missingGrids.length === 0 && one.pipeline !== undefined && !faultOf(one.name);
  const usable = operations.filter(isUsable);
  if (candidate.operation.ballpark || usable.length < 2) return undefined;
  let order: readonly Operation[] | undefined;
  const inOrder = async () => {
    const known = new Map(usable.map((operation) => [identityOf(operation), operation]));
    order ??= (await listOperations(proj, source, { signal })).flatMap(
      (one) => known.get(identityOf(one)) ?? [],
    );
    return order;
  };
  // Only those that never take the place of another ask for PROJ's own order.
  const listed = usable.some(isLast) ? await inOrder() : usable;
  const areasOfUse = await operationAreas(proj, source, { box, signal });
  const areaOf = new Map(operations.map((operation, i) => [operation, areasOfUse[i]]));
  const proposals = await proposalsOf(proj, candidate.plan, listed, areaOf, signal);
  if (!proposals) return undefined;
  const taken = new TakenPoints(candidate, spread(domain));
  const take = async (operation: Operation, areas: readonly Rectangle[]) => {
    const inside = taken.openIn(areas);
    if (inside.length === 0) return false;
    const its =
      taken.candidateOf(operation) ?? (await triedOrNone(proj, operation, domain, metresPerUnit, signal));
    return its !== undefined && taken.take(its, inside, areas);
  };
  for (const { operation, areas } of takenAreas(proposals, around(domain))) await take(operation, areas);
  // A point in no area goes by the first that needs no grid.
  if (taken.someOpen) {
    for (const operation of await inOrder()) {
      if (!/\+grids=/.test(operation.pipeline!) && (await take(operation, [around(domain)]))) break;
    }
  }
  return taken.outcome;
}

/** The points of a data set, and the operations that PROJ takes for them, one operation after the other. */
class TakenPoints {
  readonly #candidate: Candidate;
  readonly #points: ArrayLike<number>;
  readonly #total: number;
  /** Points that no operation has placed as PROJ would, so far. */
  readonly #open: Set<number>;
  readonly #ways: TakenWay[] = [];
  #farthest: Omit<Farthest, "share"> | undefined;
  /** Whether a point has a place by one way and none by the other. */
  #beyond = false;

  /**
   * @param candidate the way that was chosen for all of them
   * @param points x, y, z of each, source units
   */
  constructor(candidate: Candidate, points: ArrayLike<number>) {
    this.#candidate = candidate;
    this.#points = points;
    this.#total = points.length / 3;
    this.#open = new Set(Array.from({ length: this.#total }, (_, i) => i));
  }

  /** Whether there are points that no operation has been taken for. */
  get someOpen(): boolean {
    return this.#open.size > 0;
  }

  /** Nothing where the chosen way is PROJ's everywhere, or all ways lead to the same places. */
  get outcome(): PointByPoint | undefined {
    const [ways, farthest] = [this.#ways, this.#farthest];
    if (!farthest && !this.#beyond) return undefined;
    const others = ways.filter((way) => way.candidate !== this.#candidate);
    const share = others.reduce((sum, way) => sum + way.share, 0);
    return { ways, ...(farthest && { farthest: { ...farthest, share } }) };
  }

  /** What is known of an operation already. */
  candidateOf(operation: Operation): Candidate | undefined {
    const known = [this.#candidate, ...this.#ways.map((way) => way.candidate)];
    return known.find((one) => one.operation === operation);
  }

  /** Indices of the open points in some areas. */
  openIn(areas: readonly Rectangle[]): number[] {
    const points = this.#points;
    return [...this.#open].filter((i) =>
      areas.some((area) => holds(area, points[3 * i]!, points[3 * i + 1]!)),
    );
  }

  /** Takes a way for those of some open points that it has a place for; says whether there were any. */
  take(its: Candidate, inside: readonly number[], areas: readonly Rectangle[]): boolean {
    const own = this.#candidate.places;
    const placed = inside.filter((i) => Number.isFinite(its.places[3 * i]!));
    if (placed.length === 0) return false;
    for (const i of placed) {
      this.#open.delete(i);
      const metres = Math.hypot(...[0, 1, 2].map((axis) => its.places[3 * i + axis]! - own[3 * i + axis]!));
      const worth = metres + (its.operation.accuracy ?? 0);
      this.#beyond ||= Number.isNaN(metres);
      if (!(metres > SAME) || worth <= (this.#farthest?.worth ?? 0)) continue;
      this.#farthest = { operation: its.operation.name, metres, worth };
    }
    this.#ways.push({ candidate: its, areas, share: placed.length / this.#total });
    return true;
  }
}

/** Operations with their areas in source units; nothing where PROJ cannot choose by area. */
async function proposalsOf(
  proj: Proj,
  plan: Candidate["plan"],
  list: readonly Operation[],
  areaOf: ReadonlyMap<Operation, AreaOfUse | undefined>,
  signal: AbortSignal | undefined,
): Promise<Proposal[] | undefined> {
  const known = list.flatMap((operation) => {
    const area = areaOf.get(operation);
    return area ? [{ operation, area }] : [];
  });
  try {
    const projection = plan.pipeline.slice(0, plan.projection);
    const areas = known.map(({ area }) => area);
    const rectangles = await rectanglesOf(proj, projection, areas, signal);
    return known.map((one, i) => ({ ...one, areas: rectangles[i]! }));
  } catch (error) {
    // A projection that PROJ has no way back to: it cannot choose by area either.
    if (error instanceof GromaError && error.code === "PROJ_FAILED") return undefined;
    throw error;
  }
}

/** An operation over the data set; nothing where it is not for this place, or its steps are not understood. */
async function triedOrNone(
  proj: Proj,
  operation: Operation,
  domain: Domain,
  metresPerUnit: number,
  signal: AbortSignal | undefined,
): Promise<Candidate | undefined> {
  try {
    return await tryOperation(proj, operation, domain, metresPerUnit, signal);
  } catch (error) {
    // It is named among those passed over.
    if (error instanceof GromaError && error.code !== "PROJ_OUTPUT") return undefined;
    throw error;
  }
}

/** A domain with as much again on every side. */
export function around({ minX, minY, maxX, maxY }: Domain): Rectangle {
  const [width, height] = [maxX - minX + 1, maxY - minY + 1];
  return { minX: minX - width, minY: minY - height, maxX: maxX + width, maxY: maxY + height };
}

/** Whether PROJ's own order may matter for an operation: it never takes the place of some others, whatever its area. */
function isLast({ accuracy, area }: Operation): boolean {
  return accuracy === null || area.includes("- offshore");
}

/** What tells operations of two lists apart: several may have one name. */
function identityOf({ name, pipeline }: Operation): string {
  return `${name}\n${pipeline}`;
}

/** Metres; two ways that are closer lead to the same place. */
const SAME = 1e-3;
