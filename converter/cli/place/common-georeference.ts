import { CrsError, type CrsNote, sameHeights, samePlane, sameSize } from "@groma/georef";
import { type Georeferenced, type Given, georeference, type Named } from "./georeference.js";

/**
 * The one coordinate reference system of several inputs, however each of them spells it.
 *
 * @throws CrsError CRS_MIXED with the list when they differ in meaning; as {@link georeference}
 */
export async function commonGeoreference(scans: readonly Named[], given: Given): Promise<Georeferenced> {
  const systems: { readonly one: Georeferenced; readonly files: string[] }[] = [];
  const notes = new Map<string, { readonly note: CrsNote; readonly files: string[] }>();
  for (const scan of scans) {
    const one = await georeference(scan, given);
    const known = systems.find((system) => isSame(system.one, one));
    if (known) known.files.push(scan.file);
    else systems.push({ one, files: [scan.file] });
    for (const note of one.notes) {
      const told = notes.get(note.text);
      if (told) told.files.push(scan.file);
      else notes.set(note.text, { note, files: [scan.file] });
    }
  }
  const [{ one: first }] = systems as [(typeof systems)[number]];
  if (systems.length > 1) throw mixed(systems);
  const whose = (files: readonly string[]) => (files.length === scans.length ? "" : `${listed(files)}: `);
  const all = [...notes.values()].map(({ note, files }) => ({
    ...note,
    text: `${whose(files)}${note.text}`,
  }));
  return { ...first, notes: all };
}

function isSame(a: Georeferenced, b: Georeferenced): boolean {
  const similarity = ({ local }: Georeferenced) => JSON.stringify(local?.similarity ?? null);
  return samePlane(a.crs, b.crs) && sameHeights(a.crs, b.crs) && similarity(a) === similarity(b);
}

function mixed(systems: readonly { readonly one: Georeferenced; readonly files: readonly string[] }[]) {
  const list = systems.map(({ one, files }) => `${inWords(one)} (${listed(files)})`).join("; ");
  const first = systems[0]!.one.crs;
  // A given height reference leaves the units of z as they are.
  const oneUnit = systems.every(({ one }) => sameSize(one.crs.verticalUnit.size, first.verticalUnit.size));
  const plane = systems.every(({ one }) => samePlane(one.crs, first));
  const heights = oneUnit ? "--vertical, or with --crs with its heights" : "--crs with its heights";
  return new CrsError({
    code: "CRS_MIXED",
    file: systems[1]!.files[0]!,
    cause: `the inputs are in ${systems.length} different systems: ${list}`,
    fix: `convert them separately, or give the one that is right for all with ${plane ? heights : "--crs"}`,
  });
}

function inWords({ crs: { name, verticalUnit } }: Georeferenced): string {
  return verticalUnit.declared ? `${name}, z in ${verticalUnit.name}` : name;
}

/** Files that a message names; of more, it gives the number. */
const LISTED = 3;

function listed(files: readonly string[]): string {
  const more = files.length - LISTED;
  return `${files.slice(0, LISTED).join(", ")}${more > 0 ? `, ${more} more` : ""}`;
}
