import { PlacementError } from "@groma/georef";
import type { PointCloud } from "@groma/layer/cesium";
import { Pace } from "@groma/layer/query";
import {
  type Alignment,
  inUnit,
  readDxfLine,
  readLandXml,
  readMeasurements,
  type StationEquation,
  sourceLine,
  sourceVertex,
  type Vertex,
} from "@groma/layer/tools";

/** A line of a file, as it lies in a cloud. */
export interface FileLine {
  readonly name: string;
  readonly vertices: readonly Vertex[];
  /** Chainage at its start, metres. */
  readonly start: number;
  /** Where stations are counted anew, by the distance from the start, metres. */
  readonly equations: readonly StationEquation[];
}

type Places = readonly (readonly [number, number])[];

/** Distance of the chords that stand for arcs from them, metres: fine for the eye, and few enough to be dragged. */
const TOLERANCE = 0.01;

/** Each leaves some millionths of the distance. */
const ROUNDS = 2;

/**
 * Reads the lines of a file: GeoJSON in longitude and latitude; DXF (its polyline) and LandXML (its alignment) in the cloud's own
 * coordinates. Vertices stand at the height of the recorded point that is nearest in the coarsest level, and their longitudes and
 * latitudes lead to the very places of the cloud's plane that the file has, as on the command line.
 * @throws FormatError FORMAT_ALIGNMENT; MeasureError MEASURE_FILE; PlacementError
 */
export async function readLines(file: File, cloud: PointCloud): Promise<FileLine[]> {
  const text = (await file.text()).replace(/^\uFEFF/, "");
  const ending = /\.(dxf|xml|landxml)$/i.exec(file.name)?.[1]?.toLowerCase();
  if (!ending) {
    const lines = linesOfGeoJson(text, cloud, file.name);
    return Promise.all(
      lines.map(async ({ name, places }) => ({
        name,
        start: 0,
        equations: [],
        vertices: await onPoints(places, cloud, file.name),
      })),
    );
  }
  const alignment = (ending === "dxf" ? readDxfLine : readLandXml)(text, undefined, file.name);
  const { places, ...stations } = await inCloud(alignment, cloud, file.name);
  const vertices = await onPoints(places, cloud, file.name);
  return [{ name: alignment.name || file.name, vertices, ...stations }];
}

function linesOfGeoJson(text: string, cloud: PointCloud, file: string) {
  const { measurements } = readMeasurements(asFeature(text), [], file);
  return measurements
    .filter(({ vertices, kind }) => vertices.length > 1 && (kind === "polyline" || kind === "distance"))
    .map(({ name, vertices }) => {
      const line = vertices.map(({ longitude, latitude }) => [longitude, latitude] as const);
      return { name, places: sourceLine(cloud, line, file) };
    });
}

/** A bare geometry as the feature that readers of measurements know; anything else as it is. */
function asFeature(text: string): string {
  try {
    const value = JSON.parse(text);
    if (value?.type === "LineString")
      return JSON.stringify({ type: "Feature", properties: {}, geometry: value });
  } catch {
    // Whoever reads it says what is wrong with it.
  }
  return text;
}

/** An alignment in the unit of the cloud, arcs as fewer chords. */
async function inCloud(alignment: Alignment, { crs }: PointCloud, file: string) {
  const { kind, size } = crs.horizontalUnit;
  if (kind === "angular") {
    throw new PlacementError({
      ...{ code: "PLACE_ANGLES", file, cause: "the cloud's coordinates are angles, and its own are lengths" },
      fix: "Give the line as GeoJSON, in longitude and latitude",
    });
  }
  const { vertices, start, equations } = inUnit(alignment, size);
  const { default: LineString } = await import("ol/geom/LineString.js");
  const line = new LineString(vertices.map(([x, y]) => [x, y]));
  const simple = line.simplify(TOLERANCE / size) as typeof line;
  const places = simple.getCoordinates().map(([x, y]) => [x!, y!] as const);
  const inMetres = equations.map(({ internal, ahead, ...equation }) => ({
    ...{ internal: (internal - start) * size, ahead: ahead * size },
    ...equation,
  }));
  return { places, start: start * size, equations: inMetres };
}

/** Vertices at places, each as high as the point that is nearest to it. */
async function onPoints(places: Places, cloud: PointCloud, file: string): Promise<Vertex[]> {
  const heights = new Float64Array(places.length);
  const nearest = new Float64Array(places.length).fill(Number.POSITIVE_INFINITY);
  const pace = new Pace(undefined);
  const { scale, offset } = cloud;
  for await (const { records } of cloud.query({ spacing: Number.POSITIVE_INFINITY }).batches()) {
    const { xyz, count } = records;
    for (const [index, [x, y]] of places.entries()) {
      for (let at = 0; at < 3 * count; at += 3) {
        const away = Math.hypot(xyz[at]! * scale[0] + offset[0] - x, xyz[at + 1]! * scale[1] + offset[1] - y);
        if (away >= nearest[index]!) continue;
        nearest[index] = away;
        heights[index] = xyz[at + 2]! * scale[2] + offset[2];
      }
      await pace.rest();
    }
  }
  return places.map((place, index) => vertexOver(place, heights[index]!, cloud, file));
}

/**
 * The vertex at a height whose longitude and latitude lead to a place of the cloud's plane. Where a datum is shifted they change
 * with the height, and profiles take them at one: the vertex stands as much beside the place, hundredths of a millimetre for each
 * metre between both.
 */
function vertexOver([x, y]: Places[number], z: number, cloud: PointCloud, file: string): Vertex {
  let [besideX, besideY] = [x, y];
  for (let round = 0; round < ROUNDS; round++) {
    const { longitude, latitude } = sourceVertex(cloud, [besideX, besideY, z]);
    const [[foundX, foundY]] = sourceLine(cloud, [[longitude, latitude]], file) as [[number, number]];
    besideX += x - foundX;
    besideY += y - foundY;
  }
  return sourceVertex(cloud, [besideX, besideY, z]);
}
