import { describe, expect, it } from "vitest";
import { looksLikeHtml, parseContentRange, parseRetryAfter } from "./http-answer.js";

describe("parseContentRange", () => {
  it.each([
    ["bytes 0-99/1000", { first: 0, last: 99, size: 1000 }],
    ["bytes 5-5/*", { first: 5, last: 5, size: undefined }],
  ])("reads %s", (header, range) => expect(parseContentRange(header)).toEqual(range));

  it.each(["bytes */1000", "bytes 9-5/1000", "bytes 0-1000/1000", "items 0-1/2", "bytes 0-99", ""])(
    "refuses %j",
    (header) => expect(parseContentRange(header)).toBeUndefined(),
  );
});

describe("looksLikeHtml", () => {
  const bytes = (text: string) => new TextEncoder().encode(text);

  it.each(["<!DOCTYPE html>", "<html lang=en>", "\uFEFF\n <!doctype html>"])("knows %j", (text) =>
    expect(looksLikeHtml(bytes(text))).toBe(true),
  );

  it.each(["LASF", "<?xml", ""])("leaves %j alone", (text) => expect(looksLikeHtml(bytes(text))).toBe(false));
});

describe("parseRetryAfter", () => {
  const now = Date.UTC(2026, 10, 6, 8, 49, 37);

  it.each([
    ["3", 3000],
    [" 120 ", 120_000],
    ["Fri, 06 Nov 2026 08:49:41 GMT", 4000],
    ["Friday, 06-Nov-26 08:49:41 GMT", 4000],
    ["Fri Nov  6 08:49:41 2026 GMT", 4000],
    ["Fri, 06 Nov 2026 08:00:00 GMT", 0],
    ["-3", undefined],
    ["1.5", undefined],
    ["soon", undefined],
    ["2026", 2_026_000],
    ["", undefined],
    [null, undefined],
  ])("of %s", (header, expected) => expect(parseRetryAfter(header, now)).toBe(expected));
});
