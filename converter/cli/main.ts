// What a command needs is loaded when it is run, so that help and refused options come at once.
import { createRequire } from "node:module";
import { Command, CommanderError, Option } from "commander";
import {
  attributeRanges,
  boxNumbers,
  classNumbers,
  finite,
  notNegative,
  numbers,
  originList,
  portNumber,
  positive,
  refuseEmpty,
  returnKinds,
  sectionFormats,
  statistic,
  threadCount,
  valueRange,
} from "./given/arguments.js";
import { PROGRESS_KINDS, SAMPLINGS } from "./given/choices.js";
import type { EngineChoice } from "./place/engine.js";
import { complain, endWithReader, fail } from "./terminal/output.js";

const ENGINES: readonly NonNullable<EngineChoice["engine"]>[] = ["proj", "proj4js"];

/** What may be said of the coordinates and of who places them, in the commands that convert. */
const placing = () => [
  new Option(
    "--crs <X>",
    'coordinate reference system: EPSG code, PROJ string, WKT or PROJJSON; "none" ignores the file\'s CRS',
  ),
  new Option("--vertical <X>", "height reference: a vertical EPSG code, or ellipsoidal"),
  new Option(
    "--anchor <lon,lat,height,heading>",
    "for a scan without CRS: position of its origin (degrees, metres above the ellipsoid) and heading of +y (degrees clockwise from north); metres per unit may follow",
  ).conflicts("control"),
  new Option("--anchor-at <x,y,z>", "point of the scan that lies at the anchor, instead of its origin"),
  new Option(
    "--control <FILE>",
    "for a scan without CRS: file of three or more lines x y z lon lat height (degrees, metres above the ellipsoid)",
  ).conflicts("anchorAt"),
  new Option(
    "--engine <name>",
    "what transforms the coordinates: PROJ with its grids, or proj4js with EGM96",
  ).choices(ENGINES),
  new Option("--proj <DIR>", "folder of PROJ's programs projinfo and cct, instead of the one that is found"),
  new Option("--grids <DIR>", "folder of grid files, searched before PROJ's own"),
];
const progress = () => new Option("--progress <kind>", "how progress is shown").choices(PROGRESS_KINDS);
const host = () => new Option("--host <address>", "address to listen on").default("127.0.0.1");
const port = () =>
  new Option("--port <number>", "first port to try, 0 for any").default(8080).argParser(portNumber);

const cors = () =>
  new Option(
    "--cors [ORIGINS]",
    "let pages of other origins read: those listed, separated by commas, or all",
  ).argParser(originList);

/** What may be said of inputs that PDAL reads. */
const reading = () => [
  new Option("--pipeline <FILE>", "PDAL pipeline to run on the inputs; it may name its own inputs"),
  new Option("--pdal <PATH>", "path of the pdal program, if it is not on PATH"),
  new Option(
    "--scale <STEP>",
    "scale factor of the stored integers for inputs read by PDAL, in their own units",
  ).argParser(positive),
];

/** Options with `--cors` alone read as all origins. */
function serving<T extends { cors?: true | string[] }>(options: T) {
  const { cors, ...others } = options;
  return { ...others, ...(cors !== undefined && { cors: cors === true ? ("any" as const) : cors }) };
}

const program = new Command("groma")
  .description("Convert laser scans to georeferenced COPC files and show them on the globe.")
  .version(createRequire(import.meta.url)("../package.json").version)
  .configureOutput({ writeErr: () => undefined })
  .exitOverride();

