"""Chooses records of a COPC file and places them with PROJ: the referee of where the page draws them.

Usage:
  placing.py choose COPC NODES POINTS -> [{ key: "level-x-y-z", index }], random with a fixed seed
  placing.py check COPC PROJ4 METRES_PER_VERTICAL_UNIT, standard input [{ key, index, ecef: [x, y, z] }]
    -> { count, worst } (metres between PROJ's place and the one given)
"""

import json
import random
import sys

import copclib
import numpy as np
from pyproj import CRS, Transformer


def choose(path: str, nodes: int, points: int) -> list:
    chance = random.Random(20150217)
    entries = [node for node in copclib.FileReader(path).GetAllNodes() if node.point_count > 0]
    entries.sort(key=lambda node: (node.key.d, node.key.x, node.key.y, node.key.z))
    chosen = chance.sample(entries, min(nodes, len(entries)))
    picked = []
    for number in range(points):
        node = chosen[number % len(chosen)]
        key = node.key
        picked.append({"key": f"{key.d}-{key.x}-{key.y}-{key.z}", "index": chance.randrange(node.point_count)})
    return picked


def check(path: str, proj4: str, vertical: float, asked: list) -> dict:
    reader = copclib.FileReader(path)
    source = {}
    for key in sorted({point["key"] for point in asked}):
        node = reader.FindNode(copclib.VoxelKey(*(int(part) for part in key.split("-"))))
        points = reader.GetPoints(node)
        source[key] = np.stack([points.x, points.y, points.z], axis=1)
    xyz = np.array([source[point["key"]][point["index"]] for point in asked])
    # From a 2D CRS PROJ shifts longitude and latitude and leaves the height alone, in metres.
    geocentric = Transformer.from_crs(CRS.from_proj4(proj4), CRS.from_epsg(4978), always_xy=True)
    truth = np.stack(geocentric.transform(xyz[:, 0], xyz[:, 1], xyz[:, 2] * vertical), axis=1)
    distance = np.linalg.norm(truth - np.array([point["ecef"] for point in asked]), axis=1)
    return {"count": len(asked), "worst": float(distance.max())}


if sys.argv[1] == "choose":
    json.dump(choose(sys.argv[2], int(sys.argv[3]), int(sys.argv[4])), sys.stdout)
else:
    json.dump(check(sys.argv[2], sys.argv[3], float(sys.argv[4]), json.load(sys.stdin)), sys.stdout)
