import { dated } from "./epoch.js";
import { compose, helmertMap, IDENTITY, isIdentity, type LinearMap } from "./helmert.js";
import type { EllipsoidText, GridName, Plan, PlannedStep } from "./plan.js";
import { refuseStep } from "./refuse.js";
import { sampledFrom } from "./sampled-steps.js";
import { type StepText, splitPipeline } from "./step-text.js";
import { angularUnit, linearUnit } from "./units.js";

/** Parameters of an ellipsoid in any step. */
const ELLIPSOID = new Set(["ellps", "a", "b", "rf", "f", "es", "e", "R", "datum"]);
/** Operations that are no map projections, though PROJ writes them in the same way. */
const OPERATIONS = new Set(
  "affine cart defmodel deformation geoc geogoffset gridshift helmert hgridshift horner molobadekas molodensky set tinshift topocentric vertoffset vgridshift xyzgridshift".split(
    " ",
  ),
);
/** Parameters of projections with which PROJ would shift datums or heights behind the pipeline's back. */
const HIDDEN = ["nadgrids", "geoidgrids", "towgs84"];
const WGS84: EllipsoidText = new Map([["ellps", "WGS84"]]);

/**
 * Understands a pipeline that PROJ proposes from a source CRS to EPSG:4978. A leading swap of axes is left out, since
 * LAS has the easting or longitude in x whatever the authority of the CRS prescribes.
 *
 * @throws CrsError CRS_OPERATION_UNSUPPORTED naming the step that is not known here
 */
export function parsePipeline(text: string): Plan {
  const { steps: given, undated } = dated(splitPipeline(text));
  const pipeline = given.filter(({ name }) => name !== "noop");
  if (pipeline[0]?.name === "axisswap" && pipeline[0].parameters.get("order") === "2,1") pipeline.shift();
  const { count, metresPerUnit } = readProjection(pipeline);
  const steps = new Walk(pipeline, count, metresPerUnit).steps();
  const scale = steps.reduce((size, step) => (step.kind === "height" ? size * step.metresPerUnit : size), 1);
  return { pipeline, projection: count, steps, metresPerUnit: scale, undated };
}

/** The steps from source coordinates to longitude and latitude in radians, and what they do to z. */
function readProjection(pipeline: readonly StepText[]): { count: number; metresPerUnit: number } {
  let metresPerUnit = 1;
  for (const [i, step] of pipeline.entries()) {
    const { name, inverse, parameters } = step;
    if (name === "axisswap") {
      // Signs and swaps of the plane are part of what is sampled; z takes no part in it but for its sign.
      const order = /^-?[12],-?[12](,-?3)?$/.exec(parameters.get("order") ?? "");
      if (!order) throw refuseStep(step, orderOf(step));
      if (order[1] === ",-3") metresPerUnit = -metresPerUnit;
    } else if (name === "affine") {
      // A derived CRS: its plane is turned and moved into that of another one, which is part of what is sampled too.
      only(step, IN_PLANE);
    } else if (name === "helmert") {
      only(step, SIMILARITY);
    } else if (name === "tinshift") {
      // Triangles in the plane of a projection.
      only(step, ["file"]);
    } else if (name === "unitconvert") {
      const units = readUnits(step);
      metresPerUnit *= units.height;
      if (units.angular && units.to === 1) {
        return { count: withTurns(pipeline, i + 1), metresPerUnit };
      }
    } else if (inverse && !OPERATIONS.has(name)) {
      refuseHidden(step);
      return { count: withTurns(pipeline, i + 1), metresPerUnit: metresPerUnit * verticalUnit(step) };
    } else throw refuseStep(step);
  }
  throw refuseStep(
    pipeline[0] ?? { name: "noop", inverse: false, parameters: new Map() },
    "no map projection",
  );
}

/** Parameters of `helmert` in the plane. */
const SIMILARITY = ["x", "y", "s", "theta"];
/** Parameters of `affine` that leave z and time alone. */
const IN_PLANE = ["xoff", "yoff", "s11", "s12", "s21", "s22"];

/**
 * Steps that follow and turn the sphere alone are part of the projection: `longlat`, which counts longitude from another
 * meridian or does nothing, and the way back from a rotated pole.
 */
function withTurns(pipeline: readonly StepText[], count: number): number {
  const step = pipeline[count];
  const turned = step?.name === "ob_tran" && step.inverse && step.parameters.get("o_proj") === "longlat";
  if (step?.name !== "longlat" && !turned) return count;
  refuseHidden(step);
  return withTurns(pipeline, count + 1);
}

function refuseHidden(step: StepText): void {
  const hidden = HIDDEN.find((key) => step.parameters.has(key));
  if (hidden) throw refuseStep(step, `its parameter +${hidden}`);
}

function verticalUnit(step: StepText): number {
  const text = step.parameters.get("vunits") ?? step.parameters.get("vto_meter");
  const unit = text === undefined ? 1 : linearUnit(text);
  if (unit === undefined) throw refuseStep(step, `the vertical unit ${text}`);
  return unit;
}

