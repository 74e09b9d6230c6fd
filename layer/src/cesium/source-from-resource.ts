import { Resource, TrustedServers } from "cesium";
import type { HttpOptions, SourceLike } from "../sources/index.js";

/** What a layer can be made from: as a cloud, and Cesium's `Resource` besides. */
export type LayerSource = SourceLike | Resource;

/** A source and the options under which it is asked. */
export interface ResolvedSource {
  readonly from: SourceLike;
  readonly http: Pick<HttpOptions, "headers" | "credentials">;
}

/**
 * Takes a `Resource` apart: address with query and proxy, headers, and credentials where the server is one of
 * Cesium's `TrustedServers`. Anything else is left as it is.
 */
export function resolveSource(source: LayerSource): ResolvedSource {
  if (!(source instanceof Resource)) return { from: source, http: {} };
  const url = source.getUrlComponent(true, true);
  const headers: Record<string, string> = {};
  for (const [name, value] of Object.entries(source.headers ?? {})) headers[name] = String(value);
  const address = new URL(url, globalThis.location?.href).href;
  return {
    from: url,
    http: { headers, ...(TrustedServers.contains(address) && { credentials: "include" }) },
  };
}
