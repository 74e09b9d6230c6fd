"""Compares COPC files with the inputs they were made of.

Standard input: [[COPC file, [input, ...]], ...]; standard output: one object per file, or { "error": text }. Without
inputs, the file is read and checked alone.
laspy reads both sides; lazrs decodes every chunk on its own; copclib and laspy's CopcReader give a second and a third
opinion; `rules.py` has the rules of the format.
"""

import json
import os
import resource
import signal
import sys
import traceback
from collections import deque
from decimal import Decimal
from fractions import Fraction

import copclib
import laspy
import lazrs
import numpy as np
from copc_file import CopcFile
from records import as_format_6_to_8, same_multiset
from rules import broken_rules

# Up to so many points every reader reads all of them; above, one node and the first chunks stand for the rest.
ALL_BY_ALL = 100_000
POINTS_AT_A_TIME = 1_000_000
# Of one comparison; Autzen takes 25 s and 6 GB. The first argument gives other seconds.
SECONDS, MEMORY = int(sys.argv[1]) if len(sys.argv) > 1 else 250, 16 << 30


def decode(copc, nodes):
    """The records of some nodes, each from nothing but the bytes that the hierarchy gives it."""
    data = np.frombuffer(b"".join(copc.bytes[n.offset : n.offset + n.size] for n in nodes), np.uint8)
    count = sum(node.points for node in nodes)
    out = np.zeros(count * copc.record_length, np.uint8)
    table = [(node.points, node.size) for node in nodes]
    lazrs.decompress_points_with_chunk_table(data, copc.laszip, out, table)
    return out.reshape(count, copc.record_length)


def positions(rows, copc):
    """Coordinates of raw records, n × 3."""
    integers = np.ascontiguousarray(rows[:, :12]).view("<i4")
    return integers * np.array(copc.scale) + np.array(copc.offset)


def groups(nodes):
    """Nodes in lists of about a million points."""
    group, points = [], 0
    for node in nodes:
        group.append(node)
        points += node.points
        if points >= POINTS_AT_A_TIME:
            yield group
            group, points = [], 0
    if group:
        yield group


def check_points(copc):
    """Reads every node by itself; returns all records, their bounds, and how many lie outside of their node."""
    parts, outside = [], 0
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for group in groups(copc.chunks()):
        rows = decode(copc, group)
        xyz = positions(rows, copc)
        counts = [node.points for node in group]
        cubes = np.repeat(np.array([copc.cube(node.key) for node in group]), counts, axis=0)
        outside += int(((xyz < cubes[:, 0]) | (xyz > cubes[:, 1])).any(axis=1).sum())
        low, high = np.minimum(low, xyz.min(axis=0)), np.maximum(high, xyz.max(axis=0))
        parts.append(rows)
    return np.concatenate(parts), tuple(low), tuple(high), outside


def copclib_agrees(path, copc):
    """Whether copclib finds the same nodes and in each the same bytes."""
    reader = copclib.FileReader(path)
    nodes = reader.GetAllNodes()
    ours = {node.key: node for node in copc.nodes}
    if len(nodes) != len(ours):
        return False
    for node in nodes:
        mine = ours.get((node.key.d, node.key.x, node.key.y, node.key.z))
        if mine is None or (mine.offset, mine.size, mine.points) != (node.offset, node.byte_size, node.point_count):
            return False
    wanted = nodes if copc.count <= ALL_BY_ALL else [max(nodes, key=lambda n: n.point_count)]
    for node in wanted:
        if node.point_count == 0:
            continue
        mine = ours[(node.key.d, node.key.x, node.key.y, node.key.z)]
        if np.asarray(reader.GetPointData(node)).tobytes() != decode(copc, [mine]).tobytes():
            return False
    return True


def laspy_agrees(path, in_nodes):
    """Whether laspy reads the same records, as a LAZ file by its chunk table and as COPC by its hierarchy."""
    with laspy.open(path) as reader:
        points = reader.read_points(ALL_BY_ALL) if len(in_nodes) > ALL_BY_ALL else reader.read().points
        if points.array.tobytes() != in_nodes[: len(points)].tobytes():
            return False
    with laspy.CopcReader.open(path) as reader:
        if len(in_nodes) > ALL_BY_ALL:
            return len(reader.query(level=0)) > 0
        return same_multiset(reader.query().array, in_nodes)


