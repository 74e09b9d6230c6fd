import type { NodeStore, OctreeNode } from "../octree/index.js";
import type { PointSource } from "../sources/contract/point-source.js";
import { Pace } from "./pace.js";

/** Entries between two looks at the clock: what Groma puts into a page, so that a cloud opens without a frame in between. */
const SLICE = 1024;

/**
 * Reads the page of the hierarchy that a node stands for and puts it into the octree, whole and at once; what takes
 * long before that is done in stretches.
 * @throws SourceError, FormatError; the signal's reason when aborted
 */
export async function openPage(
  source: Pick<PointSource, "page">,
  store: NodeStore,
  node: OctreeNode,
  signal: AbortSignal | undefined,
): Promise<void> {
  const draft = store.draft(node);
  const entries = await source.page(draft.page.address, { signal });
  const pace = new Pace(signal);
  let taken = 0;
  for (const entry of entries) {
    draft.take(entry);
    if (++taken % SLICE === 0) await pace.rest();
  }
  while (draft.grow(SLICE)) await pace.rest();
  store.insertPage(draft);
}
