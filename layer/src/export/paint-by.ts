import {
  completeStyle,
  defaultStyle,
  OFFSET,
  type PaintStyle,
  type StyledAttribute,
} from "../effects/index.js";
import type { PointSource } from "../sources/contract/point-source.js";

/** What colours are chosen by: the attributes of a data set, and what is known of them. */
export type PaintedSource = Pick<PointSource, "name" | "attributes" | "boundingBox" | "statistics">;

/** How points are coloured by an attribute. */
export interface PaintChoices {
  /** Name of the attribute; `rgb`, `elevation` (the scan's z), or `OFFSET`, the side of the line. */
  readonly color: string;
  /** Values at both ends of the gradient, in the attribute's unit. Default: the least and the greatest that statistics tell. */
  readonly range?: readonly [number, number] | undefined;
  /** How far points lie from the line at most, in its unit: the range of `OFFSET`. Default: there is no line. */
  readonly reach?: number | undefined;
}

/** What layers show as one attribute, the scan's own colours. */
const CHANNELS: readonly string[] = ["red", "green", "blue"];

/**
 * Colours for pictures on paper as a layer has them whose `style.color` is an attribute, for whoever has no layer.
 * @param sources data sets that are drawn together, in one range; the first one tells what attributes there are
 * @throws StyleError STYLE_COLOR where there is no such attribute, STYLE_NO_RGB, STYLE_RANGE
 */
export function paintBy(
  { color, range, reach }: PaintChoices,
  sources: readonly [PaintedSource, ...PaintedSource[]],
): PaintStyle {
  const [{ name, attributes: recorded, statistics }] = sources;
  const coloured = recorded.some((one) => one.name === "red") && statistics?.rgbBits !== null;
  const attributes: StyledAttribute[] = [
    ...(reach === undefined ? [] : [{ name: OFFSET, kind: "scalar", range: [-reach, reach] } as const]),
    ...(coloured ? [{ name: "rgb", kind: "color" } as const] : []),
    { name: "elevation", kind: "scalar", range: spanning(sources.map(heights)) },
    ...recorded.filter((one) => !CHANNELS.includes(one.name)).map((one) => withRange(one, sources)),
  ];
  const base = defaultStyle({ attributes });
  const style = completeStyle({ color, ...(range && { range }) }, base, { name, attributes });
  return { style, attributes, rgbBits: statistics?.rgbBits ?? undefined };
}

function heights({ boundingBox: { min, max } }: PaintedSource): readonly [number, number] {
  return [min[2], max[2]];
}

/** An attribute with the range that statistics of the data sets tell. */
function withRange(
  { name, kind, components }: PaintedSource["attributes"][number],
  sources: readonly PaintedSource[],
): StyledAttribute {
  const known = sources.flatMap(({ statistics }) =>
    (statistics?.attributes ?? []).flatMap((one) => (one.name === name ? [[one.min, one.max] as const] : [])),
  );
  return { name, kind, components, range: kind === "flags" ? undefined : spanning(known) };
}

/** The range over all; undefined where there is none. */
function spanning(ranges: readonly (readonly [number, number])[]): readonly [number, number] | undefined {
  if (ranges.length === 0) return undefined;
  return [Math.min(...ranges.map(([least]) => least)), Math.max(...ranges.map(([, greatest]) => greatest))];
}
