"""Records as numpy arrays, and whether two arrays hold the same records in any order."""

import numpy as np

SCAN_ANGLE_UNIT = 0.006
LEGACY_OVERLAP = 12
UNCLASSIFIED = 1


def as_format_6_to_8(las, dtype):
    """The records of a laspy file of point format 0 to 10 as LAS 1.4 R15 writes them in format 6, 7 or 8.

    `dtype` is the packed record type of the output. Every field is read through laspy's dimensions.
    """
    source = las.points.array
    if las.header.point_format.id in (6, 7, 8):
        return np.ascontiguousarray(source).view(dtype)
    out = np.zeros(len(source), dtype=dtype)
    names = set(las.point_format.dimension_names)
    same = ["X", "Y", "Z", "intensity", "user_data", "point_source_id", "gps_time", "red", "green", "blue", "nir"]
    for name in same + list(las.point_format.extra_dimension_names):
        if name in names:
            out[name] = las[name] if name in same else source[name]
    if las.header.point_format.id > 5:
        for name in ("bit_fields", "classification_flags", "classification", "scan_angle"):
            out[name] = source[name]
        return out
    out["bit_fields"] = np.asarray(las.return_number) | np.asarray(las.number_of_returns) << 4
    code = np.asarray(las.classification)
    overlap = code == LEGACY_OVERLAP
    out["classification"] = np.where(overlap, UNCLASSIFIED, code)
    flags = [las.synthetic, las.key_point, las.withheld, overlap]
    flags += [np.zeros(len(source)), np.zeros(len(source)), las.scan_direction_flag, las.edge_of_flight_line]
    for bit, flag in enumerate(flags):
        out["classification_flags"] |= np.asarray(flag).astype(np.uint8) << bit
    out["scan_angle"] = np.round(np.asarray(las.scan_angle_rank) / SCAN_ANGLE_UNIT)
    return out


def as_words(records):
    """Records as rows of 64-bit words."""
    length = records.dtype.itemsize
    rows = np.zeros((len(records), -(-length // 8) * 8), np.uint8)
    rows[:, :length] = np.ascontiguousarray(records).view(np.uint8).reshape(len(records), length)
    return rows.view(np.uint64)


def by_hash(words):
    """Rows ordered by a hash of their content: one sort instead of one for each word."""
    mix = np.zeros(len(words), np.uint64)
    for column in words.T:
        mix = (mix ^ column) * np.uint64(0x9E3779B97F4A7C15)
        mix ^= mix >> np.uint64(29)
    return words[np.argsort(mix)]


def by_content(words):
    """Rows ordered by their words."""
    return words[np.lexsort(words.T)]


def same_multiset(a, b):
    """Whether two arrays of records hold the same bytes the same number of times.

    Equal in some order is equal as a multiset; only rows whose hashes collide need the dearer order.
    """
    if a.dtype.itemsize != b.dtype.itemsize or len(a) != len(b):
        return False
    a, b = as_words(a), as_words(b)
    return np.array_equal(by_hash(a), by_hash(b)) or np.array_equal(by_content(a), by_content(b))
