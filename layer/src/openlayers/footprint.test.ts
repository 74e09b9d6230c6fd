import { geodeticToEcef, PlacementError } from "@groma/georef";
import type Polygon from "ol/geom/Polygon.js";
import Projection from "ol/proj/Projection.js";
import { register } from "ol/proj/proj4.js";
import { get as projectionOf } from "ol/proj.js";
import proj4 from "proj4";
import { describe, expect, it } from "vitest";
import type { PointCloud } from "../cloud/index.js";
import { Footprint, outlineOf } from "./footprint.js";

proj4.defs("X:north", "+proj=stere +lat_0=90 +lon_0=0 +k=0.994 +datum=WGS84 +units=m +no_defs");
proj4.defs("X:south", "+proj=stere +lat_0=-90 +lon_0=0 +k=0.994 +datum=WGS84 +units=m +no_defs");
proj4.defs("X:dateline", "+proj=merc +lon_0=150 +datum=WGS84 +units=m +no_defs");
proj4.defs("X:utm", "+proj=utm +zone=32 +datum=WGS84 +units=m +no_defs");
register(proj4);

/** A data set in a system of proj4js. @param box min x, y, max x, y */
function cloudIn(code: string, [minX, minY, maxX, maxY]: readonly number[], beyond = Infinity): PointCloud {
  const cloud = {
    name: "scan.copc.laz",
    boundingBox: { min: [minX, minY, 0], max: [maxX, maxY, 10] },
    place(x: number, y: number, z: number, out: Float64Array) {
      if (x > beyond) {
        throw new PlacementError({ code: "PLACE_DOMAIN", file: "scan", cause: "it is beyond", fix: "none" });
      }
      const [longitude, latitude] = proj4(code, "EPSG:4326", [x, y]) as [number, number];
      geodeticToEcef((longitude * Math.PI) / 180, (latitude * Math.PI) / 180, z, out);
      return out;
    },
  };
  return cloud as unknown as PointCloud;
}

const extentOf = (cloud: PointCloud, code: string) => outlineOf(cloud, code)?.getExtent();

describe("the outline of a data set", () => {
  it.each(["EPSG:4326", "EPSG:3857", "X:utm"])("has its corners, in %s", (code) => {
    const [minX, minY, maxX, maxY] = extentOf(cloudIn("X:utm", [5e5, 52e5, 50e4 + 900, 52e5 + 300]), code)!;
    const corners = [
      [5e5, 52e5],
      [5e5 + 900, 52e5 + 300],
    ].map((corner) => proj4("X:utm", code, corner));
    const size = maxX! - minX!;
    expect(Math.abs(minX! - corners[0]![0]!) / size).toBeLessThan(0.01);
    expect(Math.abs(minY! - corners[0]![1]!) / size).toBeLessThan(0.01);
    expect(Math.abs(maxX! - corners[1]![0]!) / size).toBeLessThan(0.01);
    expect(Math.abs(maxY! - corners[1]![1]!) / size).toBeLessThan(0.01);
  });

  it.each([
    ["X:north", "EPSG:4326", [-180, 88.6, 180, 90]],
    ["X:south", "EPSG:4326", [-180, -90, 180, -88.6]],
  ])("around a pole holds all longitudes up to it: %s in %s", (from, to, wanted) => {
    // Not in the middle of the box.
    const extent = extentOf(cloudIn(from, [-100_000, -60_000, 120_000, 90_000]), to)!;
    for (const [at, edge] of wanted.entries()) expect(Math.abs(extent[at]! - edge)).toBeLessThan(0.1);
    const [around] = outlineOf(cloudIn(from, [-100_000, -60_000, 120_000, 90_000]), to)!.getCoordinates();
    // From the edge of the world to the edge, once.
    const longitudes = around!.slice(0, -3).map(([longitude]) => longitude!);
    expect(longitudes).toEqual([...longitudes].sort((a, b) => a - b));
  });

  it("around a pole is the box itself in a polar map, and reaches past the world in Mercator's", () => {
    const box = [-100_000, -60_000, 120_000, 90_000];
    const own = extentOf(cloudIn("X:north", box), "X:north")!;
    for (const [at, edge] of box.entries()) expect(own[at]).toBeCloseTo(edge, 3);
    const mercator = extentOf(cloudIn("X:north", box), "EPSG:3857")!;
    expect(mercator[2]! - mercator[0]!).toBeCloseTo(40_075_016.69, 1);
    expect(mercator[3]).toBeGreaterThan(75e6);
  });

  it.each([
    [-1000, 180],
    [1000, -180],
  ])("lies across 180° in the world of its middle (%s m from it)", (east, edge) => {
    const [x] = proj4("EPSG:4326", "X:dateline", [180, 0]) as [number, number];
    const cloud = cloudIn("X:dateline", [x + east - 30_000, -1000, x + east + 30_000, 1000]);
    const [minX, , maxX] = extentOf(cloud, "EPSG:4326")!;
    expect(maxX! - minX!).toBeCloseTo(60_000 / 111_319.49, 4);
    expect((minX! + maxX!) / 2).toBeCloseTo(edge + east / 111_319.49, 4);
  });

  it("leaves out places that the data set does not have, and is none where too few are left", () => {
    const all = [500_000, 5_200_000, 500_900, 5_200_300];
    const [, , maxX] = extentOf(cloudIn("X:utm", all, 500_500), "X:utm")!;
    expect(maxX).toBeGreaterThan(500_400);
    expect(maxX).toBeLessThan(500_501);
    expect(outlineOf(cloudIn("X:utm", all, 0), "X:utm")).toBeUndefined();
  });

  it("tells of a projection that is not registered", () => {
    const cloud = cloudIn("X:utm", [0, 0, 1, 1]);
    const unknown = new Projection({ code: "X:unknown", units: "m" });
    for (const projection of ["X:unknown", unknown]) {
      expect(() => outlineOf(cloud, projection)).toThrow(/CRS_PROJECTION: scan.*X:unknown/s);
    }
  });
});

describe("footprints", () => {
  it("are told once for each projection, and there for whoever asks", async () => {
    const cloud = cloudIn("X:utm", [500_000, 5_200_000, 500_900, 5_200_300]);
    const footprint = new Footprint(Promise.resolve(cloud));
    await Promise.resolve();
    const told: string[] = [];
    for (const event of ["addfeature", "removefeature"] as const) {
      footprint.on(event, (one: { readonly feature?: { getGeometry(): Polygon | undefined } }) => {
        told.push(`${event} ${one.feature!.getGeometry()!.getExtent()[0]}`);
      });
    }
    let changes = 0;
    footprint.on("change", () => changes++);
    const ask = (code: string) => {
      const projection = code === "none" ? new Projection({ code }) : projectionOf(code)!;
      footprint.loadFeatures([0, 0, 1, 1], 1, projection);
      return footprint.getFeatures().map((feature) => feature.getGeometry()!.getExtent()[0]!);
    };
    const codes = ["X:utm", "EPSG:3857", "none"];
    const [utm, mercator, none] = codes.map(ask);
    const first = [...told];
    const settled = changes;
    expect([utm!.length, mercator!.length, none!.length]).toEqual([1, 1, 0]);
    expect(first).toEqual([
      `addfeature ${utm}`,
      `removefeature ${utm}`,
      `addfeature ${mercator}`,
      `removefeature ${mercator}`,
    ]);
    for (let round = 0; round < 3; round++) expect(codes.map(ask)).toEqual([utm, mercator, none]);
    expect(told).toEqual(first);
    expect(changes).toBe(settled);
  });
});
