import { spawnSync } from "node:child_process";
import { homedir } from "node:os";
import { join } from "node:path";
import { describe, expect, test } from "vitest";
import { data } from "../project.js";
import { titled } from "./comparison.js";
import { convert, coreMissing, withFolder } from "./core.js";

/** PDAL as `groma` finds it; see converter/scripts/install-pdal. */
const cache = process.env.XDG_CACHE_HOME || join(homedir(), ".cache");
const program = [process.env.GROMA_PDAL, "pdal", join(cache, "groma/pdal/bin/pdal")].find(
  (name) => name && spawnSync(name, ["--version"]).status === 0,
);
const pdalMissing = program ? undefined : "PDAL is not there: run converter/scripts/install-pdal";

/** What PDAL counts of one attribute. */
interface Statistic {
  name: string;
  count: number;
  minimum: number;
  maximum: number;
  average: number;
}

const DIMENSIONS = ["X", "Y", "Z", "Intensity", "ReturnNumber", "Classification", "PointSourceId", "GpsTime"];

/** Statistics of every point by PDAL's own reader. */
function statistics(file: string): Statistic[] {
  const args = ["info", "--stats", "--dimensions", DIMENSIONS.join(), file];
  const { stdout, stderr, status } = spawnSync(program!, args, { encoding: "utf8", timeout: 60_000 });
  expect(status, stderr).toBe(0);
  return (JSON.parse(stdout) as { stats: { statistic: Statistic[] } }).stats.statistic;
}

describe("PDAL reads what was converted", () => {
  for (const name of ["las__autzen_trim.las", "las__sample_c_thin.las", "laz__simple.laz"]) {
    const { path, missing } = data(`las-variants/${name}`);
    const reason = coreMissing ?? pdalMissing ?? missing;
    test.skipIf(reason)(titled(name, reason), { timeout: 120_000 }, () =>
      withFolder(async (folder) => {
        const output = join(folder, "out.copc.laz");
        expect((await convert([path, output])).status).toBe(0);
        const [before, after] = [path, output].map(statistics);
        expect(after).toHaveLength(before!.length);
        for (const [index, { name, count, minimum, maximum, average }] of before!.entries()) {
          expect(after![index]).toMatchObject({ name, count, minimum, maximum });
          // It adds the values up in the order of the file and prints ten digits.
          expect(after![index]!.average / average || 1).toBeCloseTo(1, 8);
        }
      }),
    );
  }
});
