# SPDX-License-Identifier: Apache-2.0
"""Race tracks: TUM centre and race lines, Formula 1 circuits, the Adria chain of lines and arcs."""
import json
import math

from . import matching, tables
from .cases import Case, noise_case, number_rows, write_points

CENTRE_TOLERANCE = 0.5  # m: centre lines smoothed from satellite positions and maps
RACELINE_TOLERANCE = 0.1  # m: computed lines, spaced 5 m, minimal curvature on the centre lines
EXACT_TOLERANCE = 1e-3  # m: computed outlines
# m: circuits clicked by hand on aerial pictures; 6 decimals of a degree are 0.1 m, a click is not.
F1_TOLERANCE = 3.0
ADRIA_TOLERANCE, ADRIA_STEP = 0.01, 5.0  # m
WGS84_A, WGS84_F = 6378137.0, 1 / 298.257223563


def cases(data, work, _options):
    return [*tum(data, work), *f1(data, work), *adria(data, work)], []


def tum(data, work):
    exact = ("handling_track", "rounded_rectangle")
    for path in sorted((data / "tracks_tum").glob("*.csv")):
        if path.stem == "clothoids_Adria_lines_arcs":  # a list of elements, not of points
            continue
        tolerance = (EXACT_TOLERANCE if path.stem in exact else
                     RACELINE_TOLERANCE if path.stem.startswith("raceline") else CENTRE_TOLERANCE)
        options = ["--closed"] + (["--primitives"] if path.stem in exact else [])
        points = [tuple(row[:2]) for row in number_rows(path, 2)]
        yield noise_case(work, path.stem, points, tolerance, "track " + path.name, options,
                         group="TUM tracks")


def to_metres(coordinates):
    """Local plane: degrees times the radii of curvature of the ellipsoid at the middle latitude.
    Over the 3 km of a circuit the meridians' convergence changes lengths by less than 1e-4."""
    lon0 = sum(c[0] for c in coordinates) / len(coordinates)
    lat0 = sum(c[1] for c in coordinates) / len(coordinates)
    e2, sine = WGS84_F * (2 - WGS84_F), math.sin(math.radians(lat0))
    prime = WGS84_A / math.sqrt(1 - e2 * sine * sine)
    meridian = prime * (1 - e2) / (1 - e2 * sine * sine)
    return [(math.radians(lon - lon0) * prime * math.cos(math.radians(lat0)),
             math.radians(lat - lat0) * meridian) for lon, lat in coordinates]


def f1(data, work):
    for path in sorted((data / "tracks_f1_geojson").glob("*.geojson")):
        feature = json.loads(path.read_text(encoding="utf-8"))["features"][0]
        points = to_metres([c[:2] for c in feature["geometry"]["coordinates"]])
        yield noise_case(work, path.stem, points, F1_TOLERANCE, "circuit, lon/lat to metres",
                         ["--closed"], group="F1 circuits")


def adria(data, work):
    """The chain does not close (its sizes are rounded), so it is sampled as an open road."""
    path = data / "tracks_tum" / "clothoids_Adria_lines_arcs.csv"
    if not path.exists():
        return
    pieces, start = [], (0j, 0.0)
    for length, kappa in number_rows(path, 2):
        pieces.append(matching.TruePiece(len(pieces), start[0], start[1], length, kappa, kappa))
        start = pieces[-1].end()
    truth = matching.sampled_truth(pieces, ADRIA_STEP, ADRIA_TOLERANCE)
    write_points(work / "adria.csv", truth["points"], "Adria, lines and arcs every 5 m")
    yield Case("adria", work / "adria.csv", ["--noise", f"{ADRIA_TOLERANCE:g}", "--primitives"],
               ADRIA_TOLERANCE, "Adria, lines and arcs", truth, matching.matched)


def details(outcomes):
    rows = [row for row in matching.table_rows(outcomes)]
    return tables.markdown(matching.COLUMNS, rows) if rows else ""


def criteria(outcomes):
    found = []
    for group, members in tables.groups_of(outcomes).items():
        text, measured, ok = tables.all_proved(members)
        found.append((f"{group}: {text}", measured, ok))
    if any("matched" in o for o in outcomes):
        found.append(matching.criterion(outcomes))
    return found + tables.common_criteria(outcomes)
