import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { buildPage, cesium, harness } from "./accuracy/rendering-browser.mjs";
import { converted } from "./converted.mjs";
import { serveOver } from "./first-sight/line.mjs";

/** By name, what the scan comes over. */
const LINES = {
  "this machine": { bitsPerSecond: 1e10, delay: 0 },
  "8 Mbit/s, 40 ms": { bitsPerSecond: 8e6, delay: 40 },
};

const PAGES = ["groma", "giro3d"];
const ROUNDS = 3;

/**
 * From the call that opens Autzen to the first points and to the complete view, with the layer in Cesium and with Giro3D, each
 * on a page that is there already, in turns and with empty caches; of each the least time counts. Bytes and requests are those
 * of the scan alone. WebGL is drawn in software.
 */
export async function bench(root) {
  const scan = join(root, "../shared/data/autzen.laz");
  if (!existsSync(scan)) return [{ note: "autzen.laz is not in ../shared/data: skipped" }];
  const source = join(root, "tests/bench/first-sight");
  execFileSync("npm", ["ci", "--workspaces=false", "--no-audit", "--no-fund"], {
    cwd: source,
    stdio: "inherit",
  });
  const folder = mkdtempSync(join(tmpdir(), "groma-first-sight-"));
  const { launch, openPage } = await harness(root);
  const browser = await launch();
  try {
    const input = PAGES.map((name) => join(source, `${name}.html`));
    await buildPage(source, folder, { minify: true, input });
    const rows = [];
    for (const [line, limits] of Object.entries(LINES)) {
      const server = await serveOver(
        [
          ["/scan.copc.laz", converted(root, scan)],
          ["/cesium", cesium(root).folder],
          [
            "/laz-perf",
            dirname(createRequire(join(source, "package.json")).resolve("laz-perf/lib/web/index.js")),
          ],
          ["/", folder],
        ],
        limits,
      );
      const best = new Map();
      for (let round = 0; round < ROUNDS; round++) {
        for (const name of PAGES) {
          const { page, watch } = await openPage(browser, { width: 960, height: 600 }, "whole");
          page.setDefaultTimeout(240_000);
          await page.goto(`${server.address}/${name}.html`);
          await page.waitForSelector("body[data-ready]", { state: "attached" });
          server.asked.length = 0;
          const sight = await page.evaluate(
            (address) => window.look(address),
            `${server.address}/scan.copc.laz`,
          );
          if (watch.errors.length > 0) throw new Error(`${name} failed: ${watch.errors.join("; ")}`);
          await page.context().close();
          const ofScan = server.asked.filter(({ pathname }) => pathname === "/scan.copc.laz");
          const bytes = ofScan.reduce((sum, one) => sum + one.bytes, 0);
          const known = best.get(name);
          best.set(name, {
            ...{ ...sight, bytes, requests: ofScan.length },
            first: Math.min(sight.first, known?.first ?? Number.POSITIVE_INFINITY),
            complete: Math.min(sight.complete, known?.complete ?? Number.POSITIVE_INFINITY),
          });
        }
      }
      server.close();
      for (const name of PAGES) rows.push(row(line, name, best.get(name)));
    }
    return rows;
  } finally {
    await browser.close();
    rmSync(folder, { recursive: true });
  }
}

function row(line, page, { first, complete, points, bytes, requests }) {
  return {
    ...{ line, page },
    "first points, ms": Math.round(first),
    "complete, ms": Math.round(complete),
    ...{ points, requests },
    "bytes a point": Number((bytes / points).toFixed(2)),
  };
}
