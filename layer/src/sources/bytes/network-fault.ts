import { type Outage, SourceError } from "../../errors/index.js";

/** Why a request ended without an answer. */
export interface NetworkFault {
  readonly code: string;
  readonly cause: string;
  readonly fix: string;
  /** Why another attempt may mend it; undefined: it does not. */
  readonly outage?: Outage;
}

const REDIRECT: NetworkFault = {
  code: "SOURCE_REDIRECT",
  cause: "the server redirects the request in a circle, or to where it cannot be followed",
  fix: "Check the address, and the redirects of the server",
};

const ENCODED: NetworkFault = {
  code: "SOURCE_ENCODED",
  cause:
    "the server compresses the answer to a Range request (Content-Encoding), so its bytes are not those of the file",
  fix: "Switch off compression on the server for this kind of file",
};

/** Names of errors of Node's `fetch` by the code of what caused them; the first pattern that fits. */
const NODE_FAULTS: readonly (readonly [RegExp, NetworkFault])[] = [
  [/redirect count exceeded/, REDIRECT],
  [/Z_(DATA|BUF)_ERROR|ERR_.*BROTLI|incorrect header check/, ENCODED],
  [
    /HEADERS_OVERFLOW/,
    {
      code: "SOURCE_HEADERS",
      cause: "the headers of the server's answer are too large",
      fix: "Check the server or proxy for what it adds to the headers",
    },
  ],
  [
    /CERT|SELF_SIGNED|UNABLE_TO_VERIFY|ERR_TLS|ERR_SSL/,
    {
      code: "SOURCE_NETWORK",
      cause: "no secure connection to the server: its certificate is not accepted",
      fix: "Check the address and the server's certificate",
    },
  ],
  [
    /ENOTFOUND|EAI_AGAIN/,
    {
      code: "SOURCE_NETWORK",
      cause: "no server of that name is found",
      fix: "Check the address and the connection",
      outage: "unreachable",
    },
  ],
  [
    /ECONNREFUSED/,
    {
      code: "SOURCE_NETWORK",
      cause: "the computer at that address refuses the connection",
      fix: "Check the address and its port, and that the server runs",
      outage: "unreachable",
    },
  ],
];

/** What a request asks for, as far as a probe repeats it. */
export interface Probed {
  readonly address: string;
  readonly headers: Readonly<Record<string, string>>;
  readonly credentials: RequestCredentials;
  readonly signal: AbortSignal;
}

/**
 * Finds out why `fetch` rejected. Node says it. Browsers hide it from pages, so that two requests for no more than
 * headers tell what can be told: whether the server redirects, and whether it answers at all.
 * @param probed undefined: nothing further is asked
 */
export async function nameNetworkFault(thrown: unknown, probed: Probed | undefined): Promise<NetworkFault> {
  const told = toldByNode(thrown);
  if (told) return told;
  const known = probed && (await probe(probed));
  if (known) return known;
  const offline = globalThis.navigator?.onLine === false;
  return {
    code: "SOURCE_NETWORK",
    cause: offline
      ? "this computer is offline"
      : "no answer that this page may read: the server is out of reach, its certificate is not accepted, its redirects lead nowhere, its headers are too large, or something on the way blocks the request",
    fix: offline ? "Connect to the network" : "Check the address and the connection",
    outage: "unreachable",
  };
}

/** The fault of an answer that is compressed; undefined: it is not, as far as its headers can be seen. */
export function encodingFault(response: Response): NetworkFault | undefined {
  const encoding = response.headers.get("Content-Encoding");
  return encoding === null || encoding === "identity" ? undefined : ENCODED;
}

/** The error for a fault of the network. */
export function networkError(fault: NetworkFault, file: string): SourceError {
  return new SourceError({ ...fault, file });
}

/** The error for redirects that `fetch` rejected to follow. */
export function redirectError(thrown: unknown, file: string): SourceError {
  return networkError(toldByNode(thrown) ?? REDIRECT, file);
}

function toldByNode(thrown: unknown): NetworkFault | undefined {
  const parts: string[] = [];
  for (let error = thrown; error instanceof Error && parts.length < 5; error = error.cause) {
    if (error !== thrown) parts.push("code" in error ? String(error.code) : "", error.message);
  }
  const text = parts.filter((part) => part !== "").join(" ");
  if (text === "") return undefined;
  return (
    NODE_FAULTS.find(([pattern]) => pattern.test(text))?.[1] ?? {
      code: "SOURCE_NETWORK",
      cause: `the connection failed (${parts.at(-1)})`,
      fix: "Check the address and the connection",
      outage: "unreachable",
    }
  );
}

async function probe({ address, ...options }: Probed): Promise<NetworkFault | undefined> {
  const head = (more: RequestInit) =>
    fetch(address, { ...options, ...more, method: "HEAD", cache: "no-store" }).catch(() => undefined);
  const seen = await head({ redirect: "manual" });
  if (seen?.type === "opaqueredirect") return REDIRECT;
  if (seen) {
    return (
      encodingFault(seen) ?? {
        code: "SOURCE_NETWORK",
        cause:
          "the server can be reached, but its answer to a Range request could not be read: it breaks off, or it is compressed although it must not be",
        fix: "Check the server or proxy for rewriting and compression of Range answers",
        outage: "failing",
      }
    );
  }
  // A request of this kind may be sent to any server; its answer stays hidden, but not that there is one.
  const hidden = await head({ mode: "no-cors", headers: {} });
  return hidden && FOREIGN;
}

const FOREIGN: NetworkFault = {
  code: "SOURCE_CORS",
  cause:
    "the server answers, but its answers do not allow this page to read them (CORS), or it is failing and its error pages do not",
  fix: "Let the server send Access-Control-Allow-Origin for this page, with its error pages too",
};
