import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, it } from "vitest";
import { convert } from "../converted.js";
import { lasOf } from "../faults/las-bytes.js";
import { projectRoot } from "../project.js";
import { settle } from "./globe.js";
import { openPage, screenshot, sharedBrowser, type View, view, type Watch } from "./harness.js";

const folder = join(projectRoot, "tests/artifacts/indexing");
const file = (name: string) => join(folder, name);
const core = (...args: string[]) =>
  execFileSync(join(projectRoot, "converter/target/release/groma-core"), args, { stdio: "pipe" });

/** Points of the scans. */
const POINTS = 60_000;

let browser: Browser;
let server: View;
let page: Page;
let watch: Watch;
/** Names of files that the page has fetched. */
const fetched: string[] = [];

/** LAS and LAZ of the same points, one that is damaged, one whose header announces more than the page takes. */
beforeAll(async () => {
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  const las = lasOf(POINTS);
  writeFileSync(file("scan.las"), las);
  core("convert", file("scan.las"), file("scan.copc.laz"));
  core("compress", file("scan.las"), file("scan.laz"));
  const damaged = readFileSync(file("scan.laz"));
  // What a chunk says of how many points it holds: behind its first record.
  damaged.writeUInt32LE(7, damaged.readUInt32LE(96) + 8 + 30);
  writeFileSync(file("damaged.laz"), damaged);
  new DataView(las.buffer).setBigUint64(247, 10_000_001n, true);
  writeFileSync(file("large.las"), las);
  convert(file("scan.las"), file("placed.copc.laz"), ["--crs", "EPSG:32632", "--vertical", "ellipsoidal"]);
  server = await view(file("placed.copc.laz"));
  browser = await sharedBrowser();
  ({ page, watch } = await openPage(browser, { width: 640, height: 480 }));
  page.on("request", (request) => fetched.push(new URL(request.url()).pathname.split("/").at(-1)!));
  await page.addInitScript(() => {
    (window as { showSaveFilePicker?: unknown }).showSaveFilePicker = undefined;
  });
  await page.goto(`${new URL(server.address).origin}/?fly=0&budget=20000`);
}, 180_000);

afterAll(async () => {
  await browser?.close();
  await server?.stop();
});

const codes = () => page.locator("#message .code").allTextContents();
const names = () => page.locator("#cloud-list .name").allTextContents();
const hasCore = () => fetched.some((name) => /^groma-core.*\.wasm$/.test(name));

/** Keeps what the page says of its work, and gives a cloud up as soon as it says what `until` finds. */
async function listen(until?: string): Promise<void> {
  await page.evaluate((words) => {
    const stage = document.querySelector("#stage")!;
    const told: string[] = [];
    Object.assign(window, { told });
    const observer = new MutationObserver(() => {
      told.push(stage.textContent!);
      if (words === undefined || !stage.textContent!.includes(words)) return;
      observer.disconnect();
      document.querySelector<HTMLButtonElement>("[aria-label^='Give up']")!.click();
    });
    observer.observe(stage, { childList: true });
  }, until);
}

const told = () => page.evaluate(() => (window as unknown as { told: string[] }).told);

/** Bytes of the points of a COPC file: from behind the place of the chunk table to there. */
function chunksOf(copc: Buffer): Buffer {
  const begin = copc.readUInt32LE(96);
  return copc.subarray(begin + 8, Number(copc.readBigUInt64LE(begin)));
}

it("of a scan whose header announces too many points it is said how to convert it", async () => {
  await page.setInputFiles("#file", file("large.las"));
  await expect.poll(codes).toEqual(["INDEX_POINTS"]);
  expect(await page.textContent("#message")).toContain("groma convert IN OUT.copc.laz");
  expect(hasCore()).toBe(false);
});

it("the core that is not to be had is told", async () => {
  await page.route(/groma-core.*\.wasm/, (route) => route.fulfill({ status: 404 }));
  await page.setInputFiles("#file", file("scan.las"));
  await expect.poll(codes).toEqual(["INDEX_CORE"]);
  expect(await page.textContent("#message")).toContain("HTTP 404");
  await page.unrouteAll();
  watch.errors.length = 0;
});

it("of a damaged scan the core's own code is told", async () => {
  await page.setInputFiles("#file", file("damaged.laz"));
  await expect.poll(codes).toEqual(["INPUT_CORRUPT"]);
  expect(await page.textContent("#message")).toMatch(/damaged\.laz: a chunk of \d+ bytes cannot be decoded/);
  expect(hasCore()).toBe(true);
  expect(await names()).toEqual([]);
});

it("one that is given up while its header is read is gone at once", async () => {
  await page.evaluate(() => {
    const read = Blob.prototype.arrayBuffer;
    // The header comes when the opening has been given up.
    Blob.prototype.arrayBuffer = async function (this: Blob) {
      const bytes = await read.call(this);
      if (this.size !== 375) return bytes;
      const button = document.querySelector<HTMLButtonElement>("[aria-label^='Give up']")!;
      button.click();
      Blob.prototype.arrayBuffer = read;
      return bytes;
    };
  });
  await page.route(/groma-core.*\.wasm/, () => undefined);
  await page.setInputFiles("#file", file("scan.las"));
  await expect.poll(() => page.evaluate(() => /native/.test(`${Blob.prototype.arrayBuffer}`))).toBe(true);
  await expect.poll(names).toEqual([]);
  await page.unrouteAll();
});

