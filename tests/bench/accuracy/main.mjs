// `npm run bench:accuracy [-- placing map geodesic measuring vertical rendering detail sampling profile]`: what accuracy costs, into
// docs/accuracy/.
import { root, setup } from "../../../.ci/setup/main.mjs";
import { forTest } from "../../../.ci/setup/steps.mjs";

await setup(forTest);
const { writeReports } = await import("./reports.mjs");
await writeReports(root, process.argv.slice(2));