interface Units {
  readonly angular: boolean;
  /** Radians per unit of x and y before and after, where they are angular. */
  readonly from: number;
  readonly to: number;
  /** By how much z is multiplied. */
  readonly height: number;
}

function readUnits(step: StepText): Units {
  const known = new Set(["xy_in", "xy_out", "z_in", "z_out"]);
  const strange = [...step.parameters.keys()].find((key) => !known.has(key));
  if (strange) throw refuseStep(step, `its parameter +${strange}`);
  const text = (key: string, otherwise: string) => step.parameters.get(key) ?? otherwise;
  const xyIn = text("xy_in", "m");
  const xyOut = text("xy_out", xyIn);
  const [from, to] = [angularUnit(xyIn), angularUnit(xyOut)];
  const [zIn, zOut] = [linearUnit(text("z_in", "m")), linearUnit(text("z_out", text("z_in", "m")))];
  const linear = linearUnit(xyIn) !== undefined && linearUnit(xyOut) !== undefined;
  if (zIn === undefined || zOut === undefined || (from === undefined) !== (to === undefined)) {
    throw refuseStep(step, "these units");
  }
  if (from === undefined && !linear) throw refuseStep(step, "these units");
  const height = step.inverse ? zOut / zIn : zIn / zOut;
  if (from === undefined || to === undefined) return { angular: false, from: 1, to: 1, height };
  return step.inverse ? { angular: true, from: to, to: from, height } : { angular: true, from, to, height };
}

/** Steps that would have to be undone where heights are put aside before them. */
const CHANGES_HEIGHT = new Set<PlannedStep["kind"]>(["height", "verticalShift", "verticalOffset"]);

/** Walks from longitude and latitude in radians to ECEF. */
class Walk {
  readonly #pipeline: readonly StepText[];
  readonly #start: number;
  readonly #planned: PlannedStep[] = [];
  /** Radians per unit of the horizontal coordinates by now, and whether latitude comes first. */
  #unit = 1;
  #swapped = false;
  /** Index in the planned steps where heights were put aside. */
  #aside: number | undefined;
  /** The ellipsoid that geocentric coordinates came from, and what has been done to them since. */
  #geocentric: { from: EllipsoidText; map: LinearMap } | undefined;

  constructor(pipeline: readonly StepText[], start: number, metresPerUnit: number) {
    this.#pipeline = pipeline;
    this.#start = start;
    this.#height(metresPerUnit);
  }

