import { i18n } from "./i18n.js";

/** A number with a fixed count of decimals in the page's language, and no marks between thousands: `1523.85`. */
export function fixed(value: number, decimals: number): string {
  return i18n.number(value, {
    minimumFractionDigits: decimals,
    maximumFractionDigits: decimals,
    useGrouping: false,
  });
}
