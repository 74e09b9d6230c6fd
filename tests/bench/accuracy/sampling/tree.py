"""The nodes of a COPC file, as copclib reads them."""

from dataclasses import dataclass

import copclib
import numpy as np

Key = tuple[int, int, int, int]


@dataclass
class Node:
    """A node: (level, x, y, z), its points' source coordinates (n × 3), and whether it has children."""

    key: Key
    points: np.ndarray
    inner: bool


class Tree:
    """All nodes of a file. `spacing` and `side` are those of the root, `min` its lower corner."""

    def __init__(self, path: str):
        self.reader = copclib.FileReader(path)
        header = self.reader.copc_config.las_header
        info = self.reader.copc_config.copc_info
        self.spacing = info.spacing
        self.side = 2 * info.halfsize
        centre = np.array([info.center_x, info.center_y, info.center_z])
        self.min = centre - info.halfsize
        self.record_length = header.point_record_length
        self.scale = np.array([header.scale.x, header.scale.y, header.scale.z])
        self.offset = np.array([header.offset.x, header.offset.y, header.offset.z])
        entries = [entry for entry in self.reader.GetAllNodes() if entry.point_count >= 0]
        self.entries = {(e.key.d, e.key.x, e.key.y, e.key.z): e for e in entries}
        parents = {(d - 1, x >> 1, y >> 1, z >> 1) for d, x, y, z in self.entries}
        self.nodes = [Node(key, self._points(entry), key in parents) for key, entry in self.entries.items()]
        self.by_key = {node.key: node for node in self.nodes}
        self.levels = 1 + max(key[0] for key in self.entries)

    def records(self, key: Key) -> bytes:
        """The point records of a node, uncompressed."""
        return bytes(self.reader.GetPointData(self.entries[key]))

    def _points(self, entry) -> np.ndarray:
        if entry.point_count == 0:
            return np.empty((0, 3))
        records = np.frombuffer(bytes(self.reader.GetPointData(entry)), np.uint8)
        records = records.reshape(entry.point_count, self.record_length)
        integers = np.ascontiguousarray(records[:, :12]).view("<i4")
        return integers * self.scale + self.offset

    def node(self, key: Key) -> Node:
        return self.by_key[key]

    def level(self, level: int) -> list[Node]:
        return [node for node in self.nodes if node.key[0] == level]

    def spacing_of(self, level: int) -> float:
        return self.spacing / 2**level

    def corner(self, key: Key) -> np.ndarray:
        """The lower corner of a node's cube."""
        return self.min + np.array(key[1:]) * self.side / 2 ** key[0]


def stacked(nodes: list[Node]) -> np.ndarray:
    """The points of several nodes in one array."""
    return np.concatenate([node.points for node in nodes]) if nodes else np.empty((0, 3))
