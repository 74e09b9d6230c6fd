import { writeFile } from "node:fs/promises";
import { basename } from "node:path";
import { encodeRecordFile, statedAccuracy } from "@groma/georef";
import { placeRows } from "../conversion/summary.js";
import { writeWhole } from "../cut/output-file.js";
import { readHead } from "../files/points.js";
import { requirePlace } from "../given/output-place.js";
import { declarationOf } from "../place/declaration.js";
import { projString } from "../place/engine.js";
import { type Given, georeference } from "../place/georeference.js";
import { makeRecords } from "../place/records.js";
import { expectedWhereabouts } from "../place/whereabouts.js";
import { interruptible } from "../terminal/interruption.js";
import { labelled, print, printJson, size } from "../terminal/output.js";

export interface GeorefOptions extends Given {
  readonly overwrite?: boolean;
  readonly json?: boolean;
}

/**
 * The `georef` command: the georeference that a conversion would put into a COPC file, as a file beside it. Header,
 * records and the first page of the hierarchy are read, of an address by Range requests.
 *
 * @param out Default: the name of the input with the ending .georef, in the working folder
 * @throws InputFileError, SourceError, FormatError, CrsError, PlacementError, ProjError, OutputError
 */
export async function runGeoref(
  input: string,
  out: string = defaultOutput(input),
  { overwrite = false, json = false, ...given }: GeorefOptions = {},
): Promise<void> {
  requirePlace(out, overwrite, [input, given.control]);
  const made = await interruptible(async (signal) => {
    const source = await readHead(input, signal);
    const { boundingBox, pointCount: points, scale, offset, name: file } = source;
    const georeferenced = await georeference(declarationOf(source), given);
    const whereabouts = expectedWhereabouts(georeferenced, boundingBox);
    const surroundings = { text: projString(given.crs), file, signal };
    const records = await makeRecords(georeferenced, boundingBox, scale, given, surroundings);
    const of = { points, scale, offset, ...boundingBox };
    const { georeference: record, transformation } = records;
    const bytes = encodeRecordFile({ of, record, transformation });
    await writeWhole(out, overwrite, (unfinished) => writeFile(unfinished, bytes));
    return { georeferenced, whereabouts, records, bytes: bytes.length };
  });
  const { georeferenced, whereabouts, records, bytes } = made;
  if (json) {
    const { crs, engine, operation, accuracy } = records.georeference;
    printJson({
      ...{ output: out, bytes, engine, operation: operation ?? null, accuracy: statedAccuracy(accuracy) },
      crs: { name: crs.name, code: crs.code, height: crs.height },
      crsNotes: [...georeferenced.notes, ...whereabouts.notes],
    });
  } else {
    const notes = whereabouts.notes.map(({ text }): [string, string] => ["note", text]);
    print(labelled([...placeRows(made), ["output", `${out}  ${size(bytes)}`], ...notes]));
  }
}

/** `site.georef` for `https://example.org/site.copc.laz?signature`. */
function defaultOutput(input: string): string {
  const name = /^https?:/i.test(input) ? new URL(input).pathname : input;
  return `${basename(name).replace(/(\.copc)?\.la[sz]$/i, "") || "scan"}.georef`;
}
