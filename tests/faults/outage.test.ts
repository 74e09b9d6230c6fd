import { readFileSync } from "node:fs";
import {
  type NodeExecutor,
  type NodeVertices,
  PointCloud,
  type PointCloudOptions,
  type ServerWait,
} from "@groma/layer";
import { type HierarchyEntry, openSource } from "@groma/layer/sources";
import { afterEach, describe, expect, it } from "vitest";
import { data } from "../project.js";
import { type Asked, BadServer, type Misbehaviour } from "./bad-server.js";
import { localExecutor } from "./local-executor.js";
import { isComplete, type Watched, watch } from "./watched-view.js";

/** 73 nodes of some eighty points each. */
const scan = data("reports/k03_geokeys_only.copc.laz");
const file = scan.missing ? new Uint8Array() : readFileSync(scan.path);

/** Where bytes lie in the file. */
interface Span {
  readonly offset: number;
  readonly length: number;
}

const quick = {
  retry: { attempts: 6, backoff: 20 },
  timeout: 3000,
  // Hardly more than the header, so that all nodes are asked for by themselves.
  headLength: 1024,
  crs: "+proj=utm +zone=31 +datum=WGS84 +units=m",
};

/** Takes every chunk for decoded: what matters here is how the bytes come. */
const undecoded = (): NodeExecutor => ({
  addDataSet: () => 1,
  removeDataSet: () => undefined,
  run: async ({ pointCount, cube: [x, y, z] }) =>
    ({ count: pointCount, bytes: 1, rgbBits: 8, extent: Float64Array.of(x, y, z, x, y, z) }) as NodeVertices,
  records: () => Promise.reject(new Error("no record is read here")),
  pending: 0,
  destroy: () => undefined,
});

const open = (from: Parameters<typeof PointCloud.fromUrl>[0], options: PointCloudOptions = {}) =>
  PointCloud.fromUrl(from, { ...quick, executor: undecoded(), ...options });

let server: BadServer;
let cloud: PointCloud | undefined;
let view: Watched | undefined;

/** Opens the file from a server that behaves, and misbehaves from then on. */
async function watched(misbehave: Misbehaviour, options: PointCloudOptions = {}): Promise<Watched> {
  server = await BadServer.start(file);
  cloud = await open(server.url, options);
  server.misbehave = misbehave;
  view = watch(cloud);
  return view;
}

/** Misbehaves for a time, and behaves after that. */
function during(milliseconds: number, misbehave: Misbehaviour): Misbehaviour {
  let end: number | undefined;
  return (asked) => {
    end ??= performance.now() + milliseconds;
    if (performance.now() < end) misbehave(asked);
    else asked.answer();
  };
}

const busy =
  (status: number, headers = {}): Misbehaviour =>
  ({ response }) =>
    response.writeHead(status, headers).end();
const circle: Misbehaviour = ({ response, request }) =>
  response.writeHead(302, { Location: request.url ?? "" }).end();

