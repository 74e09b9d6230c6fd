import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import type { Measurement } from "@groma/layer/tools";
import type { AxeResults } from "axe-core";
import type { Browser, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, expect, it } from "vitest";
import { messages as german } from "../../demo/src/language/catalogues/de.po";
import { messages as spanish } from "../../demo/src/language/catalogues/es.po";
import { messages as french } from "../../demo/src/language/catalogues/fr.po";
import { messages as japanese } from "../../demo/src/language/catalogues/ja.po";
import { LANGUAGES } from "../../demo/src/language/languages.js";
import { lasOf } from "../faults/las-bytes.js";
import { projectRoot } from "../project.js";
import "./globe.js";
import { screenshot, sharedBrowser, type View, view } from "./harness.js";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const CATALOGUES = { de: german, es: spanish, fr: french, ja: japanese } as const;
/** Words that no other language of the page has. */
const ENGLISH =
  /(?<![\p{L}-])(the|of|and|or|with|from|this|are|is|not|by|unknown|heights?|click|share)(?![\p{L}-])/iu;

/** What one English word says, "Share", is another word where it means to pass on than where it is a part of a whole. */
const TO_SHARE = { de: "Teilen", es: "Compartir", fr: "Partager", ja: "共有" } as const;

/** A line in the coordinates of the cloud that is opened. */
const LINE =
  "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\n7\n90\n3\n70\n0\n10\n200\n20\n500\n10\n500\n20\n600\n10\n800\n20\n500\n0\nENDSEC\n0\nEOF\n";

let browser: Browser;
let server: View;
let line: string;

beforeAll(async () => {
  const folder = join(projectRoot, "tests/artifacts/languages");
  mkdirSync(folder, { recursive: true });
  const scan = join(folder, "7.las");
  writeFileSync(scan, lasOf(5000));
  line = join(folder, "7.dxf");
  writeFileSync(line, LINE);
  server = await view(scan, ["--crs", "EPSG:32632", "--vertical", "ellipsoidal"]);
  browser = await sharedBrowser();
}, 180_000);

afterEach(async () => {
  await Promise.all(browser.contexts().map((context) => context.close()));
});

afterAll(async () => {
  await browser?.close();
  await server?.stop();
});

/** The page as a reader of a language has it on a phone, with all that it has to say: map, profile, measurements, keys. */
async function open(locale: string): Promise<Page> {
  const context = await browser.newContext({
    ...{ locale, viewport: { width: 320, height: 480 }, reducedMotion: "reduce" },
  });
  const page = await context.newPage();
  page.setDefaultTimeout(60_000);
  // A map takes as long as the globe: it is looked at once.
  await page.goto(`${server.address}&fly=0&budget=2000${locale === "de" ? "&map=1" : ""}`);
  await page.waitForFunction(() => window.groma?.layer);
  if (locale === "de") await page.waitForSelector("#map .ol-zoom");
  // Nobody looks at the picture, which a processor takes long for.
  await page.evaluate(() => {
    window.groma.viewer.useDefaultRenderLoop = false;
  });
  await page.evaluate(() => {
    document.querySelector<HTMLElement>("#fold")!.click();
    for (const part of Array.from(document.querySelectorAll("details"))) part.open = true;
    document.querySelector<HTMLElement>("#keys-open")!.click();
    document.querySelector<HTMLDialogElement>("#keys")!.close();
  });
  await page.setInputFiles("#profile-file", line);
  await page.waitForFunction(() => window.groma.profile.shown > 0);
  await page.check("#profile-table-shown");
  await page.evaluate(() => {
    const { measure, profile } = window.groma as unknown as {
      measure: { add(added: readonly unknown[]): void };
      profile: { lines: { chosen: Pick<Measurement, "vertices"> } };
    };
    const { vertices } = profile.lines.chosen;
    const kinds = {
      point: 1,
      distance: 2,
      height: 2,
      polyline: 3,
      area: 3,
      angle: 3,
      circle: 3,
      plane: 3,
      volume: 3,
    };
    measure.add(
      Object.entries(kinds).map(([kind, count]) => ({
        ...{ id: kind, kind, name: "7", vertices: vertices.slice(0, count) },
      })),
    );
  });
  await page.waitForSelector("#profile-table tbody tr");
  // An error of a library: English, below a sentence that is not.
  await page.evaluate(() => {
    document.querySelector<HTMLInputElement>("#address")!.value = "none.copc.laz";
    document.querySelector<HTMLFormElement>("#by-address")!.requestSubmit();
  });
  await page.waitForSelector("#message .told + [lang=en]");
  return page;
}

