"""One area in two zones: scans of the same places, written in the coordinates of neighbouring UTM zones.

Usage:
  zones.py write FOLDER -> { zones: [{ file, zone }], ecef: [[x, y, z]] }: point i of both files is the place i (metres,
    EPSG:4978), and has the intensity i
  zones.py nodes COPC -> ["level-x-y-z"], the nodes that have points
"""

import json
import sys
from pathlib import Path

import copclib
import laspy
import numpy as np
from pyproj import CRS, Transformer

POINTS = 2000
EDGE = 6.0  # degrees east: zone 31 ends, zone 32 begins
LATITUDE = 52.0
SCALE = 0.0001  # metres; its rounding stays below 0.1 mm


def places():
    """Longitude, latitude (degrees) and ellipsoidal height of points on both sides of the edge: a block of 300 m."""
    random = np.random.default_rng(19470521)
    longitude = EDGE + random.uniform(-0.0022, 0.0022, POINTS)
    latitude = LATITUDE + random.uniform(-0.00135, 0.00135, POINTS)
    return longitude, latitude, random.uniform(20, 80, POINTS)


def write(folder: str) -> dict:
    longitude, latitude, height = places()
    zones = []
    for zone in (31, 32):
        crs = CRS.from_epsg(32600 + zone)
        x, y = Transformer.from_crs(CRS.from_epsg(4326), crs, always_xy=True).transform(longitude, latitude)
        header = laspy.LasHeader(point_format=6, version="1.4")
        header.scales = [SCALE] * 3
        header.offsets = [np.floor(x.min()), np.floor(y.min()), 0.0]
        header.add_crs(crs)
        las = laspy.LasData(header)
        las.x, las.y, las.z = x, y, height
        las.intensity = np.arange(POINTS)
        path = Path(folder) / f"zone-{zone}.las"
        las.write(str(path))
        zones.append({"file": str(path), "zone": zone})
    geocentric = Transformer.from_crs(CRS.from_epsg(4979), CRS.from_epsg(4978), always_xy=True)
    ecef = np.stack(geocentric.transform(longitude, latitude, height), axis=1)
    return {"zones": zones, "ecef": ecef.tolist()}


def nodes(path: str) -> list:
    entries = [node for node in copclib.FileReader(path).GetAllNodes() if node.point_count > 0]
    return [f"{node.key.d}-{node.key.x}-{node.key.y}-{node.key.z}" for node in entries]


if __name__ == "__main__":
    command, argument = sys.argv[1:3]
    json.dump(write(argument) if command == "write" else nodes(argument), sys.stdout)
