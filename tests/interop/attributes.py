"""Writes scans with every kind of attribute, and reads records of COPC files with laspy: the referee of `readPoint`.

Usage:
  attributes.py make PATH FORMAT POINTS -> the number of points
  attributes.py read COPC, standard input [{ key: "level-x-y-z", index }]
    -> [{ name: value }] in the names of laspy, X, Y and Z as integers; numbers as text, in full
"""

import json
import sys

import copclib
import laspy
import numpy as np

EXTRA = [
    ("height above ground", "float32", {"description": "metres above ground"}),
    ("reflectance", "int16", {"scales": np.array([0.01]), "offsets": np.array([-20.0]), "no_data": [-32768]}),
    ("target", "uint32", {}),
    ("depth", "int32", {"scales": np.array([0.001]), "offsets": np.array([0.0])}),
    ("pulse", "int64", {}),
    ("time of flight", "float64", {}),
    ("quality", "uint8", {}),
]


def make(path: str, point_format: int, count: int) -> int:
    chance = np.random.default_rng(20261122 + point_format)
    header = laspy.LasHeader(point_format=point_format, version="1.4")
    header.scales, header.offsets = [0.001] * 3, [2_600_000, 1_200_000, 400]
    for name, kind, options in EXTRA:
        header.add_extra_dim(laspy.ExtraBytesParams(name, kind, **options))
    las = laspy.LasData(header, laspy.ScaleAwarePointRecord.zeros(count, header=header))
    las.x = 2_600_000 + chance.uniform(0, 200, count)
    las.y = 1_200_000 + chance.uniform(0, 200, count)
    las.z = 400 + chance.uniform(0, 30, count)
    whole = lambda least, greatest: chance.integers(least, greatest + 1, count)
    las.intensity = whole(0, 65535)
    las.number_of_returns = whole(1, 15)
    las.return_number = np.minimum(las.number_of_returns, whole(1, 15))
    las.classification = whole(0, 255)
    las.user_data = whole(0, 255)
    las.scan_angle = whole(-30000, 30000)
    las.point_source_id = whole(0, 65535)
    las.gps_time = 3.2e8 + chance.uniform(0, 1e4, count)
    for name in ("synthetic", "key_point", "withheld", "overlap", "scan_direction_flag", "edge_of_flight_line"):
        las[name] = whole(0, 1)
    las.scanner_channel = whole(0, 3)
    for name in ("red", "green", "blue") if point_format >= 7 else ():
        las[name] = whole(0, 65535)
    if point_format == 8:
        las.nir = whole(0, 65535)
    las["height above ground"] = chance.normal(0, 10, count)
    raw = whole(-32767, 32767)
    raw[:: count // 50] = -32768
    las.points.array["reflectance"] = raw
    las["target"] = whole(0, 2**32 - 1)
    las.points.array["depth"] = whole(-(2**31), 2**31 - 1)
    las["pulse"] = chance.integers(-(2**63), 2**63 - 1, count)
    las["time of flight"] = chance.uniform(0, 1e-3, count)
    las["quality"] = np.full(count, 7, dtype=np.uint8)
    las.write(path)
    return count


def read(path: str, asked: list) -> list:
    reader = copclib.FileReader(path)
    with laspy.open(path) as file:
        header = file.header
    nodes = {}
    for key in sorted({point["key"] for point in asked}):
        node = reader.FindNode(copclib.VoxelKey(*(int(part) for part in key.split("-"))))
        plain = np.frombuffer(bytes(reader.GetPointData(node)), dtype=header.point_format.dtype())
        nodes[key] = laspy.ScaleAwarePointRecord(plain, header.point_format, header.scales, header.offsets)
    rows = []
    for point in asked:
        record = nodes[point["key"]][point["index"] : point["index"] + 1]
        row = {}
        for dimension in header.point_format.dimensions:
            name = dimension.name
            stored = record.array[name][0] if dimension.no_data is not None else None
            missing = stored is not None and stored == np.ravel(dimension.no_data)[0]
            row[name] = None if missing else repr(np.ravel(np.asarray(record[name]))[0].item())
        rows.append(row)
    return rows


if sys.argv[1] == "make":
    json.dump(make(sys.argv[2], int(sys.argv[3]), int(sys.argv[4])), sys.stdout)
else:
    json.dump(read(sys.argv[2], json.load(sys.stdin)), sys.stdout)
