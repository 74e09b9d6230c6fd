/**
 * Where a node stands in its life.
 * - `page`: known only by a reference to a further page of the hierarchy
 * - `opening`: that page is being read
 * - `empty`: in the octree without points of its own; never requested
 * - `listed`: has points, none of them here
 * - `queued`: wanted, waiting for its turn
 * - `loading`: being read, decoded and placed
 * - `ready`: its vertices are here
 * - `failed`: reading it, or its page, ended in an error
 */
export type NodeState = "page" | "opening" | "empty" | "listed" | "queued" | "loading" | "ready" | "failed";

const LEGAL: Readonly<Record<NodeState, readonly NodeState[]>> = {
  page: ["opening"],
  opening: ["page", "empty", "listed", "failed"],
  // Back to the page that lists it, once that is given up.
  empty: ["page"],
  listed: ["queued", "page"],
  queued: ["loading", "listed"],
  loading: ["ready", "listed", "failed"],
  ready: ["listed"],
  failed: ["page", "listed"],
};

/** True where a node may go from one state to the other. */
export function isLegal(from: NodeState, to: NodeState): boolean {
  return LEGAL[from].includes(to);
}

/**
 * Holds a change of state against the table.
 * @throws Error for a change that the table does not have: a bug of the layer's own, not a fault of the data
 */
export function assertLegal(from: NodeState, to: NodeState, node: { readonly name: string }): void {
  if (!isLegal(from, to)) throw new Error(`node ${node.name} cannot go from ${from} to ${to}`);
}

/** True where a node in this state is waiting, on its way or here: what knows of it must stay. */
export function isHeld(state: NodeState): boolean {
  return state === "opening" || state === "queued" || state === "loading" || state === "ready";
}
