"""A COPC file read by its specification alone (https://copc.io): header, information record, hierarchy."""

import struct
from dataclasses import dataclass

HEADER = 375
VLR_HEADER = 54


@dataclass
class Info:
    """The COPC information record. `center` and `halfsize` in source coordinates."""

    center: tuple
    halfsize: float
    spacing: float
    root_offset: int
    root_size: int
    gps_time: tuple


@dataclass
class Entry:
    """A node: its key (level, x, y, z), where its chunk is, and its number of points."""

    key: tuple
    offset: int
    size: int
    points: int


class CopcFile:
    """What a COPC reader needs to know; asserts what the specification demands."""

    def __init__(self, path):
        with open(path, "rb") as file:
            self.bytes = file.read()
        b = self.bytes
        assert b[:4] == b"LASF" and (b[24], b[25]) == (1, 4), "LAS 1.4"
        (self.encoding,) = struct.unpack_from("<H", b, 6)
        header_size, self.points_at, vlrs, fmt, self.record_length, legacy = struct.unpack_from("<HIIBHI", b, 94)
        assert header_size == HEADER and fmt & 0x80 and fmt & 0x3F in (6, 7, 8)
        assert legacy == 0 and struct.unpack_from("<5I", b, 111) == (0,) * 5, "legacy counts are zero"
        assert self.encoding & 0x10, "the WKT bit is set"
        self.point_format = fmt & 0x3F
        self.scale = struct.unpack_from("<3d", b, 131)
        self.offset = struct.unpack_from("<3d", b, 155)
        max_x, min_x, max_y, min_y, max_z, min_z = struct.unpack_from("<6d", b, 179)
        self.min, self.max = (min_x, min_y, min_z), (max_x, max_y, max_z)
        waveforms, evlr_at, evlrs, self.count = struct.unpack_from("<QQIQ", b, 227)
        assert waveforms == 0
        self.by_return = struct.unpack_from("<15Q", b, 255)
        self.vlrs = self._records(HEADER, vlrs, "<H", 2)
        assert b[377:381] == b"copc" and self.vlrs[0][:2] == ("copc", 1), "the information record comes first"
        self.evlrs = self._records(evlr_at, evlrs, "<Q", 8)
        data = self.record("copc", 1)
        assert len(data) == 160
        ids = [record[:2] for record in self.vlrs + self.evlrs]
        for single in [("LASF_Projection", 2112), ("laszip encoded", 22204), ("copc", 1), ("copc", 1000)]:
            assert ids.count(single) == 1 or single[0] == "LASF_Projection" and single not in ids, single
        values = struct.unpack_from("<5dQQdd", data, 0)
        self.info = Info(values[0:3], values[3], values[4], values[5], values[6], values[7:9])
        self.laszip = self.record("laszip encoded", 22204)
        self.nodes = []
        self.pages = 0
        self._page(self.info.root_offset, self.info.root_size)

    def _records(self, at, count, length_format, length_size):
        records = []
        for _ in range(count):
            user = self.bytes[at + 2 : at + 18].split(b"\0")[0].decode()
            (record_id,) = struct.unpack_from("<H", self.bytes, at + 18)
            (length,) = struct.unpack_from(length_format, self.bytes, at + 20)
            at += 20 + length_size + 32
            records.append((user, record_id, self.bytes[at : at + length]))
            assert len(records[-1][2]) == length
            at += length
        return records

    def record(self, user, record_id):
        """The data of one record, or None."""
        return next((data for u, i, data in self.vlrs + self.evlrs if (u, i) == (user, record_id)), None)

    def _page(self, offset, size):
        assert size % 32 == 0 and offset + size <= len(self.bytes)
        self.pages += 1
        for at in range(offset, offset + size, 32):
            *key, chunk, length, points = struct.unpack_from("<4iQii", self.bytes, at)
            if points == -1:
                self._page(chunk, length)
            else:
                self.nodes.append(Entry(tuple(key), chunk, length, points))

    def cube(self, key):
        """Lower and upper corner of a node."""
        level, *place = key
        size = 2 * self.info.halfsize / 2**level
        low = [c - self.info.halfsize + k * size for c, k in zip(self.info.center, place)]
        return low, [v + size for v in low]
