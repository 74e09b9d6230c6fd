"""Makes scans of one hillside in several systems, and compares cuts of them.

mixed_scans.py make SCAN FOLDER     writes merged.las (UTM 32), one.las and three.las (UTM 32), two.las (UTM 31), degrees.las
mixed_scans.py compare A.csv B.csv  prints JSON: points, and the greatest differences of chainage, offset and height
"""

import json
import sys

import laspy
import numpy as np
import pyproj


def write(path, epsg, x, y, z, source, scale):
    header = laspy.LasHeader(point_format=7, version="1.4")
    header.scales = scale
    header.offsets = [np.floor(x.min()), np.floor(y.min()), 0]
    header.add_crs(pyproj.CRS.from_epsg(epsg))
    las = laspy.LasData(header)
    las.x, las.y, las.z = x, y, z
    las.intensity = source
    las.write(path)


def make(scan, folder):
    las = laspy.read(scan)
    kept = slice(None, None, 7)
    x, y, z = np.array(las.x)[kept], np.array(las.y)[kept], np.array(las.z)[kept]
    names = (np.arange(len(x)) % 65536).astype("uint16")
    # A hillside of its own: the same places in all systems, whatever the scan's datum is.
    east, north = x - x.mean() + 400_000, y - y.mean() + 5_230_000
    to_degrees = pyproj.Transformer.from_crs(32632, 4326, always_xy=True)
    longitude, latitude = to_degrees.transform(east, north)
    west, north31 = pyproj.Transformer.from_crs(32632, 32631, always_xy=True).transform(east, north)
    fine = [1e-4, 1e-4, 1e-3]
    write(f"{folder}/merged.las", 32632, east, north, z, names, fine)
    first, last = np.quantile(east, [1 / 3, 2 / 3])
    one, three = east < first, east >= last
    two = ~one & ~three
    write(f"{folder}/one.las", 32632, east[one], north[one], z[one], names[one], fine)
    write(f"{folder}/two.las", 32631, west[two], north31[two], z[two], names[two], fine)
    write(f"{folder}/three.las", 32632, east[three], north[three], z[three], names[three], fine)
    write(f"{folder}/degrees.las", 4326, longitude, latitude, z, names, [1e-9, 1e-9, 1e-3])
    ends = [to_degrees.transform(east.mean() + dx, north.mean() + dy) for dx, dy in [(-120, -20), (0, 10), (120, -15)]]
    print(json.dumps({"line": ends, "points": len(x)}))


def compare(first, second):
    tables = []
    for path in (first, second):
        table = np.genfromtxt(path, delimiter=",", names=True)
        tables.append(table[np.lexsort((np.round(table["chainage"], 2), table["z"], table["intensity"]))])
    a, b = tables
    same = len(a) == len(b)
    print(
        json.dumps(
            {
                "counts": [len(a), len(b)],
                "names": bool(same and np.array_equal(a["intensity"], b["intensity"])),
                **{
                    column: float(np.abs(a[column] - b[column]).max()) if same else None
                    for column in ("chainage", "offset", "z")
                },
            }
        )
    )


if sys.argv[1] == "make":
    make(sys.argv[2], sys.argv[3])
else:
    compare(sys.argv[2], sys.argv[3])
