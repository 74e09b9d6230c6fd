import { open, stat } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join, normalize } from "node:path";
import { gzipSync } from "node:zlib";

const TYPES = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".wasm": "application/wasm",
  ".css": "text/css",
};

/** What is sent at once, bytes. */
const SLICE = 16_384;

/**
 * A server at the end of a line: all answers together come at its speed, each after its delay.
 *
 * @param {readonly [string, string][]} folders what an address begins with, and the folder or file there; the first that fits counts
 * @param {{ bitsPerSecond: number, delay: number }} line delay in milliseconds
 */
export async function serveOver(folders, { bitsPerSecond, delay }) {
  /** When the line has sent all that it was given, on the clock of `performance.now`. */
  let free = 0;
  const asked = [];
  const server = createServer(async (request, response) => {
    const { pathname } = new URL(request.url, "http://localhost");
    const [prefix, folder] = folders.find(([begin]) => pathname.startsWith(begin));
    const path = join(folder, normalize(pathname.slice(prefix.length)));
    const size = await stat(path).then(
      (found) => (found.isFile() ? found.size : -1),
      () => -1,
    );
    if (size < 0) return response.writeHead(404).end();
    const [, from, to] = /^bytes=(\d+)-(\d+)?$/.exec(request.headers.range ?? "") ?? [];
    const begin = Number(from ?? 0);
    const part = await readPart(path, begin, Math.min(Number(to ?? size - 1) + 1, size));
    // As any server does with what is no scan.
    const bytes = from === undefined ? gzipSync(part) : part;
    asked.push({ pathname, bytes: bytes.length });
    response.writeHead(from === undefined ? 200 : 206, {
      "Content-Type": TYPES[extname(path)] ?? "application/octet-stream",
      "Content-Length": bytes.length,
      ...(from === undefined
        ? { "Content-Encoding": "gzip" }
        : { "Content-Range": `bytes ${begin}-${begin + bytes.length - 1}/${size}` }),
    });
    await sleep(delay);
    for (let at = 0; at < bytes.length && !response.destroyed; at += SLICE) {
      const slice = bytes.subarray(at, at + SLICE);
      free = Math.max(free, performance.now()) + (slice.length * 8e3) / bitsPerSecond;
      await sleep(free - performance.now());
      response.write(slice);
    }
    response.end();
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return {
    asked,
    address: `http://127.0.0.1:${server.address().port}`,
    close: () => {
      server.closeAllConnections();
      server.close();
    },
  };
}

function sleep(milliseconds) {
  return milliseconds > 1 ? new Promise((done) => setTimeout(done, milliseconds)) : Promise.resolve();
}

async function readPart(path, begin, end) {
  const file = await open(path);
  try {
    const bytes = Buffer.alloc(end - begin);
    await file.read(bytes, 0, bytes.length, begin);
    return bytes;
  } finally {
    await file.close();
  }
}
