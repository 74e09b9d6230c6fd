"""Reads a COPC file whose transformation stands behind its points with laspy and copclib.

Argument: the file.
Standard output: { laspy: points, copclib: points, extended: [[user id, record id], ...], bytes: of the last one }
"""

import json
import sys

import copclib
import laspy

path = sys.argv[1]
with laspy.open(path) as reader:
    points = len(reader.read().points)
    records = list(reader.evlrs)
copc = copclib.FileReader(path)
count = sum(node.point_count for node in copc.GetAllNodes())
extended = [[record.user_id, record.record_id] for record in records]
size = len(records[-1].record_data_bytes())
print(json.dumps({"laspy": points, "copclib": count, "extended": extended, "bytes": size}))
