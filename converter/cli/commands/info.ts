import { inspect } from "../inspect/inspect.js";

/** The `info` command. A file without a usable CRS is described all the same; what is wrong with it is said. */
export async function runInfo(file: string, { json = false }: { json?: boolean }): Promise<void> {
  const inspection = await inspect(file);
  if (json) {
    const { machineForm } = await import("../inspect/machine-form.js");
    process.stdout.write(`${JSON.stringify(machineForm(inspection), undefined, 2)}\n`);
    return;
  }
  const { personForm } = await import("../inspect/person-form.js");
  process.stdout.write(personForm(inspection));
}
