import { StyleError } from "../errors/index.js";
import type { StyledCloud } from "./complete-style.js";
import { type PointFilter, RETURN_BITS } from "./filter.js";

/**
 * A filter that can be carried out on a data set.
 * @throws StyleError STYLE_FILTER
 */
export function checkFilter(filter: PointFilter, { attributes, file }: StyledCloud): PointFilter {
  const fail = (cause: string, fix: string): never => {
    throw new StyleError({ code: "STYLE_FILTER", file, cause, fix });
  };
  for (const number of filter.classes ?? []) {
    if (!Number.isInteger(number) || number < 0 || number > 255) {
      fail(`there is no class ${number}`, "Use whole numbers from 0 to 255");
    }
  }
  for (const kind of filter.returns ?? []) {
    if (!Object.hasOwn(RETURN_BITS, kind)) {
      fail(`there is no kind of return "${kind}"`, `Use some of ${Object.keys(RETURN_BITS).join(", ")}`);
    }
  }
  const names = attributes.filter(({ kind }) => kind !== "color").map(({ name }) => name);
  for (const [name, range] of Object.entries(filter.ranges ?? {})) {
    if (!names.includes(name)) fail(`the data set has no "${name}"`, `Use some of ${names.join(", ")}`);
    const [least, greatest] = range;
    if (!(least <= greatest)) {
      fail(`"${name}" cannot run from ${least} to ${greatest}`, "Give the least value first");
    }
  }
  return filter;
}
