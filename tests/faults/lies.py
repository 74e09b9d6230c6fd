"""Writes scans that are broken or lie: `lies.py FOLDER`.

Standard output: [{ name, inputs: [path, ...], codes: [error code, ...] }, ...]. Without codes it is open whether the
input can be converted: it gives one error or the file that laspy's reading of the input makes.
"""

import itertools
import json
import math
import struct
import sys
from pathlib import Path

import numpy as np
from scan_bytes import COUNT, COUNT_LEGACY, OFFSET, SCALE, las, laz, patched, points_at, records, vlr

TRUNCATED, CORRUPT, FORMAT, MAGIC, EMPTY, MIXED = (
    f"INPUT_{name}" for name in ("TRUNCATED", "CORRUPT", "FORMAT", "MAGIC", "EMPTY", "MIXED")
)
FLIPS = 160
CUT_EVERY = 1000


def wrong_headers(three, seven):
    """`three`: LAS 1.2 of format 3; `seven`: LAS 1.4 of format 7. Both have 2000 points."""
    for version, data, at, pattern in (("1.2", three, COUNT_LEGACY, "I"), ("1.4", seven, COUNT, "Q")):
        most = 2 ** (8 * struct.calcsize(pattern)) - 1
        for kind, file in (("LAS", data), ("LAZ", laz(data, 500))):
            for count in (2001, 4000, 2**31, most):
                yield f"{count} points announced in {kind} {version}", patched(file, at, pattern, count), [TRUNCATED]
            yield f"no points announced in {kind} {version}", patched(file, at, pattern, 0), [EMPTY]
    yield "fewer points announced than LAZ chunks hold", patched(laz(seven, 500), COUNT, "Q", 700), [CORRUPT]
    yield "fewer points announced than one LAZ chunk holds", patched(laz(seven), COUNT, "Q", 700), [CORRUPT]
    for bad in (math.nan, math.inf, -math.inf, 0.0, 1e300):
        yield f"scale {bad}", patched(seven, SCALE + 8, "d", bad), [CORRUPT]
    for bad in (math.nan, math.inf, 1e308 * 1.7):
        yield f"offset {bad}", patched(patched(seven, OFFSET, "d", bad), SCALE, "d", 1e299), [CORRUPT]
    yield "records shorter than their format", patched(three, 105, "H", 33), [CORRUPT]
    yield "records without length", patched(three, 105, "H", 0), [CORRUPT]
    yield "point format 11", patched(three, 104, "B", 11), [FORMAT]
    yield "point format 63, compressed", patched(three, 104, "B", 0xFF), [FORMAT]
    yield "LAS 1.5", patched(seven, 25, "B", 5), [FORMAT]
    yield "LAS 2.0", patched(seven, 24, "BB", 2, 0), [FORMAT]
    yield "a header without length", patched(seven, 94, "H", 0), [CORRUPT]
    yield "a header that is too long", patched(seven, 94, "H", 65_535), [CORRUPT, TRUNCATED]
    yield "points in the header", patched(seven, 96, "I", 100), [CORRUPT]
    yield "points beyond the end", patched(seven, 96, "I", 2**32 - 1), [TRUNCATED]
    yield "nothing", b"", [MAGIC]
    yield "something else", b"%PDF-1.7\n" * 100, [MAGIC]
    yield "a signature alone", b"LASF", [TRUNCATED]
    yield "zeros after the signature", b"LASF" + bytes(1000), [FORMAT, CORRUPT, TRUNCATED]
    yield "compression that the header invents", patched(three, 104, "B", 3 | 0x80), [CORRUPT]


def wrong_laz(seven):
    good = laz(seven, 500)
    start = points_at(good)
    (table,) = struct.unpack_from("<q", good, start)
    parameters = good.index(b"laszip encoded") - 2 + 54
    wrong = lambda at, pattern, *values: patched(good, at, pattern, *values)
    # A position that cannot be: the chunks can still be read one after the other.
    yield "a chunk table before the points", wrong(start, "q", 10), None
    for name, position in (("beyond the end", 2**62), ("at the last byte", len(good) - 1)):
        yield f"a chunk table {name}", wrong(start, "q", position), [CORRUPT, TRUNCATED]
    for count in (0, 1, 2**32 - 1):
        yield f"a chunk table of {count} chunks", wrong(table + 4, "I", count), [CORRUPT, TRUNCATED]
    yield "no LASzip record", good.replace(b"laszip encoded", b"laszip decoded", 1), [CORRUPT]
    yield "a compressor that nobody has", wrong(parameters, "H", 77), [CORRUPT]
    yield "chunks without points", wrong(parameters + 12, "I", 0), [CORRUPT]
    yield "LASzip items without end", wrong(parameters + 32, "H", 65_535), [CORRUPT]
    yield "a LASzip item of another size", wrong(parameters + 36, "H", 7), [CORRUPT]
    yield "an item version that nobody has", wrong(parameters + 38, "H", 99), [CORRUPT]
    yield "layers longer than the chunk", wrong(start + 8 + 36 + 4, "I", 2**32 - 1), [CORRUPT]
    untabled = patched(good[:table], start, "q", -1)
    for size in (2**31, 2**32 - 1):
        name = f"layers of {size} bytes in a file without chunk table"
        yield name, patched(untabled, start + 8 + 36 + 4, "I", size), [CORRUPT, TRUNCATED]
    yield "the chunk's own count is another", wrong(start + 8 + 36, "I", 2**31), None
    yield "chunks of zeros", good[: start + 8] + bytes(table - start - 8) + good[table:], None


