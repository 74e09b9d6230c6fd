import { realpath } from "node:fs/promises";
import { createServer, type IncomingMessage, type Server, type ServerResponse } from "node:http";
import { basename, dirname, join, sep } from "node:path";
import { GromaError } from "@groma/georef";
import send from "send";

/** The server could not be started, or has nothing to serve. */
export class ServerError extends GromaError {}

/** A folder or a single file, and the path under which it is served. */
export interface Mount {
  /** Begins and ends with a slash. */
  readonly path: string;
  /** Folder: everything below it, no dot files, nothing that a link leads out to. */
  readonly folder: string;
  /** Only this file of the folder. */
  readonly only?: string;
}

/** What readers of COPC in other pages need to see, and nothing that reveals more. */
const HEADERS = {
  "Access-Control-Allow-Origin": "*",
  "Access-Control-Allow-Methods": "GET, HEAD, OPTIONS",
  "Access-Control-Allow-Headers": "Range, If-Match, If-None-Match, If-Range",
  "Access-Control-Expose-Headers": "Accept-Ranges, Content-Length, Content-Range, ETag, Last-Modified",
  "Cross-Origin-Resource-Policy": "cross-origin",
  "X-Content-Type-Options": "nosniff",
};

/** Ports that are tried after the one asked for, before giving up. */
const PORTS_TRIED = 20;

/**
 * Serves files with Range, ETag and CORS; GET, HEAD and OPTIONS only.
 *
 * @param port 0 for any free one; a port that is taken makes the next one be tried
 * @returns the server and its address, e.g. `http://localhost:8080/`
 * @throws ServerError SERVER_PORT when no port is free or the host cannot be bound
 */
export async function serve(
  mounts: readonly Mount[],
  { host = "127.0.0.1", port = 8080 }: { host?: string; port?: number } = {},
): Promise<{ server: Server; address: string }> {
  const server = createServer((request, response) => {
    answer(mounts, request, response).catch(() => refuse(response, 500));
  });
  for (let tried = port; ; tried++) {
    try {
      await listen(server, host, tried);
      break;
    } catch (error) {
      const taken = (error as NodeJS.ErrnoException).code === "EADDRINUSE";
      if (taken && tried < port + PORTS_TRIED) continue;
      throw new ServerError({
        ...{ code: "SERVER_PORT", file: `${host}:${port}`, cause: `it cannot be listened on (${error})` },
        fix: "give another one with --port or --host",
      });
    }
  }
  const bound = server.address();
  const number = bound !== null && typeof bound === "object" ? bound.port : port;
  const name = host === "127.0.0.1" || host === "0.0.0.0" ? "localhost" : host;
  return { server, address: `http://${name}:${number}/` };
}

/** The mount of a folder, or of a single file under its own name. */
export function mountFile(path: string, file: string): Mount {
  return { path, folder: dirname(file), only: basename(file) };
}

function listen(server: Server, host: string, port: number): Promise<void> {
  return new Promise((resolve, reject) => {
    server.once("error", reject);
    server.listen(port, host, () => {
      server.off("error", reject);
      resolve();
    });
  });
}

async function answer(
  mounts: readonly Mount[],
  request: IncomingMessage,
  response: ServerResponse,
): Promise<void> {
  for (const [name, value] of Object.entries(HEADERS)) response.setHeader(name, value);
  if (request.method === "OPTIONS") return refuse(response, 204);
  if (request.method !== "GET" && request.method !== "HEAD") return refuse(response, 405);
  const path = pathOf(request);
  if (path === undefined) return refuse(response, 400);
  const mount = mounts.find((candidate) => path.startsWith(candidate.path));
  if (!mount) return refuse(response, 404);
  const inner = path.slice(mount.path.length - 1);
  if (mount.only !== undefined && inner !== `/${mount.only}`) return refuse(response, 404);
  if (mount.only === undefined && !(await stays(mount.folder, inner))) return refuse(response, 404);
  await new Promise<void>((resolve) => {
    // `send` wants the path as it came: encoded.
    const stream = send(request, encodeURI(inner).replaceAll("?", "%3F").replaceAll("#", "%23"), {
      root: mount.folder,
      dotfiles: "deny",
      // Data sets are converted again under the same name; a page must not mix two of them.
      cacheControl: false,
    });
    stream.on("error", (error: { status?: number }) => {
      refuse(response, error.status ?? 500);
      resolve();
    });
    stream.on("directory", () => {
      refuse(response, 404);
      resolve();
    });
    response.on("close", resolve);
    response.setHeader("Cache-Control", "no-cache");
    stream.pipe(response);
  });
}

function pathOf(request: IncomingMessage): string | undefined {
  try {
    const path = decodeURIComponent(new URL(request.url ?? "/", "http://localhost").pathname);
    return path.includes("\0") ? undefined : path;
  } catch {
    return undefined;
  }
}

/** Whether a path, links followed, stays inside the folder. */
async function stays(folder: string, inner: string): Promise<boolean> {
  try {
    const root = await realpath(folder);
    const target = await realpath(join(root, inner));
    return target === root || target.startsWith(root + sep);
  } catch {
    return false;
  }
}

function refuse(response: ServerResponse, status: number): void {
  if (response.headersSent) {
    response.destroy();
    return;
  }
  response.statusCode = status;
  response.setHeader("Content-Type", "text/plain; charset=utf-8");
  response.end(status === 204 ? undefined : `${status}\n`);
}
