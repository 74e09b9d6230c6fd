import { isOfReturns, type PointFilter } from "../effects/index.js";
import { FormatError } from "../errors/index.js";
import { ofClasses, type PointBatch, type PointOrigin } from "../query/index.js";
import { valueReader } from "../workers/index.js";

/** Which of the points of a data set are wanted, by what is recorded of them. */
export interface WantedPoints {
  readonly origin: PointOrigin;
  /** Classes of the points that are wanted. Default: all. */
  readonly classes?: ReadonlySet<number> | undefined;
  /** What passes, such as `layer.filter`. Default: everything. */
  readonly filter?: PointFilter | undefined;
  /**
   * Where source coordinates are, for GeoJSON: longitude and latitude (degrees, WGS 84) and height above the ellipsoid
   * (metres), written to `out`.
   */
  readonly geodetic?: ((x: number, y: number, z: number, out: Float64Array) => void) | undefined;
}

/** Whether a record passes, by its index. */
type Test = (point: number) => boolean;

/**
 * Those of a batch's points that a selection's classes and filter let pass: indices of records, rising. The same records as a
 * layer with that filter shows, on their exact values.
 * @throws FormatError EXPORT_NO_PLACE where heights above the ellipsoid are asked for and not known
 */
export function passing(batch: PointBatch, selection: WantedPoints): Uint32Array {
  const { classes, filter } = selection;
  const wanted = classes ? ofClasses(batch, classes) : batch.inside;
  if (!filter) return wanted;
  const tests = testsOf(batch, selection, filter);
  return tests.length === 0 ? wanted : wanted.filter((point) => tests.every((test) => test(point)));
}

function testsOf(batch: PointBatch, selection: WantedPoints, filter: PointFilter): Test[] {
  const tests: Test[] = [];
  const { classes, returns, ranges = {} } = filter;
  if (classes) {
    const [passes, value] = [new Set(classes), readerOf(batch, selection, "classification")];
    tests.push((point) => passes.has(value(point)));
  }
  if (returns) {
    const number = readerOf(batch, selection, "returnNumber");
    const of = readerOf(batch, selection, "numberOfReturns");
    tests.push((point) => isOfReturns(returns, number(point), of(point)));
  }
  for (const [name, [least, greatest]] of Object.entries(ranges)) {
    const value = readerOf(batch, selection, name);
    tests.push((point) => value(point) >= least && value(point) <= greatest);
  }
  return tests;
}

/** Reads an attribute, recorded or one of the heights that layers add; NaN where there is none of that name. */
function readerOf({ records }: PointBatch, selection: WantedPoints, name: string): (point: number) => number {
  const { xyz, attributes } = records;
  const { name: file, scale, offset } = selection.origin;
  const axis = (point: number, which: number) => xyz[3 * point + which] * scale[which] + offset[which];
  if (name === "elevation") return (point) => axis(point, 2);
  if (name === "ellipsoidalHeight") {
    const { geodetic } = selection;
    if (!geodetic) throw noPlace(file, "heights above the ellipsoid");
    const place = new Float64Array(3);
    return (point) => {
      geodetic(axis(point, 0), axis(point, 1), axis(point, 2), place);
      return place[2];
    };
  }
  const found = attributes.find((attribute) => attribute.name === name);
  return found ? valueReader(found) : () => Number.NaN;
}

/** The error for points whose place on the globe is asked for and not known. */
export function noPlace(file: string, what: string): FormatError {
  return new FormatError({
    code: "EXPORT_NO_PLACE",
    file,
    cause: `${what} are asked for, and where its points lie on the globe is not known`,
    fix: "Open it as a PointCloud, or give volumes in source coordinates",
  });
}