/** All that the page says: texts, and what is read out or shown in passing; but for names, and what says that it is English. */
function said(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    const elements = Array.from(document.querySelectorAll("body *:not(script, style)"));
    return elements
      .filter((element) => !element.closest('[translate="no"], [lang="en"]'))
      .flatMap((element) => [
        ...["aria-label", "title", "placeholder", "alt"].map((name) => element.getAttribute(name) ?? ""),
        ...Array.from(element.childNodes, (node) => (node.nodeType === 3 ? (node.nodeValue ?? "") : "")),
      ])
      .map((text) => text.trim().replace(/\s+/g, " "))
      .filter((text) => /\p{L}{2}/u.test(text));
  });
}

/** What axe finds of names and languages, which are other ones in each language. */
async function violations(page: Page): Promise<string[]> {
  await page.evaluate(axe);
  return page.evaluate(async () => {
    const { axe } = globalThis as unknown as {
      axe: { run(page: Document, how: object): Promise<AxeResults> };
    };
    const values = ["cat.language", "cat.name-role-value", "cat.forms", "cat.text-alternatives", "cat.aria"];
    const { violations } = await axe.run(document, {
      runOnly: { type: "tag", values },
      resultTypes: ["violations"],
    });
    return violations.map(
      ({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(" ")).join(", ")}`,
    );
  });
}

/** Choices and fields that are seen and have less room than the longest of their words needs. */
function cut(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    const seen = <E extends HTMLElement>(selector: string) =>
      Array.from(document.querySelectorAll<E>(selector)).filter(
        (one) => one.getBoundingClientRect().width > 0,
      );
    const pen = document.createElement("canvas").getContext("2d")!;
    const fields = seen<HTMLInputElement>("input[placeholder]").filter((field) => {
      const { font, paddingLeft, paddingRight } = getComputedStyle(field);
      pen.font = font;
      const room = field.clientWidth - Number.parseFloat(paddingLeft) - Number.parseFloat(paddingRight);
      return pen.measureText(field.placeholder).width > room + 1;
    });
    const choices = seen<HTMLSelectElement>("select").filter((choice) => {
      const { minWidth, maxWidth, width, flex } = choice.style;
      const room = choice.offsetWidth;
      Object.assign(choice.style, { minWidth: "0", maxWidth: "none", width: "max-content", flex: "none" });
      const wanted = choice.offsetWidth;
      Object.assign(choice.style, { minWidth, maxWidth, width, flex });
      return wanted > room + 1;
    });
    return [...fields, ...choices].map(({ id }) => id);
  });
}

/** Elements that stand out of the window, or whose words do not fit into them. */
function overflowing(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    const parts = document.querySelectorAll<HTMLElement>(
      "#panel *, #profile button, #profile label, #keys *",
    );
    return Array.from(parts)
      .filter((element) => {
        const { left, right, width } = element.getBoundingClientRect();
        const spills =
          element.matches("button, summary, th, td, dt, dd, p") &&
          element.scrollWidth > element.clientWidth + 1;
        return (
          width > 0 &&
          (left < -1 || right > innerWidth + 1 || (spills && getComputedStyle(element).display !== "inline"))
        );
      })
      .map((element) => `${element.tagName} ${element.id} ${element.textContent?.slice(0, 60)}`);
  });
}

it.each(Object.keys(CATALOGUES) as (keyof typeof CATALOGUES)[])(
  "speaks %s, fits a phone, and cuts no words",
  { timeout: 120_000 },
  async (code) => {
    const page = await open(code);
    expect(await page.getAttribute("html", "lang")).toBe(code);
    expect(await page.textContent("#share h2")).toBe(TO_SHARE[code]);
    const translated = CATALOGUES[code] as Readonly<Record<string, unknown>>;
    const texts = await said(page);
    expect(texts.length).toBeGreaterThan(300);
    // What one word says in English another one may say in this language: "Profile" are several in German.
    const known = new Set(Object.values(translated).map(String));
    const english = texts.filter((text) => ENGLISH.test(text) || (text in translated && !known.has(text)));
    expect([...new Set(english)]).toEqual([]);
    expect(await violations(page)).toEqual([]);
    expect(await overflowing(page)).toEqual([]);
    expect(await cut(page)).toEqual([]);
    await screenshot(page, `languages-${code}`);
    await page.setViewportSize({ width: 1280, height: 800 });
    expect(await overflowing(page)).toEqual([]);
    expect(await cut(page)).toEqual([]);
  },
);

it("knows all languages there are", () => {
  expect(
    LANGUAGES.map(({ code }) => code)
      .filter((code) => code !== "en")
      .sort(),
  ).toEqual(Object.keys(CATALOGUES).sort());
});
