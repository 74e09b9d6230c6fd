"""Holds an export of a scan against an independent computation over all of the scan's points.

exported.py SCAN EXPORT WANTED, as JSON an object of what is wanted, all of it at once:
  strip    {line, width}   source coordinates, edges by exact rationals
  polygon  [ring, ...]     source coordinates, by GEOS, edges included
  box      {center, size, heading, pitch, roll}   center ECEF, metres
  plane    {through, heading, pitch}              through ECEF, metres
  classes, returns, ranges {name: [least, greatest]}
  pipeline of PROJ: source coordinates to ECEF
Prints JSON: whether the records of the export are those wanted, byte for byte, each once. Records within 5 mm of a face of a
box or a plane may be there or not: PROJ and the certified map of the file differ by less.
"""

import json
import sys
from fractions import Fraction
from math import ceil, floor

import laspy
import numpy as np
import shapely
from pyproj import Transformer
from strip import strip

NEAR = 0.005


def rows(array):
    array = np.ascontiguousarray(array)
    return array.view(np.dtype((np.void, array.dtype.itemsize))).ravel()


def axes(place, heading, pitch, roll):
    """Width, depth and height of a box in ECEF, as rows, after its turns from east, north and up."""
    longitude, latitude, _ = Transformer.from_crs(4978, 4979, always_xy=True).transform(*place)
    l, p = np.radians(longitude), np.radians(latitude)
    east = np.array([-np.sin(l), np.cos(l), 0])
    north = np.array([-np.sin(p) * np.cos(l), -np.sin(p) * np.sin(l), np.cos(p)])
    up = np.array([np.cos(p) * np.cos(l), np.cos(p) * np.sin(l), np.sin(p)])
    width = np.cos(heading) * east - np.sin(heading) * north
    depth = np.sin(heading) * east + np.cos(heading) * north
    depth, up = np.cos(pitch) * depth + np.sin(pitch) * up, np.cos(pitch) * up - np.sin(pitch) * depth
    width, up = np.cos(roll) * width - np.sin(roll) * up, np.cos(roll) * up + np.sin(roll) * width
    return np.array([width, depth, up])


scan, export = laspy.read(sys.argv[1]), laspy.read(sys.argv[2])
wanted = json.loads(sys.argv[3])
scale, offset = scan.header.scales, scan.header.offsets
x, y, z = (scan[name] * scale[axis] + offset[axis] for axis, name in enumerate("XYZ"))
inside = np.ones(len(scan), bool)
# How far each point lies from the faces that PROJ places, metres.
away = np.full(len(scan), np.inf)
if "strip" in wanted:
    inside &= strip(x, y, wanted["strip"]["line"], wanted["strip"]["width"])[0]
if "polygon" in wanted:
    polygon = shapely.Polygon(wanted["polygon"][0], wanted["polygon"][1:])
    shapely.prepare(polygon)
    inside &= shapely.intersects_xy(polygon, x, y)
if "box" in wanted or "plane" in wanted:
    ecef = np.array(Transformer.from_pipeline(wanted["pipeline"]).transform(x, y, z)).T
if "box" in wanted:
    box = wanted["box"]
    local = np.abs((ecef - box["center"]) @ axes(box["center"], box["heading"], box["pitch"], box["roll"]).T)
    beyond = (local - np.array(box["size"]) / 2).max(axis=1)
    inside &= beyond <= 0
    away = np.minimum(away, np.abs(beyond))
if "plane" in wanted:
    plane = wanted["plane"]
    normal = axes(plane["through"], plane["heading"], plane["pitch"], 0)[1]
    before = (ecef - plane["through"]) @ normal
    inside &= before >= 0
    away = np.minimum(away, np.abs(before))
if "classes" in wanted:
    inside &= np.isin(scan.classification, wanted["classes"])
if "returns" in wanted:
    number, of = np.array(scan.return_number), np.array(scan.number_of_returns)
    first, last = number <= 1, number >= of
    kinds = {"first": first, "last": last, "single": first & last, "intermediate": ~first & ~last}
    inside &= np.any([kinds[kind] for kind in wanted["returns"]], axis=0)
for name, (least, greatest) in wanted.get("ranges", {}).items():
    if name == "elevation":
        # In whole steps, as decimals: what float64 makes of them decides nothing.
        step, begin = Fraction(str(scale[2])), Fraction(str(offset[2]))
        low, high = (Fraction(str(value)) - begin for value in (least, greatest))
        inside &= (scan.Z >= ceil(low / step)) & (scan.Z <= floor(high / step))
        continue
    values = np.array(scan[{"userData": "user_data"}.get(name, name)])
    inside &= (values >= least) & (values <= greatest)

doubtful = away < NEAR
sure, sought, found = inside & ~doubtful, rows(scan.points.array), rows(export.points.array)
expected, count = np.unique(sought[sure], return_counts=True)
allowed, most = np.unique(sought[sure | doubtful], return_counts=True)
here, times = np.unique(found, return_counts=True)
complete = np.isin(expected, here).all() and bool((times[np.searchsorted(here, expected)] >= count).all())
at = np.searchsorted(allowed, here)
at[at == len(allowed)] = 0
nothing_else = len(allowed) > 0 and bool((allowed[at] == here).all() and (times <= most[at]).all())
print(
    json.dumps(
        {
            "count": int(sure.sum()),
            "of": len(scan),
            "written": len(found),
            "doubtful": int(doubtful.sum()),
            "complete": bool(complete),
            "nothingElse": nothing_else,
        }
    )
)
