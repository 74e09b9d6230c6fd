"""Writes scans of every point format with laspy: `generate.py FOLDER`.

Standard output: [{ name, inputs: [path, ...] }, ...], each to be converted and compared on its own. Deterministic.
Every field takes every value that its bits allow.
"""

import json
import sys
from pathlib import Path

import laspy
import numpy as np
from laspy.header import GpsTimeType

POINTS = 4000
SCALES, OFFSETS = [0.001, 0.001, 0.01], [2_600_000.0, 1_200_000.0, -0.0]

SOME = [
    laspy.ExtraBytesParams(name="Amplitude", type=np.float32),
    laspy.ExtraBytesParams(name="Pulse width", type=np.uint16, scales=[0.1], offsets=[0.0]),
]
# 192 bytes: what a scanner's raw export may have, and each byte is a layer of its own in LAZ.
WIDE = [laspy.ExtraBytesParams(name=f"f{i}", type=np.float64) for i in range(20)]
WIDE += [laspy.ExtraBytesParams(name=f"b{i}", type=np.int8) for i in range(32)]


def fill(array, random):
    """Random values in every field."""
    for name in array.dtype.names:
        kind = array.dtype[name]
        if kind.kind == "f":
            array[name] = random.normal(0, 1e5, len(array))
        elif name in "XYZ":
            array[name] = random.integers(-1_000_000, 1_000_000, len(array))
        else:
            bounds = np.iinfo(kind)
            array[name] = random.integers(bounds.min, bounds.max, len(array), dtype=kind, endpoint=True)


def scan(point_format, seed, points=POINTS, extra=SOME, scales=SCALES, offsets=OFFSETS, time=GpsTimeType.WEEK_TIME):
    """A scan of one format with random fields."""
    header = laspy.LasHeader(point_format=point_format, version="1.4" if point_format > 3 else "1.2")
    header.scales, header.offsets = scales, offsets
    header.global_encoding.gps_time_type = time
    for parameters in extra:
        header.add_extra_dim(parameters)
    las = laspy.LasData(header)
    las.points = laspy.ScaleAwarePointRecord.zeros(points, header=header)
    fill(las.points.array, np.random.default_rng(seed))
    return las


def legacy_bits():
    """Every pair of return byte and classification byte of the formats 0 to 5, with every scan angle rank."""
    las = scan(1, 77, points=1 << 16, extra=[])
    pairs = np.arange(1 << 16)
    las.points.array["bit_fields"] = pairs & 255
    las.points.array["raw_classification"] = pairs >> 8
    las.points.array["scan_angle_rank"] = (pairs * 7 & 255).astype(np.uint8).view(np.int8)
    return las


def undescribed(path):
    """The same file without the record that describes its extra bytes."""
    path.write_bytes(path.read_bytes().replace(b"LASF_Spec", b"somebody\0", 1))


class Cases:
    def __init__(self, folder):
        self.folder, self.list = Path(folder), []

    def add(self, name, *scans):
        """`scans`: pairs of a laspy file and `las` or `laz`."""
        number, inputs = len(self.list), []
        for part, (las, suffix) in enumerate(scans):
            path = self.folder / f"{number}-{part}.{suffix}"
            las.write(str(path))
            inputs.append(str(path))
        self.list.append({"name": name, "inputs": inputs})


def main(folder):
    cases = Cases(folder)
    for point_format in range(11):
        for suffix in ("las", "laz"):
            cases.add(f"format {point_format} as {suffix.upper()}", (scan(point_format, point_format), suffix))
        parts = [scan(point_format, 100 * point_format + i, points=900) for i in range(2)]
        # Ten steps of the first's scale in one of its own, and another origin.
        form = {"scales": [0.01, 0.01, 0.01], "offsets": [2_600_100.5, 1_199_000.0, 20.25]}
        coarse = scan(point_format, 100 * point_format + 2, points=900, **form)
        coarse.points.array["X"] //= 100
        cases.add(
            f"format {point_format} from three files",
            *((parts[0], "las"), (parts[1], "laz"), (coarse, "laz" if point_format % 2 else "las")),
        )
    cases.add("formats 7 and 3", (scan(7, 7, points=900), "laz"), (scan(3, 3, points=900), "las"))
    for point_format, suffix in ((0, "las"), (3, "laz"), (7, "laz"), (10, "las")):
        name = f"192 extra bytes in format {point_format} as {suffix.upper()}"
        cases.add(name, (scan(point_format, 5, points=600, extra=WIDE), suffix))
    cases.add("extra bytes that nobody describes", (scan(6, 6, points=900), "las"))
    undescribed(Path(cases.list[-1]["inputs"][0]))
    cases.add("every byte of returns, flags, classes and angles of format 1", (legacy_bits(), "las"))
    for point_format in (1, 7):
        for time in (GpsTimeType.WEEK_TIME, GpsTimeType.STANDARD):
            las = scan(point_format, 9, points=300, time=time)
            cases.add(f"GPS {time.name.lower().replace('_', ' ')} in format {point_format}", (las, "laz"))
    json.dump(cases.list, sys.stdout)


if __name__ == "__main__":
    main(sys.argv[1])
