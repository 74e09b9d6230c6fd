"""A COPC file read by its specification alone (https://copc.io): header, information record, hierarchy."""

import struct
from dataclasses import dataclass

HEADER = 375


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


@dataclass
class Page:
    """A hierarchy page: the node that it begins with, where it is, and the keys of its entries."""

    key: tuple
    offset: int
    size: int
    keys: list


class CopcFile:
    """What a COPC reader needs to know; asserts what reading on depends on, `rules.py` checks the rest."""

    def __init__(self, path):
        with open(path, "rb") as file:
            self.bytes = file.read()
        b = self.bytes
        assert b[:4] == b"LASF", "a LAS file"
        (self.encoding,) = struct.unpack_from("<H", b, 6)
        _, self.points_at, vlrs, fmt, self.record_length = struct.unpack_from("<HIIBH", b, 94)
        self.point_format = fmt & 0x3F
        self.scale = struct.unpack_from("<3d", b, 131)
        self.offset = struct.unpack_from("<3d", b, 155)
        max_x, min_x, max_y, min_y, max_z, min_z = struct.unpack_from("<6d", b, 179)
        self.min, self.max = (min_x, min_y, min_z), (max_x, max_y, max_z)
        waveforms, evlr_at, evlrs, self.count = struct.unpack_from("<QQIQ", b, 227)
        assert waveforms == 0
        self.by_return = struct.unpack_from("<15Q", b, 255)
        self.vlrs, _, self.vlrs_end = self._records(HEADER, vlrs, "<H", 2)
        self.evlrs, places, self.evlrs_end = self._records(evlr_at, evlrs, "<Q", 8)
        data = self.record("copc", 1)
        assert len(data) == 160
        values = struct.unpack_from("<5dQQdd", data, 0)
        self.info = Info(values[0:3], values[3], values[4], values[5], values[6], values[7:9])
        self.laszip = self.record("laszip encoded", 22204)
        hierarchy = [i for i, record in enumerate(self.evlrs) if record[:2] == ("copc", 1000)]
        assert hierarchy, "a hierarchy record"
        self.hierarchy_at, self.hierarchy_size = places[hierarchy[0]], len(self.evlrs[hierarchy[0]][2])
        (self.table_at,) = struct.unpack_from("<q", b, self.points_at)
        self.nodes = []
        self.page_list = []
        self._page((0, 0, 0, 0), self.info.root_offset, self.info.root_size)

    def _records(self, at, count, length_format, length_size):
        records, places = [], []
        for _ in range(count):
            user = self.bytes[at + 2 : at + 18].split(b"\0")[0].decode("latin-1")
            (record_id,) = struct.unpack_from("<H", self.bytes, at + 18)
            (length,) = struct.unpack_from(length_format, self.bytes, at + 20)
            at += 20 + length_size + 32
            records.append((user, record_id, self.bytes[at : at + length]))
            places.append(at)
            assert len(records[-1][2]) == length
            at += length
        return records, places, at

    def record(self, user, record_id):
        """The data of one record, or None."""
        return next((data for u, i, data in self.vlrs + self.evlrs if (u, i) == (user, record_id)), None)

    def chunks(self):
        """The nodes that have points, in the order of their chunks in the file."""
        return sorted((node for node in self.nodes if node.points > 0), key=lambda node: node.offset)

    def _page(self, key, offset, size):
        assert size % 32 == 0 and offset + size <= len(self.bytes)
        assert all(page.offset != offset for page in self.page_list), "pages do not go round in circles"
        page = Page(key, offset, size, [])
        self.page_list.append(page)
        for at in range(offset, offset + size, 32):
            *place, chunk, length, points = struct.unpack_from("<4iQii", self.bytes, at)
            if points == -1:
                self._page(tuple(place), chunk, length)
            else:
                page.keys.append(tuple(place))
                self.nodes.append(Entry(tuple(place), chunk, length, points))

    def cube(self, key):
        """Lower and upper corner of a node."""
        level, *place = key
        size = 2 * self.info.halfsize / 2**level
        low = [c - self.info.halfsize + k * size for c, k in zip(self.info.center, place)]
        return low, [v + size for v in low]
