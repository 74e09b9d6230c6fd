"""Reads a file whole with laspy, which refuses one whose records contradict each other.

Argument: the file.
Standard output: { points, extra: names of the attributes in the extra bytes }
"""

import json
import sys

import laspy

las = laspy.read(sys.argv[1])
print(json.dumps({"points": len(las.points), "extra": list(las.point_format.extra_dimension_names)}))
