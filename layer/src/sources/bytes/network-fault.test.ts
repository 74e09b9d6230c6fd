import { afterEach, describe, expect, it, vi } from "vitest";
import { nameNetworkFault } from "./network-fault.js";

const probed = () => ({
  ...{ address: "https://a.example/a.copc.laz", headers: {}, credentials: "omit" as const },
  signal: new AbortController().signal,
});
/** What `fetch` of a browser rejects with, whatever the reason. */
const hidden = new TypeError("Failed to fetch");

afterEach(() => vi.unstubAllGlobals());

/** A browser: what it answers to a look at the headers, and to one whose answer stays hidden. */
function browser(seen: Partial<Response> | undefined, opaque: boolean) {
  const fetch = vi.fn((_url: string, { mode }: RequestInit) => {
    const answer = mode === "no-cors" ? opaque && { type: "opaque" } : seen;
    return answer ? Promise.resolve({ headers: new Headers(), ...answer }) : Promise.reject(hidden);
  });
  vi.stubGlobal("fetch", fetch);
  return fetch;
}

describe("nameNetworkFault", () => {
  it.each([
    ["redirect count exceeded", undefined, "SOURCE_REDIRECT", undefined],
    ["Headers Overflow Error", "UND_ERR_HEADERS_OVERFLOW", "SOURCE_HEADERS", undefined],
    ["incorrect header check", "Z_DATA_ERROR", "SOURCE_ENCODED", undefined],
    ["self-signed certificate", "DEPTH_ZERO_SELF_SIGNED_CERT", "SOURCE_NETWORK", undefined],
    ["getaddrinfo ENOTFOUND a.example", "ENOTFOUND", "SOURCE_NETWORK", "unreachable"],
    ["connect ECONNREFUSED 127.0.0.1:9", "ECONNREFUSED", "SOURCE_NETWORK", "unreachable"],
    ["other side closed", "UND_ERR_SOCKET", "SOURCE_NETWORK", "unreachable"],
  ])("says what Node says: %s", async (message, code, named, outage) => {
    const fetch = browser(undefined, false);
    const cause = Object.assign(new Error(message), code && { code });
    const fault = await nameNetworkFault(new TypeError("fetch failed", { cause }), probed());
    expect([fault.code, fault.outage]).toEqual([named, outage]);
    expect(fault.cause).not.toMatch(/CORS/);
    expect(fetch).not.toHaveBeenCalled();
  });

  it.each([
    ["a redirect", { type: "opaqueredirect" as const }, false, "SOURCE_REDIRECT", undefined],
    [
      "a compressed answer",
      { headers: new Headers({ "Content-Encoding": "gzip" }) },
      false,
      "SOURCE_ENCODED",
      undefined,
    ],
    ["an answer to this, but none to ranges", {}, true, "SOURCE_NETWORK", "failing"],
    ["an answer that it hides from the page", undefined, true, "SOURCE_CORS", undefined],
    ["nothing", undefined, false, "SOURCE_NETWORK", "unreachable"],
  ])("finds out in a browser that there is %s", async (_, seen, opaque, code, outage) => {
    const fetch = browser(seen, opaque);
    const fault = await nameNetworkFault(hidden, probed());
    expect([fault.code, fault.outage]).toEqual([code, outage]);
    expect(fetch.mock.calls.every(([, { method }]) => method === "HEAD")).toBe(true);
    expect(fetch.mock.calls.length).toBeLessThanOrEqual(2);
  });

  it("asks for nothing further where it may not", async () => {
    const fetch = browser(undefined, true);
    expect(await nameNetworkFault(hidden, undefined)).toMatchObject({
      code: "SOURCE_NETWORK",
      outage: "unreachable",
    });
    expect(fetch).not.toHaveBeenCalled();
  });

  it("says that the computer is offline", async () => {
    vi.stubGlobal("navigator", { onLine: false });
    expect((await nameNetworkFault(hidden, undefined)).cause).toBe("this computer is offline");
  });
});
