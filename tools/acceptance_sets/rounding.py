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


def padding(word):
    """Zeros at the end of a fraction; as many also where the last digit misses them by one, as
    single precision prints them. None where only zeros stand."""
    fraction = WORD.match(word).group(2)
    if not fraction.strip("0"):
        return None
    for last, before in (("1", "0"), ("9", "9")):
        rest = fraction[:-1].rstrip(before)
        if fraction.endswith(last) and len(fraction) - len(rest) > 1:
            return len(fraction) - len(rest)
    return len(fraction) - len(fraction.rstrip("0"))


def common_padding(columns):
    """Zeros that end every number of both columns mean nothing when rounded numbers stand before
    them: at least 10 numbers, the longest of at least 4 digits."""
    words = [word for column in columns for word in column]
    if any(WORD.match(word).group(3) for word in words):
        return 0
    found = [p for p in map(padding, words) if p is not None]
    pad = min(found, default=0)
    longest = max((len(WORD.match(word).group(2)) for word in words), default=0) - pad
    return pad if len(found) >= 10 and longest >= 4 else 0


def half_unit(words, pad):
    """Of a column: the most decimals decide; with exponents the coarsest value of full mantissa."""
    parts = [WORD.match(word) for word in words]
    most = max((len(p.group(2)) for p in parts), default=0)
    full = [p for p in parts if len(p.group(2)) == most]
    return max((0.5 * 10.0 ** (int(p.group(3) or 0) - most + pad) for p in full), default=0.0)


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
    pad = common_padding(columns)
    return math.hypot(half_unit(columns[0], pad), half_unit(columns[1], pad))
