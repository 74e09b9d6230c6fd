import { mkdirSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { join } from "node:path";

const MIB = 2 ** 20;
const ratio = (value) => value.toFixed(2);
const table = (head, rows) =>
  [head, head.map(() => "---"), ...rows].map((cells) => `| ${cells.join(" | ")} |`).join("\n");

/** Median over the rounds of a command's figure over that of another in the same round. */
function paired(one, other, field) {
  const ratios = one.rounds.map((run, round) => run[field] / other.rounds[round][field]);
  return ratios.sort((a, b) => a - b)[(ratios.length - 1) >> 1];
}

function peerTable(peers) {
  const bound = peers[0];
  const rows = peers.map((row) => [
    row.name,
    row.seconds.toFixed(1),
    row.cpu.toFixed(1),
    ratio(paired(row, bound, "seconds")),
    ratio(paired(row, bound, "cpu")),
    String(Math.round(row.peak / MIB)),
    String(Math.round(row.scratch / MIB)),
    (row.bytes / 1e6).toFixed(1),
  ]);
  const head = [
    "autzen.laz to COPC",
    "wall s",
    "cpu s",
    "wall ×",
    "cpu ×",
    "peak MiB",
    "scratch MiB",
    "output MB",
  ];
  return table(head, rows);
}

function sizeTable(sizes) {
  const rows = sizes.map((row) => {
    const small = sizes.find(({ memory }) => memory === row.memory);
    return [
      `${row.points / 1e6} M`,
      row.memory,
      row.seconds.toFixed(1),
      ratio(paired(row, small, "seconds")),
      ratio(paired(row, small, "cpu")),
      String(Math.round(row.peak / MIB)),
      ratio(row.scratch / row.pointBytes),
      (row.bytes / 1e6).toFixed(1),
    ];
  });
  const head = [
    "points",
    "--memory",
    "wall s",
    "wall × 10 M",
    "cpu × 10 M",
    "peak MiB",
    "scratch × points",
    "output MB",
  ];
  return table(head, rows);
}

/** What the command adds to its core. */
function commandLine({ seconds, own }) {
  const share = Math.round((100 * own) / seconds);
  return `Of ${seconds.toFixed(1)} s that \`groma convert\` takes with PROJ, ${own.toFixed(1)} s (${share} %) are not the core's: the command's start, the CRS, the summary. PROJ works while the core builds.`;
}

/** Writes docs/bench/converters.json and .md; returns rows for the terminal. */
export function writeReport(root, { peers, command, sizes }) {
  const folder = join(root, "docs/bench");
  mkdirSync(folder, { recursive: true });
  const machine = { cpu: cpus()[0]?.model, cores: cpus().length };
  const report = { date: new Date().toISOString(), machine, peers, command, sizes };
  writeFileSync(join(folder, "converters.json"), `${JSON.stringify(report, null, 2)}\n`);
  const text = `# Converters

\`npm run bench -- converters\` on ${machine.cores} × ${machine.cpu}, ${report.date.slice(0, 10)}.
Times are medians of ${peers[0]?.runs ?? 0} rounds in which every command ran once; ratios (×) are medians of the ratios
within a round, to the lower bound: the crate \`laz\` on all cores decompresses, compresses and writes the same points, and
does nothing else (\`converter/examples/lower_bound.rs\`).

${peers.length > 0 ? peerTable(peers) : "autzen.laz was not there."}

${command ? commandLine(command) : ""}

## Size and memory

A generated airborne scan (LAS, 30 bytes a point, \`tests/bench/converters/terrain.py\`), default sampling, in rounds as
above. Scratch is what lay in the temporary folder at most, over the bytes of the points.

${sizeTable(sizes)}
`;
  writeFileSync(join(folder, "converters.md"), text);
  const brief = ({ name, seconds, cpu, peak, bytes }) => ({
    name,
    ...{ seconds: Number(seconds.toFixed(1)), cpu: Number(cpu.toFixed(1)) },
    ...{ "peak MiB": Math.round(peak / MIB), "output MB": Number((bytes / 1e6).toFixed(1)) },
  });
  return [...peers, ...sizes].map(brief);
}
