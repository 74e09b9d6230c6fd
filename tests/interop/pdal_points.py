"""Prints the points of a LAS or LAZ file as laspy reads them: stored integers, scale, offset, and every dimension."""

import json
import sys

import laspy
import numpy

las = laspy.read(sys.argv[1])
names = [name for name in las.point_format.dimension_names if name not in ("X", "Y", "Z")]
print(
    json.dumps(
        {
            "integers": [las.X.tolist(), las.Y.tolist(), las.Z.tolist()],
            "scale": las.header.scales.tolist(),
            "offset": las.header.offsets.tolist(),
            "dimensions": {name: numpy.asarray(las[name]).tolist() for name in names},
        }
    )
)
