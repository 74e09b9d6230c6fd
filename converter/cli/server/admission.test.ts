import { hostname } from "node:os";
import { describe, expect, it } from "vitest";
import { admitsHost, allowedOrigin } from "./admission.js";

const loopback = { host: "127.0.0.1" };

describe("admitsHost", () => {
  it.each(["localhost:8080", "LOCALHOST", "groma.localhost:1", "127.0.0.1:8080", "127.8.9.1", "[::1]:8080"])(
    "lets %s in",
    (header) => expect(admitsHost(header, loopback)).toBe(true),
  );

  it.each([
    undefined,
    "",
    "evil.example",
    "evil.example:8080",
    "localhost.evil.example",
    "127.0.0.1.evil.example",
    "192.168.1.7:8080",
    "evil.example/@localhost",
    "localhost@evil.example",
    "a b",
  ])("keeps %s out", (header) => expect(admitsHost(header, loopback)).toBe(false));

  it("knows the computer's own names where it listens to the network", () => {
    for (const host of ["0.0.0.0", "::", "scans.example"]) {
      expect(admitsHost(`${hostname()}:8080`, { host })).toBe(true);
      expect(admitsHost("evil.example", { host })).toBe(false);
    }
    expect(admitsHost("scans.example:80", { host: "scans.example" })).toBe(true);
  });
});

describe("allowedOrigin", () => {
  it("lets pages of the same server and of loopback hosts read, and no others", () => {
    const of = (origin: string) => allowedOrigin(origin, "scans.example:8080", { host: "0.0.0.0" });
    for (const origin of ["http://scans.example:8080", "http://localhost:5173", "https://127.0.0.1"]) {
      expect(of(origin)).toBe(origin);
    }
    for (const origin of [
      "https://evil.example",
      "http://scans.example",
      "null",
      "http://localhost.evil.example",
    ]) {
      expect(of(origin)).toBeUndefined();
    }
  });

  it("lets those read that the user names, or all", () => {
    const cors = ["https://a.example"];
    expect(allowedOrigin("https://a.example", "localhost", { ...loopback, cors })).toBe("https://a.example");
    expect(allowedOrigin("https://b.example", "localhost", { ...loopback, cors })).toBeUndefined();
    expect(allowedOrigin("null", "localhost", { ...loopback, cors: "any" })).toBe("*");
  });
});
