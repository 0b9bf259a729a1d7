# SPDX-License-Identifier: Apache-2.0
"""Half a unit of the last printed digit of a file, found from its text alone."""
import math
import re

WORD = re.compile(r"^[-+]?(\d*)\.?(\d*)(?:[eEdD]([-+]?\d+))?$")
SEPARATORS = re.compile(r"[\s,;]+")


def value_of(word):
    try:
        return float(word.replace("d", "e").replace("D", "e"))
    except ValueError:
        return None


def half_unit(words):
    """Of a column: the most decimals decide; with exponents the coarsest value of full mantissa."""
    parts = [WORD.match(word) for word in words]
    most = max((len(p.group(2)) for p in parts), default=0)
    full = [p for p in parts if len(p.group(2)) == most]
    return max((0.5 * 10.0 ** (int(p.group(3) or 0) - most) for p in full), default=0.0)


def printed_rounding(text, points):
    """Largest distance between a point and what was rounded to it. Rows count when their two
    numbers are a point of the series, so titles, counts and grid bounds do not."""
    wanted, columns = {tuple(p) for p in points}, ([], [])
    for line in text.splitlines():
        words = [w for w in SEPARATORS.split(line.strip()) if w]
        if len(words) < 2 or not all(WORD.match(w) for w in words[:2]):
            continue
        if (value_of(words[0]), value_of(words[1])) in wanted:
            columns[0].append(words[0])
            columns[1].append(words[1])
    return math.hypot(half_unit(columns[0]), half_unit(columns[1]))
