"""Holes of the sample that levels up to one make together."""

import numpy as np
from scipy.spatial import cKDTree

from tree import Tree, stacked

# Every eighth point of the scan is asked for its distance from the sample.
STEP = 8


def coverage(tree: Tree, level: int) -> dict:
    """Distance of the scan's points from the nearest point of levels up to this one, in spacings of the level:
    `hole` is the radius of the largest empty ball around a point that exists."""
    sample = stacked([node for node in tree.nodes if node.key[0] <= level])
    scan = stacked(tree.nodes)[::STEP]
    distance, _ = cKDTree(sample).query(scan)
    distance /= tree.spacing_of(level)
    return {"hole": float(distance.max()), "hole999": float(np.quantile(distance, 0.999))}
