import type { LayerStatistics, LedgerRow, MeasuredCost } from "@groma/layer/cesium";
import { i18n } from "../language/i18n.js";
import { libraryWords } from "../language/library-words.js";

/** What effects are called; one that is not among them is called by its key. */
const EFFECTS: ReadonlyMap<string, string> = new Map([
  ["adaptiveSize", i18n.t("adaptive size")],
  ["attenuatedSize", i18n.t("attenuated size")],
  ["fixedSize", i18n.t("fixed size")],
  ["blend", i18n.t("blend")],
  ["classification", i18n.t("classification")],
  ["clip", i18n.t("clip")],
  ["curvature", i18n.t("curvature")],
  ["curvatureAndRefraction", i18n.t("curvature and refraction")],
  ["disc", i18n.t("disc")],
  ["dithering", i18n.t("dithering")],
  ["eyeDomeLighting", i18n.t("eye dome lighting")],
  ["filter", i18n.t("filter")],
  ["geoid", i18n.t("geoid")],
  ["gradient", i18n.t("gradient")],
  ["gridScale", i18n.t("grid scale")],
  ["highlight", i18n.t("highlight")],
  ["levelOfDetail", i18n.t("level of detail")],
  ["logarithmicDepth", i18n.t("logarithmic depth")],
  ["opacity", i18n.t("opacity")],
  ["paraboloid", i18n.t("paraboloid")],
  ["placing", i18n.t("placing")],
  ["placingOnScreen", i18n.t("placing on screen")],
  ["rgb", i18n.t("rgb")],
  ["splats", i18n.t("splats")],
  ["storage", i18n.t("storage")],
  ["tone", i18n.t("tone")],
]);

/** An effect's name as a reader would write it: `eyeDomeLighting` is "eye dome lighting". */
export function effectWords({ effect }: LedgerRow): string {
  return (
    EFFECTS.get(effect) ?? libraryWords(effect.replace(/[A-Z]/g, (letter) => ` ${letter.toLowerCase()}`))
  );
}

/** How much an effect would change, against what. */
export function magnitudeWords({ magnitude, threshold, unit }: LedgerRow): string {
  const now = Number.isNaN(magnitude) ? "?" : threeDigits(magnitude);
  // A number of things has no unit.
  return `${now} / ${threeDigits(threshold)} ${unit === "1" ? "" : libraryWords(unit)}`.trim();
}

/** What the GPU took for the last frame; empty where the browser does not say. */
export function frameWords({ points, picture }: LayerStatistics["gpuMilliseconds"]): string {
  if (points === undefined) return "";
  return picture === undefined
    ? i18n.t("Last frame on the GPU: points {points} ms.", { points: threeDigits(points) })
    : i18n.t("Last frame on the GPU: points {points} ms, light and blending {picture} ms.", {
        points: threeDigits(points),
        picture: threeDigits(picture),
      });
}

/** Whether an effect runs, and by whose will. */
export function stateWords({ active, why }: LedgerRow): string {
  if (why.startsWith("forced")) return active ? i18n.t("on, forced") : i18n.t("off, forced");
  return active ? i18n.t("on") : i18n.t("off");
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
  if (size >= 1e6 || size < 1e-4) {
    return i18n.number(value, { notation: "scientific", maximumFractionDigits: 1 });
  }
  return Number(value.toPrecision(3)).toLocaleString(i18n.locale, { maximumSignificantDigits: 3 });
}