const convert = program
  .command("convert")
  .description(
    "convert scans to one georeferenced COPC file; LAS and LAZ directly, other formats through PDAL",
  )
  .argument("<paths...>", "input files, patterns or folders, then the output file")
  .addOption(new Option("--sampling <S>", "how the points of each node are chosen").choices(SAMPLINGS))
  .option("--average-colors", "give points of coarse levels the mean colour of the points they represent")
  .addOption(new Option("--threads <N>", "number of threads (default: all cores)").argParser(threadCount))
  .option("--memory <SIZE>", "memory limit, e.g. 2GB")
  .option("--temp-dir <DIR>", "folder for temporary files (default: the folder of the output)")
  .option("--dry-run", "print the plan without writing anything")
  .option("--json", "with --dry-run: print the plan as JSON")
  .addOption(progress())
  .option("--overwrite", "replace an existing output")
  .option("--strict", "refuse an empty or damaged input instead of converting what can be read")
  .action(async (paths: string[], options, command: Command) => {
    const least = options.pipeline === undefined ? 2 : 1;
    if (paths.length < least) command.error("error: inputs and an output are required");
    if (options.json && !options.dryRun) {
      command.error("error: --json requires --dry-run; use --progress json for a conversion");
    }
    const { runConvert } = await import("./commands/convert.js");
    return runConvert(paths, options);
  });

program
  .command("info")
  .description("show contents, location and accuracy of a LAS, LAZ or COPC file")
  .argument("<file>")
  .option("--json", "print JSON")
  .option("--verify", "read all points and verify their checksums")
  .action(async (file: string, options) => (await import("./commands/info.js")).runInfo(file, options));

const georef = program
  .command("georef")
  .description(
    "write where the points of a COPC file or address are to a file beside it, for a page that shows it; only its header is read",
  )
  .argument("<file>", "COPC file or its address")
  .argument("[output]", "file to write (default: the name of the input with .georef)")
  .option("--overwrite", "replace an existing output")
  .option("--json", "print JSON")
  .action(async (file: string, output: string | undefined, options) =>
    (await import("./commands/georef.js")).runGeoref(file, output, options),
  );

const grids = program
  .command("grids")
  .description("show which grids PROJ lacks to place a file more accurately, and how to get them")
  .argument("<file>", "LAS, LAZ or COPC file, or the address of a COPC file")
  .option("--json", "print JSON")
  .action(async (file: string, options) => (await import("./commands/grids.js")).runGrids(file, options));

program
  .command("locate")
  .description("convert points to ECEF, longitude, latitude and height as the page does, with their accuracy")
  .argument("<file>")
  .requiredOption(
    "--points <FILE>",
    "file of one x y z per line in the coordinates of the scan; - for standard input",
  )
  .option(
    "--inverse <FROM>",
    "points are given elsewhere and their coordinates in the scan wanted: ecef (metres), geodetic (longitude, latitude, height), or a map projection such as EPSG:3857",
  )
  .option("--json", "print JSON")
  .action(async (file: string, options) => (await import("./commands/locate.js")).runLocate(file, options));

/** Coordinates of a line or a polygon that is given. */
const givenCrs = (flag: string, what: string) =>
  new Option(`${flag} <CRS>`, `coordinates of the ${what}: longitude and latitude, or those of the scan`)
    .choices(["EPSG:4326", "source"])
    .default("EPSG:4326");

/** How a cut is written. */
const cutting = () => [
  new Option(
    "--out <FILE>",
    "output; its ending says the format: .las, .laz, .csv, .geojson, .dxf; of profiles .svg, .pdf, .xml (LandXML) too",
  ).makeOptionMandatory(),
  new Option("--overwrite", "replace an existing output"),
  new Option("--classes <numbers>", "classes that are kept, e.g. 2,9").argParser(classNumbers),
  new Option("--returns <kinds>", "returns that are kept: first, last, intermediate, single").argParser(
    returnKinds,
  ),
  new Option(
    "--range <NAME=least,greatest>",
    "values that are kept of an attribute, both included; may be given again for others",
  ).argParser(attributeRanges),
  new Option("--clips <FILE>", "volumes that cut: JSON list of boxes, planes, polygons, as of layer.clips"),
  progress(),
];

