import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, expect, it } from "vitest";
import { converted } from "../converted.js";
import { data, projectRoot } from "../project.js";
import type {} from "./globe.js";
import { openPage, screenshot, sharedBrowser, type View, view } from "./harness.js";

const scan = data("vol_total.laz");
const why = scan.missing ? ` (skipped: ${scan.missing})` : "";

/** The policy that the examples are held to. */
const policy = /^Content-Security-Policy: (.*)$/m.exec(
  readFileSync(join(projectRoot, "demo/examples/README.md"), "utf8"),
)![1]!;

let server: View;
let browser: Browser;

beforeAll(async () => {
  if (scan.missing) return;
  server = await view(converted(scan.path));
  browser = await sharedBrowser();
}, 240_000);

afterAll(async () => {
  await browser?.close();
  await server?.stop();
});

it.skipIf(scan.missing)(
  `the page draws globe and map under the policy that groma view sends${why}`,
  { timeout: 180_000 },
  async () => {
    const { page, watch } = await openPage(browser, { width: 640, height: 420 });
    await page.addInitScript(() => {
      const violations: string[] = [];
      Object.assign(window, { violations });
      addEventListener("securitypolicyviolation", ({ violatedDirective }) =>
        violations.push(violatedDirective),
      );
    });
    const violations = () => page.evaluate(() => (window as unknown as { violations: string[] }).violations);
    const answer = await page.goto(`${server.address}&fly=0&budget=50000&map=1`);
    const sent = answer!.headers()["content-security-policy"]!;
    for (const part of policy.split("; ")) expect(sent.split("; ")).toContain(part);
    expect(sent).not.toContain("'unsafe-eval'");
    await page.waitForFunction(
      () => window.groma?.layer?.settled && window.groma.layer.statistics.pointsDrawn > 1000,
      undefined,
      { timeout: 150_000 },
    );
    await page.evaluate(() => document.querySelector<HTMLElement>("#keys-open")!.click());
    expect([watch.errors, watch.foreign, await violations()]).toEqual([[], [], []]);
    await screenshot(page, "policy");
    // What the policy forbids is seen (negative control).
    await page.evaluate(() => {
      const script = document.createElement("script");
      script.textContent = "window.ran = true";
      document.head.append(script);
    });
    await expect.poll(violations).toEqual(["script-src-elem"]);
    expect(await page.evaluate(() => "ran" in window)).toBe(false);
    await page.context().close();
  },
);
