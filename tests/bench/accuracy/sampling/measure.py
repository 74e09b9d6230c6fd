"""Measures the samples of COPC files: `measure.py scan.copc.laz [--prefix]` prints JSON."""

import json
import sys

from borders import density
from coverage import coverage
from distances import inner_nodes, leaves, shown
from picture import window
from prefix import cost
from tree import Tree

# Levels whose holes are looked for; deeper ones are nearly the scan itself.
COVERAGE_LEVELS = range(1, 4)
PICTURE_LEVEL = 2
PICTURE_SIDE = 44


def measure(path: str, prefix: bool) -> dict:
    """Everything that is known of the samples of one file."""
    tree = Tree(path)
    result = {"levels": [level(tree, number) for number in range(tree.levels)]}
    result["picture"] = window(tree, min(PICTURE_LEVEL, tree.levels - 1), PICTURE_SIDE)
    if prefix:
        result["prefix"] = cost(path, tree)
    return result


def level(tree: Tree, number: int) -> dict:
    nodes = tree.level(number)
    sizes = [len(node.points) for node in nodes]
    return {
        "level": number,
        "nodes": len(nodes),
        "innerNodes": sum(node.inner for node in nodes),
        "points": sum(sizes),
        "largestNode": max(sizes),
        "inner": inner_nodes(tree, number),
        "shownBelowOne": shown(tree, number),
        "leaves": leaves(tree, number),
        "density": density(tree, number),
        **(coverage(tree, number) if number in COVERAGE_LEVELS else {}),
    }


if __name__ == "__main__":
    print(json.dumps(measure(sys.argv[1], "--prefix" in sys.argv[2:])))
