"""How many records of a scan lie in a disc over the plane, and a digest of their integers in rising order.

usage: inside.py SCAN X Y RADIUS   (source coordinates and units)
"""

import hashlib
import json
import sys

import laspy
import numpy

scan, x, y, radius = sys.argv[1], *map(float, sys.argv[2:5])
las = laspy.read(scan)
places = [numpy.asarray(las[axis], dtype=numpy.int64) for axis in "XYZ"]
easting, northing = (
    places[axis] * las.header.scales[axis] + las.header.offsets[axis] for axis in (0, 1)
)
inside = (easting - x) ** 2 + (northing - y) ** 2 <= radius**2
rows = numpy.stack([axis[inside] for axis in places], axis=1).astype("<i4")
rows = rows[numpy.lexsort(rows.T[::-1])]
print(json.dumps({"count": len(rows), "digest": hashlib.sha256(rows.tobytes()).hexdigest()}))
