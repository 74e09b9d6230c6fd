import { type Cut, type CutListener, type CutRequest, cut } from "../cut/cut.js";
import type { CutOptions } from "../cut/writers.js";
import type { ProgressKind } from "../given/choices.js";
import { interruptible } from "../terminal/interruption.js";
import { count, counted, labelled, print, printJson } from "../terminal/output.js";
import { createProgress, defaultProgress } from "../terminal/progress.js";

/** Writes a cut and tells how far it is and what it came to: for people, or JSON lines for machines. */
export async function tellCut(
  label: string,
  files: readonly string[],
  options: CutOptions & { readonly progress?: ProgressKind },
  request: CutRequest,
): Promise<void> {
  const work = { label, stages: [{ stage: "read", share: 1 }] };
  const progress = await createProgress(options.progress ?? defaultProgress(), work);
  const listener: CutListener = {
    onProgress: ({ read, total }) => progress.show({ event: "progress", stage: "read", done: read, total }),
    onWarning: (text) => progress.show({ event: "warning", text }),
  };
  try {
    const done = await interruptible((signal) => cut(files, request, options, listener, signal));
    progress.stop();
    if (options.progress === "json") printJson({ event: "done", ...done });
    else print(inWords(done));
  } finally {
    progress.stop();
  }
}

/** What a cut came to, for people. */
function inWords({ output, points, read, inputs, seconds }: Cut): string[] {
  return labelled([
    ["points", `${count(points)} of ${count(read)} that were read from ${counted(inputs, "file")}`],
    ["time", `${seconds.toFixed(1)} s`],
    ["output", output],
  ]);
}
