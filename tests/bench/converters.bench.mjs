import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { ownTime } from "./converters/command.mjs";
import { coreOf, lowerBoundOf, PEER, peerOf } from "./converters/commands.mjs";
import { measure, summary } from "./converters/measure.mjs";
import { writeReport } from "./converters/report.mjs";

const SAMPLINGS = ["poisson", "grid", "random", "first"];
const ROUNDS = Number(process.env.GROMA_BENCH_ROUNDS ?? 3);
const SIZES = (process.env.GROMA_BENCH_POINTS ?? "10000000,100000000").split(",").map(Number);
const MEMORIES = ["256MB", "512MB"];

/** The work on one scan. */
async function race(root, python, folder, scan) {
  const output = join(folder, "out.copc.laz");
  const scratch = join(folder, "scratch");
  const core = coreOf(root);
  const peer = peerOf(root);
  const convert = (sampling) => [
    ...[core, "convert", scan, output, "--sampling", sampling, "--temp-dir", scratch],
  ];
  const commands = [
    { name: "lower bound", command: [lowerBoundOf(root), scan, output] },
    ...SAMPLINGS.map((sampling) => ({ name: `groma ${sampling}`, command: convert(sampling) })),
    ...(peer
      ? [{ name: `${PEER.crate} ${PEER.version}`, command: [peer, scan, output, "--temp-dir", scratch] }]
      : []),
  ];
  return inRounds(commands, ({ command }) => measure(python, scratch, command, output));
}

/** Every command once a round, so that all of them meet the same state of the machine. */
async function inRounds(commands, run) {
  const rounds = [];
  for (let round = 0; round < ROUNDS; round++) {
    const taken = [];
    for (const command of commands) {
      taken.push(await run(command));
      const { seconds, peak } = taken.at(-1);
      console.log(
        `round ${round + 1}: ${command.name} ${seconds.toFixed(1)} s, ${Math.round(peak / 2 ** 20)} MiB`,
      );
    }
    rounds.push(taken);
  }
  return commands.map(({ command, ...named }, index) => {
    const runs = rounds.map((taken) => taken[index]);
    return { ...named, ...summary(runs), rounds: runs };
  });
}

/** Conversions of generated scans with little memory, the sizes next to each other. */
async function grow(root, python, folder) {
  const [output, scratch] = [join(folder, "out.copc.laz"), join(folder, "scratch")];
  const scans = SIZES.map((points) => ({ points, file: join(folder, `${points}.las`) }));
  for (const { points, file } of scans) {
    execFileSync(python, [join(root, "tests/bench/converters/terrain.py"), String(points), file]);
  }
  const commands = MEMORIES.flatMap((memory) =>
    scans.map(({ points, file }) => ({
      name: `${points / 1e6} M points in ${memory}`,
      ...{ points, memory, pointBytes: points * 30 },
      command: [coreOf(root), "convert", file, output, "--memory", memory, "--temp-dir", scratch],
    })),
  );
  return inRounds(commands, ({ command }) => measure(python, scratch, command, output));
}

/** Converters against each other and against the lower bound; writes docs/bench/converters.*. */
export async function bench(root) {
  const scan = join(root, "../shared/data/autzen.laz");
  const python = process.env.GROMA_PYTHON ?? join(root, "tests/.venv/bin/python");
  const folder = mkdtempSync(join(process.env.GROMA_BENCH_FOLDER ?? tmpdir(), "groma-bench-"));
  mkdirSync(join(folder, "scratch"));
  try {
    const peers = existsSync(scan) ? await race(root, python, folder, scan) : [];
    const command = existsSync(scan)
      ? ownTime(root, scan, join(folder, "command.copc.laz"), ROUNDS)
      : undefined;
    const sizes = await grow(root, python, folder);
    return writeReport(root, { peers, command, sizes });
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
