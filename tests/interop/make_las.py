"""Writes LAS files of given points with laspy.

Standard input: [{ path, scale, rows: [[x, y, z], ...], wkt?: any text that pyproj reads }]
Standard output: the number of files.
"""

import json
import sys

import laspy
import numpy
from pyproj import CRS

jobs = json.load(sys.stdin)
for job in jobs:
    points = numpy.array([row[:3] for row in job["rows"]], dtype=numpy.float64)
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales = [job["scale"]] * 3
    header.offsets = numpy.round((points.min(axis=0) + points.max(axis=0)) / 2)
    if job.get("wkt"):
        header.add_crs(CRS(job["wkt"]))
    las = laspy.LasData(header)
    las.x, las.y, las.z = points.T
    las.write(job["path"])
print(json.dumps(len(jobs)))
