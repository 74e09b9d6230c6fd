import { random } from "../cartesian/points.fixture.js";
import { type ChoiceStep, fitPatchwork, type GridWindow, type Step, WGS84 } from "../index.js";
import { samplerOf } from "../transformation/sampler.fixture.js";

const DEGREE = Math.PI / 180;

/**
 * 1' × 1' cells around 46° north, 9° east, of chance values up to an amplitude: by column and by row, and a tenth of it
 * by node, so that lines have folds that change little along them, as those of real grids.
 */
export function chanceWindow(channels: number, amplitude: number, unit: number, seed: number): GridWindow {
  const next = random(seed);
  const [columns, rows] = [14, 14];
  const chance = (count: number) => Array.from({ length: count }, () => amplitude * (2 * next() - 1));
  const values = Array.from({ length: channels }, () => {
    const [byColumn, byRow] = [chance(columns), chance(rows)];
    return chance(columns * rows).map(
      (value, i) => byColumn[i % columns] + byRow[Math.floor(i / columns)] + value / 10,
    );
  });
  return {
    ...{ grid: "chance", columns, rows, channels, unit },
    ...{ west: 8.9 * DEGREE, south: 45.9 * DEGREE },
    ...{ stepLongitude: DEGREE / 60, stepLatitude: DEGREE / 60 },
    values: Float32Array.from(values.flat()),
  };
}

/** What such windows cover, UTM zone 32. */
export const AREA = { minX: 494e3, minY: 5085e3, maxX: 504e3, maxY: 5096e3 };
export const patchwork = await fitPatchwork(samplerOf("+proj=utm +zone=32 +ellps=WGS84"), AREA);

/**
 * From UTM to ECEF over chance grids.
 * @param roughness metres that neighbouring nodes of a grid differ by
 * @param shift direction of the grid of shifts; undefined: there is none
 * @param heights whether there is a grid of heights
 */
export function chanceSteps(
  roughness: number,
  seed: number,
  { shift, heights }: { readonly shift?: "forward" | "inverse" | undefined; readonly heights: boolean },
): Exclude<Step, ChoiceStep>[] {
  return [
    { kind: "projection", patchwork },
    ...(shift
      ? [
          {
            kind: "horizontalShift",
            direction: shift,
            window: chanceWindow(2, 1, roughness / 6.4e6, seed),
          } as const,
        ]
      : []),
    ...(heights
      ? [{ kind: "verticalShift", multiplier: 1, window: chanceWindow(1, roughness, 1, seed + 1) } as const]
      : []),
    { kind: "geocentric", ellipsoid: WGS84 },
  ];
}
