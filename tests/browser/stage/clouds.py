"""Writes small scans with known shapes: `clouds.py FOLDER`, as LAS 1.4 in EPSG:32632, heights above the ellipsoid.

All lie at E 500,000 m, N 5,200,000 m, h 500 m; lengths in metres. Prints {name: path}.

plane    20 x 20 m, points every 10 cm, level, mid grey
steps    a level square of 20 x 20 m with a block of 8 x 8 x 4 m on it, points every 10 cm, mid grey
stripes  as plane, but colours, classes, returns, intensities, times and extra bytes change from strip to strip
checks   4 x 4 m with points every 2 cm and squares of 4 cm, black and white
terraces as stripes, but each strip lies 1.2 m above the one to its west, and no two attributes go the same way
density  20 x 20 m; the west has a point every 5 cm, the east one every 20 cm
cliff    two level squares of 10 x 10 m: red ones at 0 m, green ones at 6 m above them
"""

import json
import os
import sys

import laspy
import numpy as np
from pyproj import CRS

ORIGIN = np.array([500_000.0, 5_200_000.0, 500.0])
CRS_WKT = CRS.from_epsg(32632)


def grid(width, spacing, height=0.0, jitter=0.0, seed=1):
    at = np.arange(-width / 2 + spacing / 2, width / 2, spacing)
    x, y = (axis.ravel() for axis in np.meshgrid(at, at))
    random = np.random.default_rng(seed)
    if jitter:
        x = x + random.uniform(-jitter, jitter, x.size)
        y = y + random.uniform(-jitter, jitter, y.size)
    return np.column_stack([x, y, np.full(x.size, height)])


def write(folder, name, points, rgb=None, **attributes):
    header = laspy.LasHeader(point_format=7, version="1.4")
    header.scales = [0.001] * 3
    header.offsets = ORIGIN
    header.add_crs(CRS_WKT)
    extra = attributes.pop("extra", {})
    for key, values in extra.items():
        header.add_extra_dim(laspy.ExtraBytesParams(name=key, type=values.dtype))
    las = laspy.LasData(header)
    las.x, las.y, las.z = (points + ORIGIN).T
    colours = np.full((len(points), 3), 128) if rgb is None else rgb
    las.red, las.green, las.blue = colours.T.astype(np.uint16) * 257
    for key, values in {**attributes, **extra}.items():
        las[key] = values
    path = os.path.join(folder, f"{name}.las")
    las.write(path)
    return path


def steps():
    ground = grid(20, 0.1)
    ground = ground[(np.abs(ground[:, 0]) > 4) | (np.abs(ground[:, 1]) > 4)]
    top = grid(8, 0.1, 4.0)
    along, up = (axis.ravel() for axis in np.meshgrid(np.arange(-4, 4, 0.1), np.arange(0.1, 4, 0.1)))
    walls = [
        np.column_stack(side)
        for edge in (-4.0, 4.0)
        for side in ((along, np.full_like(along, edge), up), (np.full_like(along, edge), along, up))
    ]
    return np.vstack([ground, top, *walls])


# Numbers of the strips of `terraces`, from west to east, by what has them.
WAYS = {
    "return": [0, 2, 1, 3, 4],
    "source": [0, 3, 2, 1, 4],
    "angle": [4, 0, 2, 1, 3],
    "user": [0, 4, 1, 2, 3],
    "time": [1, 0, 4, 2, 3],
    "extra": [2, 1, 0, 3, 4],
}


def stripes(folder, name="stripes", step=0.0, ways={}):
    points = grid(20, 0.1)
    strip = np.clip(((points[:, 0] + 10) / 4).astype(int), 0, 4)
    palette = np.array([[220, 40, 40], [40, 200, 60], [50, 80, 230], [240, 220, 60], [240, 240, 240]])
    points[:, 2] += step * strip
    way = {key: np.array(ways.get(key, range(5)))[strip] for key in WAYS}
    return write(
        folder,
        name,
        points,
        palette[strip],
        intensity=(strip * 12_000 + 1_000).astype(np.uint16),
        classification=np.array([2, 3, 5, 6, 9])[strip].astype(np.uint8),
        return_number=(way["return"] + 1).astype(np.uint8),
        number_of_returns=np.full(len(points), 5, np.uint8),
        point_source_id=(way["source"] + 100).astype(np.uint16),
        scan_angle=((way["angle"] - 2) * 1_000).astype(np.int16),
        user_data=(way["user"] * 50).astype(np.uint8),
        gps_time=300_000_000.25 + way["time"] * 10.0,
        extra={"amplitude": (way["extra"] * 1.5 - 2.0).astype(np.float32)},
    )


def density():
    west = grid(20, 0.05)
    east = grid(20, 0.2)
    return np.vstack([west[west[:, 0] < 0], east[east[:, 0] >= 0]])


def main(folder):
    os.makedirs(folder, exist_ok=True)
    dense = grid(4, 0.02)
    black = ((np.floor(dense[:, 0] / 0.04) + np.floor(dense[:, 1] / 0.04)) % 2).astype(int)
    low, high = grid(10, 0.1), grid(10, 0.1, 6.0)
    cliff = np.vstack([low, high])
    levels = np.repeat([[200, 30, 30], [30, 200, 30]], [len(low), len(high)], axis=0)
    paths = {
        "plane": write(folder, "plane", grid(20, 0.1)),
        "steps": write(folder, "steps", steps()),
        "stripes": stripes(folder),
        "terraces": stripes(folder, "terraces", 1.2, WAYS),
        "checks": write(folder, "checks", dense, np.array([[0, 0, 0], [255, 255, 255]])[black]),
        "density": write(folder, "density", density()),
        "cliff": write(folder, "cliff", cliff, levels),
    }
    json.dump(paths, sys.stdout)


if __name__ == "__main__":
    main(sys.argv[1])
