import { SingleBar } from "cli-progress";
import type { CoreEvent } from "./core.js";

/** How progress is shown: a bar on a terminal, a line now and then, or JSON lines for machines. */
export const PROGRESS_KINDS = ["bar", "plain", "json"] as const;
export type ProgressKind = (typeof PROGRESS_KINDS)[number];

/** Shows the events of a conversion; `stop` leaves the terminal tidy, however it ended. */
export interface Progress {
  show(event: CoreEvent): void;
  stop(): void;
}

/** A bar where a person looks on, plain lines into a file. */
export function defaultProgress(): ProgressKind {
  return process.stderr.isTTY ? "bar" : "plain";
}

export function createProgress(kind: ProgressKind): Progress {
  return { bar, plain, json }[kind]();
}

/** Share of the whole that each stage takes, by experience, so that one bar runs through. */
const STAGES: readonly { readonly stage: string; readonly share: number }[] = [
  { stage: "read", share: 0.4 },
  { stage: "build", share: 0.15 },
  { stage: "write", share: 0.45 },
];

/** Share of the whole conversion that is done, 0 to 1. */
export function overall(stage: string, done: number, total: number): number {
  let before = 0;
  for (const step of STAGES) {
    if (step.stage === stage) return before + step.share * (total > 0 ? Math.min(1, done / total) : 1);
    before += step.share;
  }
  return 0;
}

function bar(): Progress {
  const line = new SingleBar({
    format: "convert  {bar} {percentage} %  {duration_formatted}  {stage}",
    barCompleteChar: "█",
    barIncompleteChar: "░",
    hideCursor: true,
    stream: process.stderr,
  });
  line.start(1000, 0, { stage: "" });
  return {
    show(event) {
      if (event.event === "warning") process.stderr.write(`\nwarning: ${event.text}\n`);
      else
        line.update(Math.round(1000 * overall(event.stage, event.done, event.total)), { stage: event.stage });
    },
    stop: () => line.stop(),
  };
}

/** A line per stage and tenth. */
function plain(): Progress {
  let last = "";
  return {
    show(event) {
      if (event.event === "warning") {
        process.stderr.write(`warning: ${event.text}\n`);
        return;
      }
      const tenth = event.total > 0 ? Math.floor((10 * event.done) / event.total) : 10;
      const text = `${event.stage} ${10 * tenth} %`;
      if (text !== last) process.stderr.write(`${text}\n`);
      last = text;
    },
    stop: () => undefined,
  };
}

/** `{ event, stage, done, total, rate, eta }` on standard output: rate in points per second, eta in seconds. */
function json(): Progress {
  let stage = "";
  let began = performance.now();
  return {
    show(event) {
      if (event.event === "warning") {
        process.stdout.write(`${JSON.stringify(event)}\n`);
        return;
      }
      if (event.stage !== stage) {
        stage = event.stage;
        began = performance.now();
      }
      const seconds = (performance.now() - began) / 1000;
      const rate = seconds > 0 ? Math.round(event.done / seconds) : 0;
      const eta = rate > 0 ? Math.max(0, Math.round((event.total - event.done) / rate)) : null;
      process.stdout.write(`${JSON.stringify({ ...event, rate, eta })}\n`);
    },
    stop: () => undefined,
  };
}
