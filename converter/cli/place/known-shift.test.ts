import { type ExactTransform, resolveCrs, truthOf } from "@groma/georef";
import { expect, it } from "vitest";
import { proj4jsTransformation } from "../proj/fallback.js";
import { epsg } from "./epsg.js";
import { withKnownShift } from "./known-shift.js";

const DOMAIN = { minX: 580_000, minY: 4_500_000, minZ: 0, maxX: 581_000, maxY: 4_501_000, maxZ: 50 };
const resolved = (given: string) => resolveCrs({ file: "scan.las", given }, epsg);
const truth = (crs: ReturnType<typeof resolved>) => truthOf({ crs }, 25, "scan.las");
const NAD83 = resolved("EPSG:26918");
const unstated = {
  ...(await proj4jsTransformation(NAD83, DOMAIN)).report,
  operation: "unknown",
  accuracy: null,
};

it("a way whose accuracy nobody has stated is worth what the shift is that leads to the same place", () => {
  expect(withKnownShift(unstated, NAD83, truth(NAD83), DOMAIN)).toMatchObject({
    ...{ accuracy: 4, operation: expect.stringContaining("EPSG:1188") },
  });
});

it("the ensemble of WGS 84 is never worth less than its two metres, and a better word stands", () => {
  const wgs84 = resolved("EPSG:32618");
  const zero = { ...unstated, operation: "PROJ's", accuracy: 0 };
  expect(withKnownShift(zero, wgs84, truth(wgs84), DOMAIN)).toMatchObject({
    accuracy: 2,
    operation: "PROJ's",
  });
  expect(withKnownShift({ ...zero, accuracy: 5 }, wgs84, truth(wgs84), DOMAIN).accuracy).toBe(5);
});

it.each([
  ["at 180°", "EPSG:4979", { minX: 179.99, minY: -17.01, minZ: 0, maxX: 180.01, maxY: -16.99, maxZ: 9 }],
  ["around a pole", "EPSG:3413", { minX: -100, minY: -100, minZ: 0, maxX: 100, maxY: 100, maxZ: 9 }],
])(
  "%s too, where longitudes jump: a way that nobody has stated leads to the same place",
  (_, given, domain) => {
    const wgs84 = resolved(given);
    const own = truth(wgs84) as ExactTransform;
    for (const nanometres of [-1, 1]) {
      const other: ExactTransform = (x, y, out, offset) => {
        own(x, y, out, offset);
        out[offset + 1] += 1e-9 * nanometres;
      };
      expect(withKnownShift(unstated, wgs84, other, domain)).toMatchObject({ accuracy: 2 });
    }
  },
);

it("a conversion alone is worth what its datum is, also where proj4js does not know the projection", () => {
  const wgs84 = resolved("EPSG:32618");
  const crs = { ...wgs84, proj4: "+proj=igh +datum=WGS84" };
  const zero = { ...unstated, operation: "PROJ's", accuracy: 0 };
  expect(withKnownShift(zero, crs, truth(wgs84), DOMAIN)).toMatchObject({ accuracy: 2, operation: "PROJ's" });
  expect(withKnownShift(unstated, crs, truth(wgs84), DOMAIN)).toBe(unstated);
  const byGeoid = { ...unstated, operation: "EGM96 height to WGS 84", accuracy: 1 };
  expect(withKnownShift(byGeoid, crs, truth(wgs84), DOMAIN).accuracy).toBe(2);
});

it("nothing is known of a way to another place, of a ballpark, or of a shift that nobody has published", () => {
  const near = resolved("+proj=utm +zone=18 +ellps=GRS80 +towgs84=1,0,0");
  expect(withKnownShift(unstated, NAD83, truth(near), DOMAIN)).toBe(unstated);
  expect(withKnownShift(unstated, near, truth(near), DOMAIN)).toBe(unstated);
  const ballpark = { ...unstated, ballpark: true };
  expect(withKnownShift(ballpark, NAD83, truth(NAD83), DOMAIN)).toBe(ballpark);
});
