"""Holds a clip of a scan against GEOS: the same records, byte for byte, each once.

clipped.py SCAN CLIP POLYGON CLASSES   polygon and classes as JSON, [] and [] for all; prints JSON
"""

import json
import sys

import laspy
import numpy as np
import shapely

scan, clip = laspy.read(sys.argv[1]), laspy.read(sys.argv[2])
rings, classes = json.loads(sys.argv[3]), json.loads(sys.argv[4])
scale, offset = scan.header.scales, scan.header.offsets
inside = np.ones(len(scan), bool)
on_edge = 0
if rings:
    polygon = shapely.Polygon(rings[0], rings[1:])
    shapely.prepare(polygon)
    x, y = scan.X * scale[0] + offset[0], scan.Y * scale[1] + offset[1]
    inside = shapely.intersects_xy(polygon, x, y)
    on_edge = int((inside & ~shapely.contains_xy(polygon, x, y)).sum())
if classes:
    inside &= np.isin(scan.classification, classes)


def rows(array):
    array = np.ascontiguousarray(array)
    return np.sort(array.view(np.dtype((np.void, array.dtype.itemsize))).ravel())


same = np.array_equal(rows(scan.points.array[inside]), rows(clip.points.array))
print(json.dumps({"count": int(inside.sum()), "same": bool(same), "onEdge": on_edge}))