const profile = program
  .command("profile")
  .description("write all points in a strip along a line, record by record, to a file")
  .argument("<files...>", "COPC files or their addresses")
  .requiredOption(
    "--line <FILE>",
    "line: GeoJSON with one LineString, DXF with a polyline, LandXML with an alignment",
  )
  .option(
    "--line-name <NAME>",
    "layer of the polyline in DXF, or name of the alignment, where there are several",
  )
  .addOption(
    new Option(
      "--line-crs <CRS>",
      "coordinates of the line: longitude and latitude (GeoJSON), or those of the scan (DXF, LandXML)",
    ).choices(["EPSG:4326", "source"]),
  )
  .addOption(
    new Option("--plane <which>", "where points are decided: in the plane of the scans, or on the ellipsoid")
      .choices(["source", "ellipsoid"])
      .default("source"),
  )
  .addOption(
    new Option("--width <W>", "width of the strip: metres; with --line-crs source, units of the scan")
      .argParser(positive)
      .makeOptionMandatory(),
  )
  .addOption(
    new Option("--stations <how>", "how chainage is counted: in the plane, or along geodesics")
      .choices(["grid", "geodesic"])
      .default("grid"),
  )
  .addOption(
    new Option("--start <S>", "chainage at the start of the line (0, or what LandXML says)").argParser(
      finite,
    ),
  )
  .option("--chainage", "add chainage and offset along the line to each LAS record, as extra bytes")
  .option("--straightened", "lay the points of DXF along the line: x is the chainage, y the height")
  .option("--sections", "cut across the line instead: to a .zip of files, a .pdf of pages, or .xml (LandXML)")
  .addOption(
    new Option("--interval <D>", "sections at the ends of the line and at round multiples of D").argParser(
      positive,
    ),
  )
  .addOption(new Option("--at <chainages>", "sections there, e.g. 12.5,40").argParser(numbers))
  .addOption(
    new Option("--left <L>", "how far sections reach to the left (half the width)").argParser(notNegative),
  )
  .addOption(new Option("--right <R>", "how far to the right (half the width)").argParser(notNegative))
  .addOption(
    new Option("--thickness <T>", "of the strip of each section, in the unit of the width")
      .argParser(positive)
      .default(0.5),
  )
  .addOption(
    new Option("--files <formats>", "of each section in a .zip: las, laz, csv, geojson, dxf, svg, pdf")
      .argParser(sectionFormats)
      .default(["las", "svg"], "las,svg"),
  )
  .addOption(new Option("--scale <N>", "draw .svg and .pdf 1:N (what fits onto A3)").argParser(positive))
  .addOption(new Option("--exaggeration <E>", "draw heights stretched by E").argParser(positive).default(1))
  .option(
    "--color-by <NAME>",
    "attribute that .svg and .pdf are coloured by: rgb, elevation, classification, ..., or side (of the line)",
  )
  .addOption(
    new Option(
      "--color-range <least,greatest>",
      "its values at the ends of the gradient (of all points)",
    ).argParser(valueRange),
  )
  .addOption(
    new Option(
      "--ground <how>",
      "ground in .svg, .pdf, .xml: min, max, mean, or a percentile such as p25",
    ).argParser(statistic),
  )
  .addOption(
    new Option("--ground-interval <D>", "distance between its stations (1 unit of the scan)").argParser(
      positive,
    ),
  )
  .addOption(
    new Option("--ground-classes <numbers>", "classes of its points, e.g. 2 (all)").argParser(classNumbers),
  )
  .addOption(
    new Option("--spacing <S>", "a thinner level: one point in about S units of the scan suffices").argParser(
      positive,
    ),
  )
  .action(async (files: string[], given, command: Command) => {
    const { ground: statistic, groundInterval, groundClasses, ...options } = given;
    const { sections, interval, at } = options;
    if (sections && interval === undefined && at === undefined)
      command.error("error: --sections requires --interval or --at");
    if (options.colorRange && options.colorBy === undefined)
      command.error("error: --color-range requires --color-by");
    if (!sections && (interval ?? at) !== undefined)
      command.error("error: --interval and --at require --sections");
    const asked = (statistic ?? groundInterval ?? groundClasses) !== undefined;
    const classes = groundClasses && new Set<number>(groundClasses);
    const ground = asked && { interval: groundInterval ?? 1, statistic: statistic ?? 25, classes };
    const { runProfile } = await import("./commands/profile.js");
    return runProfile(files, { ...options, ...(ground && { ground }) });
  });

