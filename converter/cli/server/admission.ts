import { hostname as nameOfComputer, networkInterfaces } from "node:os";

/** Origins of other sites whose pages may read: those listed, or any. */
export type AllowedOrigins = "any" | readonly string[];

/** Who may ask a server. */
export interface Admission {
  /** Address or name that the server listens on. */
  readonly host: string;
  /** Besides pages of this server and of loopback hosts. Default: none. */
  readonly cors?: AllowedOrigins | undefined;
}

/**
 * Whether a request's `Host` header names this computer. A site whose name resolves to a loopback address (DNS
 * rebinding) makes browsers send its own name here, and would else read all answers as its own.
 */
export function admitsHost(header: string | undefined, { host }: Admission): boolean {
  const named = header === undefined ? undefined : hostnameOf(`http://${header}`);
  if (named === undefined) return false;
  if (isLoopback(named)) return true;
  const bound = hostnameOf(`http://${host.includes(":") ? `[${host}]` : host}`);
  if (bound === undefined || isLoopback(bound)) return false;
  return named === bound || ownNames().has(named);
}

/**
 * What a page of the origin given is told by `Access-Control-Allow-Origin`; undefined: it may not read.
 * @param origin the request's `Origin`
 * @param header its `Host`, admitted
 */
export function allowedOrigin(origin: string, header: string, { cors }: Admission): string | undefined {
  if (cors === "any") return "*";
  if (origin === `http://${header}`) return origin;
  const named = hostnameOf(origin);
  return (named !== undefined && isLoopback(named)) || cors?.includes(origin) ? origin : undefined;
}

/** Host of an address that has nothing else but a port, as browsers write it: lower case, IPv6 in brackets. */
function hostnameOf(address: string): string | undefined {
  if (!/^https?:\/\/[^/?#@\\\s]+$/i.test(address) || !URL.canParse(address)) return undefined;
  return new URL(address).hostname;
}

function isLoopback(host: string): boolean {
  return (
    host === "localhost" || host.endsWith(".localhost") || host === "[::1]" || /^127(\.\d+){3}$/.test(host)
  );
}

/** Names and addresses by which others on the network know this computer. */
function ownNames(): ReadonlySet<string> {
  const name = nameOfComputer().toLowerCase();
  const addresses = Object.values(networkInterfaces()).flatMap((all) => all ?? []);
  return new Set([
    ...[name, `${name}.local`],
    ...addresses.map(({ family, address }) => (family === "IPv6" ? `[${address}]` : address)),
  ]);
}
