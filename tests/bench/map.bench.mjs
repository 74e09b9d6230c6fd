import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { loadavg, tmpdir } from "node:os";
import { join } from "node:path";
import { openScanPage, SCAN } from "./accuracy/rendering-browser.mjs";
import { converted } from "./converted.mjs";

/** Sets of effects, by name. */
const STYLES = {
  fixed: {},
  adaptive: { size: "adaptive", shape: "disc" },
  "Eye-Dome Lighting": { eyeDomeLighting: true },
};

/**
 * Script of a frame whose view has moved, on a map of OpenLayers and on the globe, with the same scan and budget of points,
 * in one page and in turns: ratios count. Points are not rasterised. `own` is the frame less that of the same view without
 * the layer. `still`: calls that draw in ten frames of a map that stands still.
 *
 * @param {{ points?: number[] }} options
 */
export async function bench(root, { points = [1_000_000] } = {}) {
  const scan = join(root, "../shared/data/autzen.laz");
  if (!existsSync(scan)) return [{ note: "autzen.laz is not in ../shared/data: skipped" }];
  const folder = mkdtempSync(join(tmpdir(), "groma-map-"));
  try {
    const source = join(root, "tests/bench/map");
    const { page, setting, watch, close } = await openScanPage(root, source, converted(root, scan), folder);
    try {
      console.log(`${setting}, load ${loadavg()[0].toFixed(1)}`);
      await page.evaluate(() => {
        window.beside = new window.MapBesideGlobe();
      });
      const rows = [];
      for (const count of points) {
        for (const [name, style] of Object.entries(STYLES)) {
          const asked = { points: count, style, frames: 101 };
          const figures = await page.evaluate(
            ([scan, asked]) => window.beside.measure(scan, asked),
            [SCAN, asked],
          );
          rows.push(row(name, figures));
        }
      }
      if (watch.errors.length > 0) throw new Error(`the page failed: ${watch.errors.join("; ")}`);
      return rows;
    } finally {
      await close();
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
}

function row(style, { globe, map, still }) {
  const figure = (number) => Number(number.toFixed(3));
  const own = ({ whole, empty }) => whole - empty;
  return {
    style,
    ...{ "points, globe": globe.points, "points, map": map.points },
    ...{ "nodes, globe": globe.nodes, "nodes, map": map.nodes },
    ...{ "ms, globe": figure(globe.whole), "own, globe": figure(own(globe)) },
    ...{ "ms, map": figure(map.whole), "own, map": figure(own(map)) },
    "own, map ÷ globe": figure(own(map) / own(globe)),
    "the same per point": figure(own(map) / map.points / (own(globe) / globe.points)),
    "draws, globe / map": `${globe.draws} / ${map.draws}`,
    still,
  };
}
