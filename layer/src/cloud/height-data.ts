import { decodeEgm96, type Grid, GromaError, type VerticalSystem } from "@groma/georef";
import { SourceError } from "../errors/index.js";

/** What it takes to place heights above a geoid where no conversion has settled them. Large, so fetched when needed. */
export interface HeightData {
  /** The vertical systems of EPSG. */
  systems(): Promise<readonly VerticalSystem[]>;
  /** The geoid model EGM96. */
  egm96(): Promise<Grid>;
}

const SYSTEMS = new URL("./vertical-systems.json", import.meta.url);
const GEOID = new URL("./egm96.bin", import.meta.url);

/** One load for all who ask; after a failure the next one tries again. */
function once<T>(load: () => Promise<T>): () => Promise<T> {
  let loading: Promise<T> | undefined;
  return () => {
    loading ??= load().catch((thrown: unknown) => {
      loading = undefined;
      throw thrown;
    });
    return loading;
  };
}

/** The files that lie beside this library: 37 kB of systems, 1.1 MB of geoid. */
export const packagedHeights: HeightData = {
  systems: once(() => fetched(SYSTEMS, (response) => response.json())),
  egm96: once(() =>
    fetched(GEOID, async (response) => decodeEgm96(new Uint8Array(await response.arrayBuffer()), GEOID.href)),
  ),
};

/** @throws SourceError SOURCE_HEIGHTS */
async function fetched<T>(address: URL, read: (response: Response) => Promise<T>): Promise<T> {
  let cause: string;
  try {
    const response = await fetch(address);
    if (response.ok) return await read(response);
    cause = `the server answered ${response.status}`;
  } catch (thrown) {
    cause = thrown instanceof GromaError ? thrown.cause : String(thrown);
  }
  throw new SourceError({
    code: "SOURCE_HEIGHTS",
    file: address.href,
    cause: `the data of height systems cannot be had: ${cause}`,
    fix: "put the files of @groma/layer/dist/cloud beside the code, as bundlers do that follow new URL(…, import.meta.url)",
  });
}