it("one that is written to while it is read is told as that, and not as damaged", async () => {
  writeFileSync(file("other.las"), lasOf(POINTS));
  await page.route(/groma-core.*\.wasm/, async (route) => {
    writeFileSync(file("other.las"), "something else");
    await route.continue();
  });
  await page.setInputFiles("#file", file("other.las"));
  await expect.poll(codes).toEqual(["SOURCE_CHANGED"]);
  expect(await page.textContent("#message")).toContain("Choose the file again");
  await page.unrouteAll();
});

it("a folder that is dropped is told as one, and the file beside it is opened", async () => {
  const session = await page.context().newCDPSession(page);
  mkdirSync(file("tiles"), { recursive: true });
  const data = { items: [], files: [file("tiles"), file("placed.copc.laz")], dragOperationsMask: 1 };
  for (const type of ["dragEnter", "dragOver", "drop"] as const)
    await session.send("Input.dispatchDragEvent", { type, x: 320, y: 240, data });
  await settle(page);
  expect(await names()).toEqual(["placed.copc.laz"]);
  expect(await page.textContent("#message")).toMatch(/PAGE_FOLDER.*tiles: this is a folder/);
  await page.click("#cloud-list [aria-label^=Remove]");
});

it("one that is given up meanwhile ends its worker, and leaves nothing", async () => {
  await listen("2 of 3");
  await page.setInputFiles("#file", file("scan.las"));
  await expect.poll(async () => (await told()).at(-1)).toContain("building the octree");
  await expect.poll(names).toEqual([]);
  await expect.poll(() => page.workers().filter((one) => /index/.test(one.url())).length).toBe(0);
  expect(await codes()).toEqual([]);
});

it("without a coordinate system it is asked for, and what was indexed is taken up again", async () => {
  await page.setInputFiles("#file", file("scan.las"));
  await expect.poll(codes).toEqual(["CRS_MISSING"]);
  await page.fill("#crs", "EPSG:32632");
  await listen();
  await page.setInputFiles("#file", file("scan.las"));
  await settle(page);
  expect((await told()).filter((words) => words.startsWith("Indexing"))).toEqual([]);
  expect(await page.evaluate(() => window.groma.layer.cloud.pointCount)).toBe(POINTS);
});

it("LAZ appears beside it, and the page tells how far it is", { timeout: 120_000 }, async () => {
  await listen();
  await page.setInputFiles("#file", file("scan.laz"));
  await page.waitForFunction(() => window.groma.layer?.cloud.name === "scan.laz");
  await settle(page);
  expect((await told()).filter((words) => words.startsWith("Indexing"))).toEqual([
    "Indexing scan.laz, 1 of 3: reading the points…",
    "Indexing scan.laz, 2 of 3: building the octree…",
    "Indexing scan.laz, 3 of 3: writing it…",
  ]);
  expect(await names()).toEqual(["scan.las", "scan.laz"]);
  expect(await page.evaluate(() => window.groma.layer.statistics.pointsDrawn)).toBeGreaterThan(1_000);
});

it("scans that others are compared with are indexed too, the last one that was chosen", {
  timeout: 120_000,
}, async () => {
  for (const input of ["#compare-file", "#profile-other"])
    expect(await page.getAttribute(input, "accept")).toBe(".laz,.las,.copc");
  writeFileSync(file("dropped.las"), lasOf(POINTS));
  // LAZ that names its coordinate system: the page asks for none here.
  const groma = join(projectRoot, "converter/dist/main.js");
  const part = ["clip", file("placed.copc.laz"), "--classes", "2", "--out", file("other.laz"), "--overwrite"];
  execFileSync(process.execPath, [groma, ...part], { stdio: "pipe" });
  const note = () => page.textContent("#compare-note");
  await page.locator("#crs").evaluate((field: HTMLInputElement) => {
    field.value = "";
  });
  await page.setInputFiles("#compare-file", file("dropped.las"));
  await page.setInputFiles("#compare-file", file("other.laz"));
  await expect.poll(note).toContain("other.laz is open");
  expect(await codes()).toEqual([]);
  await page.setInputFiles("#compare-file", file("dropped.las"));
  await expect.poll(codes).toEqual(["CRS_MISSING"]);
  expect(await note()).toBe("");
  // The system that is given for clouds is theirs too.
  await page.getByRole("button", { name: "Give it here" }).click();
  await page.keyboard.type("EPSG:32632");
  await page.setInputFiles("#compare-file", file("dropped.las"));
  await expect.poll(note).toContain("dropped.las is open");
});

it("its octree is that of the command, and can be saved", { timeout: 120_000 }, async () => {
  await page.click("#cloud-list li:first-child .name");
  await page.click("#about summary");
  await screenshot(page, "indexing");
  const download = page.waitForEvent("download");
  await page.click("text=Save as COPC…");
  const saved = await download;
  expect(saved.suggestedFilename()).toBe("scan.copc.laz");
  const bytes = readFileSync(await saved.path());
  expect(bytes.equals(readFileSync(file("scan.copc.laz")))).toBe(true);
  // The command writes its georeference before them, and nothing else.
  expect(chunksOf(bytes).equals(chunksOf(readFileSync(file("placed.copc.laz"))))).toBe(true);
  expect(watch.errors).toEqual([]);
});
