"""LAS and LAZ files byte by byte, so that any byte of them can be wrong."""

import io
import struct

import lazrs
import numpy as np

LENGTHS = [20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67]
HEADERS = {2: 227, 4: 375}
# Byte offsets of header fields (LAS 1.4 R15, table 3).
COUNT_LEGACY, COUNT, BOUNDS, SCALE, OFFSET = 107, 247, 179, 131, 155
LASZIP = b"laszip encoded"


def records(points, point_format, random):
    """Raw records at integer positions (n × 3), GPS times ordinary numbers, each once.

    The other bytes are random in a small scan; in a large one, which random bytes would make slow to compress, zero.
    """
    shape = (len(points), LENGTHS[point_format])
    rows = random.integers(0, 256, shape, np.uint8) if len(points) < 10_000 else np.zeros(shape, np.uint8)
    rows[:, :12] = np.ascontiguousarray(points, "<i4").view(np.uint8).reshape(-1, 12)
    at = {1: 20, 3: 20, 4: 20, 5: 20}.get(point_format, 22 if point_format > 5 else None)
    if at is not None:
        times = (np.arange(len(points)) * 0.25).astype("<f8")
        rows[:, at : at + 8] = times.view(np.uint8).reshape(-1, 8)
    return rows


def vlr(user, number, data):
    return struct.pack("<H16sHH32s", 0, user, number, len(data), b"") + data


def las(rows, point_format, scale=(0.01,) * 3, offset=(0.0,) * 3, vlrs=(), bounds=None):
    """A LAS file of raw records."""
    minor = 4 if point_format > 3 else 2
    size, count = HEADERS[minor], len(rows)
    area = b"".join(vlrs)
    if bounds is None:
        xyz = np.ascontiguousarray(rows[:, :12]).view("<i4") * np.array(scale) + np.array(offset)
        bounds = [v for low, high in zip(xyz.min(axis=0), xyz.max(axis=0)) for v in (high, low)]
    head = bytearray(size)
    struct.pack_into("<4sHH", head, 0, b"LASF", 0, 0x10 if point_format > 5 else 0)
    struct.pack_into("<BB", head, 24, 1, minor)
    legacy = count if point_format < 6 else 0
    struct.pack_into("<HHHIIBHI", head, 90, 1, 2024, size, size + len(area), len(vlrs), point_format, rows.shape[1], legacy)
    struct.pack_into("<12d", head, SCALE, *scale, *offset, *bounds)
    if minor == 4:
        struct.pack_into("<Q", head, COUNT, count)
    return bytes(head) + area + rows.tobytes()


def laz(data, chunk_points=50_000):
    """The LAZ file of a LAS file, in chunks of as many points."""
    size, points_at, vlrs, point_format, length = struct.unpack_from("<HIIBH", data, 94)
    made = lazrs.LazVlr.new_for_compression(point_format, length - LENGTHS[point_format], False)
    parameters = bytearray(made.record_data())
    struct.pack_into("<I", parameters, 12, chunk_points)
    head = bytearray(data[:points_at]) + vlr(LASZIP, 22204, bytes(parameters))
    struct.pack_into("<IIB", head, 96, len(head), vlrs + 1, point_format | 0x80)
    out = io.BytesIO()
    compressor = lazrs.LasZipCompressor(out, lazrs.LazVlr(bytes(parameters)))
    compressor.compress_many(np.frombuffer(data, np.uint8, offset=points_at))
    compressor.done()
    body = bytearray(out.getvalue())
    struct.pack_into("<q", body, 0, struct.unpack_from("<q", body, 0)[0] + len(head))
    return bytes(head + body)


def patched(data, at, pattern, *values):
    """A copy with values written over, as `struct` packs them."""
    copy = bytearray(data)
    struct.pack_into("<" + pattern, copy, at, *values)
    return bytes(copy)


def points_at(data):
    return struct.unpack_from("<I", data, 96)[0]
