import { inspect } from "../inspect/inspect.js";
import { print, printJson } from "../terminal/output.js";

/**
 * The `info` command. A file without a usable CRS is described all the same; what is wrong with it is said.
 *
 * @param options with `verify`, all points are read first
 */
export async function runInfo(file: string, options: { json?: boolean; verify?: boolean }): Promise<void> {
  const { json = false, verify = false } = options;
  const inspection = await inspect(file, verify);
  if (json) {
    const { reportJson } = await import("../inspect/report-json.js");
    printJson(reportJson(inspection), 2);
    return;
  }
  const { report } = await import("../inspect/report.js");
  print(report(inspection));
}
