import { describe, expect, it } from "vitest";
import { looksLikeHtml, parseContentRange } from "./http-answer.js";

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
