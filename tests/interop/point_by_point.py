"""Where PROJ puts points when it is asked for each of them, by the operation that it takes there.

point_by_point.py CRS PROJ_DATA < POINTS -> JSON: [X, Y, Z] (EPSG:4978) of each, null where PROJ has none

POINTS: JSON, a list of [x, y, z] in the units of the CRS, x easting or longitude. Operations that pass over a difference of
datums are not taken.
"""

import json
import math
import sys
import warnings

import pyproj

warnings.filterwarnings("ignore")
pyproj.datadir.set_data_dir(sys.argv[2])
pyproj.network.set_network_enabled(False)

from pyproj.transformer import Transformer

transformer = Transformer.from_crs(sys.argv[1], "EPSG:4978", always_xy=True, allow_ballpark=False)
places = [transformer.transform(*point) for point in json.load(sys.stdin)]
print(json.dumps([list(place) if all(map(math.isfinite, place)) else None for place in places]))
