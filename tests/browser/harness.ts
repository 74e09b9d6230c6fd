import { type ChildProcess, spawn } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { type Browser, chromium, type Page } from "playwright-core";
import { PNG } from "pngjs";
import { projectRoot } from "../project.js";
import type {} from "./globe.js";

const groma = join(projectRoot, "converter/dist/main.js");
const artifacts = join(projectRoot, "tests/artifacts");

/** A running `groma view`: its address, and how to end it. */
export interface View {
  readonly address: string;
  stop(): Promise<void>;
}

/**
 * Runs the public command `groma view FILE` (which converts the file if need be) until it prints its address.
 *
 * @throws Error with what the command printed, when it ends without an address
 */
export function view(file: string, options: readonly string[] = []): Promise<View> {
  const child = spawn(
    process.execPath,
    [groma, "view", file, "--port", "0", "--progress", "plain", ...options],
    {
      stdio: ["ignore", "pipe", "pipe"],
    },
  );
  let output = "";
  return new Promise((resolve, reject) => {
    const onData = (chunk: Buffer) => {
      output += chunk.toString();
      const address = /http:\/\/\S+/.exec(output)?.[0];
      if (address) resolve({ address, stop: () => stop(child) });
    };
    child.stdout.on("data", onData);
    child.stderr.on("data", onData);
    child.on("close", (code) => reject(new Error(`groma view ended with ${code}:\n${output}`)));
  });
}

function stop(child: ChildProcess): Promise<void> {
  return new Promise((resolve) => {
    if (child.exitCode !== null) return resolve();
    child.on("close", () => resolve());
    child.kill("SIGTERM");
  });
}

/** What WebGL 2 is drawn by: the processor, or a graphics card through Vulkan. */
export type Graphics = "software" | "card";

const GRAPHICS: Readonly<Record<Graphics, readonly string[]>> = {
  software: [
    ...["--use-angle=swiftshader", "--use-gl=angle", "--enable-unsafe-swiftshader"],
    // A program that is linked becomes code of the processor where something is drawn with it, not before.
    "--disable-angle-features=warmUpPipelineCacheAtLink",
  ],
  card: ["--use-angle=vulkan", "--use-gl=angle", "--enable-features=Vulkan", "--enable-gpu"],
};

/** System Chromium with WebGL 2, kept from calling anyone. */
export function launch(graphics: Graphics = "software"): Promise<Browser> {
  return chromium.launch({
    executablePath: process.env.GROMA_CHROMIUM ?? "/usr/bin/chromium",
    args: [
      "--no-sandbox",
      ...GRAPHICS[graphics],
      "--ignore-gpu-blocklist",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
      "--disable-quic",
      "--no-first-run",
    ],
  });
}

let running: Browser | undefined;

/**
 * One Chromium for all files of tests of a process, which share their modules and run one after the other. Its `close` closes the pages
 * and leaves the browser to the next file; it ends with the process.
 */
export async function sharedBrowser(): Promise<Browser> {
  if (!running?.isConnected()) {
    const browser = await launch();
    browser.close = async () => {
      await Promise.all(browser.contexts().map((context) => context.close()));
    };
    running = browser;
  }
  return running;
}

/** What a page did that a test must know of. */
export interface Watch {
  /** Console errors and uncaught exceptions. */
  readonly errors: string[];
  /** Requests to any host but this machine. */
  readonly foreign: string[];
}

/**
 * Leaves out sky and air, which a card draws at once, and a processor in half of the time of a frame: 65,000 vertices with a
 * ray through the air each, and one for each pixel of the ground.
 * @param scale pixels of the globe for one of the screen, along each side
 */
function drawPlainly(scale: number): void {
  let opened: Window["groma"] | undefined;
  Object.defineProperty(window, "groma", {
    get: () => opened,
    set: (groma: Window["groma"]) => {
      opened = groma;
      const { scene } = groma.viewer;
      groma.viewer.resolutionScale = scale;
      for (const part of [scene.skyAtmosphere, scene.skyBox, scene.sun, scene.moon])
        if (part) part.show = false;
      scene.globe.showGroundAtmosphere = false;
      scene.fog.enabled = false;
    },
  });
}

/** How the page of Groma draws its globe: as readers see it, without sky and air, or so with a quarter of the pixels. */
type Globe = "whole" | "plain" | "coarse";

/** A page of the size given, watched for errors and for requests that leave the machine. */
export async function openPage(
  browser: Browser,
  size: { width: number; height: number },
  globe: Globe = "plain",
): Promise<{ page: Page; watch: Watch }> {
  const context = await browser.newContext({ viewport: size, deviceScaleFactor: 1 });
  const page = await context.newPage();
  // On a busy machine a page takes many times as long as on a quiet one.
  page.setDefaultTimeout(120_000);
  if (globe !== "whole") await page.addInitScript(drawPlainly, globe === "coarse" ? 0.5 : 1);
  const watch: Watch = { errors: [], foreign: [] };
  page.on("console", (message) => {
    if (message.type() === "error") watch.errors.push(message.text());
  });
  page.on("pageerror", (error) => watch.errors.push(String(error)));
  page.on("request", (request) => {
    const { protocol, hostname } = new URL(request.url());
    const local = ["localhost", "127.0.0.1", "[::1]"].includes(hostname);
    if (/^(http|ws)s?:$/.test(protocol) && !local) watch.foreign.push(request.url());
  });
  return { page, watch };
}

/** Takes a screenshot, keeps it as `tests/artifacts/NAME.png` and returns its pixels. */
export async function screenshot(page: Page, name: string): Promise<PNG> {
  const bytes = await page.screenshot({ timeout: 120_000 });
  mkdirSync(artifacts, { recursive: true });
  writeFileSync(join(artifacts, `${name}.png`), bytes);
  return PNG.sync.read(bytes);
}

/** Mean RGB (0..255) of the square of `2 · reach + 1` pixels around (x, y). */
export function meanColour(image: PNG, x: number, y: number, reach: number): [number, number, number] {
  const sum: [number, number, number] = [0, 0, 0];
  let count = 0;
  for (let row = Math.round(y) - reach; row <= Math.round(y) + reach; row++) {
    for (let column = Math.round(x) - reach; column <= Math.round(x) + reach; column++) {
      if (row < 0 || column < 0 || row >= image.height || column >= image.width) continue;
      const at = 4 * (row * image.width + column);
      sum[0] += image.data[at]!;
      sum[1] += image.data[at + 1]!;
      sum[2] += image.data[at + 2]!;
      count++;
    }
  }
  return [sum[0] / count, sum[1] / count, sum[2] / count];
}

/** Largest difference of two colours in one channel, 0..255. */
export function colourDifference(a: ArrayLike<number>, b: ArrayLike<number>): number {
  return Math.max(...[0, 1, 2].map((channel) => Math.abs(a[channel]! - b[channel]!)));
}
