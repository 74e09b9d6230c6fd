import type { CoreEvent } from "../core/core.js";
import type { ProgressKind } from "../given/choices.js";
import { complain, count, printJson } from "./output.js";
import { createPace, type Pace, type Stage } from "./pace.js";

/** Shows the events of a conversion; `stop` leaves the terminal tidy, however it ended. */
export interface Progress {
  show(event: CoreEvent): void;
  stop(): void;
}

/** A bar where a person looks on, plain lines into a file. */
export function defaultProgress(): ProgressKind {
  return process.stderr.isTTY ? "bar" : "plain";
}

/** Work whose progress is shown. */
export interface ShownWork {
  /** What stands before the bar, at most eight characters. */
  readonly label: string;
  readonly stages?: readonly Stage[];
}

/** @param work Default: a conversion */
export async function createProgress(
  kind: ProgressKind,
  work: ShownWork = { label: "convert" },
): Promise<Progress> {
  return { bar, plain, json }[kind](work);
}

/** `1,234,567 points/s, 12 s left`; stages that do not count points have no rate. */
function paceInWords(stage: string, { rate, eta }: Pace): string {
  const parts = [
    ...(rate === 0 || stage === "inspect" ? [] : [`${count(rate)} points/s`]),
    ...(eta === null ? [] : [`${duration(eta)} left`]),
  ];
  return parts.join(", ");
}

/** `12 s`, `3 min 20 s`, `2 h 5 min`. */
function duration(seconds: number): string {
  if (seconds < 60) return `${seconds} s`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min ${seconds % 60} s`;
  return `${Math.floor(seconds / 3600)} h ${Math.floor((seconds % 3600) / 60)} min`;
}

async function bar({ label, stages }: ShownWork): Promise<Progress> {
  const { SingleBar } = await import("cli-progress");
  const line = new SingleBar({
    format: `${label.padEnd(8)} {bar} {percentage} %  {stage}  {pace}`,
    barCompleteChar: "█",
    barIncompleteChar: "░",
    hideCursor: true,
    clearOnComplete: true,
    stream: process.stderr,
  });
  const pace = createPace(undefined, stages);
  line.start(1000, 0, { stage: "", pace: "" });
  return {
    show(event) {
      if (event.event === "warning") {
        process.stderr.write("\r\x1b[K");
        complain([`warning: ${event.text}`]);
        return;
      }
      const { stage, done, total } = event;
      const now = pace.advance(stage, done, total);
      line.update(Math.round(1000 * now.overall), { stage, pace: paceInWords(stage, now) });
    },
    stop: () => line.stop(),
  };
}

/** A line per stage and tenth. */
async function plain({ stages }: ShownWork): Promise<Progress> {
  const pace = createPace(undefined, stages);
  let last = "";
  return {
    show(event) {
      if (event.event === "warning") {
        complain([`warning: ${event.text}`]);
        return;
      }
      const { stage, done, total } = event;
      const now = pace.advance(stage, done, total);
      const tenth = total > 0 ? Math.floor((10 * done) / total) : 10;
      const text = `${stage} ${10 * tenth} %`;
      if (text !== last) complain([`${text}  ${paceInWords(stage, now)}`.trimEnd()]);
      last = text;
    },
    stop: () => undefined,
  };
}

/** `{ event, stage, done, total, rate, eta }` on standard output: points per second, seconds to the end of the whole. */
async function json({ stages }: ShownWork): Promise<Progress> {
  const pace = createPace(undefined, stages);
  return {
    show(event) {
      if (event.event === "warning") {
        printJson(event);
        return;
      }
      const { rate, eta } = pace.advance(event.stage, event.done, event.total);
      printJson({ ...event, rate, eta });
    },
    stop: () => undefined,
  };
}
