import { rmSync } from "node:fs";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { converted } from "../converted.js";
import { data } from "../project.js";
import {
  type Converted,
  compareAll,
  convertAndCompare,
  expectConverted,
  expectFaithful,
  refereesMissing,
  titled,
} from "./comparison.js";
import { makeFolder } from "./core.js";

/** Well-formed files of the data folder; what is odd about each stands in its name. */
const variants = [
  "copc__lone-star.copc.laz",
  "las__100-points.las",
  "las__autzen_trim.las",
  "las__bad-geotiff-keys.las",
  "las__epsg_4326.las",
  "las__hextest.las",
  "las__lots_of_vlr.las",
  "las__noise-dirty.las",
  "las__permutations__1.0_1.las",
  "las__permutations__1.1_1.las",
  "las__permutations__1.2_0.las",
  "las__permutations__1.2_2.las",
  "las__prec3.las",
  "las__sample_c_thin.las",
  "las__simple.las",
  "las__spurious.las",
  "las__test1_4.las",
  "las__test_epsg_4326.las",
  "las__test_epsg_4326x3.las",
  "las__test_utm17.las",
  "las__utm17.las",
  "las__wontcompress3.las",
  "laz__las_with_several_extra_byte_bloc.laz",
  "laz__simple.laz",
].map((name) => `las-variants/${name}`);

const scans = [...variants, "lion_takanawa.copc.laz", "ellipsoid.copc.laz", "vol_total.laz"].map((name) => ({
  name,
  ...data(name),
}));

describe("referees find every record of the input in the COPC", () => {
  const folder = makeFolder();
  const results = new Map<string, Converted>();
  afterAll(() => rmSync(folder, { recursive: true, force: true }));
  beforeAll(async () => {
    const there = scans.filter(({ missing }) => missing === undefined);
    const found = await convertAndCompare(
      folder,
      there.map(({ path }) => ({ inputs: [path] })),
    );
    for (const [index, { name }] of there.entries()) results.set(name, found[index]!);
  }, 280_000);

  for (const { name, missing } of scans) {
    const reason = refereesMissing ?? missing;
    test.skipIf(reason)(titled(name, reason), () => {
      expectConverted(results.get(name)!);
    });
  }

  const autzen = data("autzen.laz");
  const reason = refereesMissing ?? autzen.missing;
  test.skipIf(reason)(titled("autzen.laz", reason), { timeout: 300_000 }, () => {
    const [comparison] = compareAll([[converted(autzen.path), [autzen.path]]]);
    const found = expectFaithful(comparison);
    expect(found.points).toBe(10_653_336);
    expect(found.nodes).toBeGreaterThan(100);
    expect(found.largestNode).toBeLessThan(100_000);
    expect(found.statistics.rgbBits).toBe(8);
    expect(found.records).toContainEqual(["LASF_Projection", 2112]);
  });
});
