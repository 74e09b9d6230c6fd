"""The same coordinate reference systems in all spellings that pyproj has for them, and where PROJ puts points by each.

spellings.py SEED COUNT SHARE PROJ_DATA -> JSON: a list of
{ system, spelling, text, points: [x, y, z], ecef: [[X, Y, Z], ...] | null }

Systems: those of three dimensions, bound ones and compound ones that are listed here, and COUNT chosen by chance from EPSG, each
made three-dimensional; of their spellings one in SHARE, and those that were wrong once. Points: a square of about a kilometre in the units of the system, x easting or longitude, in the
text's own spelling of it. ECEF (EPSG:4978) by PROJ's best operation, null where PROJ has none.
"""

import json
import math
import random
import sys
import warnings

import pyproj

warnings.filterwarnings("ignore")
seed, count, share, folder = int(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
pyproj.datadir.set_data_dir(folder)
pyproj.network.set_network_enabled(False)

from pyproj import CRS
from pyproj.aoi import AreaOfInterest
from pyproj.crs import BoundCRS
from pyproj.crs.coordinate_operation import ToWGS84Transformation
from pyproj.database import query_crs_info
from pyproj.enums import PJType
from pyproj.transformer import Transformer, TransformerGroup

HALF = 500.0
BESSEL = "+ellps=bessel +towgs84=598.1,73.7,418.2,0.202,0.045,-2.455,6.7"
EGM96 = "+geoidgrids=egm96_15.gtx"
PARIS = "+proj=lcc +lat_1=49.5 +lat_0=49.5 +lon_0=2.337229167 +k_0=0.999877341 +x_0=600000 +y_0=200000 +ellps=clrk80ign"

# Name, CRS, longitude and latitude of the middle.
LISTED = [
    ("3D on Bessel", CRS("EPSG:28992").to_3d(), 5.4, 52.15),
    ("3D on Bessel, Swiss", CRS("EPSG:21781").to_3d(), 7.44, 46.95),
    ("3D in feet", CRS("EPSG:2994").to_3d(), -121, 44),
    ("3D degrees", CRS("EPSG:4979"), 9, 48),
    ("3D degrees east first", CRS("OGC:CRS84h"), 9, 48),
    ("3D of a national datum", CRS("EPSG:4171").to_3d(), 3, 47),
    ("bound", CRS(f"+proj=utm +zone=32 {BESSEL} +type=crs"), 9, 48),
    ("bound, 3D", CRS(f"+proj=utm +zone=32 {BESSEL} +type=crs").to_3d(), 9, 48),
    ("bound by a grid", CRS(f"{PARIS} +nadgrids=ntf_r93.gsb +type=crs"), 3, 49),
    ("bound, above a geoid", CRS(f"+proj=utm +zone=32 {BESSEL} {EGM96} +type=crs"), 9, 48),
    ("above a geoid", CRS(f"+proj=utm +zone=32 +datum=WGS84 {EGM96} +type=crs"), 9, 48),
    ("above a geoid in feet", CRS(f"+proj=utm +zone=32 +datum=WGS84 {EGM96} +vunits=us-ft +type=crs"), 9, 48),
    ("degrees above a geoid", CRS(f"+proj=longlat +datum=WGS84 {EGM96} +type=crs"), 9, 48),
    ("compound", CRS("EPSG:32632+5773"), 9, 48),
    ("compound degrees", CRS("EPSG:4326+5773"), 9, 48),
    ("bound, with a code", BoundCRS(CRS("EPSG:21781"), CRS("EPSG:4326"), ToWGS84Transformation(CRS("EPSG:21781").geodetic_crs, 660, 20, 400)), 7.44, 46.95),
    ("a unit of height", CRS("+proj=utm +zone=32 +datum=WGS84 +vunits=us-ft +type=crs"), 9, 48),
    ("a unit of height on Bessel", CRS(f"+proj=utm +zone=32 {BESSEL} +vunits=m +type=crs"), 9, 48),
]

# WKT 1 that says that heights are ellipsoidal: name, EPSG code of the plane, unit, longitude and latitude.
ELLIPSOIDAL = [
    ("2002 on Bessel", 21781, 'UNIT["metre",1]', 7.44, 46.95),
    ("2002 on NAD83(HARN)", 2994, 'UNIT["foot",0.3048]', -121, 44),
    ("2002 on WGS 84", 32632, 'UNIT["metre",1]', 9, 48),
]

WRONG_ONCE = {
    ("3D on Bessel", "PROJJSON"),
    ("above a geoid", "WKT1 of ESRI"),
    ("bound, above a geoid", "WKT2:2019"),
    ("bound, with a code", "WKT2:2019"),
    ("2002 on Bessel", "WKT1 of GDAL"),
}

FORMS = {
    "PROJ": lambda crs: crs.to_proj4(),
    "WKT1 of GDAL": lambda crs: crs.to_wkt("WKT1_GDAL"),
    "WKT1 of ESRI": lambda crs: crs.to_wkt("WKT1_ESRI"),
    "WKT2:2015": lambda crs: crs.to_wkt("WKT2_2015"),
    "WKT2:2019": lambda crs: crs.to_wkt("WKT2_2019"),
    "PROJJSON": lambda crs: crs.to_json(),
}


def plane(crs):
    return crs.sub_crs_list[0] if crs.is_compound else crs


def square(crs, longitude, latitude):
    flat = plane(crs)
    x, y = Transformer.from_crs("EPSG:4326", flat.to_2d(), always_xy=True).transform(longitude, latitude)
    unit = flat.axis_info[0].unit_conversion_factor if flat.axis_info else 1
    half = math.radians(HALF / 111e3) / unit if flat.is_geographic else HALF / unit
    if not math.isfinite(x + y):
        return None
    return [[x + u * half, y + v * half, z] for u, v, z in [(-1, -1, 0), (1, 1, 300), (0.3, -0.7, 20)]]


def places(crs, points, longitude, latitude):
    aoi = AreaOfInterest(longitude - 0.01, latitude - 0.01, longitude + 0.01, latitude + 0.01)
    try:
        group = TransformerGroup(crs, "EPSG:4978", always_xy=True, area_of_interest=aoi)
    except pyproj.exceptions.ProjError:
        return None
    if not group.transformers:
        return None
    columns = group.transformers[0].transform(*zip(*points), errcheck=False)
    ecef = [list(place) for place in zip(*columns)]
    return ecef if all(math.isfinite(c) for place in ecef for c in place) else None


tried = 0


def row(system, spelling, text, longitude, latitude):
    # GDAL and Groma have a code go before the TOWGS84 that comes with it; PROJ does not.
    if "TOWGS84" in text and 'AUTHORITY["EPSG","21781"]' in text:
        return None
    global tried
    tried += 1
    if (tried + seed) % share and (system, spelling) not in WRONG_ONCE:
        return None
    crs = CRS(text)
    points = square(crs, longitude, latitude)
    return points and {
        "system": system,
        "spelling": spelling,
        "text": text,
        "points": points,
        "ecef": places(crs, points, longitude, latitude),
    }


def spelled(system, crs, longitude, latitude):
    for spelling, write in FORMS.items():
        try:
            text = write(crs)
            if text:
                yield row(system, spelling, text, longitude, latitude)
        except pyproj.exceptions.ProjError:
            continue


def chosen():
    infos = query_crs_info(auth_name="EPSG", pj_types=[PJType.GEOGRAPHIC_2D_CRS, PJType.PROJECTED_CRS])
    infos = sorted((info for info in infos if info.area_of_use), key=lambda info: int(info.code))
    for info in random.Random(seed).sample(infos, count):
        area = info.area_of_use
        east = area.east if area.east > area.west else area.east + 360
        longitude = ((area.west + east) / 2 + 180) % 360 - 180
        yield f"EPSG:{info.code} in 3D", CRS.from_epsg(info.code).to_3d(), longitude, (area.south + area.north) / 2


rows = [row for system in [*LISTED, *chosen()] for row in spelled(*system)]
for system, code, unit, longitude, latitude in ELLIPSOIDAL:
    vertical = f'VERT_CS["Ellipsoid",VERT_DATUM["Ellipsoid",2002],{unit},AXIS["Up",UP]]'
    flat = CRS.from_epsg(code).to_wkt("WKT1_GDAL", pretty=False)
    rows.append(row(system, "WKT1 of GDAL", f'COMPD_CS["{system}",{flat},{vertical}]', longitude, latitude))
print(json.dumps([row for row in rows if row]))
