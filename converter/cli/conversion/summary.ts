import { basename } from "node:path";
import { statedAccuracy } from "@groma/georef";
import { pdalInWords } from "../pdal/report.js";
import { accuracyInWords, placeInWords, remarks } from "../place/describe.js";
import { centreRow } from "../place/whereabouts.js";
import { count, counted, labelled, length, rounded, size, skippedRow } from "../terminal/output.js";
import type { Converted } from "./convert.js";

/** What a conversion made, for machines: the last of its JSON lines. */
export function summaryForMachines({ georeferenced, whereabouts, records, ...summary }: Converted) {
  const { crs, engine, operation, accuracy } = records.georeference;
  return {
    event: "done",
    ...summary,
    crs: { name: crs.name, code: crs.code, height: crs.height },
    crsNotes: [...georeferenced.notes, ...whereabouts.notes],
    centre: whereabouts.centre ?? null,
    engine,
    operation: operation ?? null,
    residuals: georeferenced.local?.fitted?.residuals ?? null,
    accuracy: statedAccuracy(accuracy),
    recordBytes: records.record.length,
    transformationBytes: records.transformation?.length ?? 0,
  };
}

/** What a conversion made, for people. */
export function summaryInWords(converted: Converted): string[] {
  const { output, points, nodes, bytes, seconds } = converted;
  const each = `${rounded(bytes / points, 2)} bytes per point`;
  const rate = seconds > 0 ? `, ${count(Math.round(points / seconds))} points/s` : "";
  const first = `${basename(output)}  ${counted(points, "point")} in ${counted(nodes, "node")}  ${size(bytes)} (${each})  ${seconds.toFixed(1)} s${rate}`;
  return [first, ...placeSummary(converted)];
}

/** Location, accuracy and notes, a line each; a data set far from where it belongs was warned of by then. */
export function placeSummary(converted: Converted): string[] {
  const { rgbBits, pdal, skipped } = converted;
  const lines: Row[] = [
    ...placeRows(converted),
    ...pdal.flatMap(pdalInWords).map((text): Row => ["pdal", text]),
  ];
  if (rgbBits === 8) {
    lines.push(["colours", "8-bit colours in 16-bit fields; values unchanged"]);
  }
  lines.push(...skipped.map(skippedRow));
  return labelled(lines);
}

type Row = [label: string, text: string];

/** Where a data set was put and by what, row by row. */
export function placeRows({
  georeferenced,
  whereabouts,
  records,
}: Pick<Converted, "georeferenced" | "whereabouts" | "records">): Row[] {
  const { crs, engine, operation, accuracy } = records.georeference;
  const residuals = georeferenced.local?.fitted?.residuals ?? [];
  return [
    ["place", placeInWords({ crs, engine, operation, accuracy, fitBound: records.fitBound })],
    ...centreRow(whereabouts),
    ["accuracy", accuracyInWords(accuracy, crs)],
    ...remarks(operation).map((text): Row => ["note", text]),
    ...residuals.map(
      (residual, index): Row => ["control", `point ${index + 1}: residual ${length(residual)}`],
    ),
  ];
}
