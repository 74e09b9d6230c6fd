import { expect, it } from "vitest";
import { localPlace } from "./local.js";

it.each([
  ["8.5,47.3,500", undefined, "OPTION_ANCHOR", "needs lon,lat,height,heading: heading is missing"],
  ["8.5", undefined, "OPTION_ANCHOR", "needs lon,lat,height,heading: lat, height, heading are missing"],
  ["8,5,47,3,500,0", undefined, "OPTION_ANCHOR", "expected 4 or 5 numbers, found 6; use a decimal point"],
  ["8.5,47.3,,0", undefined, "OPTION_ANCHOR", '"" is not a number'],
  ["8.5,47.3,high,0", undefined, "OPTION_ANCHOR", '"high" is not a number'],
  ["8.5,97.3,500,0", undefined, "OPTION_ANCHOR", "latitude must be between −90 and 90, and is 97.3"],
  ["860,47.3,500,0", undefined, "OPTION_ANCHOR", "longitude must be between −360 and 360, and is 860"],
  ["8.5,47.3,500,0,0", undefined, "OPTION_ANCHOR", "the scale must be greater than 0, and is 0"],
  [undefined, "1,2,3", "OPTION_ANCHOR", "--anchor-at requires --anchor"],
  ["8.5,47.3,500,0", "1,2", "OPTION_ANCHOR_AT", "needs x,y,z: z is missing"],
  ["8.5,47.3,500,0", "1,2,3,4", "OPTION_ANCHOR_AT", "expected 3 numbers, found 4; use a decimal point"],
])(
  "--anchor %s --anchor-at %s is refused by what is wrong with it",
  async (anchor, anchorAt, code, cause) => {
    await expect(localPlace({ anchor, anchorAt })).rejects.toMatchObject({ code, cause });
  },
);
