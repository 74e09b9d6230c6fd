"""Small LAS files with the declarations of their coordinate reference system that a test asks for.

Standard input: [{ path, version, format, wktBit, rows: [[x, y, z], ...], wkt?, keys?: [[key, value], ...] }].
Standard output: the paths.
"""

import json
import struct
import sys

import laspy
import numpy as np

PROJECTION = "LASF_Projection"
WKT_BIT = 1 << 4

jobs = json.load(sys.stdin)
for job in jobs:
    header = laspy.LasHeader(version=job["version"], point_format=job["format"])
    header.scales, header.offsets = [0.01] * 3, job["rows"][0]
    if "wkt" in job:
        header.vlrs.append(laspy.VLR(PROJECTION, 2112, "", job["wkt"].encode() + b"\0"))
    if "keys" in job:
        words = [1, 1, 0, len(job["keys"])] + [w for key, value in job["keys"] for w in (key, 0, 1, value)]
        header.vlrs.append(laspy.VLR(PROJECTION, 34735, "", struct.pack(f"<{len(words)}H", *words)))
    las = laspy.LasData(header)
    las.x, las.y, las.z = np.array(job["rows"], float).T
    las.write(job["path"])
    # laspy has a mind of its own on the bit.
    with open(job["path"], "r+b") as file:
        file.seek(6)
        (encoding,) = struct.unpack("<H", file.read(2))
        file.seek(6)
        file.write(struct.pack("<H", encoding | WKT_BIT if job["wktBit"] else encoding & ~WKT_BIT))
print(json.dumps([job["path"] for job in jobs]))
