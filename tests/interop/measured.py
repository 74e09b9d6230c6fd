"""Distances, areas, scale factors and crossings by pyproj (GeographicLib in C, PROJ) and shapely (GEOS).

Reads {"lines": [[lon1, lat1, lon2, lat2]], "rings": [[[lon, lat]]], "grids": [{"proj4", "lines": [[x1, y1, x2, y2]],
"rings": [[[x, y]]]}]} from stdin, degrees and metres; writes the same shape with values: geodesic [distance, azimuth,
back azimuth], [area, perimeter] of rings, and for grids [geodesic, scale factor, convergence in degrees] of each line at
its start and [planar area, whether the ring is simple] of each ring.
"""

import json
import re
import sys

import pyproj
import shapely

request = json.load(sys.stdin)
wgs84 = pyproj.Geod(ellps="WGS84")


def line(geod, lon1, lat1, lon2, lat2):
    forward, back, distance = geod.inv(lon1, lat1, lon2, lat2)
    return [distance, forward, back]


def ring(points):
    area, perimeter = wgs84.polygon_area_perimeter([p[0] for p in points], [p[1] for p in points])
    return [abs(area), perimeter]


def grid(given):
    proj4 = re.sub(r" ?\+towgs84=\S+", "", given["proj4"])
    projection = pyproj.Proj(proj4)
    geod = projection.crs.get_geod()
    lines = []
    for x1, y1, x2, y2 in given["lines"]:
        lon1, lat1 = projection(x1, y1, inverse=True)
        lon2, lat2 = projection(x2, y2, inverse=True)
        factors = projection.get_factors(lon1, lat1)
        lines.append([geod.inv(lon1, lat1, lon2, lat2)[2], factors.meridional_scale, factors.meridian_convergence])
    rings = []
    for points in given["rings"]:
        made = shapely.LinearRing(points)
        rings.append([shapely.Polygon(points).area, bool(made.is_simple)])
    return {"lines": lines, "rings": rings}


json.dump(
    {
        "lines": [line(wgs84, *one) for one in request["lines"]],
        "rings": [ring(one) for one in request["rings"]],
        "grids": [grid(one) for one in request["grids"]],
    },
    sys.stdout,
)
