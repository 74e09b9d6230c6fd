import type { ByteSink } from "./byte-sink.js";
import { CoordinateText } from "./columns.js";
import { gridOf, groups, stationsOf } from "./dxf-annotations.js";
import {
  type AlongLine,
  type ExportOptions,
  eachBatch,
  type PointSelection,
  spacingOf,
} from "./selection.js";
import { requireOneHeightUnit, requireOnePlane } from "./systems.js";
import { TextSink } from "./text-sink.js";

/** How DXF is written. */
export interface DxfOptions extends ExportOptions {
  /**
   * Whether points stand where they are (`space`) or are laid along the straightened line (`straightened`: x is the
   * chainage, y the height, z the offset from the line). Default: `space`.
   */
  readonly layout?: "space" | "straightened" | undefined;
  /** Stations as they are written beside the line, by chainage: those of station equations. Default: the chainage itself. */
  readonly stationOf?: ((chainage: number) => number) | undefined;
}

/** Layers by what stands on them, and their colours (AutoCAD colour index). */
const LAYERS = [
  ["POINTS", 7],
  ["LINE", 1],
  ["GRID", 8],
  ["TEXT", 3],
] as const;

/** Digits of numbers that do not come from records. */
const DIGITS = 5;

/**
 * Writes points as DXF, the ASCII form of AutoCAD R12 (AC1009), which every program reads: a POINT for each, in real
 * size and with every digit of the record, on a layer of their own; the line as a 3D POLYLINE; stations, or the grid around
 * straightened points, as LINEs and TEXT. Points along a line in another plane than theirs stand in the plane of the line.
 *
 * @returns number of points
 * @throws FormatError EXPORT_MIXED where coordinates are of several systems, and no line brings them into one plane
 * @throws SourceError, FormatError, DecodeError; the signal's reason when aborted; what the sink throws
 */
export async function exportDxf(
  selections: readonly PointSelection[],
  sink: ByteSink,
  options: DxfOptions = {},
): Promise<number> {
  const { layout = "space", stationOf = (chainage) => chainage } = options;
  requireOneHeightUnit(selections);
  if (layout === "space") requireOnePlane(selections.filter(({ along }) => !along?.toPlane));
  const text = new TextSink(sink);
  const spacing = spacingOf(selections);
  if (spacing > 0) text.add(groups([999, `thinned: one point in about ${spacing}`]));
  text.add(front());
  const line = selections.find(({ along }) => along)?.along;
  text.add(polyline(line, layout));
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  const place = new Float64Array(2);
  const count = await eachBatch(selections, options, async (batch, wanted, { origin, along }) => {
    const coordinates = new CoordinateText(origin);
    const { xyz } = batch.records;
    const valuesOf = (at: number) => [0, 1, 2].map((axis) => coordinates.value(xyz[at + axis], axis));
    for (const point of wanted) {
      const at = 3 * point;
      const [x, y, z] = [0, 1, 2].map((axis) => coordinates.of(xyz[at + axis], axis));
      if (layout === "straightened" && along) {
        const [px, py, pz] = valuesOf(at);
        along.locate(px, py, place, pz);
        low = Math.min(low, pz);
        high = Math.max(high, pz);
        text.add(pointText(place[0].toFixed(DIGITS), z, place[1].toFixed(DIGITS)));
      } else if (along?.toPlane) {
        const [px, py, pz] = valuesOf(at);
        along.toPlane(px, py, pz, place);
        text.add(pointText(place[0].toFixed(DIGITS), place[1].toFixed(DIGITS), z));
      } else {
        text.add(pointText(x, y, z));
      }
    }
    await text.rest();
  });
  if (line) {
    const [from, to] = [line.chainages[0], line.chainages[line.chainages.length - 1]];
    if (layout === "space") text.add(stationsOf(line, stationOf));
    else if (high >= low) text.add(gridOf({ from, to, low, high }));
  }
  text.add(groups([0, "ENDSEC"], [0, "EOF"]));
  await text.end();
  return count;
}

function front(): string {
  const layers = LAYERS.map(([name, colour]) =>
    groups([0, "LAYER"], [2, name], [70, 0], [62, colour], [6, "CONTINUOUS"]),
  );
  return [
    groups([0, "SECTION"], [2, "HEADER"], [9, "$ACADVER"], [1, "AC1009"], [0, "ENDSEC"]),
    groups([0, "SECTION"], [2, "TABLES"]),
    groups([0, "TABLE"], [2, "LTYPE"], [70, 1]),
    groups([0, "LTYPE"], [2, "CONTINUOUS"], [70, 0], [3, "Solid line"], [72, 65], [73, 0], [40, 0]),
    groups([0, "ENDTAB"], [0, "TABLE"], [2, "LAYER"], [70, LAYERS.length]),
    ...layers,
    groups([0, "ENDTAB"], [0, "ENDSEC"], [0, "SECTION"], [2, "ENTITIES"]),
  ].join("");
}

function pointText(x: string, y: string, z: string): string {
  return `0\nPOINT\n8\nPOINTS\n10\n${x}\n20\n${y}\n30\n${z}\n`;
}

/** The line at height 0: as it runs, or straightened. */
function polyline(along: AlongLine | undefined, layout: DxfOptions["layout"]): string {
  if (!along) return "";
  const vertices = along.vertices.map(([x, y], index) => {
    const [u, v] = layout === "straightened" ? [along.chainages[index], 0] : [x, y];
    return groups([0, "VERTEX"], [8, "LINE"], [10, u], [20, v], [30, 0], [70, 32]);
  });
  return [
    groups([0, "POLYLINE"], [8, "LINE"], [66, 1], [10, 0], [20, 0], [30, 0], [70, 8]),
    ...vertices,
    groups([0, "SEQEND"], [8, "LINE"]),
  ].join("");
}