const clip = program
  .command("clip")
  .description(
    "write all points in a polygon, a box or other volumes, or that a filter leaves, record by record, to a file",
  )
  .argument("<files...>", "COPC files or their addresses")
  .addOption(new Option("--polygon <FILE>", "GeoJSON file with one Polygon").conflicts("box"))
  .addOption(givenCrs("--polygon-crs", "polygon"))
  .addOption(
    new Option(
      "--box <least,greatest>",
      "x,y,x,y or x,y,z,x,y,z in the coordinates of the scan: least, then greatest",
    ).argParser(boxNumbers),
  )
  .addOption(
    new Option("--heights <low,high>", "a horizontal slice: what lies between these z of the scan").argParser(
      valueRange,
    ),
  )
  .action(async (files: string[], options, command: Command) => {
    const { polygon, box, heights, classes, returns, range, clips } = options;
    if (!(polygon ?? box ?? heights ?? classes ?? returns ?? range ?? clips)) {
      command.error(
        "error: --polygon, --box, --heights, --clips, --classes, --returns or --range is required",
      );
    }
    return (await import("./commands/clip.js")).runClip(files, options);
  });

for (const command of [profile, clip]) for (const option of cutting()) command.addOption(option);

program
  .command("serve")
  .description("serve the files of a folder with Range")
  .argument("<folder>")
  .addOption(host())
  .addOption(port())
  .addOption(cors())
  .action(async (folder: string, options) =>
    (await import("./commands/serve.js")).runServe(folder, serving(options)),
  );

const view = program
  .command("view")
  .description("show a scan on the globe: convert it if needed, serve it, print the address")
  .argument("<file>")
  .addOption(progress())
  .addOption(host())
  .addOption(port())
  .addOption(cors())
  .action(async (file: string, options) =>
    (await import("./commands/view.js")).runView(file, serving(options)),
  );

for (const command of [convert, view, georef, grids]) {
  for (const option of placing()) command.addOption(option);
}
for (const command of [convert, view]) for (const option of reading()) command.addOption(option);
for (const command of program.commands) {
  command.copyInheritedSettings(program);
  refuseEmpty(command);
}

endWithReader();
try {
  await program.parseAsync();
} catch (error) {
  if (!(error instanceof CommanderError)) fail(error);
  else if (error.code === "commander.help") {
    // What was asked for, `groma help info`, has been printed.
    if (error.exitCode !== 0) helpInstead();
  } else if (error.exitCode !== 0) {
    const cause = error.message
      .replace(/^error: /, "")
      .replace(/\.$/, "")
      .replace(/\s*\n\s*/g, " ");
    refuse(cause || "no command given");
  }
}

/** Nothing was asked for, or help about a command that does not exist. */
function helpInstead(): void {
  const [, unknown] = program.args;
  process.exitCode = 1;
  if (unknown === undefined) complain(program.helpInformation().trimEnd().split("\n"));
  else refuse(`unknown command '${unknown}'`);
}

/** An error like all others, told without what they need. */
function refuse(cause: string): void {
  process.exitCode = 1;
  const [given] = process.argv.slice(2);
  const command = program.commands.find((one) => one.name() === given);
  complain([`OPTION_INVALID: groma: ${cause}. Run groma ${command ? `${command.name()} ` : ""}--help.`]);
}
