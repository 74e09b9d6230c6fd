import { expect, it } from "vitest";
import { languageFor } from "./languages.js";

it.each([
  [["de-CH", "en"], "de"],
  [["pt-BR", "DE", "en"], "de"],
  [["tlh"], "en"],
  [[], "en"],
])("of %j the page takes %s", (wanted, code) => {
  expect(languageFor(wanted).code).toBe(code);
});
