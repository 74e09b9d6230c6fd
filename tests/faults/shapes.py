"""Writes scans that are hard to divide, and well-formed files that are unusual: `shapes.py FOLDER`.

Standard output: [{ name, inputs: [path], references?: [path] }, ...]; each has to be converted without loss.
"""

import json
import math
import sys
from pathlib import Path

import numpy as np
from scan_bytes import BOUNDS, las, laz, patched, records

EDGE = 2**31


def shapes(random):
    """Name, integer positions, scale, offset."""
    whole = lambda n, low=-EDGE, high=EDGE - 1: random.integers(low, high, (n, 3), endpoint=True)
    metres, origin = (0.001,) * 3, (500_000.0, 5_000_000.0, 100.0)
    yield "a million coincident points", np.full((1_000_000, 3), [7, 8, 9]), metres, origin
    yield "a thousand places with 200 points each", np.repeat(whole(1000, 0, 10**6), 200, axis=0), metres, origin
    pile = np.concatenate([np.full((150_000, 3), 500_000), whole(100_000, 0, 10**6)])
    yield "a pile in a cloud", random.permutation(pile), metres, origin
    along = np.arange(200_000)[:, None]
    yield "a line along x", along * [1, 0, 0], metres, origin
    yield "a diagonal line", along * [1, 1, 1], metres, origin
    yield "a vertical plane", np.stack([along[:, 0] % 447, along[:, 0] * 0, along[:, 0] // 447], 1), metres, origin
    yield "a level plane", whole(200_000, 0, 10**5) * [1, 1, 0], metres, origin
    far = np.concatenate([whole(80_000, 0, 10_000), whole(80_000, 0, 10_000) + [10**9, 0, 0]])
    yield "two clusters 1,000 km apart", far, metres, origin
    yield "one point", np.array([[1, 2, 3]]), metres, origin
    yield "two points", np.array([[1, 2, 3], [4, 5, 6]]), metres, origin
    corners = np.array([[x, y, z] for x in (-EDGE, EDGE - 1) for y in (-EDGE, EDGE - 1) for z in (-EDGE, EDGE - 1)])
    yield "the corners of int32", corners, metres, origin
    yield "all of int32", np.concatenate([whole(150_000), corners]), metres, origin
    yield "scale 1e-9", whole(150_000), (1e-9,) * 3, (0.0,) * 3
    yield "scale 1e-9 far from the origin", whole(150_000), (1e-9,) * 3, origin
    yield "finer steps than float64 can tell", whole(150_000, -1000, 1000), (1e-12,) * 3, origin
    yield "scale 1e3", whole(150_000), (1e3,) * 3, (0.0,) * 3
    yield "a negative scale", whole(60_000, 0, 10**6), (0.001, -0.001, 0.001), origin
    yield "scales that differ a million times", whole(150_000, 0, 10**5), (1e-3, 1e3, 1e-3), (0.0,) * 3


def unusual(random):
    """Name, bytes of a file, bytes of one with the same records if readers need another."""
    spread = lambda n: random.integers(0, 10**5, (n, 3))
    seven = las(records(spread(3000), 7, random), 7)
    bad = records(spread(3000), 7, random)
    times = np.tile([math.nan, math.inf, -math.inf, 1e308, -0.0, 5e-324], 500).astype("<f8")
    bad[:, 22:30] = times.view(np.uint8).reshape(-1, 8)
    yield "GPS times that are no numbers", las(bad, 7)
    bad[:, 22:30] = np.full(3000, math.nan).view(np.uint8).reshape(-1, 8)
    yield "GPS times of which none is a number", laz(las(bad, 7))
    many = las(records(random.integers(0, 10**6, (250_000, 3)), 6, random), 6)
    yield "one LAZ chunk of 250,000 points", laz(many, 10**6)
    yield "LAZ chunks of 30 points", laz(seven, 30)
    # Readers that take a chunk's size at its word want 150 GB for this one.
    yield "a LAZ chunk size of four billion points", laz(seven, 2**32 - 2), seven
    for text, bounds in {
        "too small": (1.0, 0.5) * 3,
        "too large": (1e12, -1e12) * 3,
        "elsewhere": (-5e6, -6e6) * 3,
        "upside down": (0.0, 1000.0) * 3,
        "NaN": (math.nan,) * 6,
        "infinite": (math.inf, -math.inf) * 3,
        "huge": (1.7e308, -1.7e308) * 3,
        "all zero": (0.0,) * 6,
    }.items():
        lying = patched(seven, BOUNDS, "6d", *bounds)
        yield f"bounds that are {text}, as LAS", lying
        yield f"bounds that are {text}, as LAZ", laz(lying)
    lying = las(records(spread(150_000), 6, random), 6, bounds=(300.0, 0.0, 300.0, 0.0, 300.0, 0.0))
    yield "bounds that hold a third of many points", laz(lying)
    one = las(records(spread(3000), 1, random), 1)
    yield "LAS 1.2 with returns that are not there", patched(one, 111, "5I", *(2**32 - 1,) * 5)
    yield "LAS 1.4 with a legacy count", patched(seven, 107, "I", 3000)
    yield "LAS 1.4 with a wrong legacy count", patched(seven, 107, "I", 7)
    yield "extended records that are not there", patched(seven, 235, "QI", 2**63, 3), seven
    yield "extended records without end", patched(seven, 235, "QI", len(seven) - 80, 2**32 - 1), seven
    yield "more variable length records than there are", patched(seven, 100, "I", 2**32 - 1), seven


def main(folder):
    random = np.random.default_rng(2024)
    cases = []

    def add(name, *files):
        paths = []
        for data in files:
            path = Path(folder) / f"shape-{len(cases)}-{len(paths)}.las"
            path.write_bytes(data)
            paths.append(str(path))
        cases.append({"name": name, "inputs": paths[:1], "references": paths[-1:]})

    for name, points, scale, offset in shapes(random):
        add(name, las(records(points, 6, random), 6, scale, offset))
    for name, *files in unusual(random):
        add(name, *files)
    json.dump(cases, sys.stdout)


if __name__ == "__main__":
    main(sys.argv[1])
