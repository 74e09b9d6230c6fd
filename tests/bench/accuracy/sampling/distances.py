"""Distances of neighbouring points of one level, against the level's spacing."""

import numpy as np
from scipy.spatial import cKDTree

from tree import Tree, stacked

# Spacings are halves of halves of the root's: what is this near to one is rounding.
TOLERANCE = 1e-9
# Of leaves, which hold all that is left, so many points are looked at.
LEAF_SAMPLE = 100_000


def inner_nodes(tree: Tree, level: int) -> dict:
    """Shares of the points of inner nodes that have a neighbour closer than a half and than one spacing: in their
    own node, and, of points within one spacing of a face to another inner node, in another node."""
    nodes = [node for node in tree.level(level) if node.inner]
    points = stacked(nodes)
    spacing = tree.spacing_of(level)
    owner = np.repeat(np.arange(len(nodes)), [len(node.points) for node in nodes])
    pairs = cKDTree(points).query_pairs(spacing, output_type="ndarray") if len(points) > 1 else np.empty((0, 2), int)
    distance = np.linalg.norm(points[pairs[:, 0]] - points[pairs[:, 1]], axis=1) / spacing
    across = owner[pairs[:, 0]] != owner[pairs[:, 1]]
    border = near_border(tree, nodes, level)

    def share(selected: np.ndarray, among: int) -> float | None:
        return len(np.unique(pairs[selected])) / among if among else None

    return {
        "points": len(points),
        "borderPoints": border,
        "insideBelowHalf": share(~across & (distance < 0.5), len(points)),
        "insideBelowOne": share(~across & (distance < 1 - TOLERANCE), len(points)),
        "acrossBelowHalf": share(across & (distance < 0.5), border),
        "acrossBelowOne": share(across & (distance < 1 - TOLERANCE), border),
        "pairsBelowOne": int(np.count_nonzero(distance < 1 - TOLERANCE)),
    }


def shown(tree: Tree, level: int) -> float | None:
    """Share of the points of inner nodes of levels up to this one, which a page shows together, that have a neighbour
    closer than one spacing of the level."""
    points = stacked([node for node in tree.nodes if node.key[0] <= level and node.inner])
    if len(points) < 2 or not any(node.inner for node in tree.level(level)):
        return None
    distance, _ = cKDTree(points).query(points, k=2)
    return float(np.mean(distance[:, 1] < tree.spacing_of(level) * (1 - TOLERANCE)))


def near_border(tree: Tree, nodes: list, level: int) -> int:
    """How many points lie within one spacing of a face to another of the nodes."""
    keys = {node.key for node in nodes}
    spacing, side = tree.spacing_of(level), tree.side / 2**level
    count = 0
    for node in nodes:
        within = node.points - tree.corner(node.key)
        near = np.zeros(len(within), bool)
        for axis in range(3):
            for step, off in ((-1, within[:, axis]), (1, side - within[:, axis])):
                other = list(node.key)
                other[1 + axis] += step
                if tuple(other) in keys:
                    near |= off < spacing
        count += int(np.count_nonzero(near))
    return count


def leaves(tree: Tree, level: int) -> dict:
    """The same of a level's leaves, whose distance nothing keeps: any neighbour in any leaf of the level."""
    points = stacked([node for node in tree.level(level) if not node.inner])
    if len(points) < 2:
        return {"points": len(points)}
    step = max(1, len(points) // LEAF_SAMPLE)
    distance, _ = cKDTree(points).query(points[::step], k=2)
    nearest = distance[:, 1] / tree.spacing_of(level)
    return {
        "points": len(points),
        "belowHalf": float(np.mean(nearest < 0.5)),
        "belowOne": float(np.mean(nearest < 1 - TOLERANCE)),
    }
