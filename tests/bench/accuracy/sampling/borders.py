"""Density of points at the borders of nodes against the density inside."""

import numpy as np

from tree import Tree

# Spacings from the border: the strip, and what it is compared with.
STRIP = 0.25
INSIDE = (2.0, 6.0)


def density(tree: Tree, level: int) -> dict:
    """Points per width in the first quarter of a spacing at x and y borders of two inner nodes, over those from two
    to six spacings inside: `border` of what a page shows (levels up to this one), `own` of the level alone. The same
    for planes through the nodes' middles, which are no borders of this level, tells what chance and the scan itself
    do (`middle`). Errors are one standard deviation of the counts."""
    nodes = {node.key: node for node in tree.level(level) if node.inner}
    spacing, side = tree.spacing_of(level), tree.side / 2**level
    shown, own, middle = np.zeros(2, int), np.zeros(2, int), np.zeros(2, int)
    for key, node in nodes.items():
        levels = [(node.points - tree.corner(key)) / spacing]
        levels.append((ancestors(tree, key) - tree.corner(key)) / spacing)
        for within, counted in ((levels[0], [own, shown]), (levels[1], [shown])):
            for axis in range(2):
                for step, off in ((-1, within[:, axis]), (1, side / spacing - within[:, axis])):
                    other = list(key)
                    other[1 + axis] += step
                    if tuple(other) in nodes:
                        for count in counted:
                            count += counts(off)
                middle += counts(np.abs(within[:, axis] - side / spacing / 2))
    return {
        **{"border": ratio(shown), "borderError": error(shown)},
        **{"own": ratio(own), "ownError": error(own)},
        **{"middle": ratio(middle), "middleError": error(middle)},
    }


def ancestors(tree: Tree, key: tuple) -> np.ndarray:
    """The points of a node's ancestors that lie in its cube."""
    low, high = tree.corner(key), tree.corner(key) + tree.side / 2 ** key[0]
    parts = [np.empty((0, 3))]
    for up in range(1, key[0] + 1):
        parent = tree.node(tuple([key[0] - up, *(place >> up for place in key[1:])]))
        parts.append(parent.points[np.all((parent.points >= low) & (parent.points < high), axis=1)])
    return np.concatenate(parts)


def counts(off: np.ndarray) -> np.ndarray:
    return np.array([np.count_nonzero(off < STRIP), np.count_nonzero((off >= INSIDE[0]) & (off < INSIDE[1]))])


def ratio(count: np.ndarray) -> float | None:
    strip, inside = count
    return float(strip / STRIP / (inside / (INSIDE[1] - INSIDE[0]))) if inside else None


def error(count: np.ndarray) -> float | None:
    strip, inside = count
    return float(ratio(count) * np.sqrt(1 / strip + 1 / inside)) if strip and inside else None
