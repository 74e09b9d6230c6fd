"""What it costs in LAZ to order the points of each node so that every prefix is a sample (Kanzok et al. 2015)."""

from io import BytesIO

import laspy
import numpy as np

from tree import Tree

# Nodes that are compressed both ways, evenly picked.
NODES = 40


def cost(path: str, tree: Tree) -> dict:
    """Bytes of nodes as they stand and in bit-reversed order of rank along the Morton curve, both compressed by
    laspy (lazrs), one chunk a node."""
    with laspy.open(path) as reader:
        header = reader.header
    nodes = sorted(tree.nodes, key=lambda node: node.key)
    nodes = [node for node in nodes if len(node.points) > 1000]
    picked = nodes[:: max(1, len(nodes) // NODES)]
    sizes = np.zeros(2, int)
    for node in picked:
        records = np.frombuffer(tree.records(node.key), np.uint8).reshape(-1, tree.record_length)
        order = bit_reversed(len(records))
        along = np.argsort(morton(node.points), kind="stable")
        sizes += [compressed(header, records), compressed(header, records[along[order]])]
    return {"nodes": len(picked), "asStored": int(sizes[0]), "prefixOrder": int(sizes[1])}


def morton(points: np.ndarray) -> np.ndarray:
    """Places along the Morton curve of 2^16 cells along the longest edge of the points' box."""
    low = points.min(axis=0)
    cells = ((points - low) / max(np.ptp(points, axis=0).max(), 1e-300) * 65535).astype(np.uint64)
    code = np.zeros(len(points), np.uint64)
    for bit in range(16):
        for axis in range(3):
            code |= ((cells[:, axis] >> np.uint64(bit)) & np.uint64(1)) << np.uint64(3 * bit + axis)
    return code


def bit_reversed(count: int) -> np.ndarray:
    """Numbers below count, in the order of their bits read backwards: every prefix is spread over all of them."""
    bits = max(1, (count - 1).bit_length())
    numbers = np.arange(2**bits)
    turned = np.zeros_like(numbers)
    for bit in range(bits):
        turned |= ((numbers >> bit) & 1) << (bits - 1 - bit)
    return turned[turned < count]


def compressed(header: laspy.LasHeader, records: np.ndarray) -> int:
    """Bytes of point data of records as LAZ."""
    fresh = laspy.LasHeader(point_format=header.point_format, version=header.version)
    fresh.scales, fresh.offsets = header.scales, header.offsets
    array = np.ascontiguousarray(records).view(header.point_format.dtype()).ravel()
    points = laspy.ScaleAwarePointRecord(array, header.point_format, fresh.scales, fresh.offsets)
    out = BytesIO()
    with laspy.open(out, mode="w", header=fresh, do_compress=True, closefd=False) as writer:
        writer.write_points(points)
    size = out.getbuffer().nbytes
    out.seek(0)
    with laspy.open(out, closefd=False) as reader:
        return size - reader.header.offset_to_point_data
