import { findProj } from "../converter/cli/proj/program/find.js";

/** PROJ as `groma` finds it. */
export const proj = await findProj();

/** Why tests that need it are skipped. */
export const projMissing = proj ? undefined : "PROJ is not there: run npm run setup";
