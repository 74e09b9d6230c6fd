"""Holds an archive of cross-sections against an independent computation over all of the scan's points.

sections.py SCAN ZIP THICKNESS. Prints JSON: whether each section has just the records in its rectangle, byte for byte, each
once; points near an edge are decided by exact rationals. And what the list, LandXML and DXF say, read by programs that nobody
here wrote.
"""

import csv
import io
import json
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
import zipfile
from fractions import Fraction

import ezdxf
import laspy
import numpy as np

LANDXML = "{http://www.landxml.org/schema/LandXML-1.2}"

# What LandXML-1.2.xsd says of the elements that are written: attributes that they must have, others that they may have, and
# children in the order in which they are written, with the least and greatest number of each. The schema itself is no package of
# a registry; this is its content, read from classes that others generated from it.
UNITS = {"areaUnit", "linearUnit", "volumeUnit", "temperatureUnit", "pressureUnit"}
ANY = (0, None)
SCHEMA = {
    "LandXML": (
        {"version", "date", "time"},
        {"language", "readOnly"},
        {"Units": (1, 1), "CoordinateSystem": (0, 1), "Project": (0, 1), "Application": ANY, "Alignments": ANY},
    ),
    "Units": (set(), set(), {"Metric": (0, 1), "Imperial": (0, 1)}),
    "Metric": (UNITS, set(), {}),
    "Imperial": (UNITS, set(), {}),
    "CoordinateSystem": (set(), {"name", "desc", "epsgCode", "ogcWktCode"}, {}),
    "Project": ({"name"}, {"desc", "state"}, {}),
    "Application": ({"name"}, {"desc", "manufacturer", "version"}, {}),
    "Alignments": (set(), {"name", "desc", "state"}, {"Alignment": (1, None)}),
    "Alignment": (
        {"name", "length", "staStart"},
        {"desc", "oID", "state"},
        {"CoordGeom": (1, 1), "StaEquation": ANY, "Profile": ANY, "CrossSects": (0, 1)},
    ),
    "StaEquation": ({"staAhead", "staInternal"}, {"staBack", "staIncrement", "desc"}, {}),
    "CoordGeom": (set(), {"name", "desc", "state", "oID"}, {"Line": (1, None)}),
    "Line": (set(), {"desc", "dir", "length", "name", "staStart", "state", "oID", "note"}, {"Start": (1, 1), "End": (1, 1)}),
    "Start": (set(), set(), {}),
    "End": (set(), set(), {}),
    "Profile": (set(), {"name", "desc", "staStart", "state"}, {"ProfSurf": ANY}),
    "ProfSurf": ({"name"}, {"desc", "state"}, {"PntList2D": (1, None)}),
    "CrossSects": (set(), {"name", "desc", "state"}, {"CrossSect": ANY}),
    "CrossSect": ({"sta"}, {"name", "desc"}, {"CrossSectSurf": ANY}),
    "CrossSectSurf": ({"name"}, {"desc", "state"}, {"PntList2D": (1, None)}),
    "PntList2D": (set(), set(), {}),
}
WORDS = {
    "areaUnit": {"squareMeter", "hectare", "squareFoot", "acre"},
    "linearUnit": {"meter", "foot", "USSurveyFoot"},
    "volumeUnit": {"cubicMeter", "cubicFeet", "cubicYard"},
    "temperatureUnit": {"celsius", "kelvin", "fahrenheit"},
    "pressureUnit": {"milliBars", "HPA", "inHG", "inchHG"},
    "state": {"existing", "proposed"},
    "staIncrement": {"increasing", "decreasing"},
    "readOnly": {"true", "false"},
}
NUMBERS = {"length", "staStart", "sta", "staAhead", "staInternal", "staBack"}


def faults(element):
    """What of an element and its children the schema does not allow."""
    name = element.tag.removeprefix(LANDXML)
    required, optional, allowed = SCHEMA[name]
    given = {key for key in element.attrib if not key.startswith("{")}
    found = [f"{name} lacks {attribute}" for attribute in required - given]
    found += [f"{name} has no {attribute}" for attribute in given - required - optional]
    for key in given:
        if key in WORDS and element.get(key) not in WORDS[key]:
            found.append(f"{key} cannot be {element.get(key)}")
        if key in NUMBERS:
            float(element.get(key))
    if name in ("PntList2D", "Start", "End"):
        numbers = [float(word) for word in element.text.split()]
        if len(numbers) < 2 or len(numbers) % 2 != 0:
            found.append(f"{name} has {len(numbers)} numbers")
    children = [child.tag.removeprefix(LANDXML) for child in element]
    if any(child not in allowed for child in children) or children != sorted(children, key=list(allowed).index):
        found.append(f"{name} has {children}")
    for child, (least, most) in allowed.items():
        count = children.count(child)
        if count < least or (most is not None and count > most):
            found.append(f"{name} has {count} {child}")
    return found + [fault for child in element for fault in faults(child)]


