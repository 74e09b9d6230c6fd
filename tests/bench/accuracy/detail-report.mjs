import { measureBudgets, measureWidths } from "./detail.mjs";
import { pointsInSight } from "./rendering.mjs";
import { detailChart } from "./rendering-chart.mjs";
import { percent, points } from "./rendering-figures.mjs";
import { comparison, onScan } from "./scan-report.mjs";
import { digits, markdownTable } from "./table.mjs";

const TITLE = "Level of detail: error against time";

/** What density costs: point budgets, screen-space errors, and widths of points that close what lies between them. */
export function detailReport(root) {
  return onScan(root, "detail", async (_, openPage) => {
    const { page, setting } = await openPage();
    const inSight = await pointsInSight(page);
    const widths = await measureWidths(page);
    const sweeps = (await measureBudgets(page)).map(({ ratio, ...row }) => ({ ...row, time: ratio }));
    return reportOf(widths, sweeps, inSight, setting);
  });
}

/**
 * @param {object[]} widths
 * @param {object[]} sweeps budgets and screen-space errors
 * @param {number} inSight points of the scan that are in sight
 * @param {string} packages what it was measured with
 */
export function reportOf(widths, sweeps, inSight, packages) {
  const part = (name) => sweeps.filter((row) => row.part === name);
  const parts = { widths, budget: part("budget"), spacing: part("spacing") };
  return {
    title: TITLE,
    text: describe(parts, inSight),
    svg: detailChart(parts, TITLE),
    table: tables(parts),
    packages,
    rows: [...widths, ...sweeps],
  };
}

function describe({ budget }, inSight) {
  const low = budget.find((row) => row.budget === 100_000);
  const all = budget.find((row) => row.budget === "none");
  return (
    `${comparison(inSight)} What effects and storage cost is [another report](rendering.md).\n\n` +
    "**Widths** are multiples of the spacing (`spacingFactor`), at the default screen-space error. Holes are the share of " +
    "the pixels inside the outline of full density that show the background, overdraw the fragments per pixel in it. A " +
    "radius of one spacing, factor 2, leaves nothing of a maximal Poisson-disc sample of a surface open.\n\n" +
    "**The budget** is swept without any other limit, the screen-space error without a budget; the default, points of 2 px, " +
    `is 1 on the axis of time. With fixed sizes a tenth of the default budget takes ${low.time.toFixed(2)} × the time at a difference of ` +
    `${low.onRms.toFixed(1)} steps, all points ${all.time.toFixed(2)} × at ${all.onRms.toFixed(1)}: what remains ` +
    "there is that a pixel has one sample, and points 2 px wide."
  );
}

function tables({ widths, budget, spacing }) {
  const named = (row, name) => (row.chosen ? `**${name}**` : name);
  const sweep = (row, name, value) => ({
    look: row.look,
    [name]: named(row, value),
    points: points(row.onPoints),
    "ms/frame": digits(row.onMs),
    "× default": row.time.toFixed(2),
    "RMS to full density": row.onRms.toFixed(1),
    "pixels off": percent(row.onWrongPixels),
  });
  return [
    "## Widths",
    markdownTable(widths.map(widthRow)),
    "## Point budget",
    markdownTable(
      budget.map((row) =>
        sweep(row, "budget", row.budget === "none" ? "–" : row.budget.toLocaleString("en")),
      ),
    ),
    "## Screen-space error",
    markdownTable(spacing.map((row) => sweep(row, "px", String(row.pixels)))),
  ].join("\n\n");
}

function widthRow({ look, factor, chosen, holes, overdraw, onRms, onWrongPixels }) {
  const value = factor === undefined ? "–" : String(factor);
  return {
    look,
    factor: chosen ? `**${value}**` : value,
    holes: `${(100 * holes).toFixed(2)} %`,
    overdraw: overdraw.toFixed(1),
    "RMS to full density": onRms.toFixed(1),
    "pixels off": percent(onWrongPixels),
  };
}
