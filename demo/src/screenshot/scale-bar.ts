import type { MeasureUnits } from "@groma/layer/tools";

/** A length to be drawn beside a picture, so that others can be told from it. */
export interface ScaleBar {
  /** In its unit and the reader's language. */
  readonly label: string;
  /** Of the ground. */
  readonly metres: number;
  /** CSS pixels. */
  readonly pixels: number;
}

/** Names of units as `Intl` has them, and metres in each, the small ones first. */
const METRIC = [
  ["millimeter", 0.001],
  ["centimeter", 0.01],
  ["meter", 1],
  ["kilometer", 1000],
] as const;
const IMPERIAL = [
  ["inch", 0.0254],
  ["foot", 0.3048],
  ["mile", 1609.344],
] as const;

/**
 * The longest bar of one, two or five times a power of ten that is not longer than so many pixels.
 * @param metresPerPixel metres of ground per CSS pixel
 * @param most CSS pixels
 * @param length unit that the reader measures in: feet of both kinds, and yards, are shown as feet
 */
export function scaleBar(
  metresPerPixel: number,
  most: number,
  { length, locale }: { readonly length: MeasureUnits["length"]; readonly locale: string },
): ScaleBar {
  const room = metresPerPixel * most;
  const units = ["feet", "usSurveyFeet", "inches", "yards", "miles"].includes(length) ? IMPERIAL : METRIC;
  const [unit, size] = units.findLast(([, metres]) => metres <= room) ?? units[0];
  const power = 10 ** Math.floor(Math.log10(room / size));
  const count = power * ([5, 2].find((times) => times * power * size <= room) ?? 1);
  const format = new Intl.NumberFormat(locale, {
    ...{ style: "unit", unit, unitDisplay: "short", maximumSignificantDigits: 1 },
  });
  return { label: format.format(count), metres: count * size, pixels: (count * size) / metresPerPixel };
}