describe.skipIf(scan.missing)(
  `a server that fails for a time${scan.missing ? ` (skipped: ${scan.missing})` : ""}`,
  () => {
    afterEach(async () => {
      view?.end();
      cloud?.destroy();
      [view, cloud] = [undefined, undefined];
      await server.stop();
    });

    it.each<[string, Misbehaviour, string]>([
      ["is busy", busy(503), "busy"],
      ["breaks down", busy(500), "failing"],
      ["hangs up", ({ request }) => request.socket.destroy(), "unreachable"],
      ["sends less than it says", ({ answer }) => answer({}, file.subarray(0, 9)), "failing"],
    ])(
      "that %s: all comes by itself, in a few requests, and the state is told meanwhile",
      async (_, fault, outage) => {
        const { seen, failed, until } = await watched(during(300, fault));
        const before = server.requests;
        const { wanted } = await until(isComplete);
        expect(wanted).toBeGreaterThan(8);
        expect(failed).toEqual([]);
        const waits = seen.flatMap(({ waiting }) => waiting ?? []);
        expect(new Set(waits.map((wait) => wait.outage))).toEqual(new Set([outage]));
        expect(waits.some(({ until: next }) => next !== undefined)).toBe(true);
        // The first requests at once, then one per pause of 20, 40, 80 and 160 ms.
        expect(server.requests - before).toBeLessThan(wanted + 8 + 8);
        expect(view?.seen.at(-1)?.waiting).toBeUndefined();
      },
    );

    it("comes by itself after more failures than one read puts up with", async () => {
      const retry = { attempts: 1, backoff: 5 };
      const { seen, failed, until } = await watched(during(300, busy(503)), { retry });
      await until(isComplete);
      expect(failed).toEqual([]);
      expect(seen.some(({ waiting }) => waiting?.until !== undefined)).toBe(true);
      expect(seen.every((progress) => progress.failed === 0)).toBe(true);
    });

    it("is not asked before the time that it names", async () => {
      const { until } = await watched(during(500, busy(429, { "Retry-After": "1" })));
      const first = server.requests;
      const { waiting } = await until((progress) => progress.waiting?.until !== undefined);
      expect((waiting?.until ?? 0) - Date.now()).toBeGreaterThan(500);
      await until(isComplete);
      const since = server.log.slice(first).map(({ at }) => at - server.log[first].at);
      // What was on its way when the first answer came, and then nothing for a second.
      expect(since.filter((at) => at > 400 && at < 950)).toEqual([]);
      expect(since.filter((at) => at < 950).length).toBeLessThanOrEqual(8);
    });

    it("tells of silence soon, long before it gives up a request", async () => {
      const { until } = await watched(
        during(100, () => undefined),
        { timeout: 2000 },
      );
      const start = performance.now();
      const { waiting } = await until((progress) => progress.waiting !== undefined);
      expect(performance.now() - start).toBeLessThan(1500);
      expect(waiting).toMatchObject({ outage: "silent", code: "SOURCE_TIMEOUT", until: undefined });
      await until(isComplete);
    });

    it("does not open for ever: silence has an end, and is told", async () => {
      server = await BadServer.start(file, () => undefined);
      const told: (ServerWait | undefined)[] = [];
      const onWait = (wait: ServerWait | undefined) => told.push(wait);
      const start = performance.now();
      const retry = { attempts: 100, backoff: 10, patience: 300 };
      const opening = open(server.url, { retry, onWait, timeout: 150 });
      await expect(opening).rejects.toMatchObject({ code: "SOURCE_TIMEOUT" });
      expect(performance.now() - start).toBeLessThan(10_000);
      expect(told[0]).toMatchObject({ outage: "silent" });
    });

    it("opens once a busy server is back", async () => {
      server = await BadServer.start(file, during(200, busy(503)));
      const told: (ServerWait | undefined)[] = [];
      const onWait = (wait: ServerWait | undefined) => told.push(wait);
      cloud = await open(server.url, { onWait });
      expect(told[0]).toMatchObject({ outage: "busy" });
      expect(told.at(-1)).toBeUndefined();
    });

    it.each<[string, string, (asked: Asked, bad: Span) => void]>([
      ["SOURCE_NOT_FOUND", "is gone", busy(404)],
      ["SOURCE_NOT_FOUND", "is gone for good", busy(410)],
      [
        "DECODE_CHUNK",
        "is damaged",
        ({ answer, first, last }, { offset, length }) =>
          answer(
            {},
            file.slice(first, last + 1).fill(0, Math.max(0, offset - first), offset + length - first),
          ),
      ],
    ])("%s: what %s is not asked for again, and the view is never complete", async (code, _, fault) => {
      const source = await openSource(new Blob([file.slice()]));
      const entries = [...(await source.page(source.rootPage))] as HierarchyEntry<Span>[];
      // Not the first of all nodes, which decides how the others are read.
      const bad = entries.filter(({ pointCount }) => pointCount > 0)[5].address;
      const touches = ({ first, last }: Pick<Asked, "first" | "last">) =>
        first < bad.offset + bad.length && last >= bad.offset;
      let met = 0;
      const misbehave = (asked: Asked) => {
        if (!touches(asked)) return asked.answer();
        met++;
        fault(asked, bad);
      };
      const { failed, seen, until } = await watched(misbehave, { executor: localExecutor() });
      await until(({ pending }) => pending === 0);
      expect(failed).toEqual([code]);
      expect(seen.at(-1)).toMatchObject({ failed: 1 });
      // Together with its neighbours, and by itself.
      expect(met).toBeLessThanOrEqual(2);
    });

    it("SOURCE_REDIRECT: redirects in a circle are followed once, when opening and later", async () => {
      const { failed, until } = await watched(circle);
      const opening = server.requests;
      const { wanted } = await until(({ pending }) => pending === 0);
      expect(failed).toEqual(Array.from({ length: wanted }, () => "SOURCE_REDIRECT"));
      expect(server.requests - opening).toBeLessThan(wanted + 25);
      await server.stop();
      server = await BadServer.start(file, circle);
      await expect(open(server.url)).rejects.toMatchObject({ code: "SOURCE_REDIRECT" });
      expect(server.requests).toBeLessThan(25);
    });

    it("follows redirects that lead to the file, be they there from the beginning or not", async () => {
      const away: Misbehaviour = ({ request, response, answer }) => {
        if (request.url?.includes("?moved")) answer();
        else response.writeHead(307, { Location: "?moved" }).end();
      };
      const { failed, until } = await watched(away);
      await until(isComplete);
      expect(failed).toEqual([]);
      await server.stop();
      server = await BadServer.start(file, away);
      const other = await open(server.url);
      expect((await other.loadNode("0-0-0-0")).count).toBeGreaterThan(0);
      other.destroy();
    });
  },
);

