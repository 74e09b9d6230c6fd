import { readFileSync } from "node:fs";
import { join } from "node:path";
import { Resource, TrustedServers } from "cesium";
import { afterEach, describe, expect, it } from "vitest";
import type { StyleError } from "../errors/index.js";
import { checkOpeningOptions, resolveSource } from "./layer-options.js";

/** The names that `PointCloudLayer.fromUrl` takes, as its refusal of another one lists them. */
function knownOptions(): string[] {
  try {
    checkOpeningOptions({ nope: 1 } as never);
  } catch (thrown) {
    return (thrown as StyleError).fix.replace(/^use /, "").split(/, | or /);
  }
  return [];
}

it("the table of docs/layer.md has a row for every option of fromUrl, and for no other", () => {
  const page = readFileSync(join(import.meta.dirname, "../../../docs/layer.md"), "utf8");
  const [, table] = /\n\| option \| default \| meaning \|\n((?:\|.*\n)+)/.exec(page)!;
  const rows = table.split("\n").flatMap((row) => row.split(" | ")[0].match(/(?<=`)\w+(?=`)/g) ?? []);
  expect(rows.length).toBeGreaterThan(20);
  expect(rows.toSorted()).toEqual(knownOptions().sort());
});

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
