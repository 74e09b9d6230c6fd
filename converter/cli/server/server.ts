import { realpath } from "node:fs/promises";
import { createServer, type IncomingMessage, type Server, type ServerResponse } from "node:http";
import { basename, dirname, join, relative, sep } from "node:path";
import { GromaError } from "@groma/georef";
import { type Admission, type AllowedOrigins, admitsHost, allowedOrigin } from "./admission.js";
import { answerWithFile } from "./file-answer.js";

/** The server could not be started, or has nothing to serve. */
export class ServerError extends GromaError {
  static override readonly kind = "ServerError";
}

/** A folder or a single file, and the path under which it is served. */
export interface Mount {
  /** Begins and ends with a slash. */
  readonly path: string;
  /** Folder: everything below it but hidden files and folders, and nothing that a link leads out to. */
  readonly folder: string;
  /** Only this file of the folder. */
  readonly only?: string;
  /** Content security policy sent with every answer: pages and their workers each have their own. Default: none. */
  readonly policy?: string;
}

/** Where a server listens, and whose pages may read from it. */
export interface ServingOptions {
  /** Address to listen on. Default: 127.0.0.1. */
  readonly host?: string;
  /** Port; 0 for any free one. Where it is taken, the next ones are tried. Default: 8080. */
  readonly port?: number;
  /** Origins whose pages may read, besides those of this server and of loopback hosts. Default: none. */
  readonly cors?: AllowedOrigins;
}

/** What readers of COPC in other pages need to see, and nothing that reveals more. */
const HEADERS = {
  "Access-Control-Allow-Methods": "GET, HEAD, OPTIONS",
  "Access-Control-Allow-Headers": "Range, If-Match, If-None-Match, If-Range",
  "Access-Control-Expose-Headers": "Accept-Ranges, Content-Length, Content-Range, ETag, Last-Modified",
  Vary: "Origin",
  "Referrer-Policy": "no-referrer",
  "X-Content-Type-Options": "nosniff",
};

/** Ports that are tried after the one asked for, before giving up. */
const PORTS_TRIED = 20;

/**
 * Serves files with Range and ETag; GET, HEAD and OPTIONS only. Requests that name another host than this computer, and
 * those of pages of other origins, are refused unless the options allow them.
 *
 * @returns the server and its address, e.g. `http://localhost:8080/`
 * @throws ServerError SERVER_PORT when no port is free or the host cannot be bound
 */
export async function serve(
  mounts: readonly Mount[],
  { host = "127.0.0.1", port = 8080, cors }: ServingOptions = {},
): Promise<{ server: Server; address: string }> {
  const server = createServer((request, response) => {
    answer(mounts, { host, cors }, request, response).catch(() => refuse(response, 500));
  });
  for (let tried = port; ; tried++) {
    try {
      await listen(server, host, tried);
      break;
    } catch (error) {
      const taken = (error as NodeJS.ErrnoException).code === "EADDRINUSE";
      if (taken && tried < port + PORTS_TRIED) continue;
      throw new ServerError({
        ...{
          code: "SERVER_PORT",
          file: `${host}:${port}`,
          cause: `the server cannot listen there (${error})`,
        },
        fix: "Give another address or port with --host or --port",
      });
    }
  }
  const bound = server.address();
  const number = bound !== null && typeof bound === "object" ? bound.port : port;
  const name = ["127.0.0.1", "0.0.0.0", "::", "::1"].includes(host) ? "localhost" : host;
  return { server, address: `http://${name.includes(":") ? `[${name}]` : name}:${number}/` };
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
  admission: Admission,
  request: IncomingMessage,
  response: ServerResponse,
): Promise<void> {
  for (const [name, value] of Object.entries(HEADERS)) response.setHeader(name, value);
  const { origin, host = "" } = request.headers;
  if (!admitsHost(host, admission))
    return refuse(response, 421, "this server does not answer to that host name");
  const open = admission.cors === "any";
  response.setHeader("Cross-Origin-Resource-Policy", open ? "cross-origin" : "same-site");
  if (origin !== undefined || open) {
    const allowed = allowedOrigin(origin ?? "null", host, admission);
    if (allowed === undefined) {
      return refuse(response, 403, "pages of that origin may not read here; groma serve --cors lets them");
    }
    response.setHeader("Access-Control-Allow-Origin", allowed);
  }
  if (request.method === "OPTIONS") return refuse(response, 204);
  if (request.method !== "GET" && request.method !== "HEAD") {
    response.setHeader("Allow", HEADERS["Access-Control-Allow-Methods"]);
    return refuse(response, 405);
  }
  const path = pathOf(request);
  if (path === undefined) return refuse(response, 400);
  const mount = mounts.find((candidate) => path.startsWith(candidate.path));
  if (mount?.policy) response.setHeader("Content-Security-Policy", mount.policy);
  const file = mount && (await fileAt(mount, path));
  if (file === undefined) return refuse(response, 404);
  const status = await answerWithFile(file, request, response);
  if (status !== undefined) refuse(response, status);
}

function pathOf(request: IncomingMessage): string | undefined {
  try {
    const path = decodeURIComponent(new URL(request.url ?? "/", "http://localhost").pathname);
    return path.includes("\0") ? undefined : path;
  } catch {
    return undefined;
  }
}

/** The file that a decoded path stands for, links followed; undefined where there is none to be seen. */
async function fileAt(mount: Mount, path: string): Promise<string | undefined> {
  const { folder, only } = mount;
  const inner = path.slice(mount.path.length);
  if (only !== undefined) return inner === only ? realpathOf(join(folder, only)) : undefined;
  const asked = inner === "" || inner.endsWith("/") ? `${inner}index.html` : inner;
  const root = await realpathOf(folder);
  const target = await realpathOf(join(folder, asked));
  if (root === undefined || target === undefined) return undefined;
  const inside = target.startsWith(root.endsWith(sep) ? root : root + sep);
  return inside && !isHidden(asked) && !isHidden(relative(root, target)) ? target : undefined;
}

/** Whether a part of a path begins with a dot: hidden files and folders, `..` too. */
function isHidden(path: string): boolean {
  return path.split(/[/\\]/).some((part) => part.startsWith("."));
}

async function realpathOf(path: string): Promise<string | undefined> {
  return realpath(path).catch(() => undefined);
}

function refuse(response: ServerResponse, status: number, why?: string): void {
  if (response.headersSent) {
    response.destroy();
    return;
  }
  response.statusCode = status;
  response.setHeader("Content-Type", "text/plain; charset=utf-8");
  response.end(status === 204 ? undefined : `${why ? `${status}: ${why}` : status}\n`);
}
