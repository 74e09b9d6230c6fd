import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { POSE } from "./rendering.mjs";
import { openScene } from "./rendering-browser.mjs";
import { points } from "./rendering-figures.mjs";

/** Bytes of vertices that the page may keep: more than all points of the scan take. */
const CACHE = 2 ** 31;

/**
 * Has a report made on a real scan in a real browser; undefined where the scan is not there.
 *
 * @param {string} name of the report
 * @param {(file: string, openPage: () => ReturnType<typeof openScene>) => Promise<object>} report on a COPC; the page is closed after it
 */
export async function onScan(root, name, report) {
  const scan = join(root, "../shared/data/autzen.laz");
  if (!existsSync(scan)) {
    console.log(`${name}: autzen.laz is not in ../shared/data: left out`);
    return undefined;
  }
  const folder = mkdtempSync(join(tmpdir(), `groma-${name}-`));
  let scene;
  try {
    const file = join(folder, "scan.copc.laz");
    const convert = [join(root, "converter/dist/main.js"), "convert", scan, file];
    execFileSync(process.execPath, convert, { stdio: "pipe" });
    const made = await report(file, async () => {
      scene = await openScene(root, file, folder, POSE, CACHE);
      return scene;
    });
    if (scene?.watch.errors.length > 0) throw new Error(`the page failed: ${scene.watch.errors.join("; ")}`);
    return { ...made, how: HOW };
  } finally {
    await scene?.close();
    rmSync(folder, { recursive: true });
  }
}

/** What pictures are held against. @param {number} inSight points of the scan that are in sight */
export function comparison(inSight) {
  return (
    "The Autzen scan (10.7 million points, airborne) from one place, 640 × 400 pixels. What could be seen is a picture of " +
    `full density: all ${points(inSight)} points in sight, 1.5 px wide, four samples per pixel. Differences are ` +
    "root mean squares over all channels, in steps of 255, and shares of pixels of which a channel is more than 16 steps " +
    "off."
  );
}

const HOW =
  "Times are those of the processor, of all threads of all processes of the browser (`SystemInfo.getProcessInfo`, in steps of 10 ms), which " +
  "whoever else is on the machine disturbs less than the clock: medians of frames of a view that moves by a millimetre, each ended by reading a pixel back. The two that are " +
  "compared take turns in one page, and the ratio of all their frames together counts; quartiles are those of frames that followed each other. WebGL runs in software here, on the CPU: on a GPU vertices and passes cost in another proportion.";
