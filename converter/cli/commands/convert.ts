import { GromaError } from "@groma/georef";
import { convert } from "../conversion/convert.js";
import { dryRun, planForMachines, planInWords } from "../conversion/dry-run.js";
import type { ConvertOptions } from "../conversion/options.js";
import { summaryForMachines, summaryInWords } from "../conversion/summary.js";
import { interruptible } from "../terminal/interruption.js";
import { print, printJson } from "../terminal/output.js";
import { createProgress, defaultProgress } from "../terminal/progress.js";

export interface ConvertCommandOptions extends ConvertOptions {
  readonly dryRun?: boolean;
  /** With `dryRun`: the plan for machines. */
  readonly json?: boolean;
}

/** The `convert` command: a summary for people, or JSON lines for machines, the last of which tells the result. */
export async function runConvert(files: readonly string[], options: ConvertCommandOptions): Promise<void> {
  const inputs = files.slice(0, -1);
  const output = files.at(-1)!;
  const forMachines = options.progress === "json" || options.json === true;
  const progress = await createProgress(options.progress ?? (options.dryRun ? "plain" : defaultProgress()));
  try {
    const tell = await interruptible(async (signal) => {
      if (options.dryRun) {
        const plan = await dryRun(inputs, output, options, (event) => progress.show(event), signal);
        return () => (forMachines ? printJson(planForMachines(plan)) : print(planInWords(plan)));
      }
      const converted = await convert(inputs, output, options, (event) => progress.show(event), signal);
      return () =>
        forMachines ? printJson(summaryForMachines(converted)) : print(summaryInWords(converted));
    });
    progress.stop();
    tell();
  } catch (error) {
    progress.stop();
    if (options.progress === "json" && error instanceof GromaError) {
      printJson({ event: "error", ...error.toWire() });
    }
    throw error;
  }
}
