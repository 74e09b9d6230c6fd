import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync } from "node:fs";
import { dirname, join } from "node:path";

/** The peer: the fastest writer of COPC that was measured when this was built. */
export const PEER = { crate: "copc_converter", version: "0.16.0" };

/** The converter core under measurement; `GROMA_CORE` names another build, whose examples stand beside it. */
export function coreOf(root) {
  return process.env.GROMA_CORE ?? join(root, "converter/target/release/groma-core");
}

/** The lower bound: no converter can do less (converter/examples/lower_bound.rs). */
export function lowerBoundOf(root) {
  const program = join(dirname(coreOf(root)), "examples/lower_bound");
  if (!process.env.GROMA_CORE) {
    const manifest = join(root, "converter/Cargo.toml");
    const args = ["build", "--release", "--locked", "--example", "lower_bound", "--manifest-path", manifest];
    execFileSync("cargo", args, { stdio: "inherit" });
  }
  return program;
}

/** The peer, compiled for this machine the first time; undefined where it cannot be had. */
export function peerOf(root) {
  const folder = process.env.GROMA_PEERS ?? join(root, "tests/artifacts/peers");
  const program = join(folder, "bin", PEER.crate);
  if (existsSync(program)) return program;
  mkdirSync(folder, { recursive: true });
  const args = ["install", PEER.crate, "--version", PEER.version, "--locked", "--root", folder];
  try {
    const env = { ...process.env, RUSTFLAGS: "-C target-cpu=native" };
    execFileSync("nice", ["cargo", ...args], { stdio: "inherit", env });
    return program;
  } catch {
    return undefined;
  }
}