def cut(files):
    for name, data in files.items():
        for end in range(0, len(data), CUT_EVERY):
            yield f"{name} cut at byte {end}", data[:end], [TRUNCATED, CORRUPT, MAGIC]
        yield f"{name} without its last byte", data[:-1], [TRUNCATED, CORRUPT]


def flipped(files, random):
    """Bytes changed at random: one half of the files before the points, where each byte means something."""
    names = list(files)
    for number in range(FLIPS):
        name = names[number % len(names)]
        data = bytearray(files[name])
        end = points_at(data) + 60 if number % 2 else len(data)
        places = random.integers(0, end, int(random.integers(1, 4)))
        for at in places:
            data[at] = random.choice([0, 0xFF, data[at] ^ 1 << int(random.integers(8)), int(random.integers(256))])
        yield f"{name} with bytes changed at {sorted(places.tolist())}", bytes(data), None


def mixed(positions, random):
    """Several inputs that may not stand in one file; yields lists of files."""
    rows = records(positions, 6, random)
    crs = lambda name: [vlr(b"LASF_Projection", 2112, f'LOCAL_CS["{name}"]\0'.encode())]
    plain = las(rows, 6)
    apart = [las(rows, 6, vlrs=crs(name)) for name in ("here", "there", "elsewhere")]
    yield "three coordinate reference systems", apart, [MIXED]
    yield "one coordinate reference system for two of three", [apart[0], apart[0], plain], [MIXED]
    yield "weeks and standard time", [plain, patched(plain, 6, "H", 0x11)], [MIXED]
    yield "colours and none", [plain, las(records(positions, 7, random), 7)], [MIXED]
    yield "extra bytes and none", [plain, las(np.concatenate([rows, rows[:, :2]], axis=1), 6)], [MIXED]
    yield "offsets too far apart for int32", [plain, las(rows, 6, offset=(1e9, 0, 0))], [MIXED]
    yield "a scale that goes into no other", [plain, las(rows, 6, scale=(0.0031, 0.01, 0.01))], None
    yield "a finer scale", [plain, las(rows, 6, scale=(0.001,) * 3)], None
    yield "an offset between the steps", [plain, las(rows, 6, offset=(0.005, 0, 0))], None
    yield "one scan good, one cut", [plain, plain[:-1]], [TRUNCATED]
    yield "one scan good, one empty", [plain, patched(plain, COUNT, "Q", 0)], [EMPTY]


def main(folder):
    random = np.random.default_rng(1859)
    positions = random.integers(0, 10_000, (2000, 3))
    wkt = vlr(b"LASF_Projection", 2112, b'LOCAL_CS["somewhere"]\0')
    extra = struct.pack("<HBB32s4s24s24s24s24s24s32s", 0, 3, 24, b"strange", *(b"",) * 6, b"")
    three = las(records(positions, 3, random), 3)
    seven = las(records(positions, 7, random), 7, vlrs=[wkt])
    wide = np.concatenate([records(positions, 6, random), records(positions, 0, random)[:, 12:14]], axis=1)
    six = las(wide, 6, vlrs=[vlr(b"LASF_Spec", 4, extra)])
    files = {
        "LAS of format 3": three[: points_at(three) + 400 * 34],
        "LAZ of format 3": laz(three, 500),
        "LAZ of format 7": laz(seven, 500),
        "LAS of format 6": six,
        "LAZ of format 6": laz(six, 500),
    }
    files["LAS of format 3"] = patched(files["LAS of format 3"], COUNT_LEGACY, "I", 400)
    cases = []
    single = (wrong_headers(three, seven), wrong_laz(seven), cut(files), flipped(files, random))
    several = mixed(positions, random)
    for name, data, codes in itertools.chain(*single, several):
        inputs = []
        for part in [data] if isinstance(data, bytes) else data:
            inputs.append(str(Path(folder) / f"lie-{len(cases)}-{len(inputs)}.las"))
            Path(inputs[-1]).write_bytes(part)
        cases.append({"name": name, "inputs": inputs, "codes": codes})
    json.dump(cases, sys.stdout)


if __name__ == "__main__":
    main(sys.argv[1])
