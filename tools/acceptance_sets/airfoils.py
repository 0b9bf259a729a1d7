# SPDX-License-Identifier: Apache-2.0
"""Public airfoils with the rounding of their printed digits as tolerance."""
from . import tables
from .cases import Case

GROUPS = [("UIUC airfoils", "airfoils_uiuc_selig/*.dat"),
          ("further airfoils", "airfoils_aerosandbox/*.dat"),
          ("Lednicer, OpenVSP", "airfoils_other_formats/*")]


def cases(data, _work, _options):
    found = []
    for group, pattern in GROUPS:
        for path in sorted(data.glob(pattern)):
            found.append(Case(path.name, path, ["--noise", "rounding"], None, group))
    return found, []


def criteria(outcomes):
    fitted = [o for o in outcomes if "vertices" in o]
    explained = [o for o in outcomes if o["exit"] == 4 and o["error"]]
    proved = tables.percent(o["exit"] == 0 for o in outcomes)
    least = tables.percent(o["vertices"] == o["bound"] for o in fitted)
    seconds = [o["seconds"] for o in fitted]
    return [
        ("proved, at least 99.5 %", f"{proved:.2f} %", proved >= 99.5),
        ("the others explained (exit code 4)", f"{len(explained)} of "
         f"{sum(o['exit'] != 0 for o in outcomes)}",
         all(o["exit"] in (0, 4) and (o["exit"] == 0 or o["error"]) for o in outcomes)),
        ("median of the vertices, at most 4", f"{tables.median(o['vertices'] for o in fitted):g}",
         tables.median(o["vertices"] for o in fitted) <= 4),
        ("vertices = lower bound, at least 70 %", f"{least:.1f} %", least >= 70),
        ("median time, at most 25 ms", f"{1e3 * tables.median(seconds):.1f} ms",
         tables.median(seconds) <= 0.025),
        ("longest time, at most 1 s", f"{max(seconds, default=0):.2f} s",
         max(seconds, default=0) <= 1),
    ] + tables.common_criteria(outcomes)