def rescaled(integers, scale, offset, to_scale, to_offset):
    """Integers of one scale and offset as those of another, by exact decimals; ValueError where that is not exact."""
    exact = [Fraction(Decimal(repr(float(v)))) for v in (scale, offset, to_scale, to_offset)]
    factor, shift = exact[0] / exact[2], (exact[1] - exact[3]) / exact[2]
    values = [int(v) * factor + shift for v in integers]
    if any(value.denominator != 1 for value in values):
        raise ValueError("a coordinate has no exact integer in the output")
    return np.array([int(value) for value in values], np.int64)


def expected_records(las, copc, dtype):
    """What the output has to hold of one input."""
    records = as_format_6_to_8(las, dtype)
    header = las.header
    if (*header.scales, *header.offsets) == (*copc.scale, *copc.offset):
        return records
    records = records.copy()
    for axis, name in enumerate("XYZ"):
        form = (header.scales[axis], header.offsets[axis], copc.scale[axis], copc.offset[axis])
        records[name] = rescaled(records[name], *form)
    return records


def wkt(las):
    """The text of a file's WKT record, or None."""
    records = [*las.header.vlrs, *(las.evlrs or [])]
    record = next((v for v in records if (v.user_id, v.record_id) == ("LASF_Projection", 2112)), None)
    return None if record is None else record.record_data_bytes().rstrip(b"\0")


def no_constant(text):
    raise ValueError(f"{text} is not JSON")


def check(path, copc, dtype, rows, low, high, outside):
    """What a file's own bytes tell."""
    in_nodes = rows.reshape(-1).view(dtype)
    returns = np.bincount(in_nodes["bit_fields"] & 15, minlength=16)[1:]
    times = in_nodes["gps_time"][np.isfinite(in_nodes["gps_time"])]
    return {
        "points": copc.count,
        "nodes": len(copc.nodes),
        "levels": 1 + max(node.key[0] for node in copc.nodes),
        "largestNode": max(node.points for node in copc.nodes),
        "broken": broken_rules(copc),
        "outsideCube": outside,
        "sameBounds": (*copc.min, *copc.max) == (*low, *high),
        "sameReturns": copc.by_return == tuple(returns.tolist()),
        "sameGpsTimes": copc.info.gps_time == ((times.min(), times.max()) if len(times) else (0.0, 0.0)),
        "copclib": copclib_agrees(path, copc),
        "laspy": laspy_agrees(path, in_nodes),
        "statistics": json.loads(copc.record("groma", 2), parse_constant=no_constant),
        "records": [[user, record_id] for user, record_id, _ in copc.vlrs],
    }


def check_against(inputs, copc, dtype, rows):
    """What the inputs' bytes tell."""
    sources = [laspy.read(name) for name in inputs]
    expected = np.concatenate([expected_records(las, copc, dtype) for las in sources])
    first = sources[0].header
    forms = {(*las.header.scales, *las.header.offsets) for las in sources}
    source_time = first.global_encoding.gps_time_type.value if first.version.minor >= 2 else 0
    output_wkt = copc.record("LASF_Projection", 2112)
    return {
        "expectedPoints": len(expected),
        "sameRecords": same_multiset(rows.reshape(-1).view(dtype), expected),
        "sameScaleAndOffset": len(forms) > 1 or (*copc.scale, *copc.offset) in forms,
        "sameGpsTimeType": copc.encoding & 1 == source_time,
        "sameWkt": (None if output_wkt is None else output_wkt.rstrip(b"\0")) == wkt(sources[0]),
    }


def compare(path, inputs):
    copc = CopcFile(path)
    with laspy.open(path) as reader:
        dtype = reader.header.point_format.dtype()
    rows, low, high, outside = check_points(copc)
    against = check_against(inputs, copc, dtype, rows) if inputs else {}
    return check(path, copc, dtype, rows, low, high, outside) | against


def attempt(job):
    try:
        return compare(*job)
    except Exception:
        return {"error": traceback.format_exc()}


def start(job):
    """Compares in a process of its own: a reader that a bad file leads astray takes no other comparison with it."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        signal.alarm(SECONDS)
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        with os.fdopen(writing, "w") as pipe:
            json.dump(attempt(job), pipe)
            pipe.flush()
            os._exit(0)
    os.close(writing)
    return child, reading


def finish(child, reading):
    with os.fdopen(reading) as pipe:
        text = pipe.read()
    status = os.waitpid(child, 0)[1]
    return json.loads(text) if status == 0 else {"error": f"a referee ended with status {status}"}


def main(jobs):
    results, running = [], deque()
    for job in jobs:
        running.append(start(job))
        if len(running) > 1:
            results.append(finish(*running.popleft()))
    return results + [finish(*job) for job in running]


if __name__ == "__main__":
    json.dump(main(json.load(sys.stdin)), sys.stdout)
