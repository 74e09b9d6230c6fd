import { SourceError } from "../../errors/index.js";
import { discardBody, looksLikeHtml, parseRetryAfter, peekBody } from "./http-answer.js";

/** An error for an answer, and the pause that the server asks for with it. */
export interface Refusal {
  readonly error: SourceError;
  /** Milliseconds. */
  readonly pause?: number | undefined;
  /** Status of an answer that refuses access, 401 or 403. */
  readonly denied?: number;
}

/** Bytes of an answer that are looked at to tell a web page from data. */
const PEEK_LENGTH = 256;

/** Statuses of servers that cannot serve now: timeout, too early, too many requests. All from 500 on count as well. */
const PASSING = [408, 425, 429];

/**
 * The error for an answer that is not 206.
 * @param name what errors call the file
 * @param known whether the file was there before
 */
export async function refusalOf(
  response: Response,
  { name, known, first }: { readonly name: string; readonly known: boolean; readonly first: number },
): Promise<Refusal> {
  const { status } = response;
  const error = (code: string, cause: string, fix: string) =>
    new SourceError({ code, file: name, cause: `${cause} (HTTP ${status})`, fix });
  if (status === 200) {
    if (looksLikeHtml(await peekBody(response, PEEK_LENGTH))) return { error: htmlError(name) };
    const fix = "Serve the file from a server with Range requests, for example: groma serve DIR";
    return { error: error("SOURCE_NO_RANGE", "the server answers a Range request with the whole file", fix) };
  }
  await discardBody(response);
  if (status === 404 || status === 410) {
    const cause = known ? "the file vanished while it was being read" : "the file does not exist";
    return { error: error("SOURCE_NOT_FOUND", cause, "Check the address") };
  }
  if (status === 401 || status === 403) {
    const fix = "Pass headers or credentials, or renew the signed address";
    return { error: error("SOURCE_DENIED", "the server refuses access", fix), denied: status };
  }
  if (status === 416) {
    if (known) return { error: changedError(name) };
    const fix = "Check that the file on the server is complete";
    return { error: error("SOURCE_EMPTY", `byte ${first} lies outside the file`, fix) };
  }
  if (status < 500 && !PASSING.includes(status)) {
    return {
      error: error("SOURCE_HTTP", "the server does not accept the request", "Look into the server's log"),
    };
  }
  const busy = status === 429 || status === 503;
  return {
    error: new SourceError({
      code: "SOURCE_HTTP",
      file: name,
      cause: `the server ${busy ? "is busy" : "fails"} (HTTP ${status})`,
      fix: busy ? "Try again later" : "Try again later, or look into the server's log",
      outage: busy ? "busy" : "failing",
    }),
    pause: parseRetryAfter(response.headers.get("Retry-After")),
  };
}

/** The error for a file that is another one than before. */
export function changedError(name: string): SourceError {
  return new SourceError({
    ...{ code: "SOURCE_CHANGED", file: name },
    cause: "the file changed while it was being read",
    fix: "Open it again",
  });
}

function htmlError(name: string): SourceError {
  return new SourceError({
    ...{ code: "SOURCE_HTML", file: name },
    cause: "the server returned HTML, not a point cloud",
    fix: "Check the address; a login or error page may stand in for the file",
  });
}
