"""Holds cuts of a scan against an independent computation over all of the scan's points.

strip.py SCAN < JSON: [[CUT, WIDTH, [[x, y], ...]], ...], files with their widths and lines. Prints JSON, for each of them:
what was found, and whether the records of the cut are those of the scan, byte for byte, each once. Points near an edge of
the strip are decided by exact rationals.
"""

import json
import sys
from fractions import Fraction

import laspy
import numpy as np


def beside(x, y, a, b, reach):
    """Whether points lie at right angles to a segment and no farther than a reach, and which of them float64 cannot decide."""
    u = b - a
    square = u @ u
    along = (x - a[0]) * u[0] + (y - a[1]) * u[1]
    distance = np.abs(u[0] * (y - a[1]) - u[1] * (x - a[0])) / np.sqrt(square)
    inside = (along >= 0) & (along <= square) & (distance <= reach)
    edge = np.minimum(np.abs(along), np.abs(along - square)) < 1e-7 * square + 1e-4
    doubt = (np.abs(distance - reach) < 1e-4) | edge
    return inside, doubt & (distance < reach + 1)


def at_joint(x, y, a, b, c, reach):
    """The same of the outer side of a joint: behind the end of one segment and before the start of the next."""
    behind = (x - b[0]) * (b - a)[0] + (y - b[1]) * (b - a)[1]
    before = (x - b[0]) * (c - b)[0] + (y - b[1]) * (c - b)[1]
    distance = np.hypot(x - b[0], y - b[1])
    inside = (behind >= 0) & (before <= 0) & (distance <= reach)
    doubt = (np.abs(distance - reach) < 1e-4) | (np.minimum(np.abs(behind), np.abs(before)) < 1e-3)
    return inside, doubt & (distance < reach + 1)


def exactly(x, y, pairs, reach):
    """Whether one point lies in the strip, without rounding."""
    x, y, reach = Fraction(float(x)), Fraction(float(y)), Fraction(float(reach))
    exact = [tuple(Fraction(float(value)) for value in (*a, *b)) for a, b in pairs]
    for index, (ax, ay, bx, by) in enumerate(exact):
        ux, uy = bx - ax, by - ay
        square = ux * ux + uy * uy
        along = (x - ax) * ux + (y - ay) * uy
        across = ux * (y - ay) - uy * (x - ax)
        if 0 <= along <= square and across**2 <= reach**2 * square:
            return True
        if along < square or index + 1 == len(exact):
            continue
        _, _, cx, cy = exact[index + 1]
        before = (x - bx) * (cx - bx) + (y - by) * (cy - by)
        if before <= 0 and (x - bx) ** 2 + (y - by) ** 2 <= reach**2:
            return True
    return False


def strip(x, y, line, width):
    """Which points lie in the strip, and how many of them lie so near an edge that they were decided exactly."""
    vertices = [np.array(vertex, float) for vertex in line]
    pairs = [(a, b) for a, b in zip(vertices, vertices[1:]) if (a != b).any()]
    parts = [beside(x, y, a, b, width / 2) for a, b in pairs]
    parts += [at_joint(x, y, a, b, c, width / 2) for (a, b), (_, c) in zip(pairs, pairs[1:])]
    inside = np.any([one for one, _ in parts], axis=0)
    doubtful = np.any([doubt for _, doubt in parts], axis=0)
    for point in np.flatnonzero(doubtful):
        inside[point] = exactly(x[point], y[point], pairs, width / 2)
    return inside, int(doubtful.sum())


def without(array, names):
    """The records without some fields."""
    kept = [name for name in array.dtype.names if name not in names]
    out = np.empty(len(array), [(name, array.dtype[name]) for name in kept])
    for name in kept:
        out[name] = array[name]
    return out


def judge(scan, path, width, line):
    cut = laspy.read(path)
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
    return {
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


if __name__ == "__main__":
    scan = laspy.read(sys.argv[1])
    print(json.dumps([judge(scan, path, float(width), line) for path, width, line in json.load(sys.stdin)]))
