import { createServer } from "node:http";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import send from "send";
import { build, runnerImport } from "vite";

/** Address of the scan on the page's server. */
export const SCAN = "/scan.copc.laz";

/**
 * The page of the report on drawing, in headless Chromium that draws with WebGL in software.
 *
 * @param {string} file COPC
 * @param {string} folder for what is built
 * @param {object} pose from where it is looked at
 * @param {number} cacheBytes bytes of vertices that the page may keep
 */
export async function openScene(root, file, folder, pose, cacheBytes) {
  const source = join(root, "tests/bench/accuracy/rendering");
  const scene = await openScanPage(root, source, file, folder);
  try {
    await tellProcessorTime(scene.page);
    const renderer = await scene.page.evaluate(
      async ([address, pose, cacheBytes]) => {
        window.bench = await window.Bench.open(address, pose, cacheBytes);
        return window.bench.renderer;
      },
      [SCAN, pose, cacheBytes],
    );
    return { ...scene, setting: `${scene.setting}, ${renderer}` };
  } catch (thrown) {
    await scene.close();
    throw thrown;
  }
}

/**
 * A page of a bench in headless Chromium, from a server that has a scan as {@link SCAN} besides.
 *
 * @param {string} source folder of the page
 * @param {string} file COPC
 * @param {string} folder for what is built
 * @param {"software" | "card"} [graphics] what draws
 */
export async function openScanPage(root, source, file, folder, graphics = "software") {
  await buildPage(source, join(folder, "page"));
  const server = await serve(root, folder, file);
  const { launch, openPage } = await harness(root);
  const browser = await launch(graphics);
  const close = async () => {
    await browser.close();
    server.close();
  };
  try {
    const { page, watch } = await openPage(browser, { width: 1300, height: 1250 });
    page.setDefaultTimeout(0);
    await page.goto(`http://127.0.0.1:${server.address().port}/index.html`);
    await page.waitForSelector("body[data-ready]", { state: "attached", timeout: 60_000 });
    return { page, setting: `Cesium ${cesium(root).version}, Chromium ${browser.version()}`, watch, close };
  } catch (thrown) {
    await close();
    throw thrown;
  }
}

/**
 * Has a page know `processorTime()`: milliseconds of the processor that all threads of all processes of its browser have taken, in
 * steps of 10 ms.
 */
export async function tellProcessorTime(page) {
  const session = await page.context().browser().newBrowserCDPSession();
  await page.exposeFunction("processorTime", async () => {
    const { processInfo } = await session.send("SystemInfo.getProcessInfo");
    return processInfo.reduce((sum, { cpuTime }) => sum + 1000 * cpuTime, 0);
  });
}

/** Its launch of Chromium is that of the tests. */
export async function harness(root) {
  const options = { root, configFile: false, logLevel: "error" };
  return (await runnerImport(join(root, "tests/browser/harness.ts"), options)).module;
}

export function cesium(root) {
  const manifest = createRequire(join(root, "layer/package.json")).resolve("cesium/package.json");
  return {
    folder: join(dirname(manifest), "Build/Cesium"),
    version: createRequire(manifest)(manifest).version,
  };
}

/**
 * Builds the pages of a folder.
 *
 * @param {{ minify?: boolean, input?: string[] }} [how] input: the pages, where they are not `index.html`
 */
export function buildPage(source, outDir, { minify = false, input } = {}) {
  return build({
    root: source,
    base: "./",
    logLevel: "error",
    configFile: false,
    worker: { format: "es" },
    build: {
      ...{ outDir, minify, target: "es2022" },
      // Cesium is served as it was built by its makers.
      rollupOptions: { external: ["cesium"], ...(input && { input }) },
    },
  });
}

function serve(root, folder, file) {
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url ?? "/", "http://localhost");
    // A page that shares nothing with others has a clock of 5 µs, others one of 100 µs.
    response.setHeader("Cross-Origin-Opener-Policy", "same-origin");
    response.setHeader("Cross-Origin-Embedder-Policy", "require-corp");
    if (pathname === SCAN) return send(request, file).pipe(response);
    const ofCesium = pathname.startsWith("/cesium/");
    const from = ofCesium ? cesium(root).folder : join(folder, "page");
    send(request, pathname.slice(ofCesium ? "/cesium".length : 0), { root: from }).pipe(response);
  });
  return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(server)));
}
