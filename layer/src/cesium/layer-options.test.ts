import { Resource, TrustedServers } from "cesium";
import { afterEach, describe, expect, it } from "vitest";
import { resolveSource } from "./layer-options.js";

describe("resolveSource", () => {
  afterEach(() => TrustedServers.clear());

  it("takes address, headers and trust of a Resource", () => {
    TrustedServers.add("a.example", 443);
    const resource = new Resource({
      ...{ url: "https://a.example/a.copc.laz", queryParameters: { v: "1" }, headers: { a: "b" } },
    });
    expect(resolveSource(resource)).toEqual({
      ...{ from: "https://a.example/a.copc.laz?v=1", http: { headers: { a: "b" }, credentials: "include" } },
    });
  });

  it("has a Resource renew itself by its retryCallback when access is refused", async () => {
    const statuses: unknown[] = [];
    const resource = new Resource({
      ...{ url: "https://a.example/a", headers: { token: "1" } },
      retryCallback: (which, error) => {
        statuses.push(error?.statusCode);
        which?.setQueryParameters({ sig: "2" });
        if (which) which.headers = { token: "2" };
        return Promise.resolve(true);
      },
    });
    const { from, http } = resolveSource(resource);
    if (typeof from !== "function" || typeof http.headers !== "function")
      throw new Error("nothing can be renewed");
    expect(await from({ reason: "open" })).toBe("https://a.example/a");
    expect(await http.headers({ reason: "open" })).toEqual({ token: "1" });
    expect(await from({ reason: "denied", status: 403 })).toBe("https://a.example/a?sig=2");
    expect(await http.headers({ reason: "denied", status: 403 })).toEqual({ token: "2" });
    expect(statuses).toEqual([403]);
  });
});
