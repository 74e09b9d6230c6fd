import { statedAccuracy } from "@groma/georef";
import { density } from "../place/describe.js";
import { className } from "../terminal/class-names.js";
import type { Inspection } from "./inspect.js";

/** What is known of a file as one JSON object (docs/cli.md). */
export function reportJson(inspection: Inspection) {
  const { scan, header, place, problem, bounds, whereabouts, accuracy, statistics, sampled, gps, octree } =
    inspection;
  const { groma, wktBit: _, wkt: __, geoTiff: ___, ...rest } = scan;
  const bytes = (base64: string | undefined) => (base64 ? Buffer.byteLength(base64, "base64") : 0);
  const perArea = place && density(scan, place.crs);
  return {
    ...rest,
    crs: place?.crs ?? null,
    crsFrom: place?.basis ?? "none",
    crsNotes: [...(place?.notes ?? []), ...whereabouts.notes],
    centre: whereabouts.centre ?? null,
    problem: problem?.toWire() ?? null,
    engine: place?.engine ?? null,
    operation: place?.operation ?? null,
    geoids: place?.geoids ?? [],
    fitBound: place?.fitBound ?? null,
    geodeticBounds: bounds ?? null,
    density: perArea ?? null,
    spacing: perArea === undefined ? null : 1 / Math.sqrt(perArea),
    accuracy: statedAccuracy(accuracy),
    gpsTime: gps ?? null,
    pointsByReturn: header.returns,
    records: header.records.map(({ begin: _begin, ...record }) => record),
    recordBytes: { georeference: bytes(groma?.["1"]), transformation: bytes(groma?.["3"]) },
    octree: octree ? { levels: octree.levels, whole: octree.whole } : null,
    verified: inspection.verified ?? null,
    octreeProblem: inspection.octreeProblem ?? null,
    statistics: statistics ?? null,
    statisticsOf: statistics ? (sampled ?? "all points") : null,
    classNames: Object.fromEntries(
      Object.keys(statistics?.classes ?? {}).map((code) => [code, className(Number(code), scan.pointFormat)]),
    ),
  };
}
