import { createHash } from "node:crypto";
import { mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";

const GENERATED = new Set(["node_modules", "dist", "target", ".venv", "artifacts"]);

/** Digest of the contents of files and, walked in order of name, folders (generated folders left out). */
export function digest(root, places) {
  const hash = createHash("sha256");
  const visit = (place) => {
    const path = join(root, place);
    if (statSync(path).isDirectory()) {
      for (const name of readdirSync(path).sort()) {
        if (!GENERATED.has(name) && !name.endsWith(".tsbuildinfo")) visit(join(place, name));
      }
    } else {
      hash.update(place).update("\0").update(readFileSync(path)).update("\0");
    }
  };
  places.forEach(visit);
  return hash.digest("hex");
}

/** Whether the step behind this stamp was last finished with the same digest. */
export function isDone(stamp, value) {
  try {
    return readFileSync(stamp, "utf8") === value;
  } catch {
    return false;
  }
}

/** Remembers that the step behind this stamp is finished with this digest. */
export function markDone(stamp, value) {
  mkdirSync(dirname(stamp), { recursive: true });
  writeFileSync(stamp, value);
}
