/// <reference path="./catalogue.d.ts" />
import { i18n } from "@lingui/core";
import { messages } from "./catalogues/en.po";
import { beginLanguage } from "./choice.js";

i18n.loadAndActivate({ locale: "en", messages });
// Modules that have words are loaded after this one, and so find them in the reader's language.
if (typeof document !== "undefined") await beginLanguage();

export { i18n };
