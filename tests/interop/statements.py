"""Random EPSG systems with places all over their areas of use, and where PROJ puts each of these.

statements.py SEED COUNT PLACES PROJ_DATA -> JSON: a list of
{ code, name, places: [{ source: [x, y, z], ecef: [X, Y, Z], operation, accuracy }] }

`source`: x easting or longitude, in the units of the system. `ecef`: EPSG:4978, by the operation that PROJ takes for that
place. Places for which PROJ has none, or one that passes over a difference of datums, are left out.
"""

import json
import math
import random
import sys
import warnings

import pyproj

warnings.filterwarnings("ignore")
seed, count, number, folder = int(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
pyproj.datadir.set_data_dir(folder)
pyproj.network.set_network_enabled(False)

from pyproj.database import query_crs_info
from pyproj.enums import PJType
from pyproj.transformer import Transformer

KINDS = [PJType.GEOGRAPHIC_2D_CRS, PJType.GEOGRAPHIC_3D_CRS, PJType.PROJECTED_CRS, PJType.COMPOUND_CRS]


def used(transformer):
    """The operation of the last place; a transformer with one operation has no last one."""
    try:
        return transformer.get_last_used_operation()
    except pyproj.exceptions.ProjError:
        return transformer


def place_of(area, to_plane, to_space, chance):
    east = area.east if area.east > area.west else area.east + 360
    longitude = (area.west + (east - area.west) * chance.uniform(0.02, 0.98) + 180) % 360 - 180
    latitude = area.south + (area.north - area.south) * chance.uniform(0.02, 0.98)
    x, y = to_plane.transform(longitude, latitude)
    z = chance.uniform(0, 1000)
    if not math.isfinite(x + y):
        return None
    ecef = to_space.transform(x, y, z)
    if not all(map(math.isfinite, ecef)):
        return None
    operation = used(to_space)
    if "allpark" in operation.description:
        return None
    accuracy = operation.accuracy
    return {
        "source": [x, y, z],
        "ecef": ecef,
        "operation": operation.description,
        "accuracy": accuracy if accuracy is not None and accuracy >= 0 else None,
    }


def one(info):
    chance = random.Random(seed * 100003 + int(info.code))
    try:
        crs = pyproj.CRS.from_epsg(info.code)
        flat = crs.sub_crs_list[0] if crs.is_compound else crs
        to_plane = Transformer.from_crs("EPSG:4326", flat, always_xy=True)
        to_space = Transformer.from_crs(crs, "EPSG:4978", always_xy=True)
    except pyproj.exceptions.ProjError:
        return None
    places = [place_of(info.area_of_use, to_plane, to_space, chance) for _ in range(number)]
    return {"code": int(info.code), "name": info.name, "places": [place for place in places if place]}


infos = query_crs_info(auth_name="EPSG", pj_types=KINDS)
infos = sorted((info for info in infos if info.area_of_use), key=lambda info: int(info.code))
rows = []
for info in random.Random(seed).sample(infos, len(infos)):
    if len(rows) == count:
        break
    row = one(info)
    if row and row["places"]:
        rows.append(row)
print(json.dumps(rows))
