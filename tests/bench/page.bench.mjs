import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";

/** Starts `groma view` and resolves with its address once it stands. */
function view(root, file) {
  const child = spawn(process.execPath, [join(root, "converter/dist/main.js"), "view", file, "--port", "0"], {
    stdio: ["ignore", "pipe", "inherit"],
  });
  return new Promise((resolve, reject) => {
    let output = "";
    child.stdout.on("data", (chunk) => {
      output += chunk;
      const address = /http:\/\/\S+/.exec(output)?.[0];
      if (address) resolve({ address, child });
    });
    child.on("close", (code) => reject(new Error(`groma view ended with ${code}`)));
  });
}

/**
 * Time from opening the page to the first frame with points and to everything that the first view wants, in system
 * Chromium with WebGL 2 in software; three runs, each with an empty cache.
 */
export async function bench(root) {
  const file = join(root, "../shared/data/autzen.laz");
  if (!existsSync(file)) return [{ note: "autzen.laz is not in ../shared/data: skipped" }];
  const { address, child } = await view(root, file);
  const browser = await chromium.launch({
    executablePath: process.env.GROMA_CHROMIUM ?? "/usr/bin/chromium",
    args: [
      "--no-sandbox",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--ignore-gpu-blocklist",
    ],
  });
  try {
    const rows = [];
    for (let run = 1; run <= 3; run++) {
      const context = await browser.newContext({ viewport: { width: 960, height: 600 } });
      const page = await context.newPage();
      const began = performance.now();
      const seconds = () => ((performance.now() - began) / 1000).toFixed(1);
      await page.goto(`${address}&budget=1000000&fly=0`);
      const wait = (condition) =>
        page.waitForFunction(condition, undefined, { timeout: 240_000, polling: 50 });
      await wait(() => window.groma?.layer?.statistics.pointsDrawn > 0);
      const first = seconds();
      await wait(() => window.groma.layer.settled);
      const complete = seconds();
      const { pointsDrawn } = await page.evaluate(() => window.groma.layer.statistics);
      rows.push({ run, "first picture s": first, "complete view s": complete, "points drawn": pointsDrawn });
      await context.close();
    }
    return rows;
  } finally {
    await browser.close();
    child.kill();
  }
}
