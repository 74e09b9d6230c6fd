// `npm run pack`: the packages of a release as tarballs, from what is built here.
import { existsSync, mkdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { parseArgs } from "node:util";
import { platform } from "../../converter/dist/installed/parts.js";
import { packStaged, stagePackages } from "./packages.mjs";
import { billOfMaterials } from "./sbom.mjs";

const root = join(import.meta.dirname, "../..");
const { values } = parseArgs({
  options: {
    out: { type: "string", default: join(root, ".groma/packages") },
    platform: { type: "string", default: platform },
    core: { type: "string" },
    proj: { type: "string", default: join(root, ".groma/proj") },
    "core-only": { type: "boolean", default: false },
  },
});
const out = resolve(values.out);
const program = `groma-core${values.platform.startsWith("win32") ? ".exe" : ""}`;
const native = {
  platform: values.platform,
  program: values.core ?? join(root, "converter/target/release", program),
  proj: existsSync(values.proj) ? values.proj : undefined,
};
if (!native.proj)
  process.stderr.write("pack: without PROJ: converter/scripts/build-proj .groma/proj builds it\n");

const stage = join(out, "stage");
rmSync(stage, { recursive: true, force: true });
mkdirSync(stage, { recursive: true });
const packages = stagePackages(root, stage, native, values["core-only"]);
for (const [name, file] of packStaged(packages, out)) {
  const bill = billOfMaterials(packages.find((one) => one.name === name));
  writeFileSync(file.replace(/\.tgz$/, ".cdx.json"), bill);
  console.log(`${name.padEnd(32)} ${(statSync(file).size / 1e6).toFixed(2)} MB  ${file}`);
}
rmSync(stage, { recursive: true });
