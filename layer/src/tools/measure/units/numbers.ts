const formats = new Map<string, Intl.NumberFormat>();

/**
 * A format with a fixed number of decimals; negative ones round to tens, hundreds and so on.
 * @param leading least number of digits before the decimal point
 */
export function numberFormat(decimals: number, locale?: string, leading = 1): Intl.NumberFormat {
  const key = `${locale} ${decimals} ${leading}`;
  let format = formats.get(key);
  if (!format) {
    const digits = Math.min(MOST_DECIMALS, Math.max(0, decimals));
    format = new Intl.NumberFormat(locale, {
      minimumFractionDigits: digits,
      maximumFractionDigits: digits,
      minimumIntegerDigits: leading,
    });
    formats.set(key, format);
  }
  return format;
}

/** As many as every engine knows. */
const MOST_DECIMALS = 20;

/** A number by its decimals, a true minus before negative ones, none before a zero. */
export function numberText(value: number, decimals: number, locale?: string): string {
  const step = 10 ** -decimals;
  const rounded = decimals < 0 ? Math.round(value / step) * step : value;
  const text = numberFormat(decimals, locale).format(Math.abs(rounded));
  const negative = rounded < 0 && /[^0\p{P}\p{Z}]/u.test(numberFormat(decimals, "en").format(-rounded));
  return negative ? `−${text}` : text;
}

/** Decimals with which an uncertainty has two significant digits (GUM 7.2.6); undefined where it has none to tell. */
export function decimalsOf(uncertainty: number): number | undefined {
  if (!(uncertainty > 0) || !Number.isFinite(uncertainty)) return undefined;
  const decimals = 1 - Math.floor(Math.log10(uncertainty));
  // 0.0996 rounds to 0.10 with two digits, and has one decimal less.
  const rounded = Number(uncertainty.toPrecision(2));
  return Math.min(MOST_DECIMALS, 1 - Math.floor(Math.log10(rounded)), decimals);
}
