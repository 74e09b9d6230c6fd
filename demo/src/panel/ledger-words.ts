import type { LayerStatistics, LedgerRow, MeasuredCost } from "@groma/layer/cesium";

/** An effect's name as a reader would write it: `eyeDomeLighting` is "eye dome lighting". */
export function effectWords({ effect }: LedgerRow): string {
  return effect.replace(/[A-Z]/g, (letter) => ` ${letter.toLowerCase()}`);
}

/** How much an effect would change, against what. */
export function magnitudeWords({ magnitude, threshold, unit }: LedgerRow): string {
  const now = Number.isNaN(magnitude) ? "?" : threeDigits(magnitude);
  // A number of things has no unit.
  return `${now} / ${threeDigits(threshold)} ${unit === "1" ? "" : unit}`.trim();
}

/** What the GPU took for the last frame; empty where the browser does not say. */
export function frameWords({ points, picture }: LayerStatistics["gpuMilliseconds"]): string {
  if (points === undefined) return "";
  const second = picture === undefined ? "" : `, light and blending ${threeDigits(picture)} ms`;
  return `Last frame on the GPU: points ${threeDigits(points)} ms${second}.`;
}

/** Whether an effect runs, and by whose will. */
export function stateWords({ active, why }: LedgerRow): string {
  const state = active ? "on" : "off";
  return why.startsWith("forced") ? `${state}, forced` : state;
}

/** What an effect takes; empty while nobody knows. */
export function costWords(cost: MeasuredCost | undefined): string {
  return cost ? `${threeDigits(cost.value)} ${UNITS[cost.unit]}` : "";
}

const UNITS = { "ms per frame": "ms", "ns per point": "ns/pt", bytes: "B" } as const satisfies Record<
  MeasuredCost["unit"],
  string
>;

function threeDigits(value: number): string {
  if (value === 0 || !Number.isFinite(value)) return String(value).replace("Infinity", "∞");
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(1);
  return Number(value.toPrecision(3)).toLocaleString("en", { maximumSignificantDigits: 3 });
}
