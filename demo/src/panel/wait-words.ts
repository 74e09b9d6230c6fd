import type { ServerWait } from "@groma/layer/cesium";
import { i18n } from "../language/i18n.js";

const OUTAGES: Readonly<Record<ServerWait["outage"], string>> = {
  busy: i18n.t("The server is busy."),
  failing: i18n.t("The server fails."),
  silent: i18n.t("The server does not answer."),
  unreachable: i18n.t("The server cannot be reached."),
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
  if (until !== undefined && until > now)
    return i18n.t("trying again in {seconds} s", { seconds: Math.ceil((until - now) / 1000) });
  return outage === "silent" ? i18n.t("still waiting for it") : i18n.t("trying again now");
}
