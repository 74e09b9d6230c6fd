"""A part of a level from above, as numbers for a picture."""

import numpy as np

from tree import Tree, stacked


def window(tree: Tree, level: int, side: float) -> dict:
    """Points of levels up to this one in a square of `side` spacings around the corner of four nodes of the level that
    is nearest to the middle of the scan; in tenths of a spacing from the square's lower left corner."""
    spacing = tree.spacing_of(level)
    points = stacked([node for node in tree.nodes if node.key[0] <= level])[:, :2]
    edge = tree.side / 2**level
    middle = tree.min[:2] + np.round((np.median(points, axis=0) - tree.min[:2]) / edge) * edge
    within = (points - middle) / spacing + side / 2
    inside = within[np.all((within >= 0) & (within < side), axis=1)]
    return {"side": side, "points": np.round(inside * 10).astype(int).tolist()}
