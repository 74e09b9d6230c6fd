"""The rules of COPC 1.0 (https://copc.io/), LAS 1.4 R15 and LASzip, checked on the bytes of a file.

They include every check of copc-validator (its README, "All checks") that is about the file rather than about the
scan in it: 8-bit colours and GPS times out of order are the scan's.
"""

import io
import struct

import lazrs
import numpy as np

INFO_AT = 375
VLR_HEADER, EVLR_HEADER = 54, 60
ENTRY = 32
# What a reader of COPC asks for first, before it knows anything.
FIRST_REQUEST = 65_536
LAYERED_CHUNKED = 3
VARIABLE_CHUNKS = 0xFFFF_FFFF


def broken_rules(copc):
    """The rules that a file breaks, in words; none for a good one. Its points are not decoded."""
    broken = []
    for check in (header, records, info, pages, keys, chunks, order, compression, first_picture):
        broken += [text for holds, text in check(copc) if not holds]
    return broken


def header(copc):
    b = copc.bytes
    yield (b[24], b[25]) == (1, 4), "LAS 1.4"
    yield struct.unpack_from("<H", b, 94) == (375,), "a header of 375 bytes"
    yield b[104] in (0x86, 0x87, 0x88), "point format 6, 7 or 8, compressed"
    yield struct.unpack_from("<6I", b, 107) == (0,) * 6, "legacy counts are zero"
    yield bool(copc.encoding & 0x10), "the WKT bit is set"
    yield not copc.encoding & 0b0110, "no bit tells of waveforms"
    yield sum(copc.by_return) <= copc.count, "no more returns than points"
    yield bool(np.isfinite(copc.min + copc.max).all()), "bounds are numbers"
    yield all(low <= high for low, high in zip(copc.min, copc.max)), "bounds are in order"
    low, high = copc.cube((0, 0, 0, 0))
    inside = all(c <= m and n <= d for c, m, n, d in zip(low, copc.min, copc.max, high))
    yield inside, "the root's cube holds the header's bounds"


def records(copc):
    """Variable length records: those that COPC wants are there once, and they end where the points begin."""
    yield copc.vlrs_end <= copc.points_at, "the records end before the points"
    yield copc.evlrs_end == len(copc.bytes), "the extended records end the file"
    plain, extended = [r[:2] for r in copc.vlrs], [r[:2] for r in copc.evlrs]
    yield plain.count(("copc", 1)) == 1 and ("copc", 1) not in extended, "one information record"
    yield extended.count(("copc", 1000)) == 1 and ("copc", 1000) not in plain, "one hierarchy record"
    yield plain.count(("laszip encoded", 22204)) == 1, "one LASzip record"
    wkts = [data for user, number, data in copc.vlrs + copc.evlrs if (user, number) == ("LASF_Projection", 2112)]
    yield len(wkts) <= 1, "at most one WKT"
    yield all(b"\0" not in data.rstrip(b"\0") for data in wkts), "a WKT has NULs at its end alone"


def info(copc):
    b = copc.bytes
    yield b[INFO_AT + 2 : INFO_AT + 18] == b"copc".ljust(16, b"\0"), "the information record is the first"
    yield struct.unpack_from("<HH", b, INFO_AT + 18) == (1, 160), "record id 1, 160 bytes"
    data = copc.record("copc", 1)
    yield data[72:160] == bytes(88), "reserved fields are zero"
    values = (*copc.info.center, copc.info.halfsize, copc.info.spacing, *copc.info.gps_time)
    yield bool(np.isfinite(values).all()), "the information is of numbers"
    yield copc.info.halfsize > 0 and copc.info.spacing > 0, "cube and spacing are positive"
    yield copc.info.spacing <= 2 * copc.info.halfsize, "the spacing is no larger than the cube"
    yield copc.info.gps_time[0] <= copc.info.gps_time[1], "GPS times are in order"


