"""Random EPSG systems with points in their areas of use, and where PROJ puts them.

systems.py SEED COUNT PROJ_DATA -> JSON: a list of
{ code, name, kind, points: [x, y, z], operations: [{ name, accuracy, ballpark, ecef }], refused }

Points: a square of about a kilometre in the units of the system, x easting or longitude. Operations: those that PROJ has
for the square, the best first, with the ECEF (EPSG:4978) of each point by each; none where PROJ refuses.
"""

import json
import math
import random
import sys
import warnings

import pyproj

warnings.filterwarnings("ignore")
seed, count, folder = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
pyproj.datadir.set_data_dir(folder)
pyproj.network.set_network_enabled(False)

from pyproj.aoi import AreaOfInterest
from pyproj.database import query_crs_info
from pyproj.enums import PJType
from pyproj.transformer import Transformer, TransformerGroup

KINDS = [PJType.GEOGRAPHIC_2D_CRS, PJType.GEOGRAPHIC_3D_CRS, PJType.PROJECTED_CRS, PJType.COMPOUND_CRS]
HALF = 500.0
# EPSG methods 1132 and 1133; an older PROJ takes their angles for small ones.
KNOWS_FULL_MATRIX = tuple(map(int, pyproj.proj_version_str.split(".")[:2])) >= (9, 6)


class NotKnown(Exception):
    """This PROJ does not know what its database, of a newer one, asks for."""


def plane(crs):
    return crs.sub_crs_list[0] if crs.is_compound else crs


def square(info, crs, chance):
    """Corners, middle and two more points of a square about a random place of the area of use."""
    area = info.area_of_use
    east = area.east if area.east > area.west else area.east + 360
    flat = plane(crs)
    to_plane = Transformer.from_crs("EPSG:4326", flat, always_xy=True)
    for _ in range(50):
        longitude = area.west + (east - area.west) * chance.uniform(0.2, 0.8)
        latitude = area.south + (area.north - area.south) * chance.uniform(0.2, 0.8)
        longitude = (longitude + 180) % 360 - 180
        x, y = to_plane.transform(longitude, latitude)
        if all(map(math.isfinite, (x, y))):
            break
    else:
        return None
    unit = flat.axis_info[0].unit_conversion_factor
    if flat.is_geographic:
        half = [math.radians(HALF / 111e3) / unit / max(0.05, math.cos(math.radians(latitude))), math.radians(HALF / 111e3) / unit]
    else:
        half = [HALF / unit, HALF / unit]
    shares = [(-1, -1), (1, -1), (-1, 1), (1, 1), (0, 0), (0.3, -0.7), (-0.55, 0.2)]
    points = [[x + u * half[0], y + v * half[1], 20.0 * i] for i, (u, v) in enumerate(shares)]
    # A degree is a margin about a kilometre.
    aoi = AreaOfInterest(longitude - 0.01, latitude - 0.01, longitude + 0.01, latitude + 0.01)
    return points, aoi


def operations(crs, points, aoi):
    group = TransformerGroup(crs, "EPSG:4978", always_xy=True, area_of_interest=aoi)
    found = []
    for transformer in group.transformers[:12]:
        if not KNOWS_FULL_MATRIX and any("full matrix" in step.method_name for step in transformer.operations or ()):
            raise NotKnown
        columns = transformer.transform(*zip(*points), errcheck=False)
        ecef = [[c if math.isfinite(c) else None for c in place] for place in zip(*columns)]
        name = transformer.description
        accuracy = transformer.accuracy
        found.append({
            "name": name,
            "accuracy": accuracy if accuracy is not None and accuracy >= 0 else None,
            "ballpark": "allpark" in name,
            "ecef": ecef,
        })
    return found


def one(info, chance):
    row = {"code": int(info.code), "name": info.name, "kind": info.type.name}
    try:
        crs = pyproj.CRS.from_epsg(info.code)
        placed = square(info, crs, chance)
        if placed is None:
            return None
        points, aoi = placed
        return {**row, "points": points, "operations": operations(crs, points, aoi)}
    except NotKnown:
        return None
    except pyproj.exceptions.ProjError as error:
        return {**row, "points": [], "operations": [], "refused": str(error)}


infos = query_crs_info(auth_name="EPSG", pj_types=KINDS)
infos = sorted((info for info in infos if info.area_of_use), key=lambda info: int(info.code))
chance = random.Random(seed)
rows = []
for info in chance.sample(infos, len(infos)):
    if len(rows) == count:
        break
    row = one(info, random.Random(seed * 100003 + int(info.code)))
    if row:
        rows.append(row)
print(json.dumps(rows))
