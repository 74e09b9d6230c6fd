"""Writes scans of every point format, as LAS and compressed by LASzip itself: `chunks.py FOLDER`.

Standard output: [{ name, las, laz }, ...], each LAZ of one chunk. Deterministic.
"""

import json
import sys
from pathlib import Path

import laspy
from generate import SOME, scan

folder, cases = Path(sys.argv[1]), []
for point_format in range(11):
    for extra in ([], SOME):
        las = scan(point_format, 100 + point_format, extra=extra)
        name = f"{point_format}-{len(extra)}"
        paths = {kind: str(folder / f"{name}.{kind}") for kind in ("las", "laz")}
        las.write(paths["las"])
        las.write(paths["laz"], laz_backend=laspy.LazBackend.Laszip)
        cases.append({"name": f"format {point_format} with {len(extra)} extra fields", **paths})
print(json.dumps(cases))
