"""Compares a COPC file with the inputs it was made of: `compare.py COPC INPUT...`, prints one JSON object.

laspy reads both sides; lazrs decodes every chunk on its own; copclib gives a second opinion on the nodes.
"""

import json
import sys

import copclib
import laspy
import lazrs
import numpy as np
from copc_file import CopcFile
from records import as_format_6_to_8, same_multiset


def decode(copc, node, vlr):
    """The records of one node, from nothing but the bytes of its chunk."""
    chunk = np.frombuffer(copc.bytes, np.uint8, node.size, node.offset)
    out = np.zeros(node.points * copc.record_length, np.uint8)
    lazrs.decompress_points_with_chunk_table(chunk, copc.laszip, out, [(node.points, node.size)])
    return out.reshape(node.points, copc.record_length)


def positions(rows, copc):
    """Coordinates of raw records, n × 3."""
    integers = np.ascontiguousarray(rows[:, :12]).view("<i4")
    return integers * np.array(copc.scale) + np.array(copc.offset)


def check_nodes(copc, dtype):
    """Reads every node by itself; returns all records and counts of what is wrong."""
    vlr = lazrs.LazVlr(copc.laszip)
    wrong = {"outsideCube": 0, "orphans": 0, "notContiguous": 0, "empty": 0}
    keys = {node.key for node in copc.nodes}
    parts, end = [], copc.points_at + 8
    for node in sorted(copc.nodes, key=lambda n: n.offset):
        level, x, y, z = node.key
        wrong["orphans"] += level > 0 and (level - 1, x >> 1, y >> 1, z >> 1) not in keys
        wrong["notContiguous"] += node.offset != end
        wrong["empty"] += node.points <= 0
        end = node.offset + node.size
        rows = decode(copc, node, vlr)
        low, high = copc.cube(node.key)
        xyz = positions(rows, copc)
        wrong["outsideCube"] += int(((xyz < low) | (xyz > high)).any(axis=1).sum())
        parts.append(rows)
    rows = np.concatenate(parts)
    return rows.reshape(-1).view(dtype), wrong


def second_opinion(path, copc):
    """What copclib makes of the file."""
    reader = copclib.FileReader(path)
    nodes = reader.GetAllNodes()
    ours = {node.key: (node.offset, node.size, node.points) for node in copc.nodes}
    theirs = {(n.key.d, n.key.x, n.key.y, n.key.z): (n.offset, n.byte_size, n.point_count) for n in nodes}
    largest = max(nodes, key=lambda n: n.point_count)
    data = bytes(byte if isinstance(byte, int) else ord(byte) for byte in reader.GetPointData(largest))
    key = (largest.key.d, largest.key.x, largest.key.y, largest.key.z)
    mine = next(node for node in copc.nodes if node.key == key)
    same = data == decode(copc, mine, lazrs.LazVlr(copc.laszip)).tobytes()
    return {"sameNodes": ours == theirs, "sameLargestNode": same}


def wkt(las):
    """The text of a file's WKT record, or None."""
    record = next((v for v in las.header.vlrs if (v.user_id, v.record_id) == ("LASF_Projection", 2112)), None)
    return None if record is None else record.record_data_bytes().rstrip(b"\0")


def main(path, inputs):
    copc = CopcFile(path)
    output = laspy.read(path)
    dtype = output.points.array.dtype
    sources = [laspy.read(name) for name in inputs]
    expected = np.concatenate([as_format_6_to_8(las, dtype) for las in sources])
    in_nodes, wrong = check_nodes(copc, dtype)
    xyz = positions(in_nodes.view(np.uint8).reshape(len(in_nodes), -1), copc)
    returns = np.bincount(in_nodes["bit_fields"] & 15, minlength=16)[1:]
    first = sources[0].header
    times = in_nodes["gps_time"]
    report = {
        "points": copc.count,
        "expectedPoints": len(expected),
        "hierarchySum": sum(node.points for node in copc.nodes),
        "nodes": len(copc.nodes),
        "pages": copc.pages,
        "levels": 1 + max(node.key[0] for node in copc.nodes),
        "largestNode": max(node.points for node in copc.nodes),
        "wrong": wrong,
        "sameRecords": same_multiset(in_nodes, expected),
        "sameRecordsByChunkTable": np.array_equal(output.points.array, in_nodes),
        "sameScaleAndOffset": (*copc.scale, *copc.offset) == (*first.scales, *first.offsets),
        "sameBounds": (*copc.min, *copc.max) == (*xyz.min(axis=0), *xyz.max(axis=0)),
        "sameReturns": copc.by_return == tuple(returns.tolist()),
        "sameGpsTimes": bool(not np.isfinite(times).all() or copc.info.gps_time == (times.min(), times.max())),
        "sameWkt": wkt(output) == wkt(sources[0]),
        "copclib": second_opinion(path, copc),
        "statistics": json.loads(copc.record("groma", 2)),
        "records": [[user, record_id] for user, record_id, _ in copc.vlrs],
    }
    json.dump(report, sys.stdout)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
