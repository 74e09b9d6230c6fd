"""Landmarks of a scan: small flat places of one colour whose surroundings have another.

Reads the source file with laspy and places it with PROJ, so that nothing of Groma is involved.
Usage: landmarks.py SCAN PROJ4 VERTICAL_METRES_PER_UNIT COUNT R,G,B -> JSON on standard output; R,G,B is the colour of
the bare globe there, which no landmark may resemble:
  [{ longitude, latitude (degrees, WGS 84), height (m, ellipsoidal), rgb [0..255], contrast (0..255), radius (m) }]
"""

import json
import sys

import laspy
import numpy as np
from pyproj import CRS, Transformer

CELL = 1.5  # metres
UNLIKE_GLOBE = 45  # of 255


def main() -> None:
    path, proj4, vertical, count = sys.argv[1], sys.argv[2], float(sys.argv[3]), int(sys.argv[4])
    globe = np.array([float(part) for part in sys.argv[5].split(",")])
    cloud = laspy.read(path)
    metres = CRS.from_proj4(proj4).axis_info[0].unit_conversion_factor
    x, y = np.asarray(cloud.x) * metres, np.asarray(cloud.y) * metres
    z = np.asarray(cloud.z) * vertical
    rgb = np.stack([cloud.red, cloud.green, cloud.blue], axis=1).astype(np.float64)
    if rgb.max() > 255:
        rgb /= 257.0

    column = ((x - x.min()) / CELL).astype(np.int64)
    row = ((y - y.min()) / CELL).astype(np.int64)
    width, height = column.max() + 1, row.max() + 1
    cell = row * width + column
    number = np.bincount(cell, minlength=width * height)
    full = np.maximum(number, 1)

    def mean(values):
        return (np.bincount(cell, values, minlength=width * height) / full).reshape(height, width)

    colour = np.stack([mean(rgb[:, i]) for i in range(3)], axis=2)
    square = np.stack([mean(rgb[:, i] ** 2) for i in range(3)], axis=2)
    colour_deviation = np.sqrt(np.maximum(square - colour**2, 0)).max(axis=2)
    level = mean(z)
    roughness = np.sqrt(np.maximum(mean(z**2) - level**2, 0))
    filled = number.reshape(height, width) >= 2

    def around(field, reduce, reach):
        out = field.copy()
        for dy in range(-reach, reach + 1):
            for dx in range(-reach, reach + 1):
                out = reduce(out, np.roll(field, (dy, dx), axis=(0, 1)))
        return out

    # A patch of 5 x 5 cells: filled, flat, of one colour; its ring at 8 cells of another colour.
    patch_low = np.stack([around(colour[:, :, i], np.minimum, 2) for i in range(3)], axis=2)
    patch_high = np.stack([around(colour[:, :, i], np.maximum, 2) for i in range(3)], axis=2)
    spread = (patch_high - patch_low).max(axis=2)
    flat = (around(level, np.maximum, 2) - around(level, np.minimum, 2) < 0.4) & (around(roughness, np.maximum, 2) < 0.2)
    good = around(filled, np.logical_and, 2) & flat & (spread < 30) & (around(colour_deviation, np.maximum, 2) < 15)
    good &= np.abs(colour - globe).max(axis=2) > UNLIKE_GLOBE
    good[:20] = good[-20:] = False
    good[:, :20] = good[:, -20:] = False
    ring = np.zeros((height, width))
    for dy, dx in ((0, 8), (0, -8), (8, 0), (-8, 0)):
        there = np.roll(colour, (dy, dx), axis=(0, 1))
        ring = np.maximum(ring, np.abs(there - colour).max(axis=2) * np.roll(filled, (dy, dx), axis=(0, 1)))
    score = np.where(good, ring, 0)

    transform = Transformer.from_crs(CRS.from_proj4(proj4), CRS.from_epsg(4326), always_xy=True)
    landmarks = []
    while len(landmarks) < count and score.max() > 0:
        r, c = np.unravel_index(np.argmax(score), score.shape)
        inside = (np.abs(row - r) <= 2) & (np.abs(column - c) <= 2)
        px, py = x.min() + (c + 0.5) * CELL, y.min() + (r + 0.5) * CELL
        longitude, latitude = transform.transform(px / metres, py / metres)
        landmarks.append(
            {
                "longitude": longitude,
                "latitude": latitude,
                "height": float(z[inside].mean()),
                "rgb": [float(v) for v in rgb[inside].mean(axis=0)],
                "contrast": float(score[r, c]),
                "radius": 2.5 * CELL,
            }
        )
        reach = int(150 / CELL)  # the next landmark stands elsewhere
        score[max(0, r - reach) : r + reach, max(0, c - reach) : c + reach] = 0
    json.dump(landmarks, sys.stdout)


main()
