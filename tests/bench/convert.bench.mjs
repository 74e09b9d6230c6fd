import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

/** Peak resident memory (bytes) that Linux has noted for a running process; 0 where it cannot be read. */
function peakMemory(pid) {
  try {
    const [, kilobytes] = /VmHWM:\s+(\d+) kB/.exec(readFileSync(`/proc/${pid}/status`, "utf8")) ?? [];
    return Number(kilobytes ?? 0) * 1024;
  } catch {
    return 0;
  }
}

function convert(core, input, output) {
  return new Promise((resolve, reject) => {
    const began = performance.now();
    const child = spawn(core, ["convert", input, output], { stdio: ["ignore", "ignore", "inherit"] });
    let peak = 0;
    const watch = setInterval(() => {
      peak = Math.max(peak, peakMemory(child.pid));
    }, 20);
    child.on("close", (code) => {
      clearInterval(watch);
      if (code !== 0) return reject(new Error(`groma-core ended with ${code}`));
      resolve({ seconds: (performance.now() - began) / 1000, peak });
    });
  });
}

/** Conversion of the Autzen scan: wall time, peak memory, size; best and worst of three runs. */
export async function bench(root) {
  const input = join(root, "../shared/data/autzen.laz");
  if (!existsSync(input)) return [{ note: "autzen.laz is not in ../shared/data: skipped" }];
  const folder = mkdtempSync(join(tmpdir(), "groma-bench-"));
  const output = join(folder, "autzen.copc.laz");
  const runs = [];
  try {
    for (let run = 0; run < 3; run++) {
      rmSync(output, { force: true });
      runs.push(await convert(join(root, "converter/target/release/groma-core"), input, output));
    }
    const seconds = runs.map((run) => run.seconds).sort((a, b) => a - b);
    return [
      {
        file: "autzen.laz",
        "best s": seconds[0].toFixed(1),
        "worst s": seconds.at(-1).toFixed(1),
        "peak MB": Math.round(Math.max(...runs.map((run) => run.peak)) / 1e6),
        "input MB": (statSync(input).size / 1e6).toFixed(1),
        "output MB": (statSync(output).size / 1e6).toFixed(1),
      },
    ];
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
