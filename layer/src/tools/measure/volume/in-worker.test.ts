import { describe, expect, it } from "vitest";
import { MeasureError, toWire } from "../../../errors/index.js";
import { inWorker, type VolumeReply, type VolumeWorker } from "./in-worker.js";
import { runVolumeJob, type VolumeJob } from "./volume-job.js";

/** A worker whose answers the test gives. */
class FakeWorker implements VolumeWorker {
  onmessage: VolumeWorker["onmessage"] = null;
  onerror: VolumeWorker["onerror"] = null;
  given: Transferable[] = [];
  ended = false;

  postMessage(_job: VolumeJob, transfer: Transferable[]): void {
    this.given = transfer;
  }

  terminate(): void {
    this.ended = true;
  }

  answer(data: VolumeReply): void {
    this.onmessage?.({ data } as MessageEvent<VolumeReply>);
  }
}

const square = (half: number) =>
  Float64Array.of(-half, -half, 2, half, -half, 2, half, half, 2, -half, half, 2);
const job = (): VolumeJob => ({
  points: [square(2).subarray(0, 6), square(2).subarray(6)],
  outline: square(1),
  base: { points: [square(3).map((value, at) => (at % 3 === 2 ? value - 1 : value))] },
});

describe("a volume in a worker", () => {
  it("is the sum of what was read in parts, and says how far it is", () => {
    const shares: number[] = [];
    const { whole, area, covered, points } = runVolumeJob(job(), (share) => shares.push(share));
    // Two diagonals lie on each other, and with them the surfaces' points: one metre over four square metres.
    expect([whole.cut, whole.fill, area, covered]).toEqual(
      [4, 0, 4, 4].map((value) => expect.closeTo(value, 9)),
    );
    expect(points).toBeGreaterThanOrEqual(4);
    expect(shares).toEqual([...shares].sort((a, b) => a - b));
    expect(shares.at(-1)).toBe(1);
  });

  it("gives its points away, and ends the worker with the answer", async () => {
    const worker = new FakeWorker();
    const shares: number[] = [];
    const asked = job();
    const volume = inWorker(asked, { onProgress: (share) => shares.push(share), createWorker: () => worker });
    expect(new Set(worker.given)).toEqual(
      new Set(
        [...asked.points, ...(asked.base as { points: Float64Array[] }).points].map(({ buffer }) => buffer),
      ),
    );
    const sums = runVolumeJob(job(), () => undefined);
    worker.answer({ kind: "progress", share: 0.5 });
    expect(worker.ended).toBe(false);
    worker.answer({ kind: "done", sums });
    expect(await volume).toBe(sums);
    expect([shares, worker.ended]).toEqual([[0.5], true]);
  });

  it("ends with the signal", async () => {
    const worker = new FakeWorker();
    const stop = new AbortController();
    const volume = inWorker(job(), {
      signal: stop.signal,
      onProgress: () => undefined,
      createWorker: () => worker,
    });
    stop.abort(new Error("enough"));
    await expect(volume).rejects.toThrow("enough");
    expect(worker.ended).toBe(true);
    const none = { signal: stop.signal, onProgress: () => undefined, createWorker: () => new FakeWorker() };
    await expect(inWorker(job(), none)).rejects.toThrow("enough");
  });

  it("fails with the error of the work, or of the worker", async () => {
    const cases: [(worker: FakeWorker) => void, string][] = [
      [
        (worker) => {
          const fault = { code: "MEASURE_SURFACE", file: "volume", cause: "none", fix: "more" };
          const wire = toWire(new MeasureError(fault), { ...fault, code: "OTHER" });
          worker.answer({ kind: "failed", fault: structuredClone(wire) });
        },
        "MEASURE_SURFACE",
      ],
      [
        (worker) => worker.onerror?.({ message: "", preventDefault: () => undefined } as ErrorEvent),
        "MEASURE_WORKER",
      ],
    ];
    for (const [happens, code] of cases) {
      const worker = new FakeWorker();
      const volume = inWorker(job(), { onProgress: () => undefined, createWorker: () => worker });
      happens(worker);
      const thrown = await volume.catch((one: unknown) => one);
      expect(thrown).toBeInstanceOf(MeasureError);
      expect(thrown).toMatchObject({ code });
      expect(worker.ended).toBe(true);
    }
  });
});
