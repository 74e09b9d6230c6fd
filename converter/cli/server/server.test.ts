import { mkdirSync, mkdtempSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { type IncomingHttpHeaders, request, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { mountFile, type ServingOptions, serve } from "./server.js";

const base = mkdtempSync(join(tmpdir(), "groma-server-"));
const secret = join(base, "secret.txt");
const folder = join(base, "public");
const servers: Server[] = [];
let server: Server;
let address: string;

async function start(options: ServingOptions = {}) {
  const started = await serve([mountFile("/one/", secret), { path: "/", folder }], { port: 0, ...options });
  servers.push(started.server);
  return started;
}

beforeAll(async () => {
  mkdirSync(join(folder, "inner", ".git"), { recursive: true });
  mkdirSync(join(base, "public-not"));
  writeFileSync(secret, "secret");
  writeFileSync(join(base, "public-not", "other.txt"), "other");
  writeFileSync(join(folder, "data.bin"), Buffer.from([...Array(100).keys()]));
  writeFileSync(join(folder, ".hidden"), "hidden");
  writeFileSync(join(folder, "inner", ".git", "config"), "hidden");
  writeFileSync(join(folder, "a?b#c d.bin"), "odd");
  symlinkSync(secret, join(folder, "link.txt"));
  symlinkSync(join(base, "public-not"), join(folder, "out"));
  symlinkSync(join(folder, ".hidden"), join(folder, "shown.txt"));
  symlinkSync(join(folder, "data.bin"), join(folder, "inner", "data.bin"));
  ({ server, address } = await start());
});

afterAll(() => {
  for (const each of servers) each.close();
  rmSync(base, { recursive: true });
});

interface Answer {
  readonly status: number;
  readonly headers: IncomingHttpHeaders;
  readonly body: Buffer;
}

/** Asks with path and headers exactly as given; `fetch` would tidy `..` away and set `Host` itself. */
function raw(
  path: string,
  { method = "GET", headers = {}, of = server }: { method?: string; headers?: object; of?: Server } = {},
): Promise<Answer> {
  const { port } = of.address() as AddressInfo;
  return new Promise((resolve, reject) => {
    const asked = request(
      { host: "127.0.0.1", port, path, method, headers: { ...headers } },
      async (response) => {
        const body = Buffer.concat(await response.toArray());
        resolve({ status: response.statusCode ?? 0, headers: response.headers, body });
      },
    );
    asked.on("error", reject);
    asked.end();
  });
}

const range = (text: string, more: object = {}) => raw("/data.bin", { headers: { Range: text, ...more } });

describe("the server", () => {
  it.each([
    ["bytes=10-19", 10, 19],
    ["bytes=-10", 90, 99],
    ["bytes=-999999999999999999999", 0, 99],
    ["bytes=90-999999999999999999999", 90, 99],
  ])("answers %s with 206 and the bytes asked for", async (text, first, last) => {
    const { status, headers, body } = await range(text);
    expect([status, headers["content-range"]]).toEqual([206, `bytes ${first}-${last}/100`]);
    expect([...body]).toEqual(Array.from({ length: last - first + 1 }, (_, at) => first + at));
    expect(headers.etag).toBeTruthy();
  });

  it.each(["bytes=200-", "bytes=-0", "bytes=0--1", "bytes=5-2", "bytes=0-99,0-99"])(
    "answers %s with 416 and the length",
    async (text) => {
      const { status, headers, body } = await range(text);
      expect([status, headers["content-range"]]).toEqual([416, "bytes */100"]);
      expect(body.length).toBeLessThan(10);
    },
  );

  it("gives the whole file where no bytes are asked for, or the range is of another state", async () => {
    for (const answer of [await range("lines=1-2"), await range("bytes=0-1", { "If-Range": '"another"' })]) {
      expect([answer.status, answer.body.length]).toEqual([200, 100]);
    }
    const head = await raw("/data.bin", { method: "HEAD", headers: { Range: "bytes=0-1" } });
    expect([head.status, head.headers["content-length"]]).toEqual([200, "100"]);
  });

  it("has browsers guess no types and tell nobody where readers come from; a policy comes with its mount", async () => {
    const policy = "script-src 'self'";
    const { server: strict } = await serve([mountFile("/one/", secret), { path: "/", folder, policy }], {
      port: 0,
    });
    servers.push(strict);
    for (const path of ["/data.bin", "/none"]) {
      const { headers } = await raw(path, { of: strict });
      expect(headers["x-content-type-options"]).toBe("nosniff");
      expect(headers["referrer-policy"]).toBe("no-referrer");
      expect(headers["content-security-policy"]).toBe(policy);
    }
    expect((await raw("/one/secret.txt", { of: strict })).headers["content-security-policy"]).toBeUndefined();
    expect((await raw("/data.bin")).headers["content-security-policy"]).toBeUndefined();
  });

  it("answers several ranges with their parts", async () => {
    const { status, headers, body } = await range("bytes=0-1, 50-52,-1");
    expect(status).toBe(206);
    expect(headers["content-length"]).toBe(String(body.length));
    const boundary = /^multipart\/byteranges; boundary=(\w+)$/.exec(headers["content-type"] ?? "")?.[1];
    const parts = body.toString("latin1").split(`\r\n--${boundary}`);
    expect(parts.shift()).toBe("");
    expect(parts.pop()).toBe("--\r\n");
    const content = [
      ["0-1", "\x00\x01"],
      ["50-52", "234"],
      ["99-99", "c"],
    ];
    const type = "Content-Type: application/octet-stream";
    expect(parts).toEqual(
      content.map(([at, bytes]) => `\r\n${type}\r\nContent-Range: bytes ${at}/100\r\n\r\n${bytes}`),
    );
  });

  it("says 304 to who has the file, for one range and for several", async () => {
    const { headers } = await raw("/data.bin");
    for (const text of ["bytes=0-1", "bytes=0-1,5-6"]) {
      expect((await range(text, { "If-None-Match": headers.etag })).status).toBe(304);
    }
  });

  it("answers what it cannot give: 404, 405, 204 to OPTIONS", async () => {
    const status = async (path: string, method = "GET") => (await raw(path, { method })).status;
    expect(await status("/nothing")).toBe(404);
    expect(await status("/inner")).toBe(404);
    expect(await status("/inner/")).toBe(404);
    expect(await status("/data.bin/")).toBe(404);
    expect(await status("/data.bin", "POST")).toBe(405);
    expect(await status("/data.bin", "OPTIONS")).toBe(204);
  });

  it.each([
    "/../secret.txt",
    "/%2e%2e/secret.txt",
    "/..%2fsecret.txt",
    "/..%5csecret.txt",
    "//../secret.txt",
    "/one/../../secret.txt",
    "/one/%2e%2e%2fsecret.txt",
    "/link.txt",
    "/out/other.txt",
    "/%2e%2e/public-not/other.txt",
    "/.hidden",
    "/shown.txt",
    "/inner/.git/config",
    "/a%00b",
    "/%zz",
  ])("does not give %s", async (path) => {
    const { status, body } = await raw(path);
    expect([400, 404]).toContain(status);
    expect(body.toString()).not.toMatch(/secret|hidden|other/);
  });

  it("follows links that stay inside, and serves odd names", async () => {
    expect((await raw("/inner/data.bin")).status).toBe(200);
    expect((await raw("/a%3Fb%23c%20d.bin")).body.toString()).toBe("odd");
  });

  it("gives of a single-file mount that file only", async () => {
    expect((await raw("/one/secret.txt")).status).toBe(200);
    expect((await raw("/one/public/data.bin")).status).toBe(404);
  });

  it("takes the next port when the one asked for is taken", async () => {
    const { port } = server.address() as AddressInfo;
    const second = await start({ port });
    expect((second.server.address() as AddressInfo).port).toBeGreaterThan(port);
  });
});

describe("who may read from the server", () => {
  const data = (headers: object, of?: Server) => raw("/data.bin", { headers, ...(of && { of }) });

  it("answers under loopback names only: a site whose name leads here gets nothing", async () => {
    for (const Host of ["localhost", "127.0.0.1:8080"]) expect((await data({ Host })).status).toBe(200);
    for (const Host of ["evil.example", "localhost.evil.example:8080"]) {
      const { status, body } = await data({ Host });
      expect([status, body.length < 100]).toEqual([421, true]);
    }
  });

  it("lets its own pages and those of loopback hosts read, and no site", async () => {
    for (const Origin of [new URL(address).origin, "http://127.0.0.1:5173"]) {
      const { status, headers } = await data({ Host: new URL(address).host, Origin });
      expect([status, headers["access-control-allow-origin"]]).toEqual([200, Origin]);
      expect(headers["access-control-expose-headers"]).toMatch(/Content-Range/);
    }
    for (const Origin of ["https://evil.example", "null"]) {
      for (const method of ["GET", "HEAD", "OPTIONS"]) {
        const answer = await raw("/data.bin", { method, headers: { Origin } });
        expect([answer.status, answer.headers["access-control-allow-origin"]]).toEqual([403, undefined]);
        expect(answer.body.length).toBeLessThan(100);
      }
    }
    const { headers } = await data({});
    expect(headers["access-control-allow-origin"]).toBeUndefined();
    expect(headers["cross-origin-resource-policy"]).toBe("same-site");
    expect(headers.vary).toBe("Origin");
  });

  it("lets those read that --cors names, or all; the host name still counts", async () => {
    const listed = (await start({ cors: ["https://a.example"] })).server;
    expect((await data({ Origin: "https://a.example" }, listed)).headers).toMatchObject({
      "access-control-allow-origin": "https://a.example",
    });
    expect((await data({ Origin: "https://b.example" }, listed)).status).toBe(403);
    const open = (await start({ cors: "any" })).server;
    for (const headers of [{ Origin: "null" }, {}]) {
      expect((await data(headers, open)).headers).toMatchObject({
        "access-control-allow-origin": "*",
        "cross-origin-resource-policy": "cross-origin",
      });
    }
    expect((await data({ Host: "evil.example", Origin: "https://b.example" }, open)).status).toBe(421);
  });
});
