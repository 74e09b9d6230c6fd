// `npm run bench [-- name …]`: figures, not tests. Ratios within one run count; absolute times depend on the machine.
import { mkdirSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { join } from "node:path";
import { root, setup } from "../../.ci/setup/main.mjs";
import { forTest } from "../../.ci/setup/steps.mjs";

const benches = ["placing", "converters", "page", "frames", "streaming"];

await setup(forTest);
const asked = process.argv.slice(2);
const report = {
  date: new Date().toISOString(),
  node: process.version,
  cpu: cpus()[0]?.model,
  cores: cpus().length,
  results: {},
};
for (const name of asked.length > 0 ? asked : benches) {
  console.log(`\n── ${name}`);
  const { bench } = await import(`./${name}.bench.mjs`);
  const rows = await bench(root);
  console.table(rows);
  report.results[name] = rows;
}
mkdirSync(join(root, "tests/artifacts"), { recursive: true });
writeFileSync(join(root, "tests/artifacts/bench.json"), `${JSON.stringify(report, null, 2)}\n`);
