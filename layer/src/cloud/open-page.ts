import type { NodeStore, OctreeNode } from "../octree/index.js";
import { type CopcFile, ENTRY_LENGTH, parseHierarchyPage, readPageBytes } from "../sources/index.js";
import { Pace } from "./pace.js";

/** Entries between two looks at the clock. */
const SLICE = 256;

/**
 * Reads the page of the hierarchy that a node stands for and puts it into the octree, whole and at once; what takes
 * long before that is done in stretches.
 * @throws SourceError, FormatError; the signal's reason when aborted
 */
export async function openPage(
  copc: CopcFile,
  store: NodeStore,
  node: OctreeNode,
  signal: AbortSignal | undefined,
): Promise<void> {
  const draft = store.draft(node);
  const bytes = await readPageBytes(copc, draft.page.address, { signal });
  const pace = new Pace(signal);
  for (let at = 0; at < bytes.length; at += SLICE * ENTRY_LENGTH) {
    draft.take(parseHierarchyPage(bytes.subarray(at, at + SLICE * ENTRY_LENGTH), copc.limits));
    await pace.rest();
  }
  while (draft.grow(SLICE)) await pace.rest();
  store.insertPage(draft);
}
