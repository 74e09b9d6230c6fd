import { FormatError } from "../../errors/index.js";
import type { AttributeStatistics, CloudStatistics } from "../contract/statistics.js";

/**
 * Decodes and validates the statistics record: VLR `groma`, record id 2 (UTF-8 JSON, version 1).
 * @throws FormatError FORMAT_STATISTICS
 */
export function decodeStatistics(bytes: Uint8Array, file: string): CloudStatistics {
  let value: unknown;
  try {
    value = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(bytes));
  } catch {
    throw invalid(file, "not JSON");
  }
  if (!isObject(value) || value.version !== 1) throw invalid(file, "not version 1");
  const { points, rgbBits, attributes, classes, returns } = value;
  if (!isCount(points)) throw invalid(file, "points");
  if (rgbBits !== 8 && rgbBits !== 16 && rgbBits !== null) throw invalid(file, "rgbBits");
  if (!Array.isArray(attributes) || !attributes.every(isAttribute)) throw invalid(file, "attributes");
  if (!isTally(classes)) throw invalid(file, "classes");
  if (!isTally(returns)) throw invalid(file, "returns");
  return { points, rgbBits, attributes, classes, returns };
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function isCount(value: unknown): value is number {
  return Number.isSafeInteger(value) && (value as number) >= 0;
}

function isAttribute(value: unknown): value is AttributeStatistics {
  if (!isObject(value) || typeof value.name !== "string") return false;
  return [value.min, value.max, value.mean].every(Number.isFinite);
}

function isTally(value: unknown): value is Record<string, number> {
  return (
    isObject(value) && Object.entries(value).every(([code, count]) => /^\d+$/.test(code) && isCount(count))
  );
}

function invalid(file: string, what: string): FormatError {
  return new FormatError({
    code: "FORMAT_STATISTICS",
    file,
    cause: `its statistics record is damaged (${what})`,
    fix: "Convert the scan again",
  });
}
