"""Points of a projected CRS to ECEF by PROJ, in the steps that a PROJ string with +towgs84 stands for: the datum shift
leaves the height alone (push and pop of v_3), as it is in every operation of a 2D CRS.

Reads {"projection", "ellipsoid", "shift", "horizontal", "vertical", "points"} from stdin: the projection and the
ellipsoid as PROJ parameters, the shift as the numbers of +towgs84 (or null), metres per unit of plane and height, the
points in source units. Writes the ECEF coordinates, metres.
"""

import json
import sys

import pyproj

request = json.load(sys.stdin)
steps = [
    "+proj=pipeline",
    f"+step +inv {request['projection']} {request['ellipsoid']}",
    "+step +proj=push +v_3",
    f"+step +proj=cart {request['ellipsoid']}",
]
if request["shift"]:
    x, y, z, rx, ry, rz, s = (request["shift"] + [0] * 7)[:7]
    steps.append(
        f"+step +proj=helmert +x={x} +y={y} +z={z} +rx={rx} +ry={ry} +rz={rz} +s={s} +convention=position_vector"
    )
steps += ["+step +inv +proj=cart +ellps=WGS84", "+step +proj=pop +v_3", "+step +proj=cart +ellps=WGS84"]
pipeline = pyproj.Transformer.from_pipeline(" ".join(steps))
plane, height = request["horizontal"], request["vertical"]
x, y, z = zip(*request["points"])
ecef = pipeline.transform([v * plane for v in x], [v * plane for v in y], [v * height for v in z], errcheck=True)
json.dump([list(point) for point in zip(*ecef)], sys.stdout)