  steps(): PlannedStep[] {
    for (let i = this.#start; i < this.#pipeline.length; i++) {
      const step = this.#pipeline[i];
      const plain = !this.#geocentric && this.#aside === undefined && !this.#swapped && this.#unit === 1;
      const sampled = plain && sampledFrom(this.#pipeline, i);
      if (sampled) {
        this.#planned.push(sampled);
        i = sampled.after - 1;
      } else if (this.#geocentric) this.#inSpace(step, this.#geocentric);
      else this.#onEllipsoid(step, i);
    }
    const last = this.#pipeline[this.#pipeline.length - 1];
    if (!this.#geocentric || this.#aside !== undefined)
      throw refuseStep(last, "no ECEF coordinates after it");
    const { from, map } = this.#geocentric;
    if (isIdentity(map)) return [...this.#planned, { kind: "geocentric", ellipsoid: from }];
    // A shift that ends in space goes by way of WGS 84, which changes nothing.
    this.#planned.push({ kind: "datumShift", from, to: WGS84, map, keepHeight: false });
    return [...this.#planned, { kind: "geocentric", ellipsoid: WGS84 }];
  }

  #onEllipsoid(step: StepText, before: number): void {
    const { name, inverse, parameters } = step;
    if (name === "unitconvert") {
      const units = readUnits(step);
      if (parameters.has("xy_in") && (!units.angular || units.from !== this.#unit)) {
        throw refuseStep(step, "these units");
      }
      if (units.angular) this.#unit = units.to;
      this.#height(units.height);
      return;
    }
    if (name === "axisswap") {
      const order = parameters.get("order");
      if (order === "1,2,-3") this.#height(-1);
      else if (order === "2,1") this.#swapped = !this.#swapped;
      else throw refuseStep(step, orderOf(step));
      return;
    }
    // An inverse push is a pop, and the other way round.
    if (name === "push" || name === "pop") {
      this.#putAside(step, (name === "push") !== inverse);
      return;
    }
    if (this.#swapped || this.#unit !== 1) throw refuseStep(step, "coordinates that are not in radians");
    if (name === "longlat") {
      // Without another meridian it does nothing.
      only(step, []);
    } else if (name === "cart" && !inverse) {
      this.#geocentric = { from: ellipsoidOf(step), map: IDENTITY };
    } else if (name === "geocent" && !inverse) {
      // What PROJ writes for `cart` behind a projection that has no name in WKT.
      this.#geocentric = { from: ellipsoidOf(inMetres(step)), map: IDENTITY };
    } else if (name === "hgridshift") {
      only(step, ["grids"]);
      const direction = inverse ? "inverse" : "forward";
      const grids = gridNames(step);
      if (grids[0].name !== "null") this.#planned.push({ kind: "horizontalShift", direction, grids, before });
    } else if (name === "vgridshift") {
      only(step, ["grids", "multiplier"]);
      const multiplier = multiplierOf(step) * (inverse ? -1 : 1);
      const grids = gridNames(step);
      if (grids[0].name !== "null") this.#planned.push({ kind: "verticalShift", multiplier, grids, before });
    } else if (name === "geogoffset") {
      this.#offset(step);
    } else if (name === "affine") {
      // What PROJ makes of a unit of depths.
      only(step, ["s33"]);
      const factor = Number(parameters.get("s33"));
      if (!Number.isFinite(factor) || factor === 0) throw refuseStep(step, `+s33=${parameters.get("s33")}`);
      this.#height(inverse ? 1 / factor : factor);
    } else throw refuseStep(step);
  }

  #inSpace(step: StepText, { from, map }: { from: EllipsoidText; map: LinearMap }): void {
    const { name, inverse } = step;
    if (name === "helmert" || name === "molobadekas") {
      this.#geocentric = { from, map: compose(map, helmertMap(step)) };
    } else if (name === "cart" && inverse) {
      const keepHeight = this.#aside !== undefined;
      this.#planned.push({ kind: "datumShift", from, to: ellipsoidOf(step), map, keepHeight });
      this.#geocentric = undefined;
    } else if (name === "push" || name === "pop") throw refuseStep(step, "coordinates in space");
    else throw refuseStep(step);
  }

  /** The same offset everywhere: EPSG methods 9616, 9618, 9619 and 9660. */
  #offset(step: StepText): void {
    only(step, ["dlon", "dlat", "dh"]);
    const [longitude, latitude, metres] = ["dlon", "dlat", "dh"].map((key) => offsetOf(step, key));
    if (longitude !== 0 || latitude !== 0)
      this.#planned.push({ kind: "horizontalOffset", longitude, latitude });
    if (metres !== 0) this.#planned.push({ kind: "verticalOffset", metres });
  }

  #height(metresPerUnit: number): void {
    if (metresPerUnit !== 1) this.#planned.push({ kind: "height", metresPerUnit });
  }

  /** `push v_3` and `pop v_3`: what lies between leaves heights alone. */
  #putAside(step: StepText, push: boolean): void {
    const what = [...step.parameters.keys()].join(" +");
    if (what !== "v_3" || push !== (this.#aside === undefined)) throw refuseStep(step, `+${what}`);
    if (push) {
      this.#aside = this.#planned.length;
      return;
    }
    const between = this.#planned.slice(this.#aside);
    if (between.some(({ kind }) => CHANGES_HEIGHT.has(kind))) {
      throw refuseStep(step, "a change of heights before it");
    }
    this.#aside = undefined;
  }
}

function orderOf({ parameters }: StepText): string {
  return `the order ${parameters.get("order") ?? "of axes"}`;
}

function only(step: StepText, keys: readonly string[]): void {
  for (const key of step.parameters.keys()) {
    if (!keys.includes(key) && !ELLIPSOID.has(key)) throw refuseStep(step, `its parameter +${key}`);
  }
}

function ellipsoidOf(step: StepText): EllipsoidText {
  only(step, []);
  if (step.parameters.size === 0) throw refuseStep(step, "no ellipsoid");
  return step.parameters;
}

/** A step without its unit, which is the metre. */
function inMetres(step: StepText): StepText {
  const { units = "m", ...others } = Object.fromEntries(step.parameters);
  if (units !== "m") throw refuseStep(step, "these units");
  return { ...step, parameters: new Map(Object.entries(others)) };
}

/** Forward: height plus multiplier times the grid's value. PROJ's default is −1, "for historical reasons". */
function multiplierOf(step: StepText): number {
  const text = step.parameters.get("multiplier") ?? "-1";
  const value = Number(text);
  if (text === "" || !Number.isFinite(value)) throw refuseStep(step, `the multiplier ${text}`);
  return value;
}

function offsetOf(step: StepText, key: string): number {
  const text = step.parameters.get(key) ?? "0";
  const value = Number(text);
  if (text === "" || !Number.isFinite(value)) throw refuseStep(step, `its parameter +${key}=${text}`);
  return step.inverse ? -value : value;
}

function gridNames(step: StepText): GridName[] {
  const names = (step.parameters.get("grids") ?? "").split(",").filter((name) => name !== "");
  if (names.length === 0) throw refuseStep(step, "no grid");
  return names.map((name) => ({ name: name.replace(/^@/, ""), optional: name.startsWith("@") }));
}
