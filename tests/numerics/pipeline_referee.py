"""Points through a PROJ pipeline, grids taken from a folder.

Reads {"pipeline", "grids", "points"} from stdin and writes the points that PROJ gives; null where it gives none.
"""

import json
import math
import sys

import pyproj

request = json.load(sys.stdin)
pyproj.datadir.append_data_dir(request["grids"])
pipeline = pyproj.Transformer.from_pipeline(request["pipeline"])
points = zip(*pipeline.transform(*zip(*request["points"])))
json.dump([list(point) if all(map(math.isfinite, point)) else None for point in points], sys.stdout)
