"""Reads records of a COPC file, each by its node and its place in the node's chunk, with copclib.

Usage: picked.py COPC, standard input [{ node: "level-x-y-z", index }]
  -> [{ integers: [x, y, z], intensity, classification, pointSourceId, gpsTime }]
"""

import json
import sys

import copclib


def main(path: str, asked: list) -> list:
    reader = copclib.FileReader(path)
    header = reader.copc_config.las_header
    nodes = {}
    found = []
    for point in asked:
        key = point["node"]
        if key not in nodes:
            node = reader.FindNode(copclib.VoxelKey(*(int(part) for part in key.split("-"))))
            nodes[key] = reader.GetPoints(node)
        record = nodes[key][point["index"]]
        scaled = zip(
            (record.x, record.y, record.z),
            (header.offset.x, header.offset.y, header.offset.z),
            (header.scale.x, header.scale.y, header.scale.z),
        )
        found.append(
            {
                "integers": [round((value - offset) / scale) for value, offset, scale in scaled],
                "intensity": record.intensity,
                "classification": record.classification,
                "pointSourceId": record.point_source_id,
                "gpsTime": record.gps_time,
            }
        )
    return found


if __name__ == "__main__":
    json.dump(main(sys.argv[1], json.load(sys.stdin)), sys.stdout)
