import {
  type AreaOfUse,
  areOverlapping,
  type Crs,
  CrsError,
  type Domain,
  type GromaError,
  isAboveGeoid,
} from "@groma/georef";
import { type Choice, choose, type PassedOver } from "./candidate.js";
import type { Listed } from "./elsewhere.js";
import { howToGet } from "./grids/current-names.js";
import { type DegreeBox, listOperations, type Operation, operationAreas } from "./operation.js";
import type { Proj } from "./program/find.js";
import { OTHER_WAY } from "./refuse.js";
import type { CrsText, SourceTexts } from "./source.js";

/** PROJ's words for heights taken over from another zero level as they are. */
const BALLPARK_HEIGHT = "ballpark vertical transformation";

/** Grids that a message names at most. */
const GRIDS_SHOWN = 5;

/** What was chosen for a data set, before its points are looked at one by one. */
export interface Chosen {
  readonly choice: Choice;
  readonly passedOver: readonly PassedOver[];
  /** The list that it was chosen from, or the better list that had none. */
  readonly operations: readonly Operation[];
  /** What it was chosen from. */
  readonly from: Listed;
  /** Heights go by EGM96, because PROJ would take them over as they are. */
  readonly substitute: boolean;
  /** None of PROJ's operations is meant for the place. */
  readonly outside: boolean;
}

/**
 * The operation for all of a data set, and where it comes from.
 *
 * @throws CrsError CRS_UNSUPPORTED, CRS_OPERATION_UNSUPPORTED; ProjError
 */
export async function chooseFor(
  proj: Proj,
  crs: Crs,
  source: SourceTexts,
  domain: Domain,
  box: DegreeBox | undefined,
  signal?: AbortSignal,
): Promise<Chosen> {
  const metresPerUnit = crs.verticalUnit.size;
  const list = (text: SourceTexts["horizontal"]) => listOperations(proj, text, { box, signal });
  const withHeights = source.compound ? await list(source.compound) : [];
  const best = await choose(proj, withHeights, domain, metresPerUnit, signal);
  if (best.choice && !takesHeightsOver(best.choice)) {
    const from = { source: source.compound!, operations: withHeights, box };
    return { ...best, choice: best.choice, operations: withHeights, from, substitute: false, outside: false };
  }
  const flat = await list(source.horizontal);
  const near = await choose(proj, flat, domain, metresPerUnit, signal);
  const { passedOver, blocked } = near;
  const far = near.choice?.candidate.operation.ballpark
    ? await fromAllPlaces(proj, source.horizontal, domain, box, metresPerUnit, signal)
    : undefined;
  const choice = far?.choice ?? near.choice;
  if (!choice) throw noWay(crs, [...withHeights, ...flat], best.blocked ?? blocked);
  return {
    choice,
    passedOver: [...best.passedOver, ...passedOver],
    operations: withHeights.length > 0 ? withHeights : flat,
    from: far?.from ?? { source: source.horizontal, operations: flat, box },
    substitute: isAboveGeoid(crs),
    outside: far?.outside ?? false,
  };
}

/**
 * What PROJ takes for its points where only ballparks are listed for their place: one from the list for all places that is for
 * the place; else the first that needs no grid, unless that list has a ballpark, which is for the world.
 */
async function fromAllPlaces(
  proj: Proj,
  source: CrsText,
  domain: Domain,
  box: DegreeBox | undefined,
  metresPerUnit: number,
  signal?: AbortSignal,
): Promise<Pick<Chosen, "choice" | "from" | "outside"> | undefined> {
  if (!box) return undefined;
  const operations = await listOperations(proj, source, { signal });
  const areas = await operationAreas(proj, source, { signal });
  const place: AreaOfUse = [box.west, box.south, box.east, box.north];
  const shifting = operations.filter(({ ballpark }) => !ballpark);
  const here = shifting.filter((one) => {
    const area = areas[operations.indexOf(one)];
    return area !== undefined && areOverlapping(area, place);
  });
  const from = { source, operations, box: undefined };
  const near = await choose(proj, here, domain, metresPerUnit, signal);
  if (near.choice) return { choice: near.choice, from, outside: false };
  const [first] = operations.filter(({ pipeline = "" }) => !/\+grids=/.test(pipeline));
  if (!first || shifting.length < operations.length) return undefined;
  // Nobody states what it is worth there.
  const unstated = { ...first, accuracy: null };
  const { choice } = await choose(proj, [unstated], domain, metresPerUnit, signal);
  return choice && { choice, from, outside: true };
}

/** Whether PROJ takes heights above a geoid for heights above the ellipsoid, for want of a grid or of an operation. */
function takesHeightsOver({ candidate, leftOut }: Choice): boolean {
  return (
    candidate.operation.name.includes(BALLPARK_HEIGHT) || leftOut.some(({ kind }) => kind === "vertical")
  );
}

function noWay(crs: Crs, operations: readonly Operation[], blocked?: GromaError): GromaError {
  if (blocked && blocked.code !== "CRS_OPERATION_UNSUPPORTED") return blocked;
  const { name: file } = crs;
  const code = blocked ? "CRS_OPERATION_UNSUPPORTED" : "CRS_UNSUPPORTED";
  const grids = [...new Set(operations.flatMap(({ missingGrids }) => missingGrids))].slice(0, GRIDS_SHOWN);
  if (grids.length > 0) {
    const cause = blocked ? `${blocked.cause}, and the others lack` : "every operation to WGS 84 lacks";
    return new CrsError({
      ...{ code, file, cause: `${cause} a grid (${grids.join(", ")})`, fix: howToGet(grids) },
    });
  }
  const cause = blocked
    ? `${blocked.cause}, and no other operation leads to WGS 84 without leaving a datum shift out`
    : "PROJ knows no operation from it to WGS 84 for the place of the data";
  return new CrsError({ code, file, cause, fix: OTHER_WAY });
}
