import { i18n } from "./i18n.js";

/** A number with a fixed count of decimals in the page's language, and no marks between thousands: `1523.85`. */
export function fixed(value: number, decimals: number): string {
  return i18n.number(value, {
    minimumFractionDigits: decimals,
    maximumFractionDigits: decimals,
    useGrouping: false,
  });
}

/** A number with so many significant digits at most, in the page's language. */
export function significant(value: number, digits: number): string {
  return i18n.number(value, { maximumSignificantDigits: digits, useGrouping: false });
}

/** Numbers of one thing, as its coordinates: parted so that no comma of a number is taken for one between them. */
export function several(numbers: readonly string[]): string {
  return numbers.join(numbers.some((text) => text.includes(",")) ? "; " : ", ");
}