def in_rectangle(x, y, a, b, thickness):
    """Which points lie in the rectangle around a segment: exactly where float64 leaves a doubt."""
    u = b - a
    square = u @ u
    along = (x - a[0]) * u[0] + (y - a[1]) * u[1]
    across = u[0] * (y - a[1]) - u[1] * (x - a[0])
    limit = thickness / 2 * np.sqrt(square)
    inside = (along >= 0) & (along <= square) & (np.abs(across) <= limit)
    near = 1e-7 * square
    doubt = (np.abs(along) < near) | (np.abs(along - square) < near) | (np.abs(np.abs(across) - limit) < near)
    doubt &= (along > -square) & (along < 2 * square) & (np.abs(across) < 2 * limit)
    ax, ay, bx, by, reach = (Fraction(float(value)) for value in (*a, *b, thickness / 2))
    ux, uy = bx - ax, by - ay
    for point in np.flatnonzero(doubt):
        px, py = Fraction(float(x[point])) - ax, Fraction(float(y[point])) - ay
        exact = ux * px + uy * py
        squared = ux * ux + uy * uy
        inside[point] = 0 <= exact <= squared and (ux * py - uy * px) ** 2 <= reach**2 * squared
    return inside, int(doubt.sum())


def records(array):
    """Records as bytes, sorted."""
    array = np.ascontiguousarray(array)
    return np.sort(array.view(np.dtype((np.void, array.dtype.itemsize))).ravel())


scan = laspy.read(sys.argv[1])
archive = zipfile.ZipFile(sys.argv[2])
thickness = float(sys.argv[3])
x = scan.X * scan.header.scales[0] + scan.header.offsets[0]
y = scan.Y * scan.header.scales[1] + scan.header.offsets[1]
z = scan.Z * scan.header.scales[2] + scan.header.offsets[2]
names = archive.namelist()
root = ElementTree.fromstring(archive.read("sections.xml"))
sections = root.findall(f".//{LANDXML}CrossSect")
rows = list(csv.DictReader(io.StringIO(archive.read("sections.csv").decode())))
same, doubtful, points, grounds, drawn = True, 0, 0, True, True
for row, section in zip(rows, sections, strict=True):
    a = np.array([float(row["left_x"]), float(row["left_y"])])
    b = np.array([float(row["right_x"]), float(row["right_y"])])
    inside, doubt = in_rectangle(x, y, a, b, thickness)
    doubtful += doubt
    count = int(inside.sum())
    points += count
    same &= count == int(row["points"]) and abs(float(section.get("sta")) - float(row["chainage"])) < 1e-5
    stem = f"section-{row['section']}_{row['station']}"
    if count == 0:
        same &= not any(name.startswith(stem) for name in names)
        continue
    cut = laspy.read(io.BytesIO(archive.read(f"{stem}.las")))
    same &= np.array_equal(records(cut.points.array), records(scan.points.array[inside]))
    # The ground: percentile 10 of the heights within half a metre of each metre across.
    left = np.hypot(*(a - np.array([float(row["x"]), float(row["y"])])))
    u = (b - a) / np.hypot(*(b - a))
    across = (x[inside] - a[0]) * u[0] + (y[inside] - a[1]) * u[1]
    bins = np.floor(across + 0.5)
    expected = {number: np.percentile(z[inside][bins == number], 10) for number in np.unique(bins)}
    told = {}
    for run in section.iter(f"{LANDXML}PntList2D"):
        numbers = np.array([float(word) for word in run.text.split()]).reshape(-1, 2)
        told |= {round(distance + left): height for distance, height in numbers}
    grounds &= all(abs(expected[number] - height) < 1e-5 for number, height in told.items())
    grounds &= len(expected) - len(told) <= len(expected) / 4
    if int(row["section"]) % 10 == 1:
        with tempfile.NamedTemporaryFile("wb", suffix=".dxf") as file:
            file.write(archive.read(f"{stem}.dxf"))
            file.flush()
            drawing = ezdxf.readfile(file.name)
        places = np.array([point.dxf.location for point in drawing.modelspace().query("POINT")])
        found = places
        drawn &= not drawing.audit().errors and len(places) == count
        drawn &= bool(np.allclose(np.sort(found[:, 0]), np.sort(across) - left, atol=2e-5))
        drawn &= bool(np.allclose(np.sort(found[:, 1]), np.sort(z[inside]), atol=1e-6))
print(
    json.dumps(
        {
            "sections": len(rows),
            "points": points,
            "same": bool(same),
            "doubtful": doubtful,
            "faults": faults(root),
            "grounds": bool(grounds),
            "drawn": bool(drawn),
        }
    )
)
