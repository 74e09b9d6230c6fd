/** Categories of the browser's trace that hold the marks and the garbage collections. */
export const CATEGORIES = ["blink.user_timing", "devtools.timeline"];

/**
 * The phases that a page marked, each with its frames and messages: CPU milliseconds of the page's thread by part (what
 * a part holds that is a part of its own counts there, garbage collections among them), and wall milliseconds in `wall`;
 * messages without garbage collections.
 *
 * @param {Buffer} trace JSON
 */
export function phasesOf(trace) {
  const events = JSON.parse(trace.toString()).traceEvents;
  const marks = events.filter(
    ({ cat, name }) => cat.includes("blink.user_timing") && /^([<>]|frame$|phase )/.test(name),
  );
  marks.push(...collections(events, marks[0]));
  marks.sort((a, b) => a.ts - b.ts);
  const phases = [];
  const open = [];
  let frame;
  for (const { name, ts, tts } of marks) {
    if (name === "frame") {
      frame = { cpu: {}, wall: {} };
      phases.at(-1).frames.push(frame);
    } else if (name.startsWith("phase "))
      phases.push({ name: name.slice("phase ".length), frames: [], messages: [] });
    else if (name !== "<") open.push({ part: name.slice(2), ts, tts, cpu: 0, wall: 0, garbage: 0 });
    else {
      const { part, ...began } = open.pop();
      const cpu = (tts - began.tts) / 1000;
      const wall = (ts - began.ts) / 1000;
      const outer = open.at(-1);
      if (outer) {
        outer.cpu += cpu;
        outer.wall += wall;
      }
      if (part === "garbage") for (const around of open) around.garbage += cpu;
      if (part === "message") phases.at(-1)?.messages.push(cpu - began.garbage);
      else if (frame) {
        frame.cpu[part] = (frame.cpu[part] ?? 0) + cpu - began.cpu;
        frame.wall[part] = (frame.wall[part] ?? 0) + wall - began.wall;
      }
    }
  }
  return phases;
}

/** Garbage collections of a thread, as marks of a part. */
function collections(events, { pid, tid }) {
  return events
    .filter((event) => event.pid === pid && event.tid === tid && /^(Major|Minor)GC$/.test(event.name))
    .flatMap(({ ts, tts, dur, tdur }) => [
      { name: "> garbage", ts, tts },
      { name: "<", ts: ts + dur, tts: tts + tdur },
    ]);
}
