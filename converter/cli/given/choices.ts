// Values that options take, apart from what does the work, so that the command line can tell them without loading it.

/** How progress is shown: a bar on a terminal, a line now and then, or JSON lines for machines. */
export const PROGRESS_KINDS = ["bar", "plain", "json"] as const;
export type ProgressKind = (typeof PROGRESS_KINDS)[number];

/** How the points of a node are chosen. */
export const SAMPLINGS = ["poisson", "grid", "random", "first"] as const;
export type Sampling = (typeof SAMPLINGS)[number];