def pages(copc):
    """Every page lies in the hierarchy record, no two share a byte, and all are reached."""
    spans = sorted((page.offset, page.offset + page.size) for page in copc.page_list)
    yield all(a[1] <= b[0] for a, b in zip(spans, spans[1:])), "pages do not overlap"
    yield copc.hierarchy_at <= spans[0][0], "pages stand in the hierarchy record"
    yield spans[-1][1] <= copc.hierarchy_at + copc.hierarchy_size, "pages end in the hierarchy record"
    yield sum(end - begin for begin, end in spans) == copc.hierarchy_size, "every byte of the hierarchy is reached"
    yield copc.page_list[0].offset == copc.info.root_offset, "the root page is the first"
    for page in copc.page_list[1:]:
        yield page.keys[:1] == [page.key], f"page {page.key} begins with its own node"
        below = all(is_below(key, page.key) for key in page.keys)
        yield below, f"page {page.key} holds nodes of its branch alone"


def is_below(key, ancestor):
    steps = key[0] - ancestor[0]
    return steps >= 0 and tuple(v >> steps for v in key[1:]) == ancestor[1:]


def keys(copc):
    nodes = {node.key: node for node in copc.nodes}
    yield len(nodes) == len(copc.nodes), "no node twice"
    yield (0, 0, 0, 0) in nodes, "there is a root"
    valid = all(d >= 0 and all(0 <= v < 1 << d for v in place) for d, *place in nodes)
    yield valid, "keys lie in their level"
    parents = {(d - 1, x >> 1, y >> 1, z >> 1) for d, x, y, z in nodes if d > 0}
    yield parents <= set(nodes), "every node has a parent"
    empty = [node for node in copc.nodes if node.points == 0]
    yield all((node.offset, node.size) == (0, 0) for node in empty), "a node without points has no chunk"
    yield all(node.key in parents for node in empty), "a node without points has children"
    yield all(node.points >= 0 for node in copc.nodes), "no negative counts"
    yield sum(node.points for node in copc.nodes) == copc.count, "the nodes hold as many points as the header says"


def chunks(copc):
    """Chunks follow each other without gaps from behind the table's position to the chunk table, which agrees."""
    end = copc.points_at + 8
    for node in copc.chunks():
        if node.offset != end or node.size <= 0:
            yield False, f"chunk of {node.key} at {node.offset}, the one before it ends at {end}"
            return
        end = node.offset + node.size
    yield end == copc.table_at, "the chunk table follows the chunks"
    yield struct.unpack_from("<I", copc.bytes, copc.table_at) == (0,), "chunk table version 0"
    with io.BytesIO(copc.bytes) as file:
        file.seek(copc.points_at)
        table = lazrs.read_chunk_table(file, lazrs.LazVlr(copc.laszip))
    yield list(table) == [(node.points, node.size) for node in copc.chunks()], "chunk table and hierarchy agree"


def order(copc):
    levels = [node.key[0] for node in copc.chunks()]
    yield levels == sorted(levels), "chunks stand level by level"


def compression(copc):
    compressor, coder, *_, chunk, points, size, items = struct.unpack_from("<HHBBHIIqqH", copc.laszip, 0)
    yield compressor == LAYERED_CHUNKED and coder == 0, "layered chunks, arithmetic coder"
    yield chunk == VARIABLE_CHUNKS, "chunks of any number of points"
    yield points == -1 and size == -1, "no special records"
    listed = [struct.unpack_from("<HHH", copc.laszip, 34 + 6 * i) for i in range(items)]
    yield sum(item[1] for item in listed) == copc.record_length, "the items make up a record"


def first_picture(copc):
    """Two requests tell a reader all but the points: the first bytes of the file, and the root page.

    What is needed for a picture stands before the points, and its chunks in front (`order`).
    """
    yield copc.points_at <= FIRST_REQUEST or large_records(copc), "all records lie in the first 64 KiB"
    root = copc.page_list[0]
    yield root.size == copc.info.root_size and root.size <= 1 << 20, "the root page is one request of at most 1 MiB"
    levels = {key[0] for key in root.keys}
    yield {0, 1, 2} & {node.key[0] for node in copc.nodes} <= levels, "the root page holds the levels 0 to 2"


def large_records(copc):
    """Whether records of the input alone fill the first request."""
    others = [data for user, _, data in copc.vlrs if user not in ("copc", "laszip encoded")]
    return sum(map(len, others)) > FIRST_REQUEST // 2
