import { numberFormat } from "./numbers.js";

/**
 * An angle in degrees, minutes and seconds: 46°57′08.66″. Seconds that round to 60 are carried.
 * @param radians any turn
 * @param decimals of the seconds, from 0 on
 * @param hemispheres letters for positive and negative angles in place of the sign, as `NS`
 */
export function dms(radians: number, decimals: number, locale?: string, hemispheres?: string): string {
  const whole = 10 ** decimals;
  // Carried in steps of the last digit, an integer.
  const steps = Math.round(((Math.abs(radians) * 180) / Math.PI) * 3600 * whole);
  const minutes = Math.floor(steps / (60 * whole));
  const seconds = (steps - minutes * 60 * whole) / whole;
  const two = (value: number, digits: number) => numberFormat(digits, locale, 2).format(value);
  const text = `${numberFormat(0, locale).format(Math.floor(minutes / 60))}°${two(minutes % 60, 0)}′${two(seconds, decimals)}″`;
  const negative = radians < 0 && steps > 0;
  if (hemispheres) return `${text}${hemispheres[negative ? 1 : 0]}`;
  return negative ? `−${text}` : text;
}
