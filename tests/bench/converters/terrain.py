"""Writes an airborne scan of any size: `terrain.py POINTS FILE`. LAS 1.4, point format 6, strip by strip.

Density is the same for every size (10 points per square metre); hills, and trees on a quarter of the ground.
"""

import math
import struct
import sys

import numpy as np

BLOCK = 1_000_000
DENSITY = 10
SCALE = 0.001
RECORD = np.dtype(
    [("xyz", "<i4", 3), ("intensity", "<u2"), ("returns", "u1"), ("flags", "u1"), ("class", "u1"), ("user", "u1")]
    + [("angle", "<i2"), ("source", "<u2"), ("time", "<f8")]
)


def header(points, side):
    head = bytearray(375)
    struct.pack_into("<4sHH", head, 0, b"LASF", 0, 0x11)
    struct.pack_into("<BB", head, 24, 1, 4)
    struct.pack_into("<HHHIIBHI", head, 90, 1, 2026, 375, 375, 0, 6, RECORD.itemsize, 0)
    struct.pack_into("<6d", head, 131, SCALE, SCALE, SCALE, 500_000.0, 5_000_000.0, 0.0)
    bounds = (500_000 + side, 500_000.0, 5_000_000 + side, 5_000_000.0, 200.0, 0.0)
    struct.pack_into("<6d", head, 179, *bounds)
    struct.pack_into("<Q", head, 247, points)
    struct.pack_into("<Q", head, 255, points)
    return head


def block(first, count, points, side, random):
    """Points of one stretch: lines across the strip, the strip along y."""
    at = (first + np.arange(count)) / points
    rows = np.zeros(count, RECORD)
    x = random.random(count) * side
    y = at * side
    ground = 80 + 40 * np.sin(x / 300) * np.cos(y / 220) + 3 * np.sin(x / 17 + y / 23)
    tree = (np.sin(x / 9) * np.sin(y / 11) > 0.5) & (random.random(count) < 0.7)
    z = ground + tree * random.random(count) * 18 + random.normal(0, 0.02, count)
    rows["xyz"] = np.stack([x, y, z], axis=1) / SCALE
    rows["intensity"] = random.integers(0, 4096, count)
    rows["returns"] = 0x11
    rows["class"] = np.where(tree, 5, 2)
    rows["angle"] = (x / side - 0.5) * 5000
    rows["source"] = 1
    rows["time"] = at * points * 2e-6
    return rows


def main(points, path):
    side = math.sqrt(points / DENSITY)
    random = np.random.default_rng(points)
    with open(path, "wb") as file:
        file.write(header(points, side))
        for first in range(0, points, BLOCK):
            block(first, min(BLOCK, points - first), points, side, random).tofile(file)


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2])
