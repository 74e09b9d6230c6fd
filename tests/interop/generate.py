"""Writes scans of every point format with laspy: `generate.py FOLDER`, prints the names of the files as JSON.

Deterministic. Every field takes every value that its bits allow; extra bytes of several types.
"""

import json
import sys
from pathlib import Path

import laspy
import numpy as np

POINTS = 4000


def scan(point_format, seed):
    """A scan of one format with random fields."""
    random = np.random.default_rng(seed)
    header = laspy.LasHeader(point_format=point_format, version="1.4" if point_format > 3 else "1.2")
    header.scales, header.offsets = [0.001, 0.001, 0.01], [2_600_000.0, 1_200_000.0, -0.0]
    header.add_extra_dim(laspy.ExtraBytesParams(name="Amplitude", type=np.float32))
    header.add_extra_dim(laspy.ExtraBytesParams(name="Pulse width", type=np.uint16, scales=[0.1], offsets=[0.0]))
    las = laspy.LasData(header)
    las.points = laspy.ScaleAwarePointRecord.zeros(POINTS, header=header)
    array = las.points.array
    for name in array.dtype.names:
        kind = array.dtype[name]
        if kind.kind == "f":
            array[name] = random.normal(0, 1e5, POINTS)
        elif name in "XYZ":
            array[name] = random.integers(-1_000_000, 1_000_000, POINTS)
        else:
            bounds = np.iinfo(kind)
            array[name] = random.integers(bounds.min, bounds.max, POINTS, dtype=kind, endpoint=True)
    return las


def main(folder):
    names = []
    for point_format in range(11):
        for suffix in ("las", "laz"):
            path = Path(folder) / f"format-{point_format}.{suffix}"
            scan(point_format, point_format).write(str(path))
            names.append(path.name)
    json.dump(names, sys.stdout)


if __name__ == "__main__":
    main(sys.argv[1])
