import { open } from "node:fs/promises";
import { createServer } from "node:http";

/** Serves one file by Range requests, on a port of its own. */
export async function serveFile(path) {
  const file = await open(path);
  const { size } = await file.stat();
  const server = createServer(async (request, response) => {
    const [, first, last] = /^bytes=(\d+)-(\d+)$/.exec(request.headers.range ?? "") ?? [];
    const begin = Number(first);
    const end = Math.min(Number(last) + 1, size);
    const bytes = Buffer.alloc(end - begin);
    await file.read(bytes, 0, bytes.length, begin);
    response.writeHead(206, {
      "Content-Length": bytes.length,
      "Content-Range": `bytes ${begin}-${end - 1}/${size}`,
    });
    response.end(bytes);
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return {
    url: `http://127.0.0.1:${server.address().port}/scan.copc.laz`,
    async close() {
      server.closeAllConnections();
      await new Promise((resolve) => server.close(resolve));
      await file.close();
    },
  };
}
