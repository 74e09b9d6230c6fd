import { readFileSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { basename, dirname, join } from "node:path";
import type { Browser } from "playwright-core";
import send from "send";
import { afterAll, beforeAll, expect, it } from "vitest";
import { converted } from "../converted.js";
import { data, projectRoot } from "../project.js";
import type {} from "./globe.js";
import { openPage, screenshot, sharedBrowser } from "./harness.js";

const scan = data("vol_total.laz");
const why = scan.missing ? ` (skipped: ${scan.missing})` : "";

/** The policy that the examples are held to. */
const policy = /^Content-Security-Policy: (.*)$/m.exec(
  readFileSync(join(projectRoot, "demo/examples/README.md"), "utf8"),
)![1]!;

let server: Server;
let browser: Browser;

beforeAll(async () => {
  if (scan.missing) return;
  const cloud = converted(scan.path);
  server = createServer((request, response) => {
    const { pathname } = new URL(request.url ?? "/", "http://localhost");
    response.setHeader("content-security-policy", policy);
    const [path, root] =
      pathname === "/cloud" ? [basename(cloud), dirname(cloud)] : [pathname, join(projectRoot, "demo/dist")];
    send(request, path, { root }).pipe(response);
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  browser = await sharedBrowser();
}, 240_000);

afterAll(async () => {
  await browser?.close();
  server?.close();
});

it.skipIf(scan.missing)(
  `the page draws globe and map under the policy${why}`,
  { timeout: 180_000 },
  async () => {
    const { page, watch } = await openPage(browser, { width: 640, height: 420 });
    const { port } = server.address() as AddressInfo;
    await page.goto(`http://127.0.0.1:${port}/?fly=0&budget=50000&map=1&cloud=/cloud`);
    await page.waitForFunction(
      () => window.groma?.layer?.settled && window.groma.layer.statistics.pointsDrawn > 1000,
      undefined,
      { timeout: 150_000 },
    );
    expect([watch.errors, watch.foreign]).toEqual([[], []]);
    await screenshot(page, "policy");
    await page.context().close();
  },
);
