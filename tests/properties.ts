import fc from "fast-check";

/**
 * The seed of every property is `GROMA_SEED`; where it is absent or `random`, each run tries other numbers.
 * `npm test` gives one of its own, so that a commit which was green stays green.
 */
const seed = process.env.GROMA_SEED ?? "random";
if (seed !== "random") fc.configureGlobal({ ...fc.readConfigureGlobal(), seed: Number(seed) });
