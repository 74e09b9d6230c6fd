import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { type Outage, SourceError } from "../../errors/index.js";
import { HostSchedule, type Turn } from "./host-schedule.js";

const FOREVER = Number.POSITIVE_INFINITY;
const fault = (outage: Outage = "failing") =>
  new SourceError({ code: "SOURCE_HTTP", file: "a", cause: "it fails", fix: "Wait", outage });
const pause = (backoff = 100, asked?: number) => ({ backoff, asked });

beforeEach(() => {
  vi.useFakeTimers();
  vi.spyOn(Math, "random").mockReturnValue(0.5);
});
afterEach(() => {
  vi.useRealTimers();
  vi.restoreAllMocks();
});

/** Requests that ask to be let through; those that were, in order. */
function queue(schedule: HostSchedule) {
  const turns: Turn[] = [];
  const ask = (count = 1, deadline = FOREVER) => {
    for (let at = 0; at < count; at++) {
      void schedule.enter(deadline).then((turn) => turn && turns.push(turn));
    }
  };
  /** Milliseconds pass. @returns how many were let through meanwhile */
  const pass = async (milliseconds = 0) => {
    const before = turns.length;
    await vi.advanceTimersByTimeAsync(milliseconds);
    return turns.length - before;
  };
  return { turns, ask, pass };
}

describe("HostSchedule", () => {
  it("lets all through while the server answers", async () => {
    const schedule = new HostSchedule();
    const { ask, pass } = queue(schedule);
    ask(20);
    expect(await pass()).toBe(20);
    expect(schedule.wait).toBeUndefined();
  });

  it("lets one through at a time while the server fails, after pauses that double up to a minute", async () => {
    const schedule = new HostSchedule();
    const { turns, ask, pass } = queue(schedule);
    ask();
    await pass();
    ask(3);
    await pass();
    turns[0].failed(fault(), pause());
    ask(5);
    turns[1].left();
    turns[2].left();
    turns[3].left();
    for (let failures = 1; failures <= 12; failures++) {
      const expected = Math.min(100 * 2 ** (failures - 1), 60_000);
      expect(schedule.wait?.until).toBe(Date.now() + expected);
      expect(await pass(expected - 1)).toBe(0);
      expect(await pass(1)).toBe(1);
      expect(schedule.wait).toMatchObject({ outage: "failing", cause: "it fails", until: undefined });
      expect(await pass(1000)).toBe(0);
      ask();
      turns.at(-1)?.failed(fault(), pause());
    }
  });

  it("takes failures of requests beside each other for one", async () => {
    const schedule = new HostSchedule();
    const { turns, ask, pass } = queue(schedule);
    ask(8);
    await pass();
    for (const turn of turns) turn.failed(fault(), pause());
    expect(schedule.wait?.until).toBe(Date.now() + 100);
  });

  it("waits as long as the server asks, at most five minutes, whatever others had got meanwhile", async () => {
    const schedule = new HostSchedule();
    const { turns, ask, pass } = queue(schedule);
    ask(2);
    await pass();
    turns[0].failed(fault("busy"), pause(100, 3000));
    turns[1].answered();
    ask();
    expect(schedule.wait).toMatchObject({ outage: "busy", until: Date.now() + 3150 });
    expect(await pass(3149)).toBe(0);
    expect(await pass(1)).toBe(1);
    turns[2].failed(fault("busy"), pause(100, 1e9));
    expect(schedule.wait?.until).toBe(Date.now() + 315_000);
  });

  it("ends a pause of its own where somebody wants to know, never one that the server asked for", async () => {
    const schedule = new HostSchedule();
    const { turns, ask, pass } = queue(schedule);
    ask();
    await pass();
    turns[0].failed(fault(), pause(50_000));
    ask();
    expect(await pass()).toBe(0);
    schedule.hasten();
    expect(await pass()).toBe(1);
    turns[1].failed(fault("busy"), pause(50_000, 1000));
    ask();
    schedule.hasten();
    expect(await pass(1049)).toBe(0);
    expect(await pass(1)).toBe(1);
  });

  it("opens step by step once the server answers again", async () => {
    const schedule = new HostSchedule();
    const { turns, ask, pass } = queue(schedule);
    ask();
    await pass();
    turns[0].failed(fault(), pause());
    ask(40);
    expect(await pass(100)).toBe(1);
    turns[1].answered();
    expect(schedule.wait).toBeUndefined();
    expect(await pass()).toBe(2);
    turns[2].answered();
    expect(await pass()).toBe(3);
  });

  it("gives up whom the next request comes too late for, and whom nobody waits for", async () => {
    const schedule = new HostSchedule();
    const { turns, ask, pass } = queue(schedule);
    ask();
    await pass();
    turns[0].failed(fault(), pause(1000));
    await expect(schedule.enter(Date.now() + 999)).resolves.toBeUndefined();
    const controller = new AbortController();
    const waiting = schedule.enter(FOREVER, controller.signal);
    controller.abort();
    await expect(waiting).rejects.toThrow(expect.objectContaining({ name: "AbortError" }));
    ask();
    expect(await pass(1000)).toBe(1);
  });

  it("tells of silence, and no longer once something is heard", async () => {
    const schedule = new HostSchedule();
    const told: unknown[] = [];
    schedule.subscribe(() => told.push(schedule.wait?.outage));
    const { turns, ask, pass } = queue(schedule);
    ask(2);
    await pass();
    turns[0].silent(fault("silent"));
    turns[1].silent(fault("silent"));
    turns[1].heard();
    turns[0].silent(fault("silent"));
    turns[1].left();
    turns[0].left();
    expect(told).toEqual(["silent", undefined, "silent", undefined]);
  });
});
