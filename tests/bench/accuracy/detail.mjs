import { ADAPTIVE, compare, row } from "./rendering.mjs";

/** Frames of each look that are timed, in turn with those of the default. */
const FRAMES = 3;

/** The default size. */
const FIXED = {};

/** Default point budget and screen-space error. */
const BUDGET = 1_000_000;
const SPACING = 2;
const BUDGETS = [50_000, 100_000, 200_000, 500_000, BUDGET, 2_000_000, Number.POSITIVE_INFINITY];
const SPACINGS = [32, 16, 8, 4, SPACING, 1];

/** Spacing on the screen that no node falls short of. */
const NO_LIMIT = 1e-6;

/** Budgets without any other limit, and screen-space errors without any budget, all against the default. */
export async function measureBudgets(page) {
  const rows = [];
  for (const [look, base] of [
    ["fixed size, 2 px", FIXED],
    ["adaptive size", ADAPTIVE],
  ]) {
    const isDefault = base === FIXED;
    for (const pointBudget of BUDGETS) {
      const maximumScreenSpaceError = NO_LIMIT;
      const looks = {
        off: { maximumScreenSpaceError, pointBudget: BUDGET },
        on: { ...base, maximumScreenSpaceError, pointBudget },
      };
      const found = await compare(page, looks, { off: {}, on: {} }, FRAMES);
      const limit = { budget: pointBudget === Number.POSITIVE_INFINITY ? "none" : pointBudget };
      rows.push({
        part: "budget",
        look,
        ...limit,
        chosen: isDefault && pointBudget === BUDGET,
        ...row(found),
      });
      console.log(`  ${look}, budget ${pointBudget}`);
    }
    for (const pixels of SPACINGS) {
      const pointBudget = Number.POSITIVE_INFINITY;
      const looks = {
        off: { maximumScreenSpaceError: SPACING, pointBudget },
        on: { ...base, maximumScreenSpaceError: pixels, pointBudget },
      };
      const found = await compare(page, looks, { off: {}, on: {} }, FRAMES);
      rows.push({ part: "spacing", look, pixels, chosen: isDefault && pixels === SPACING, ...row(found) });
      console.log(`  ${look}, screen-space error ${pixels}`);
    }
  }
  return rows;
}

/** Widths in spacings, and the default. */
const FACTORS = [1, 1.25, 1.5, 1.75, 2, 2.5];
const FACTOR = 2;

/** What widths leave open and draw twice, at the default screen-space error. */
export async function measureWidths(page) {
  const looks = [
    { look: "fixed size, 2 px", factor: undefined, style: {} },
    ...["attenuated", "adaptive"].flatMap((size) =>
      FACTORS.map((factor) => ({ look: `${size} size`, factor, style: { size, spacingFactor: factor } })),
    ),
  ];
  const rows = [];
  for (const { look, factor, style } of looks) {
    const { holes, overdraw, rms, changed } = await page.evaluate((look) => window.bench.coverage(look), {
      style,
    });
    const chosen = factor === FACTOR;
    rows.push({ part: "widths", look, factor, chosen, holes, overdraw, onRms: rms, onWrongPixels: changed });
  }
  console.log("  widths");
  return rows;
}
