#!/usr/bin/env node
import { Command, CommanderError, InvalidArgumentError, Option } from "commander";
import { runConvert } from "./commands/convert.js";
import { runInfo } from "./commands/info.js";
import { runLocate } from "./commands/locate.js";
import { runServe } from "./commands/serve.js";
import { runView } from "./commands/view.js";
import { OptionError } from "./option-error.js";
import { fail } from "./output.js";
import { ENGINES } from "./place/engine.js";
import { PROGRESS_KINDS } from "./progress.js";

/** What may be said of the coordinates and of who places them, in the commands that convert. */
const placing = () => [
  new Option(
    "--crs <X>",
    "coordinate reference system: EPSG code, PROJ string, WKT or PROJJSON; none passes over the file's own",
  ),
  new Option("--vertical <X>", "height reference: a vertical EPSG code, or ellipsoidal"),
  new Option(
    "--anchor <lon,lat,height,heading>",
    "for a scan without CRS, where its origin is: degrees, metres above the ellipsoid, degrees clockwise from north to +y; metres per unit may follow",
  ).conflicts("control"),
  new Option("--anchor-at <x,y,z>", "the point of the scan that stands at the anchor, instead of its origin"),
  new Option(
    "--control <FILE>",
    "for a scan without CRS, three or more lines: x y z lon lat height (degrees, metres above the ellipsoid)",
  ).conflicts("anchorAt"),
  new Option("--engine <name>", "who places the points: PROJ with its grids, or proj4js with EGM96").choices(
    ENGINES,
  ),
  new Option("--proj <DIR>", "folder of PROJ's programs projinfo and cct, if they are not on PATH"),
  new Option("--grids <DIR>", "folder of grid files for PROJ, before its own"),
];
const progress = () => new Option("--progress <kind>", "how progress is shown").choices(PROGRESS_KINDS);
const host = () => new Option("--host <address>", "address to listen on").default("127.0.0.1");
const port = () =>
  new Option("--port <number>", "first port to try, 0 for any").default(8080).argParser(portNumber);

function portNumber(text: string): number {
  const number = Number(text);
  if (Number.isInteger(number) && number >= 0 && number <= 65535) return number;
  throw new InvalidArgumentError("a port is a number from 0 to 65535");
}

const program = new Command("groma")
  .description("From a laser scan to the globe: one COPC file that knows where it is.")
  .version("0.1.0")
  .configureOutput({ writeErr: () => undefined })
  .exitOverride();

const convert = program
  .command("convert")
  .description("convert LAS and LAZ files into one COPC file with its georeference")
  .argument("<files...>", "one or more inputs, then the output")
  .addOption(new Option("--sampling <S>", "how the points of a node are chosen").choices(["grid"]))
  .option("--memory <SIZE>", "most memory to use, e.g. 2GB")
  .option("--temp-dir <DIR>", "folder for scratch files")
  .addOption(progress())
  .option("--overwrite", "replace an output that is there already")
  .action((files: string[], options, command: Command) => {
    if (files.length < 2) command.error("error: inputs and an output are needed");
    return runConvert(files, options);
  });

program
  .command("info")
  .description("tell what a LAS, LAZ or COPC file is, where it is, and what that is worth")
  .argument("<file>")
  .option("--json", "for machines")
  .action(runInfo);

program
  .command("locate")
  .description("place points as the page does: ECEF, longitude, latitude, height, and what that is worth")
  .argument("<file>")
  .requiredOption("--points <FILE>", "one x y z per line in the file's own coordinates; - for standard input")
  .option("--json", "for machines")
  .action(runLocate);

program
  .command("serve")
  .description("serve the files of a folder with Range and CORS")
  .argument("<folder>")
  .addOption(host())
  .addOption(port())
  .action(runServe);

const view = program
  .command("view")
  .description("show a scan on the globe: convert if needed, serve, print the address")
  .argument("<file>")
  .addOption(progress())
  .addOption(host())
  .addOption(port())
  .action(runView);

for (const command of [convert, view]) for (const option of placing()) command.addOption(option);
for (const command of program.commands) command.copyInheritedSettings(program);

try {
  await program.parseAsync();
} catch (error) {
  if (!(error instanceof CommanderError)) fail(error);
  else if (error.exitCode !== 0) {
    const cause = error.message.replace(/^error: /, "").replace(/\.$/, "") || "a command is needed";
    fail(new OptionError({ code: "OPTION_INVALID", file: "groma", cause, fix: "run groma --help" }));
  }
}
