import type { ServerWait } from "@groma/layer/cesium";

const OUTAGES: Readonly<Record<ServerWait["outage"], string>> = {
  busy: "The server is busy.",
  failing: "The server fails.",
  silent: "The server does not answer.",
  unreachable: "The server cannot be reached.",
};

/** Why nothing comes: said once, whereas {@link againWords} change from second to second. */
export function outageWords({ outage }: Pick<ServerWait, "outage">): string {
  return OUTAGES[outage];
}

/**
 * When the server is asked again: `trying again in 4 s`.
 * @param now milliseconds since 1970
 */
export function againWords({ outage, until }: Pick<ServerWait, "outage" | "until">, now: number): string {
  if (until !== undefined && until > now) return `trying again in ${Math.ceil((until - now) / 1000)} s`;
  return outage === "silent" ? "still waiting for it" : "trying again now";
}