describe.skipIf(scan.missing)(
  `an address and headers that end${scan.missing ? ` (skipped: ${scan.missing})` : ""}`,
  () => {
    /** Accepts only the signature, or the token, of the number given. */
    const only =
      (valid: () => number, status: number): Misbehaviour =>
      ({ request, response, answer }) => {
        const number = /sig=(\d+)/.exec(`${request.url}${request.headers.authorization}`)?.[1];
        if (Number(number) === valid()) answer();
        else response.writeHead(status).end();
      };

    afterEach(async () => {
      view?.end();
      cloud?.destroy();
      await server.stop();
    });

    it.each([401, 403])("renews them once for all reads that are refused with %i", async (status) => {
      let valid = 1;
      const reasons: string[] = [];
      server = await BadServer.start(
        file,
        only(() => valid, status),
      );
      const { url } = server;
      cloud = await open(async ({ reason }) => {
        reasons.push(reason);
        return `${url}?sig=${reasons.length}`;
      });
      valid = 2;
      view = watch(cloud);
      await view.until(isComplete);
      expect(reasons).toEqual(["open", "denied"]);
      expect(view.failed).toEqual([]);
    });

    it("renews headers too", async () => {
      let valid = 1;
      let calls = 0;
      server = await BadServer.start(
        file,
        only(() => valid, 401),
      );
      const headers = () => ({ Authorization: `Bearer sig=${++calls}` });
      cloud = await open(server.url, { headers });
      valid = 2;
      view = watch(cloud);
      await view.until(isComplete);
      expect([calls, view.failed]).toEqual([2, []]);
    });

    it("SOURCE_DENIED: gives up where the renewed one is refused too, and keeps the signature to itself", async () => {
      server = await BadServer.start(file, busy(403));
      const { url } = server;
      const opening = open(() => `${url}?sig=secret`);
      const error = await opening.catch((thrown: unknown) => thrown);
      expect(error).toMatchObject({ code: "SOURCE_DENIED", file: url });
      expect(String(error)).not.toMatch(/secret/);
      expect(server.requests).toBe(2);
    });

    it("asks for another address before the former has expired", async () => {
      server = await BadServer.start(file);
      const { url } = server;
      const reasons: string[] = [];
      cloud = await open(({ reason }) => {
        reasons.push(reason);
        return { url, expires: Date.now() + 1000 };
      });
      // Within five seconds of its end an address is renewed with every request.
      expect(new Set(reasons)).toEqual(new Set(["open", "expired"]));
      expect(reasons.length).toBe(server.requests + 1);
    });
  },
);
