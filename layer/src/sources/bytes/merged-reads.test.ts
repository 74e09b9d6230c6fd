import fc from "fast-check";
import { expect, it } from "vitest";
import { SourceError } from "../../errors/index.js";
import { type BytesRequest, MergedReads } from "./merged-reads.js";

const FILE = Uint8Array.from({ length: 4 * 1024 * 1024 }, (_, index) => (index * 31 + (index >> 8)) & 255);

/** A file that keeps the requests made of it, each with what answers and refuses it. */
function watched() {
  const asked: (BytesRequest & { answer: () => void; refuse: (reason: unknown) => void })[] = [];
  const reads = new MergedReads(
    (request) =>
      new Promise((resolve, refuse) => {
        const answer = () => resolve(FILE.slice(request.begin, request.end));
        asked.push({ ...request, answer, refuse });
        request.signal.addEventListener("abort", () => refuse(request.signal.reason));
      }),
  );
  const ranges = () => asked.map(({ begin, end }) => [begin, end]);
  return { reads, asked, ranges };
}

const task = () => new Promise((resolve) => setTimeout(resolve, 5));

it("asks once for reads that lie next to each other, the first asked for first", async () => {
  const { reads, asked, ranges } = watched();
  const spans = [
    [900_000, 900_100],
    [200, 300],
    [100, 200],
    [300 + 4096, 5000],
    [100_000, 100_010],
  ] as const;
  const answers = spans.map(([begin, end]) => reads.read(begin, end, undefined));
  await task();
  await task();
  expect(ranges()).toEqual([
    [900_000, 900_100],
    [100, 5000],
    [100_000, 100_010],
  ]);
  for (const { answer } of asked) answer();
  const bytes = await Promise.all(answers);
  expect(bytes).toEqual(spans.map(([begin, end]) => FILE.slice(begin, end)));
});

it("makes no request longer than a mebibyte of several reads", async () => {
  const { reads, ranges } = watched();
  for (let at = 0; at < 3; at++) void reads.read(at * 500_000, (at + 1) * 500_000, undefined);
  void reads.read(1_600_000, 3_600_000, undefined);
  await task();
  await task();
  expect(ranges()).toEqual([
    [0, 1_000_000],
    [1_000_000, 1_500_000],
    [1_600_000, 3_600_000],
  ]);
});

it("answers each read as soon as its bytes are there", async () => {
  const { reads, asked } = watched();
  const first = reads.read(0, 10, undefined);
  const second = reads.read(10, 30, undefined);
  await task();
  const [{ arrived }] = asked;
  const some = new Uint8Array(30);
  some.set(FILE.subarray(0, 12));
  arrived(some, 12);
  expect(await first).toEqual(FILE.slice(0, 10));
  asked[0].answer();
  expect(await second).toEqual(FILE.slice(10, 30));
});

it("tries reads by themselves where they fail together, unless the server is to be waited for", async () => {
  const { reads, asked, ranges } = watched();
  const first = reads.read(0, 10, undefined);
  const second = reads.read(10, 30, undefined);
  await task();
  asked[0].refuse("a hole in the file");
  await task();
  expect(ranges().slice(1)).toEqual([
    [0, 10],
    [10, 30],
  ]);
  asked[1].answer();
  asked[2].refuse("still there");
  expect(await first).toEqual(FILE.slice(0, 10));
  await expect(second).rejects.toBe("still there");

  const both = [reads.read(0, 10, undefined), reads.read(10, 30, undefined)];
  await task();
  const busy = new SourceError({ code: "SOURCE_HTTP", file: "a", cause: "b", fix: "c", outage: "busy" });
  asked[3].refuse(busy);
  for (const read of both) await expect(read).rejects.toBe(busy);
  expect(asked).toHaveLength(4);
});

it("gives one read up and goes on for the others, and ends once all are given up", async () => {
  const { reads, asked } = watched();
  const [one, two] = [new AbortController(), new AbortController()];
  const first = reads.read(0, 10, one.signal);
  const second = reads.read(10, 30, two.signal);
  await task();
  one.abort("first");
  await expect(first).rejects.toBe("first");
  expect(asked[0].signal.aborted).toBe(false);
  two.abort("second");
  await expect(second).rejects.toBe("second");
  expect(asked[0].signal.aborted).toBe(true);
});

it("asks for nothing that was given up before its turn", async () => {
  const { reads, ranges } = watched();
  const controller = new AbortController();
  const read = reads.read(0, 10, controller.signal);
  controller.abort("changed my mind");
  await expect(read).rejects.toBe("changed my mind");
  await task();
  expect(ranges()).toEqual([]);
});

it("gives everyone their bytes, whatever is asked for", async () => {
  const span = fc.tuple(fc.integer({ min: 0, max: 50_000 }), fc.integer({ min: 1, max: 9000 }));
  await fc.assert(
    fc.asyncProperty(fc.array(span, { minLength: 1, maxLength: 12 }), async (spans) => {
      const { reads, asked } = watched();
      const answers = spans.map(([begin, length]) => reads.read(begin, begin + length, undefined));
      let next = 0;
      while (asked.length === 0 || next < asked.length) {
        await new Promise((resolve) => setTimeout(resolve));
        for (; next < asked.length; next++) asked[next].answer();
        await new Promise((resolve) => setTimeout(resolve, 1));
      }
      const bytes = await Promise.all(answers);
      const expected = spans.map(([begin, length]) => FILE.slice(begin, begin + length));
      expect(bytes).toEqual(expected);
    }),
    { numRuns: 15 },
  );
});
