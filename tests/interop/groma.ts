import { spawnSync } from "node:child_process";
import { join } from "node:path";
import { projectRoot } from "../project.js";

const main = join(projectRoot, "converter/dist/main.js");

/** What a run of `groma` came to. */
export interface Run {
  code: number | null;
  stdout: string;
  stderr: string;
}

/** What `groma locate --json` tells of a point. */
export interface Located {
  source: [number, number, number];
  ecef: [number, number, number];
  geodetic: [number, number, number];
  accuracy: number | null;
}

/** Runs `groma`, with text on its standard input, if any. */
export function groma(args: readonly string[], input = ""): Run {
  const { status, stdout, stderr } = spawnSync(process.execPath, [main, ...args], {
    ...{ encoding: "utf8", timeout: 110_000, maxBuffer: 1 << 28, input },
  });
  return { code: status, stdout, stderr };
}

/** Runs `groma` and parses the last line of its JSON. @throws Error with what it complained of */
export function gromaJson<T>(args: readonly string[], input = ""): T {
  const { code, stdout, stderr } = groma(args, input);
  if (code !== 0) throw new Error(`groma ${args.join(" ")}: ${stderr}`);
  return JSON.parse(args.includes("--progress") ? stdout.trimEnd().split("\n").at(-1)! : stdout) as T;
}

/** Places points by `groma locate`. */
export function locate(file: string, points: readonly (readonly number[])[]): Located[] {
  const text = points.map((point) => point.slice(0, 3).join(" ")).join("\n");
  return gromaJson<{ points: Located[] }>(["locate", file, "--points", "-", "--json"], text).points;
}

/** Metres between two points of ECEF. */
export function distance(a: readonly number[], b: readonly number[]): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
