import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterAll, beforeAll, expect, it } from "vitest";
import { projectRoot } from "../project.js";
import { cloudPath, openStage, type StagePage } from "./stage.js";

const room = join(projectRoot, "tests/artifacts/readme");
const ADDRESS = "https://example.org/site.copc.laz";

/** The first TypeScript example of the README, as it stands. */
const example = /^```ts\n([\s\S]*?)^```$/m.exec(readFileSync(join(projectRoot, "README.md"), "utf8"))![1]!;

/** Builds a page that runs the example, and afterwards gives away what it made. */
async function buildPage(): Promise<string> {
  const built = join(projectRoot, "tests/artifacts/stage/readme");
  mkdirSync(room, { recursive: true });
  // `windowPosition` is where the user clicked; the picture is drawn before the example's pick is answered.
  writeFileSync(
    join(room, "example.ts"),
    `import { Cartesian2 } from "cesium";
const windowPosition = new Cartesian2(320, 240);
${example}
Object.assign(window, { example: { viewer, layer, hit } });
`,
  );
  writeFileSync(
    join(room, "index.html"),
    `<!doctype html>
<script>window.CESIUM_BASE_URL = "/cesium/";</script>
<script type="importmap">{ "imports": { "cesium": "/cesium/index.js" } }</script>
<div id="globe" style="width: 640px; height: 480px"></div>
<script type="module" src="./example.ts"></script>
`,
  );
  const { build } = await import("vite");
  await build({
    root: room,
    base: "./",
    logLevel: "error",
    configFile: false,
    worker: { format: "es" },
    build: { outDir: built, emptyOutDir: true, target: "es2022", rollupOptions: { external: ["cesium"] } },
  });
  return "readme/index.html";
}

let stage: StagePage;

beforeAll(async () => {
  stage = await openStage();
}, 240_000);

afterAll(() => stage?.close());

it("the README's example draws points and asks nobody but the server of the file", {
  timeout: 120_000,
}, async () => {
  const path = await buildPage();
  const { page, watch } = stage;
  const bytes = readFileSync(cloudPath("cliff"));
  await page.route(ADDRESS, (route) => {
    const range = /^bytes=(\d+)-(\d+)$/.exec(route.request().headers().range ?? "");
    const headers = { "access-control-allow-origin": "*", "access-control-expose-headers": "*" };
    if (!range)
      return route.fulfill({ status: 204, headers: { ...headers, "access-control-allow-headers": "*" } });
    const [first, last] = [Number(range[1]), Math.min(Number(range[2]), bytes.length - 1)];
    return route.fulfill({
      status: 206,
      headers: { ...headers, "content-range": `bytes ${first}-${last}/${bytes.length}` },
      body: bytes.subarray(first, last + 1),
    });
  });
  await page.goto(new URL(path, page.url()).href);
  await page.waitForFunction(
    () => {
      const { layer } =
        (
          window as unknown as {
            example?: { layer: { settled: boolean; statistics: { pointsDrawn: number } } };
          }
        ).example ?? {};
      // Before it flies there, the camera sees the scan as a point, and is shown that.
      return layer?.settled && layer.statistics.pointsDrawn > 1_000;
    },
    undefined,
    { timeout: 100_000 },
  );
  expect([...new Set(watch.foreign)]).toEqual([ADDRESS]);
  expect(watch.errors).toEqual([]);
  await page.screenshot({ path: join(projectRoot, "tests/artifacts/readme.png") });
});
