import type { HeaderDetails } from "./header.js";

/** Beginning of GPS time, milliseconds of Unix time. */
const GPS_EPOCH = Date.UTC(1980, 0, 6);
/** What standard GPS time of LAS leaves off, seconds (LAS 1.4 R15, global encoding, bit 0). */
const ADJUSTMENT = 1e9;
const WEEK = 7 * 86_400;
const DAYS = ["Sunday", "Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday"];

/** When the points of a data set were measured. */
export interface GpsSpan {
  readonly kind: HeaderDetails["gpsTime"];
  /** Seconds as they are stored. */
  readonly min: number;
  readonly max: number;
  /** ISO dates of GPS time, which is ahead of UTC by the leap seconds since 1980; null where the kind allows none. */
  readonly from: string | null;
  readonly to: string | null;
}

/** @returns nothing where no point has a time */
export function gpsSpan(
  kind: HeaderDetails["gpsTime"],
  range: { readonly min: number; readonly max: number } | undefined,
): GpsSpan | undefined {
  if (!range || (range.min === 0 && range.max === 0)) return undefined;
  const { min, max } = range;
  const date = (seconds: number) => {
    const time = new Date(GPS_EPOCH + (seconds + ADJUSTMENT) * 1000);
    return Number.isFinite(time.getTime()) ? time.toISOString().slice(0, 19) : null;
  };
  return {
    kind,
    min,
    max,
    from: kind === "standard" ? date(min) : null,
    to: kind === "standard" ? date(max) : null,
  };
}

/** As `groma info` prints it: dates where they can be known, else seconds and what is wrong with them. */
export function gpsSpanInWords({ kind, min, max, from, to }: GpsSpan): string {
  if (from !== null && to !== null) return `${from.replace("T", " ")} … ${to.replace("T", " ")} GPS time`;
  const range = `${Number(min.toFixed(6))} … ${Number(max.toFixed(6))} s`;
  if (kind === "standard") return `${range}, not a valid time`;
  if (min < 0 || max > WEEK)
    return `${range}, outside of a week although the header declares seconds of the GPS week`;
  return `${range} of an unstated GPS week: ${ofWeek(min)} … ${ofWeek(max)}`;
}

/** `Tuesday 20:09:39` */
function ofWeek(seconds: number): string {
  const day = DAYS[Math.floor(seconds / 86_400) % 7]!;
  return `${day} ${new Date((seconds % 86_400) * 1000).toISOString().slice(11, 19)}`;
}
