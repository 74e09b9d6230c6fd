import { inspect } from "../inspect/inspect.js";

/**
 * The `info` command. A file without a usable CRS is described all the same; what is wrong with it is said.
 *
 * @param options with `verify`, all points are read first
 */
export async function runInfo(file: string, options: { json?: boolean; verify?: boolean }): Promise<void> {
  const { json = false, verify = false } = options;
  const inspection = await inspect(file, verify);
  if (json) {
    const { machineForm } = await import("../inspect/machine-form.js");
    process.stdout.write(`${JSON.stringify(machineForm(inspection), undefined, 2)}\n`);
    return;
  }
  const { personForm } = await import("../inspect/person-form.js");
  process.stdout.write(personForm(inspection));
}
