import {
  everyStep,
  type GeoreferenceRecord,
  greatestBound,
  RecordError,
  type StatedAccuracy,
  statedAccuracy,
  type Truth,
  type TruthSources,
} from "@groma/georef";
import type { PointSource } from "../sources/contract/point-source.js";
import type { Georeference, GeoreferenceOptions } from "./georeference-options.js";

/** What of a data set its georeference is made from. */
export type Declared = Pick<PointSource, "name" | "boundingBox" | "scale" | "crs">;

/**
 * As the conversion settled it.
 * @param truth the map that the record, with its CRS or its transformation, stands for
 */
export function recorded(
  record: GeoreferenceRecord,
  truth: Truth,
  source: Declared,
  { tolerance = 0.001 }: Pick<GeoreferenceOptions, "tolerance">,
): Georeference {
  const { crs, similarity, engine, operation } = record;
  const { transformation } = source.crs;
  let stated: StatedAccuracy | undefined;
  const reckoned = () => {
    const bound = boundOf(truth, source, tolerance);
    // The record's own fit is the converter's default; what holds here is the tolerance of this page.
    return statedAccuracy(
      record.accuracy.map((part) => (part.name === "fit" ? { ...part, metres: bound } : part)),
    );
  };
  return {
    ...mapOf({ crs, similarity, transformation }, truth),
    ...{ crs, basis: "record", tolerance, engine, operation },
    get accuracy() {
      stated ??= reckoned();
      return stated;
    },
  };
}

/** What is stated of the drawn position, metres. */
export function boundOf(truth: Truth, { name, boundingBox }: Declared, tolerance: number): number {
  const [minX, minY, minZ] = boundingBox.min;
  const [maxX, maxY, maxZ] = boundingBox.max;
  return greatestBound(truth, { minX, minY, minZ, maxX, maxY, maxZ }, tolerance, name);
}

/** The map, and what follows from it. */
export function mapOf(
  sources: TruthSources,
  truth: Truth,
): Pick<Georeference, "sources" | "truth" | "geoids"> {
  const steps = typeof truth === "function" ? [] : everyStep(truth.transformation);
  const geoids = steps.flatMap((step) => (step.kind === "verticalShift" ? [step.window.grid] : []));
  return { sources, truth, geoids: [...new Set(geoids)] };
}

/**
 * What a record says of a data set that is placed as a body.
 * @throws RecordError RECORD_FIELD where it says only that it is
 */
export function similarityOf(
  { similarity, engine }: GeoreferenceRecord,
  file: string,
): GeoreferenceRecord["similarity"] {
  if (similarity || engine.name !== "similarity") return similarity;
  throw new RecordError({
    code: "RECORD_FIELD",
    file,
    cause:
      "the georeference record of Groma cannot be read: it has no similarity, which its engine stands for",
    fix: "convert the scan again, with its anchor or control points",
  });
}
