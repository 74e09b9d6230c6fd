import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";

setFlagsFromString("--expose-gc");
const collectGarbage = runInNewContext("gc");

const turn = () => new Promise((resolve) => setImmediate(resolve));

/** Bytes that are still used once all garbage is gone. */
export async function memoryInUse() {
  collectGarbage();
  // What only finalisers let go of goes with a second round.
  await turn();
  collectGarbage();
  return process.memoryUsage();
}

export const mebibytes = (bytes) => +(bytes / 2 ** 20).toFixed(1);
