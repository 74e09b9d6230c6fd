"""How far the one shift of a datum is from the operations that PROJ takes for the parts of its area.

datum-spread.py PROJ_DATA < TABLE > ROWS

TABLE: JSON, a list of { code, accuracy, towgs84 } (EPSG code of the datum, metres, `+towgs84`).
ROWS: JSON, { version, spread: { code: [[west, south, east, north, metres], …] } }: degrees, and the greatest distance from
the operation that PROJ takes there (grids that are in PROJ_DATA included) plus the accuracy that is published for that
operation. Rectangles are those of a quadtree over the datum's area of use, split where the distance varies. Datums whose
shift is nowhere farther off than its published accuracy are left out.
"""

import json
import math
import sqlite3
import sys
import warnings

import pyproj

warnings.filterwarnings("ignore")
folder = sys.argv[1]
pyproj.datadir.set_data_dir(folder)
pyproj.network.set_network_enabled(False)

from pyproj.aoi import AreaOfInterest
from pyproj.transformer import Transformer, TransformerGroup

GEOD = pyproj.Geod(ellps="WGS84")
# Samples along each side of a rectangle, splits one after the other, degrees below which none is split.
SAMPLES, DEPTH, SMALLEST = 20, 4, 2
# A rectangle is split where the distance varies by more than this factor.
VARIES = 2
# Between samples, of what is found at them.
MARGIN = 1.05
# Operations that are wrong as they are registered. EPSG:9143 (Kosovo) is 1.6 km from those of Serbia, North Macedonia and
# the former Yugoslavia, which agree there within 20 m. Its rotations, read as centesimal seconds of a coordinate frame in place
# of arc-seconds of a position vector, lead to within 2 m of Serbia's in plane.
FAULTY = ("MGI 1901 to WGS 84 (14)",)
# What EPSG writes for an accuracy that nobody knows.
UNKNOWN = 999


def own_shift(crs, towgs84):
    figure = crs.ellipsoid
    axes = f"+a={figure.semi_major_metre} +rf={figure.inverse_flattening}"
    words = " ".join(f"+{key}={value}" for key, value in zip(["x", "y", "z", "rx", "ry", "rz", "s"], towgs84))
    convention = " +convention=position_vector" if len(towgs84) > 3 else ""
    return Transformer.from_pipeline(
        "+proj=pipeline +step +proj=unitconvert +xy_in=deg +xy_out=rad +step +proj=push +v_3 "
        f"+step +proj=cart {axes} +step +proj=helmert {words}{convention} +step +inv +proj=cart +ellps=WGS84 "
        "+step +proj=pop +v_3 +step +proj=unitconvert +xy_in=rad +xy_out=deg"
    )


def used(transformer):
    """The operation of the last place; a transformer with one operation has no last one."""
    try:
        return transformer.get_last_used_operation()
    except pyproj.exceptions.ProjError:
        return transformer


def worth(own, transformer, longitude, latitude):
    """Metres; None where PROJ has no operation, or one that passes over the difference of datums."""
    x, y = transformer.transform(longitude, latitude)
    if not math.isfinite(x + y):
        return None
    operation = used(transformer)
    if "allpark" in operation.description or any(name in operation.description for name in FAULTY):
        return None
    published = operation.accuracy if operation.accuracy is not None and 0 <= operation.accuracy < UNKNOWN else 0
    return GEOD.inv(x, y, *own.transform(longitude, latitude))[2] + published


def samples(box, number):
    west, south, east, north = box
    for i in range(number):
        for j in range(number):
            longitude = west + (east - west) * i / (number - 1)
            yield (longitude + 180) % 360 - 180, south + (north - south) * j / (number - 1)


def first_choices(crs, own, box):
    """What PROJ takes where it is told that all data lie in the middle of the box."""
    longitude, latitude = (box[0] + box[2]) / 2, (box[1] + box[3]) / 2
    longitude = (longitude + 180) % 360 - 180
    area = AreaOfInterest(longitude - 0.01, latitude - 0.01, longitude + 0.01, latitude + 0.01)
    try:
        group = TransformerGroup(crs, "EPSG:4326", always_xy=True, area_of_interest=area)
    except pyproj.exceptions.ProjError:
        return []
    found = worth(own, group.transformers[0], longitude, latitude) if group.transformers else None
    return [] if found is None else [found]


def leaves(crs, own, best, box, depth):
    west, south, east, north = box
    found = [value for place in samples(box, SAMPLES) if (value := worth(own, best, *place)) is not None]
    varies = found and max(found) > VARIES * max(0.5, min(found))
    if varies and depth < DEPTH and min(east - west, north - south) > SMALLEST:
        x, y = (west + east) / 2, (south + north) / 2
        quarters = [(west, south, x, y), (x, south, east, y), (west, y, x, north), (x, y, east, north)]
        parts = [leaf for quarter in quarters for leaf in leaves(crs, own, best, quarter, depth + 1)]
        values = [leaf[4] for leaf in parts]
        alike = len(parts) == 4 and max(values) <= VARIES * min(values)
        return [(*box, max(values))] if alike else parts
    found += first_choices(crs, own, box)
    return [(*box, max(found))] if found else []


def stated(metres, published):
    if metres <= published + 1e-3:
        return published
    value = MARGIN * metres
    digits = 10 ** (1 - math.floor(math.log10(value)))
    return math.ceil(round(value * digits, 6)) / digits


def spread_of(row, database):
    query = "SELECT code FROM geodetic_crs WHERE datum_auth_name = 'EPSG' AND auth_name = 'EPSG' AND datum_code = ? AND type = 'geographic 2D' ORDER BY deprecated, code"
    found = database.execute(query, (row["code"],)).fetchone()
    if found is None:
        return []
    crs = pyproj.CRS.from_epsg(found[0])
    area = crs.area_of_use
    east = area.east if area.east > area.west else area.east + 360
    best = Transformer.from_crs(crs, "EPSG:4326", always_xy=True)
    own = own_shift(crs, row["towgs84"])
    parts = leaves(crs, own, best, (area.west, area.south, east, area.north), 0)
    if not parts or max(part[4] for part in parts) <= row["accuracy"] + 1e-3:
        return []
    turned = lambda longitude: longitude if longitude <= 180 else longitude - 360
    return [
        [round(turned(w), 4), round(s, 4), round(turned(e), 4), round(n, 4), stated(metres, row["accuracy"])]
        for w, s, e, n, metres in parts
    ]


database = sqlite3.connect(f"{folder}/proj.db")
versions = dict(database.execute("SELECT key, value FROM metadata"))
table = json.load(sys.stdin)
spread = {row["code"]: found for row in table if (found := spread_of(row, database))}
print(json.dumps({"version": f"EPSG {versions['EPSG.VERSION']} as PROJ {versions['PROJ.VERSION']} has it", "spread": spread}))
