"""Chooses points of a COPC file that stand alone in plan, and says where PROJ puts them on maps.

Usage:
  map.py COPC PROJ4 X Y HALF ALONE COUNT NAME=CRS ...
    X, Y, HALF: middle of a square and half its edge, source units; ALONE: least distance to any other point
    -> { points: [{ key, source: [x, y, z], NAME: [x, y], ... }], all: number of points in the square }
"""

import json
import random
import sys

import copclib
import numpy as np
from pyproj import CRS, Transformer
from scipy.spatial import cKDTree

path, proj4, x, y, half, alone, count = sys.argv[1:8]
x, y, half, alone = float(x), float(y), float(half), float(alone)
reader = copclib.FileReader(path)
xyz = []
box = copclib.Box(x - 1.2 * half, y - 1.2 * half, x + 1.2 * half, y + 1.2 * half)
points = reader.GetPointsWithinBox(box)
xyz = np.stack([points.x, points.y, points.z], axis=1)
distance, _ = cKDTree(xyz[:, :2]).query(xyz[:, :2], k=2)
inside = (np.abs(xyz[:, 0] - x) < half) & (np.abs(xyz[:, 1] - y) < half)
candidates = np.flatnonzero(inside & (distance[:, 1] > alone))
chosen = random.Random(7).sample(list(candidates), min(int(count), len(candidates)))
result = [{"source": xyz[i].tolist()} for i in chosen]
for argument in sys.argv[8:]:
    name, crs = argument.split("=", 1)
    target = CRS.from_proj4(crs) if crs.startswith("+") else CRS.from_user_input(crs)
    way = Transformer.from_crs(CRS.from_proj4(proj4), target, always_xy=True)
    for entry in result:
        sx, sy, _ = entry["source"]
        entry[name] = list(way.transform(sx, sy))
json.dump({"points": result, "all": len(xyz)}, sys.stdout)
