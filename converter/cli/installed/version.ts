import { createRequire } from "node:module";

/** The version of the package `@groma/converter`, which the command says. */
export const version: string = createRequire(import.meta.url)("../../package.json").version;
