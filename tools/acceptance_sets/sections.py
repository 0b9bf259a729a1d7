# SPDX-License-Identifier: Apache-2.0
"""Blade sections and hull lines: NASA rotor 37, IEA 15 MW rotor, Series 60 table, hull grids."""
import csv

from . import tables
from .cases import Case, noise_case, number_rows, write_points

THETA_HALF_UNIT = 0.5e-7  # rad: rotor 37 prints angles with 7 decimals
LENGTH_HALF_UNIT = 0.5e-7  # cm: likewise radii and axial places
# The IEA coordinates print 15 digits of an interpolation to 200 points between coordinates that
# were published with fewer; 1e-5 chord is 0.05 mm on the largest chord (5.8 m).
IEA_TOLERANCE = 1e-5
SERIES60_HALF_UNIT = 0.0005  # of the largest half-breadth of a waterline: 3 decimals
# Series 60, parent of block coefficient 0.80: length to beam 6.5, beam to draft 2.5. Lengths here
# are in half-beams.
SERIES60_LENGTH, SERIES60_DRAFT = 13.0, 0.8
GRIDS = ["Series60Offset", "TrawlerOffset", "wpb_offset_bottom", "wpb_offset_mid", "wpb_offset_top"]
# Grids come from a surface program, with 8 digits; 1e-5 of a half-breadth of metres is 0.01 to 0.1
# mm, which no yard measures.
GRID_TOLERANCE_OF_SIZE = 1e-5
FEWEST_POINTS = 4  # fewer leave nothing to choose


def cases(data, work, _options):
    found = [*rotor37(data, work), *iea15(data, work), *series60(data, work), *grids(data, work)]
    return found, []


def rotor37(data, work):
    """Each surface in the plane of axial place and arc length R theta; both sides are one closed
    outline, since they share leading and trailing edge."""
    path = data / "turbomachinery_nasa" / "rotor37geometry.dat"
    if not path.exists():
        return
    surfaces = []
    for row in number_rows(path, 5):
        if row[0] == 1:
            surfaces.append([])
        surfaces[-1].append(row[1:5])
    for i, rows in enumerate(surfaces, 1):
        round_trip = [(z, r, a) for z, r, a, _ in rows] + [(z, r, b) for z, r, _, b in rows[-2::-1]]
        points = [(z, r * theta) for z, r, theta in round_trip]
        tolerances = [r * THETA_HALF_UNIT + (1 + abs(theta)) * LENGTH_HALF_UNIT
                      for _, r, theta in round_trip]
        name = f"rotor37_surface_{i:02d}"
        write_points(work / (name + ".csv"), points, "NASA rotor 37: z, r theta in cm\n"
                     "tolerance: rounding of the printed digits", tolerances)
        yield Case(name, work / (name + ".csv"), [], max(tolerances), "NASA rotor 37 sections")


def iea15(data, _work):
    for path in sorted((data / "windturbine_iea15").glob("*_Coords.txt")):
        yield Case(path.stem, path, ["--noise", f"{IEA_TOLERANCE:g}"], IEA_TOLERANCE,
                   "IEA 15 MW sections")


def series60_table(path):
    """Waterline heights (fraction of the draft), station places (0 forward to 1), half-breadths by
    waterline, largest half-breadths."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    columns = range(1, len(rows[0]) - 1)  # the last one holds areas
    heights = [0.0 if rows[0][c] == "tan_line" else float(rows[0][c][3:]) for c in columns]
    largest = [float(rows[-1][c]) for c in columns]
    ends = {"FP": 0.0, "AP": 20.0}
    stations = [(ends[r[0]] if r[0] in ends else float(r[0])) / 20.0 for r in rows[1:-1]]
    values = [[float(r[c]) for r in rows[1:-1]] for c in columns]
    return heights, stations, values, largest


def series60(data, work):
    """Waterlines and stations, the dummies left out."""
    path = data / "hulls_offset_tables" / "series60_4214W-B4_table7.csv"
    if not path.exists():
        return
    heights, stations, values, largest = series60_table(path)
    for height, row, breadth in zip(heights, values, largest):
        kept = without_dummies(list(zip(stations, row)))
        points = [(s * SERIES60_LENGTH, v * breadth) for s, v in kept]
        if len(points) >= FEWEST_POINTS:
            yield noise_case(work, f"series60_waterline_{height:g}", points,
                             SERIES60_HALF_UNIT * breadth, "Series 60 4214W-B4 waterline",
                             group="Series 60 table")
    for j, station in enumerate(stations):
        if 0.0 < station < 1.0:  # stem and stern are not sections of the table
            points = [(values[k][j] * largest[k], height * SERIES60_DRAFT)
                      for k, height in enumerate(heights)]
            tolerances = [SERIES60_HALF_UNIT * b for b in largest]
            name = f"series60_station_{20 * station:g}"
            write_points(work / (name + ".csv"), points, "Series 60 4214W-B4 station",
                         tolerances)
            yield Case(name, work / (name + ".csv"), [], max(tolerances), "Series 60 table")


def without_dummies(row):
    """From the first to the last value that is not 0, and the 0 at the forward perpendicular, where
    the stem stands. Aft, the waterline ends at an unknown place before the 0."""
    values = [v != 0.0 for _, v in row]
    if not any(values):
        return []
    first, last = values.index(True), len(values) - 1 - values[::-1].index(True)
    return row[0 if first == 1 else first:last + 1]


def grids(data, work):
    """Each row of a grid is a station, taken in its own plane (they are not exactly planar at the
    stem: the abscissa is left out)."""
    for name in GRIDS:
        paths = [data / "hulls_grids" / f"{name}_{axis}.dat" for axis in "yz"]
        if not all(p.exists() for p in paths):
            continue
        ys, zs = (number_rows(p, 2) for p in paths)
        for i, (y, z) in enumerate(zip(ys, zs)):
            points = list(zip(y, z))
            size = max(max(y) - min(y), max(z) - min(z))
            if len(set(points)) >= FEWEST_POINTS:
                yield noise_case(work, f"{name}_{i:02d}", points, GRID_TOLERANCE_OF_SIZE * size,
                                 "hull grid, one station: y, z", group="hull stations")
    path = data / "hulls_grids" / "wpb_data_station_11.dat"
    if path.exists():
        points = [tuple(row[:2]) for row in number_rows(path, 2)]
        size = max(max(v) - min(v) for v in zip(*points))
        yield noise_case(work, path.stem, points, GRID_TOLERANCE_OF_SIZE * size,
                         "station of a patrol boat", group="hull stations")


def criteria(outcomes):
    found = []
    for group, members in tables.groups_of(outcomes).items():
        text, measured, ok = tables.all_proved(members)
        found.append((f"{group}: {text}", measured, ok))
    return found + tables.common_criteria(outcomes)
