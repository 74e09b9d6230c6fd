import { geodeticToEcef, pointTransform, truthOf } from "@groma/georef";
import type { PointCloud } from "@groma/layer/cesium";
import { Profile } from "@groma/layer/tools";
import { describe, expect, it } from "vitest";
import { readLines } from "./line-file.js";

const metre = { kind: "linear", name: "metre", size: 1, declared: true } as const;
/** The old Swiss system: the shift of its datum moves what stands higher by 26 millionths of that. */
const crs = {
  proj4:
    "+proj=somerc +lat_0=46.9524055555556 +lon_0=7.43958333333333 +k_0=1 +x_0=600000 +y_0=200000 +ellps=bessel +towgs84=674.374,15.056,405.346,0,0,0,0 +units=m",
  horizontalUnit: metre,
  verticalUnit: metre,
  height: { kind: "ellipsoidal" },
} as const;
const transform = pointTransform(truthOf({ crs: crs as never }, 100, "scan"));

/** A scan between 0 and 800 m, whose points are all at its foot. */
const cloud = {
  name: "scan",
  ...{ crs, scale: [1, 1, 1], offset: [0, 0, 0] },
  boundingBox: { min: [589500, 231300, 0], max: [589900, 231500, 800] },
  place(x: number, y: number, z: number, out = new Float64Array(3)) {
    transform(x, y, z, out, 0);
    return out;
  },
  query: () => ({
    async *batches() {
      yield { records: { count: 1, xyz: Int32Array.of(589600, 231350, 0) } };
    },
  }),
} as unknown as PointCloud;

const landXml = (unit: string, factor: number) =>
  `<LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2"><Units><Imperial linearUnit="${unit}"/></Units><Alignments>
<Alignment name="axis" staStart="${1000 / factor}"><CoordGeom><Line><Start>${231350 / factor} ${589600 / factor}</Start>
<End>${231450 / factor} ${589800 / factor}</End></Line></CoordGeom>
<StaEquation staInternal="${1050 / factor}" staAhead="${2000 / factor}"/></Alignment></Alignments></LandXML>`;

/** The line in the plane of the scan, as its profile has it. */
async function laid(text: string, name: string) {
  const [line] = await readLines(new File([text], name), cloud);
  const angles = line!.vertices.map(({ longitude, latitude }) => [longitude, latitude] as const);
  return { ...line!, plane: new Profile(cloud, { line: angles, width: 4 }).strip.vertices };
}

describe("a line of a file", () => {
  it.each([
    ["meter", 1],
    ["foot", 0.3048],
  ])("lies where an alignment in %s says, whatever the height of its points", async (unit, factor) => {
    const { plane, vertices, start, name, equations } = await laid(landXml(unit, factor), "axis.xml");
    expect(name).toBe("axis");
    expect(start).toBeCloseTo(1000, 9);
    expect(equations).toHaveLength(1);
    // Metres from the start.
    expect(equations[0]!.internal).toBeCloseTo(50, 9);
    expect(equations[0]!.ahead).toBeCloseTo(2000, 9);
    const wanted = [
      [589600, 231350],
      [589800, 231450],
    ] as const;
    for (const [index, [x, y]] of wanted.entries()) {
      expect(Math.hypot(plane[index]![0] - x, plane[index]![1] - y)).toBeLessThan(1e-7);
      // At the foot of the scan, 400 m below where profiles take places.
      expect(vertices[index]!.source![2]).toBe(0);
      const [sourceX, sourceY] = vertices[index]!.source!;
      expect(Math.hypot(sourceX - x, sourceY - y)).toBeCloseTo(0.0105, 3);
    }
  });

  it("has the longitudes and latitudes that GeoJSON gives", async () => {
    const coordinates = [
      [7.30131, 47.233],
      [7.30394, 47.2339],
    ];
    const geometry = JSON.stringify({ type: "LineString", coordinates });
    const [line] = await readLines(new File([geometry], "line.geojson"), cloud);
    for (const [index, [longitude, latitude]] of coordinates.entries()) {
      const found = line!.vertices[index]!;
      const [here, there] = [
        found,
        { longitude: (longitude! * Math.PI) / 180, latitude: (latitude! * Math.PI) / 180 },
      ].map((place) => {
        const out = new Float64Array(3);
        geodeticToEcef(place.longitude, place.latitude, 0, out);
        return out;
      });
      expect(Math.hypot(...[0, 1, 2].map((axis) => here![axis]! - there![axis]!))).toBeLessThan(1e-6);
    }
  });
});
