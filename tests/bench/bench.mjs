// `npm run bench [-- name … --minutes N --card --points N,N]`: figures, not tests. Ratios within one run count; absolute
// times depend on the machine. The soak takes two hours, or as many minutes as are asked for. With --card the bench `gpu`
// draws by a graphics card, with --points as many points as are asked for.
import { mkdirSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { join } from "node:path";
import { parseArgs } from "node:util";
import { root, setup } from "../../.ci/setup/main.mjs";
import { forTest } from "../../.ci/setup/steps.mjs";

const benches = [
  ...["placing", "decoding", "profiles", "converters", "page"],
  ...["frames", "first-sight", "gpu", "map", "streaming", "soak"],
];

await setup(forTest);
const { positionals: asked, values } = parseArgs({
  allowPositionals: true,
  options: { minutes: { type: "string" }, card: { type: "boolean" }, points: { type: "string" } },
});
const options = {
  ...(values.minutes !== undefined && { minutes: positive("minutes", values.minutes) }),
  ...(values.points !== undefined && {
    points: values.points.split(",").map((number) => positive("points", number)),
  }),
  card: values.card ?? false,
};
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
  const rows = await bench(root, options);
  console.table(rows);
  report.results[name] = rows;
}
mkdirSync(join(root, "tests/artifacts"), { recursive: true });
writeFileSync(join(root, "tests/artifacts/bench.json"), `${JSON.stringify(report, null, 2)}\n`);

function positive(name, given) {
  const number = Number(given);
  if (number > 0 && Number.isFinite(number)) return number;
  throw new Error(`--${name} ${given}: give a number greater than 0`);
}
