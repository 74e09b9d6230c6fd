"""Volume over a convex ring by scipy's Delaunay triangulation (Qhull) and shapely's clipping (GEOS), points by laspy.

Reads {"file", "ring": [[x, y]], "margin", "height"} from stdin: metres in the plane of the scan. Writes {"cut", "fill",
"points"}: the surface's volume above and below the height within the ring, and the points in the ring's rectangle with
its margin. Triangles are split along the level by clipping their corners' heights.
"""

import json
import sys

import laspy
import numpy as np
import shapely
from scipy.spatial import Delaunay

request = json.load(sys.stdin)
ring = np.array(request["ring"])
low, high = ring.min(axis=0), ring.max(axis=0)
margin = request["margin"] * (high - low)
scan = laspy.read(request["file"])
points = np.column_stack([scan.x, scan.y, scan.z]).astype(float)
near = np.all((points[:, :2] >= low - margin) & (points[:, :2] <= high + margin), axis=1)
points = points[near]
_, first = np.unique(points[:, :2], axis=0, return_index=True)
origin = ring.mean(axis=0)
xy = points[np.sort(first), :2] - origin
z = points[np.sort(first), 2] - request["height"]
polygon = shapely.Polygon(ring - origin)
shapely.prepare(polygon)
triangles = Delaunay(xy).simplices
shapes = shapely.polygons(xy[triangles])
inside = shapely.contains(polygon, shapes)
touched = shapely.intersects(polygon, shapes) & ~inside


def linear(corners, heights):
    """a, b, c of a + b x + c y through three points."""
    return np.linalg.solve(np.column_stack([np.ones(3), corners]), heights)


def integral(shape, plane):
    """Of a linear function over a convex polygon: area times value at the centroid."""
    if shape.area == 0:
        return 0.0
    centre = shape.centroid
    return shape.area * (plane[0] + plane[1] * centre.x + plane[2] * centre.y)


def above(shape, corners, heights, plane):
    """The part of it that is above 0."""
    if heights.min() >= 0:
        return integral(shape, plane)
    if heights.max() <= 0:
        return 0.0
    loop = []
    for i in range(3):
        j = (i + 1) % 3
        if heights[i] >= 0:
            loop.append(corners[i])
        if (heights[i] >= 0) != (heights[j] >= 0):
            loop.append(corners[i] + heights[i] / (heights[i] - heights[j]) * (corners[j] - corners[i]))
    part = shapely.Polygon(loop).intersection(shape)
    return integral(part, plane)


cut = fill = 0.0
for which, whole in [(inside, True), (touched, False)]:
    for at in np.flatnonzero(which):
        corners, heights = xy[triangles[at]], z[triangles[at]]
        shape = shapes[at] if whole else shapes[at].intersection(polygon)
        plane = linear(corners, heights)
        up = above(shape, corners, heights, plane)
        cut += up
        fill += up - integral(shape, plane)
json.dump({"cut": cut, "fill": fill, "points": int(near.sum())}, sys.stdout)
