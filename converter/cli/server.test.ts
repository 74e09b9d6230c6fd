import { mkdirSync, mkdtempSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { request, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { mountFile, serve } from "./server.js";

const base = mkdtempSync(join(tmpdir(), "groma-server-"));
const secret = join(base, "secret.txt");
const folder = join(base, "public");
let server: Server;
let address: string;

beforeAll(async () => {
  mkdirSync(join(folder, "inner"), { recursive: true });
  writeFileSync(secret, "secret");
  writeFileSync(join(folder, "data.bin"), Buffer.from([...Array(100).keys()]));
  writeFileSync(join(folder, ".hidden"), "hidden");
  writeFileSync(join(folder, "a?b#c d.bin"), "odd");
  symlinkSync(secret, join(folder, "link.txt"));
  symlinkSync(join(folder, "data.bin"), join(folder, "inner", "data.bin"));
  ({ server, address } = await serve([mountFile("/one/", secret), { path: "/", folder }], { port: 0 }));
});

afterAll(() => {
  server.close();
  rmSync(base, { recursive: true });
});

/** Asks with the path exactly as given; `fetch` would tidy `..` away. */
function raw(path: string, method = "GET"): Promise<number> {
  const { port } = server.address() as AddressInfo;
  return new Promise((resolve, reject) => {
    const asked = request({ host: "127.0.0.1", port, path, method }, (response) => {
      response.resume();
      resolve(response.statusCode ?? 0);
    });
    asked.on("error", reject);
    asked.end();
  });
}

describe("the server", () => {
  it("answers a Range with 206, the bytes asked for, and headers that other pages may read", async () => {
    const response = await fetch(`${address}data.bin`, { headers: { Range: "bytes=10-19" } });
    expect(response.status).toBe(206);
    expect(response.headers.get("content-range")).toBe("bytes 10-19/100");
    expect([...new Uint8Array(await response.arrayBuffer())]).toEqual([
      10, 11, 12, 13, 14, 15, 16, 17, 18, 19,
    ]);
    expect(response.headers.get("access-control-allow-origin")).toBe("*");
    expect(response.headers.get("access-control-expose-headers")).toMatch(/Content-Range/);
    expect(response.headers.get("etag")).toBeTruthy();
  });

  it("answers what it cannot give: 416, 404, 405, 204 to OPTIONS", async () => {
    const beyond = await fetch(`${address}data.bin`, { headers: { Range: "bytes=200-" } });
    expect(beyond.status).toBe(416);
    expect(await raw("/nothing")).toBe(404);
    expect(await raw("/inner")).toBe(404);
    expect(await raw("/data.bin", "POST")).toBe(405);
    expect(await raw("/data.bin", "OPTIONS")).toBe(204);
  });

  it.each([
    "/../secret.txt",
    "/%2e%2e/secret.txt",
    "/..%2fsecret.txt",
    "/link.txt",
    "/.hidden",
    "/a%00b",
    "/%zz",
  ])("does not give %s", async (path) => {
    expect([400, 403, 404]).toContain(await raw(path));
  });

  it("follows links that stay inside, and serves odd names", async () => {
    expect(await raw("/inner/data.bin")).toBe(200);
    expect(await raw("/a%3Fb%23c%20d.bin")).toBe(200);
  });

  it("gives of a single-file mount that file only", async () => {
    expect(await raw("/one/secret.txt")).toBe(200);
    expect(await raw("/one/public/data.bin")).toBe(404);
  });

  it("takes the next port when the one asked for is taken", async () => {
    const { port } = server.address() as AddressInfo;
    const second = await serve([{ path: "/", folder }], { port });
    expect((second.server.address() as AddressInfo).port).toBeGreaterThan(port);
    second.server.close();
  });
});
