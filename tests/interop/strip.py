"""Holds a cut of a scan against an independent computation over all of the scan's points.

strip.py SCAN CUT WIDTH LINE, the line as JSON: [[x, y], ...]. Prints JSON: what was found, and whether the records of the
cut are those of the scan, byte for byte, each once. Points near an edge of the strip are decided by exact rationals.
"""

import json
import sys
from fractions import Fraction

import laspy
import numpy as np


def near_segment(x, y, a, b, reach, first, last):
    """Whether points lie in the part of the strip along one segment, and which of them float64 cannot decide."""
    u = b - a
    square = u @ u
    along = (x - a[0]) * u[0] + (y - a[1]) * u[1]
    share = np.clip(along / square, 0, 1)
    distance = np.hypot(x - a[0] - share * u[0], y - a[1] - share * u[1])
    inside = distance <= reach
    doubt = np.abs(distance - reach) < 1e-4
    if first:
        inside &= along >= 0
        doubt |= np.abs(along) < 1e-7 * square
    if last:
        inside &= along <= square
        doubt |= np.abs(along - square) < 1e-7 * square
    return inside, doubt & (distance < reach + 1)


def exactly_near(x, y, a, b, reach, first, last):
    """The same for one point, without rounding."""
    x, y, ax, ay, bx, by, reach = (Fraction(float(value)) for value in (x, y, *a, *b, reach))
    ux, uy = bx - ax, by - ay
    square = ux * ux + uy * uy
    along = (x - ax) * ux + (y - ay) * uy
    if along < 0:
        return not first and (x - ax) ** 2 + (y - ay) ** 2 <= reach**2
    if along > square:
        return not last and (x - bx) ** 2 + (y - by) ** 2 <= reach**2
    across = ux * (y - ay) - uy * (x - ax)
    return across**2 <= reach**2 * square


def strip(x, y, line, width):
    """Which points lie in the strip, and how many of them lie so near an edge that they were decided exactly."""
    vertices = [np.array(vertex, float) for vertex in line]
    pairs = [(a, b) for a, b in zip(vertices, vertices[1:]) if (a != b).any()]
    inside = np.zeros(len(x), bool)
    doubtful = np.zeros(len(x), bool)
    for index, (a, b) in enumerate(pairs):
        ends = index == 0, index == len(pairs) - 1
        one, doubt = near_segment(x, y, a, b, width / 2, *ends)
        inside |= one
        doubtful |= doubt
    for point in np.flatnonzero(doubtful):
        inside[point] = any(
            exactly_near(x[point], y[point], a, b, width / 2, index == 0, index == len(pairs) - 1)
            for index, (a, b) in enumerate(pairs)
        )
    return inside, int(doubtful.sum())


def without(array, names):
    """The records without some fields."""
    kept = [name for name in array.dtype.names if name not in names]
    out = np.empty(len(array), [(name, array.dtype[name]) for name in kept])
    for name in kept:
        out[name] = array[name]
    return out


scan = laspy.read(sys.argv[1])
cut = laspy.read(sys.argv[2])
width = float(sys.argv[3])
line = json.loads(sys.argv[4])
scale, offset = scan.header.scales, scan.header.offsets
x = scan.X * scale[0] + offset[0]
y = scan.Y * scale[1] + offset[1]
inside, doubtful = strip(x, y, line, width)
added = [name for name in cut.point_format.extra_dimension_names if name in ("chainage", "offset")]
records = np.ascontiguousarray(without(cut.points.array, added))
as_bytes = np.dtype((np.void, records.dtype.itemsize))
expected = np.ascontiguousarray(scan.points.array[inside])
same = records.dtype.itemsize == expected.dtype.itemsize and np.array_equal(
    np.sort(records.view(as_bytes).ravel()), np.sort(expected.view(as_bytes).ravel())
)
vlrs = {(vlr.user_id, vlr.record_id): vlr.record_data_bytes() for vlr in cut.header.vlrs}
kept = [
    (vlr.user_id, vlr.record_id) in vlrs and vlrs[vlr.user_id, vlr.record_id] == vlr.record_data_bytes()
    for vlr in scan.header.vlrs
    if vlr.user_id in ("LASF_Projection",) or (vlr.user_id == "groma" and vlr.record_id in (1, 3))
]
along = {name: [float(np.min(cut[name])), float(np.max(cut[name]))] for name in added}
print(
    json.dumps(
        {
            "count": int(inside.sum()),
            "written": len(cut.points),
            "same": bool(same),
            "doubtful": doubtful,
            "meaning": list(cut.header.scales) == list(scale)
            and list(cut.header.offsets) == list(offset)
            and cut.header.point_format.id == scan.header.point_format.id,
            "kept": len(kept) > 0 and all(kept),
            "bounds": bool(
                len(cut.points) == 0
                or (
                    np.allclose(cut.header.mins, [cut.x.min(), cut.y.min(), cut.z.min()], atol=1e-9)
                    and np.allclose(cut.header.maxs, [cut.x.max(), cut.y.max(), cut.z.max()], atol=1e-9)
                )
            ),
            "along": along,
            "users": sorted({vlr.user_id for vlr in cut.header.vlrs}),
        }
    )
)
