"""ECEF of points of coordinate reference systems by pyproj.

Arguments: folder of grids
Standard input: [{ crs, points: [[x, y, z], ...] }], x east or north as the system is drawn, longitude first
Standard output: [[[X, Y, Z], ...], ...], metres
"""

import json
import sys

import numpy
from pyproj import CRS, Transformer, datadir

if len(sys.argv) > 1:
    datadir.append_data_dir(sys.argv[1])
results = []
for job in json.load(sys.stdin):
    source = CRS(job["crs"])
    # Heights of a system without any are ellipsoidal.
    whole = source if len(source.axis_info) > 2 or source.is_compound else source.to_3d()
    transformer = Transformer.from_crs(whole, "EPSG:4978", always_xy=True)
    results.append(numpy.array(transformer.transform(*numpy.array(job["points"]).T)).T.tolist())
json.dump(results, sys.stdout)
