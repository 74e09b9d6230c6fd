#!/usr/bin/env node
// The command as it is installed. It is there before it is built, so that npm can link it; what it says of an old Node
// has to be understood by that Node.
import { existsSync } from "node:fs";
import module from "node:module";

const main = new URL("../dist/main.js", import.meta.url);
const [major, minor] = process.versions.node.split(".").map(Number);

if (major < 20 || (major === 20 && minor < 19)) {
  fail(`NODE_VERSION: groma: this is Node.js ${process.versions.node}. Install Node.js 20.19 or newer.`);
} else if (existsSync(main)) {
  // Node.js 22 keeps what it compiled for the next run.
  module.enableCompileCache?.();
  void import(main.href);
} else {
  fail("COMMAND_MISSING: groma: the command is not built. Run npm run setup.");
}

function fail(message) {
  process.exitCode = 1;
  process.stderr.write(`${message}\n`);
}
