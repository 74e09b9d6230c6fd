"""Reads one cut in five formats by programs that nobody here wrote, and says whether they hold the same points.

cut_formats.py STEM   for STEM.las, .laz, .csv, .dxf, .geojson; prints JSON
"""

import csv
import json
import sys

import ezdxf
import laspy
import numpy as np
import pyproj

stem = sys.argv[1]
las = laspy.read(f"{stem}.las")
laz = laspy.read(f"{stem}.laz")
with open(f"{stem}.csv", newline="", encoding="utf-8") as file:
    rows = list(csv.DictReader(file))
dxf = ezdxf.readfile(f"{stem}.dxf")
points = [point.dxf.location for point in dxf.modelspace().query("POINT")]
line = dxf.modelspace().query("POLYLINE").first
with open(f"{stem}.geojson", encoding="utf-8") as file:
    features = json.load(file)["features"]

xyz = np.array([las.x, las.y, las.z]).T
transformer = pyproj.Transformer.from_crs(las.header.parse_crs(), "EPSG:4326", always_xy=True)
angles = np.array([feature["geometry"]["coordinates"][:2] for feature in features])
expected = np.array(transformer.transform(xyz[:, 0], xyz[:, 1])).T
records = {(vlr.user_id, vlr.record_id) for vlr in [*las.header.vlrs, *(las.evlrs or [])]}
print(
    json.dumps(
        {
            "count": len(las),
            "laz": bool(np.array_equal(las.points.array, laz.points.array)),
            "groma": sorted(number for user, number in records if user == "groma"),
            "compressed": bool(laz.header.are_points_compressed),
            "crs": las.header.parse_crs() == laz.header.parse_crs() and las.header.parse_crs() is not None,
            "csv": bool(
                np.array_equal(np.array([[float(row[axis]) for axis in "xyz"] for row in rows]), np.round(xyz, 2))
                and all(
                    np.array_equal(np.array([float(row[name]) for row in rows]), np.asarray(las[name], float))
                    for name in ("red", "green", "blue", "intensity", "classification")
                )
            ),
            "dxf": bool(np.array_equal(np.array(points), np.round(xyz, 2))) and not dxf.audit().errors,
            "vertices": [[vertex.dxf.location.x, vertex.dxf.location.y] for vertex in line.vertices],
            "layers": sorted(layer.dxf.name for layer in dxf.layers if layer.dxf.name.isupper()),
            "geojson": bool(
                len(features) == len(las)
                and np.array_equal([feature["properties"]["red"] for feature in features], las.red)
            ),
            # Degrees on the ground, roughly.
            "metresOff": float(np.abs(angles - expected).max() * 111_000),
        }
    )
)
