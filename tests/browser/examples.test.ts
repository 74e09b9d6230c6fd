import { createHash } from "node:crypto";
import { cpSync, existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createServer, type Server } from "node:http";
import { createRequire } from "node:module";
import type { AddressInfo } from "node:net";
import { dirname, join } from "node:path";
import type { Browser } from "playwright-core";
import send from "send";
import { afterAll, beforeAll, expect, it } from "vitest";
import webpack from "webpack";
import { convert } from "../converted.js";
import { lasOf } from "../faults/las-bytes.js";
import { projectRoot } from "../project.js";
import { openPage, screenshot, sharedBrowser } from "./harness.js";

const examples = join(projectRoot, "demo/examples");
const built = join(projectRoot, "tests/artifacts/examples");
const clouds = join(projectRoot, "tests/artifacts/examples-data");
const cesium = join(dirname(createRequire(import.meta.url).resolve("cesium/package.json")), "Build/Cesium");
/** The engine of the oldest Cesium that `@groma/layer` takes. */
const oldest = join(projectRoot, "node_modules/cesium-engine-oldest");

async function buildWithVite(): Promise<void> {
  const { build } = await import("vite");
  const configFile = join(examples, "vite.config.js");
  // Making it small takes most of the time and says nothing of whether it works.
  await build({ configFile, logLevel: "error", build: { outDir: built, emptyOutDir: true, minify: false } });
  await build({
    ...{ configFile: false, root: examples, base: "/oldest/", logLevel: "error" },
    ...{ worker: { format: "es" }, resolve: { alias: { cesium: oldest } } },
    plugins: [
      {
        name: "oldest-cesium",
        transform: (code, id) =>
          id.endsWith("vite/main.js") ? code.replace("/cesium/", "/cesium-oldest/") : undefined,
      },
    ],
    build: {
      ...{ outDir: join(built, "oldest"), target: "es2022" },
      minify: false,
      rolldownOptions: { input: join(examples, "vite/index.html") },
    },
  });
}

async function buildWithWebpack(): Promise<void> {
  const { default: config } = await import(join(examples, "webpack/webpack.config.mjs"));
  const path = join(built, "webpack");
  await new Promise<void>((resolve, reject) => {
    // Modules in one scope are what Vite makes of them above; with webpack that takes as long as all else.
    const optimization = { minimize: false, concatenateModules: false };
    const options = { ...config, output: { ...config.output, path }, optimization };
    webpack(options, (error, stats) => {
      if (error) reject(error);
      else if (stats!.hasErrors() || stats!.hasWarnings())
        reject(new Error(stats!.toString("errors-warnings")));
      else resolve();
    });
  });
  cpSync(join(examples, "webpack/index.html"), join(path, "index.html"));
}

/** The policy of `demo/examples/README.md`. */
const policy = /^Content-Security-Policy: (.*)$/m.exec(
  readFileSync(join(examples, "README.md"), "utf8"),
)![1]!;

/**
 * Serves what is built under the policy, workers too; a page has for an import map in it its hash. `?eval` lets Cesium's own
 * file run.
 */
function serve(): Promise<Server> {
  const folders = [
    ["/cesium/", cesium],
    ["/cesium-oldest/Assets/", join(oldest, "Source/Assets")],
    ["/cesium-oldest/Workers/", join(oldest, "Build/Workers")],
    ["/cesium-oldest/ThirdParty/", join(oldest, "Build/ThirdParty")],
    ["/node_modules/", join(projectRoot, "node_modules")],
    ["/groma/", join(projectRoot, "layer/dist")],
    ["/clouds/", clouds],
    ["/import-map/", join(examples, "import-map")],
    ["/", built],
  ] as const;
  const server = createServer((request, response) => {
    const { pathname, searchParams } = new URL(request.url ?? "/", "http://localhost");
    const [prefix, root] = folders.find(([start]) => pathname.startsWith(start))!;
    const path = pathname.slice(prefix.length - 1);
    response.setHeader("content-security-policy", policy);
    if (path.endsWith(".html")) {
      const page = readFileSync(join(root, path), "utf8");
      const map = /<script type="importmap">([\s\S]*?)<\/script>/.exec(page)?.[1];
      const hash = map ? `'self' 'sha256-${createHash("sha256").update(map).digest("base64")}'` : "'self'";
      const scripts = searchParams.has("eval") ? `${hash} 'unsafe-eval'` : hash;
      response.setHeader("content-security-policy", policy.replace("'self'", scripts));
    }
    send(request, path, { root }).pipe(response);
  });
  return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(server)));
}

