#!/usr/bin/env node
// The command as it is installed. It is there before it is built, so that npm can link it.
import { existsSync } from "node:fs";

const main = new URL("../dist/main.js", import.meta.url);
if (existsSync(main)) await import(main.href);
else {
  process.exitCode = 1;
  process.stderr.write("COMMAND_MISSING: groma: the command is not built. Run npm run setup.\n");
}
