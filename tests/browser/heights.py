"""Writes points of a compound CRS as a scan: `heights.py OUT.las EPSG`, standard input [[x, y, z]], source units.

Point i has the intensity i; the step of 0.1 mm keeps the rounding of the coordinates below that.
"""

import json
import sys

import laspy
import numpy as np
from pyproj import CRS


def main(path: str, code: str) -> None:
    points = np.array(json.load(sys.stdin))
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales = [0.0001] * 3
    header.offsets = [*np.floor(points[:, :2].mean(axis=0)), 0.0]
    header.add_crs(CRS.from_epsg(int(code)))
    las = laspy.LasData(header)
    las.x, las.y, las.z = points.T
    las.intensity = np.arange(len(points))
    las.write(path)
    json.dump(len(points), sys.stdout)


if __name__ == "__main__":
    main(*sys.argv[1:3])