let server: Server;
let browser: Browser;
const address = () => `http://127.0.0.1:${(server.address() as AddressInfo).port}`;

beforeAll(async () => {
  const cloud = join(clouds, "box.copc.laz");
  if (!existsSync(cloud)) {
    mkdirSync(clouds, { recursive: true });
    writeFileSync(join(clouds, "box.las"), lasOf(20_000));
    convert(join(clouds, "box.las"), cloud, ["--crs", "EPSG:32632", "--vertical", "ellipsoidal"]);
  }
  // As another program writes it: the records of Groma are nobody's.
  writeFileSync(
    join(clouds, "foreign.copc.laz"),
    Buffer.from(readFileSync(cloud, "latin1").replaceAll("groma\0", "other\0"), "latin1"),
  );
  await buildWithVite();
  await buildWithWebpack();
  [server, browser] = await Promise.all([serve(), sharedBrowser()]);
}, 480_000);

afterAll(async () => {
  await browser?.close();
  server?.close();
});

it.each([
  ["vite", "vite/index.html?"],
  ["the oldest Cesium", "oldest/vite/index.html?"],
  ["react", "react/index.html?"],
  ["vue", "vue/index.html?"],
  ["webpack", "webpack/index.html?"],
  ["import-map", "import-map/index.html?"],
  ["import-map-cesium", "import-map/globe.html?eval&"],
])("the example with %s draws under its policy", { timeout: 240_000 }, async (name, path) => {
  const { page, watch } = await openPage(browser, { width: 480, height: 360 });
  await page.goto(`${address()}/${path}cloud=/clouds/box.copc.laz`);
  const shown = page.locator("output", { hasText: /^[1-9]\d* points$/ });
  await shown.waitFor({ timeout: 200_000 }).catch(() => undefined);
  expect([watch.errors, watch.foreign]).toEqual([[], []]);
  expect(Number.parseInt(await shown.innerText(), 10)).toBeGreaterThan(1_000);
  await screenshot(page, `example-${name.replaceAll(" ", "-")}`);
  await page.context().close();
});

it.each([
  ["vite", "vite/index.html?"],
  ["webpack", "webpack/index.html?"],
  ["import-map", "import-map/index.html?"],
])(
  "the example with %s draws a file of another writer, by projections that are fetched then",
  {
    timeout: 240_000,
  },
  async (_, path) => {
    const { page, watch } = await openPage(browser, { width: 480, height: 360 });
    const shown = page.locator("output", { hasText: /^[1-9]\d* points$/ });
    await page.goto(`${address()}/${path}cloud=/clouds/foreign.copc.laz`);
    await shown.waitFor({ timeout: 200_000 }).catch(() => undefined);
    expect([watch.errors, watch.foreign]).toEqual([[], []]);
    expect(Number.parseInt(await shown.innerText(), 10)).toBeGreaterThan(1_000);
    await page.context().close();
  },
);

it("the policy forbids code from text (negative control)", { timeout: 60_000 }, async () => {
  const { page } = await openPage(browser, { width: 480, height: 360 });
  const refused = page.waitForEvent("pageerror");
  await page.goto(`${address()}/import-map/globe.html?cloud=/clouds/box.copc.laz`);
  expect((await refused).name).toBe("EvalError");
  await page.context().close();
});
