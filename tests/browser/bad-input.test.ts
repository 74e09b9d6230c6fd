import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import type { Browser, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it, vi } from "vitest";
import { converted } from "../converted.js";
import { BadServer, type Misbehaviour } from "../faults/bad-server.js";
import { data, projectRoot } from "../project.js";
import type {} from "./globe.js";
import { openPage, screenshot, sharedBrowser, type View, view, type Watch } from "./harness.js";

const scan = data("vol_total.laz");
const withoutCrs = data("lion_takanawa.copc.laz");
const missing = scan.missing ?? withoutCrs.missing;
const HTML = new TextEncoder().encode("<!DOCTYPE html><title>Sign in</title>");

const skipped = (file: { missing?: string | undefined }) =>
  file.missing ? ` (skipped: ${file.missing})` : "";

describe.skipIf(missing)(`bad input on the page${missing ? ` (skipped: ${missing})` : ""}`, () => {
  let good: View;
  let goodCloud: string;
  let file: Uint8Array;
  let browser: Browser;
  let bad: BadServer | undefined;
  let page: Page;
  let watch: Watch;

  beforeAll(async () => {
    const copc = converted(scan.path);
    file = readFileSync(copc);
    good = await view(copc);
    goodCloud = new URL(good.address).searchParams.get("cloud") ?? "";
    browser = await sharedBrowser();
  }, 120_000);

  afterAll(async () => {
    await browser?.close();
    await good?.stop();
  });

  beforeEach(async () => {
    ({ page, watch } = await openPage(browser, { width: 640, height: 420 }));
  });

  afterEach(async () => {
    await page.context().close();
    await bad?.stop();
    bad = undefined;
  });

  const show = (cloud: string) =>
    page.goto(`${new URL(good.address).origin}/?fly=0&budget=50000&cloud=${encodeURIComponent(cloud)}`);

  /** The code that the page tells, once it tells one. */
  async function told(): Promise<string> {
    const message = page.locator("#message .code");
    await message.waitFor({ timeout: 60_000 });
    return (await message.textContent()) ?? "";
  }

  it("PAGE_FILE: the built page opened as a file", async () => {
    await page.goto(pathToFileURL(join(projectRoot, "demo/dist/index.html")).href);
    expect(await told()).toBe("PAGE_FILE");
    expect(await page.textContent("#message")).toContain("groma view");
  });

  it("PAGE_WEBGL: a browser without WebGL", async () => {
    await page.addInitScript(() => {
      const get = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...rest) {
        return /webgl/.test(kind) ? null : get.call(this, kind, ...rest);
      } as typeof get;
    });
    await show(goodCloud);
    expect(await told()).toBe("PAGE_WEBGL");
    expect(await page.textContent("#message")).toContain("hardware acceleration");
  });

  /** The same page opens and draws a good cloud after all that; no exception went unhandled. */
  async function livesOn(): Promise<void> {
    if (!(await page.locator("#chooser").evaluate((chooser: HTMLDetailsElement) => chooser.open))) {
      await page.locator("#chooser summary").click();
    }
    await page.fill("#address", goodCloud);
    await page.press("#address", "Enter");
    await page.waitForFunction(
      () => window.groma?.layer?.cloud.name === "vol_total.copc.laz" && window.groma.layer.settled,
      undefined,
      { timeout: 120_000 },
    );
    expect(await page.evaluate(() => window.groma.layer.statistics.pointsDrawn)).toBeGreaterThan(1000);
    expect(await page.locator("#message .code").count()).toBe(0);
    expect(watch.errors.filter((text) => !/Failed to load resource/.test(text))).toEqual([]);
  }

  /** How many points the layer draws once it has settled. */
  async function drawn(): Promise<number> {
    await page.waitForFunction(() => window.groma?.layer?.settled, undefined, { timeout: 120_000 });
    return page.evaluate(() => window.groma.layer.statistics.pointsDrawn);
  }

  it.each<[string, string, Misbehaviour]>([
    ["SOURCE_NO_RANGE", "a server without Range", ({ response }) => response.writeHead(200).end(file)],
    ["SOURCE_HTML", "a web page instead of data", ({ response }) => response.writeHead(200).end(HTML)],
    ["SOURCE_NOT_FOUND", "no such file", ({ response }) => response.writeHead(404).end()],
    [
      "FORMAT_MAGIC",
      "another kind of file",
      ({ answer, first, last }) => answer({}, new Uint8Array(last - first + 1).fill(7)),
    ],
    [
      "SOURCE_NOT_FOUND",
      "a file that vanishes while it loads",
      ({ count, answer, response }) => {
        // The header, and too little behind it for any points.
        const range = { "Content-Range": `bytes 0-16383/${file.length}` };
        if (count <= 1) answer(range, file.subarray(0, 16_384));
        else response.writeHead(404).end();
      },
    ],
  ])("%s: %s", { timeout: 180_000 }, async (code, _, misbehave) => {
    bad = await BadServer.start(file, misbehave);
    await show(bad.url);
    expect(await told()).toBe(code);
    await livesOn();
  });

  it("nodes that failed on globe and map come when they are asked for again", {
    timeout: 180_000,
  }, async () => {
    bad = await BadServer.start(file);
    await page.goto(
      `${new URL(good.address).origin}/?fly=0&map=1&budget=300000&cloud=${encodeURIComponent(bad.url)}`,
    );
    expect(await drawn()).toBeGreaterThan(1000);
    bad.misbehave = ({ response }) => response.writeHead(404).end();
    await page.evaluate(() => {
      const { layer, viewer } = window.groma;
      layer.maximumScreenSpaceError = 0.5;
      viewer.scene.requestRender();
    });
    /** Nodes that globe and map want and have not, told as failed; -1 before the map has its layer. */
    const failed = () =>
      page.evaluate(async () => {
        const { beside, layer } = window.groma;
        const [onMap] = (await beside.view)!.map
          .getAllLayers()
          .filter((one) => "retryFailed" in one) as never as [
          { statistics: { nodesFailed: number; nodesVisible: number; nodesLoaded: number } },
        ];
        return [layer.statistics, onMap.statistics].map(({ nodesFailed, nodesVisible, nodesLoaded }) =>
          nodesVisible === 0 ? -1 : nodesFailed > 0 ? nodesFailed : nodesLoaded - nodesVisible,
        );
      });
    await vi.waitFor(async () => expect(Math.min(...(await failed()))).toBeGreaterThan(0), {
      timeout: 120_000,
    });
    expect(await told()).toBe("SOURCE_NOT_FOUND");
    bad.misbehave = undefined;
    await page.getByRole("button", { name: "Try again" }).click();
    await vi.waitFor(async () => expect(await failed()).toEqual([0, 0]), { timeout: 120_000 });
    expect(await page.locator("#message .code").count()).toBe(0);
  });

  it("CRS_MISSING: a file that names no coordinate system", { timeout: 180_000 }, async () => {
    bad = await BadServer.start(readFileSync(withoutCrs.path));
    await show(bad.url);
    expect(await told()).toBe("CRS_MISSING");
    await screenshot(page, "bad-input-no-crs");
    await livesOn();
  });

  const wrongBounds = data("reports/k30_bbox_wrong.copc.laz");
  it.skipIf(wrongBounds.missing)(
    `a file whose bounds do not hold its points is drawn, and the page says so${skipped(wrongBounds)}`,
    { timeout: 180_000 },
    async () => {
      bad = await BadServer.start(readFileSync(wrongBounds.path));
      await show(bad.url);
      expect(await drawn()).toBeGreaterThan(100);
      expect(await page.locator("#facts .warning").allTextContents()).toContainEqual(
        expect.stringContaining("the declared bounds do not hold the points"),
      );
      await screenshot(page, "bad-input-wrong-bounds");
    },
  );

  const tinyNodes = data("reports/k27_deep_empty.copc.laz");
  it.skipIf(tinyNodes.missing)(
    `a view of 1,553 nodes of one point each is called complete when all are drawn${skipped(tinyNodes)}`,
    { timeout: 180_000 },
    async () => {
      bad = await BadServer.start(readFileSync(tinyNodes.path));
      await show(bad.url);
      await page.waitForFunction(
        () => document.querySelector("#stage")!.textContent === "This view is complete.",
        undefined,
        { timeout: 120_000 },
      );
      expect(await page.evaluate(() => window.groma.layer.statistics)).toMatchObject({ pointsDrawn: 1553 });
    },
  );

  it("a damaged link is told, and the globe draws on", { timeout: 180_000 }, async () => {
    const link = (view: string) => `${new URL(good.address)}&fly=0&budget=50000#view=${view}`;
    for (const view of ["1~c9_45_1e300_0_-90_0", "1~c9_45_%"]) {
      await page.goto("about:blank");
      await page.goto(link(view));
      expect(await told()).toBe("LINK_BROKEN");
      expect(await drawn()).toBeGreaterThan(1000);
    }
    expect(watch.errors).toEqual([]);
  });

  it("PAGE_TERRAIN: no terrain where the address says; what nobody caught is told too", {
    timeout: 180_000,
  }, async () => {
    await page.goto(`${new URL("/", good.address)}?terrain=/none`);
    expect(await told()).toBe("PAGE_TERRAIN");
    await page.evaluate(() => void Promise.reject(new Error("the cause")));
    await page.locator("#message:has-text('PAGE_FAILED')").waitFor();
    expect(await page.textContent("#message")).toContain("the cause");
    await page.evaluate(() => setTimeout(() => window.groma.measure.add([{} as never])));
    await page.locator("#message:has-text('MEASURE_OPTION')").waitFor();
  });

  it("another language that the browser does not keep is told, and the page stays", async () => {
    await page.addInitScript(() => {
      Storage.prototype.setItem = () => {
        throw new DOMException("full", "QuotaExceededError");
      };
    });
    await page.goto(new URL("/", good.address).href);
    await page.selectOption("#language", "fr");
    await page.locator("#language-note:has-text('allow this site to store data')").waitFor();
    expect(await page.inputValue("#language")).toBe("en");
  });

  it("an address that is none of a cloud is not followed", { timeout: 60_000 }, async () => {
    await show("javascript:alert(1)");
    expect(await told()).toMatch(/^PAGE_/);
    expect(await page.locator("#message").innerHTML()).not.toMatch(/<script/i);
  });
});
