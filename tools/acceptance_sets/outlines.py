# SPDX-License-Identifier: Apache-2.0
"""Digitised outlines: bottles and other silhouettes on the pixel grid, mosquito wings."""

from . import tables
from .cases import noise_case, number_rows

# A point rounded to the pixel grid is at most half a diagonal of a pixel off; the issue allows 1.
PIXEL_TOLERANCE = 0.707  # half the diagonal
# Wings are given in units of their own size, not in pixels.
WING_TOLERANCE = 0.005
GROUPS = [("bottles", "bot", PIXEL_TOLERANCE), ("silhouettes", "shapes", PIXEL_TOLERANCE),
          ("mosquito wings", "mosquito", WING_TOLERANCE)]
HAND_GRID = 0.0254  # the coordinates of the hand are multiples of this


def cases(data, work, _options):
    found = []
    for group, folder, tolerance in GROUPS:
        for path in sorted((data / "outlines_momocs" / folder).glob("*.csv")):
            points = [tuple(row[:2]) for row in number_rows(path, 2)]
            found.append(noise_case(work, f"{folder}_{path.stem}", points, tolerance,
                                    "outline " + path.name, ["--closed"], group=group))
    hand = data / "hulls_grids" / "hand.dat"
    if hand.exists():  # open at the wrist
        points = [tuple(row[:2]) for row in number_rows(hand, 2)]
        found.append(noise_case(work, "hand", points, PIXEL_TOLERANCE * HAND_GRID,
                                "outline of a hand", ["--open"], group="hand"))
    return found, []


def criteria(outcomes):
    closed = [o for o in outcomes if "closed" in o and o["group"] != "hand"]
    return [tables.all_proved(outcomes),
            ("closed", f"{sum(o['closed'] for o in closed)} of {len(closed)}",
             all(o["closed"] for o in closed))] + tables.common_criteria(outcomes)
