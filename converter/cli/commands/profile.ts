import type { ExportProgress } from "@groma/layer/export";
import { type Cut, type CutOptions, cut } from "../cut/cut.js";
import { readLine } from "../cut/geojson.js";
import { corridor, type GivenCrs, inSource } from "../cut/profile.js";
import type { ProgressKind } from "../given/choices.js";
import { interruptible } from "../terminal/interruption.js";
import { count, counted, labelled, print, printJson } from "../terminal/output.js";
import { createProgress, defaultProgress } from "../terminal/progress.js";

export interface ProfileCommandOptions extends CutOptions {
  /** GeoJSON file with the line. */
  readonly line: string;
  readonly lineCrs: GivenCrs;
  /** Of the whole strip: source units, or metres where the line is in longitude and latitude. */
  readonly width: number;
  readonly progress?: ProgressKind;
}

/** The `profile` command: all points in a strip along a line, as one file. */
export async function runProfile(files: readonly string[], options: ProfileCommandOptions): Promise<void> {
  const line = await readLine(options.line);
  const work = { label: "profile", stages: [{ stage: "read", share: 1 }] };
  const progress = await createProgress(options.progress ?? defaultProgress(), work);
  const onProgress = ({ read, total }: ExportProgress) =>
    progress.show({ event: "progress", stage: "read", done: read, total });
  try {
    const done = await interruptible((signal) =>
      cut(
        files,
        async (origin) => {
          const strip = corridor(
            await inSource(line, options.lineCrs, origin, options.line),
            options.width,
            options.line,
          );
          return { origin, volume: strip, along: strip };
        },
        options,
        onProgress,
        signal,
      ),
    );
    progress.stop();
    if (options.progress === "json") printJson({ event: "done", ...done });
    else print(inWords(done));
  } finally {
    progress.stop();
  }
}

/** What a cut came to, for people. */
export function inWords({ output, points, read, inputs, seconds }: Cut): string[] {
  return labelled([
    ["points", `${count(points)} of ${count(read)} that were read from ${counted(inputs, "file")}`],
    ["time", `${seconds.toFixed(1)} s`],
    ["output", output],
  ]);
}
