interface TraceEvent {
  readonly name: string;
  readonly ph: string;
  readonly pid: number;
  readonly tid: number;
  /** Microseconds of the thread itself, whatever else the machine does. */
  readonly tdur?: number;
  readonly dur?: number;
  readonly args?: { readonly name?: string };
}

/** The longest task of a page's main thread, milliseconds: of the thread, and by the clock. */
export function longestTask(trace: Buffer): { threadMs: number; clockMs: number; tasks: number } {
  const { traceEvents } = JSON.parse(trace.toString("utf8")) as { traceEvents: TraceEvent[] };
  const mains = new Set(
    traceEvents
      .filter(({ name, args }) => name === "thread_name" && args?.name === "CrRendererMain")
      .map(({ pid, tid }) => `${pid} ${tid}`),
  );
  const tasks = traceEvents.filter(
    ({ name, ph, pid, tid }) => ph === "X" && name.endsWith("RunTask") && mains.has(`${pid} ${tid}`),
  );
  const most = (values: (number | undefined)[]) => Math.max(0, ...values.map((value) => value ?? 0)) / 1000;
  return {
    threadMs: most(tasks.map(({ tdur }) => tdur)),
    clockMs: most(tasks.map(({ dur }) => dur)),
    tasks: tasks.length,
  };
}
