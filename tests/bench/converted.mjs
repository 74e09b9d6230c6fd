import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, statSync } from "node:fs";
import { join, parse } from "node:path";

/**
 * The COPC file that `groma convert` makes of a scan, where the tests keep it; made again only when the converter is
 * newer than the file.
 *
 * @param {string} root of the project
 * @param {string} scan
 * @returns {string} absolute path
 */
export function converted(root, scan) {
  const groma = join(root, "converter/dist/main.js");
  const folder = join(root, "tests/artifacts/copc");
  const file = join(folder, `${parse(scan).name}.copc.laz`);
  const inputs = [groma, join(root, "converter/target/release/groma-core"), scan];
  const newest = Math.max(...inputs.map((input) => statSync(input).mtimeMs));
  if (existsSync(file) && statSync(file).mtimeMs > newest) return file;
  mkdirSync(folder, { recursive: true });
  execFileSync(process.execPath, [groma, "convert", scan, file, "--overwrite"], { stdio: "pipe" });
  return file;
}
