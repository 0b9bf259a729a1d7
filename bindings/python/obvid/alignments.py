# SPDX-License-Identifier: Apache-2.0
"""Roads, rails and pipes: few lines, arcs and clothoids, and a vertical profile."""
from __future__ import annotations

import ctypes as C
import json
from typing import Any, Dict, NamedTuple, Optional, Tuple

from ._library import ErrorStruct, Run, lib, options_text, raise_error, taken_text, watched_of
from .contour import Contour, taken_files
from .jobs import Points, Source, _source, read_text
from .reports import Json, numbers_of


_TABLES = {".csv": "elements", ".deviations.csv": "deviations", ".profile.csv": "profile"}


class Alignment(NamedTuple):
    """Elements through points, and what was told of them."""

    contour: Contour  #: the plan; LandXML and OpenDRIVE have its stations and its profile
    report: Json  #: elements, offsets, profile; docs/schema/alignment.schema.json
    tables: Dict[str, str]  #: CSV: "elements", "deviations", "profile" where there are heights
    picture: str  #: SVG: curve, curvature, speed and heights over the station
    remarks: Tuple[str, ...]  #: how tolerances were estimated


def _with_heights(points: Points) -> Source:
    """n x 3 numbers have heights."""
    if isinstance(points, (Source, str)) or hasattr(points, "__fspath__"):
        return _source(points)
    array = numbers_of(points)
    if array.ndim != 2 or array.shape[1] != 3:
        return _source(points)
    rows = [f"{x!r},{y!r},{z!r}" for x, y, z in array.tolist()]
    return read_text("\n".join(["x,y,z", *rows]) + "\n", "points")


def alignment(points: Points, heights: Optional[Points] = None, **options: Any) -> Alignment:
    """Few lines, arcs and clothoids within a tolerance. Options as of `obvid alignment`: noise,
    closed, open, min_length, min_radius, joints, transitions, station, lateral_acceleration, profile_noise, profile_curves,
    min_vertical_length, units, ...; progress, cancelled. `heights`: stations and heights; without them
    the third numbers of points or a column z of a file are heights.

    >>> import numpy as np, obvid
    >>> s = np.linspace(0, 1.2, 25)
    >>> bend = [(x, 0) for x in range(-100, 0, 5)] + list(zip(100 * np.sin(s), 100 - 100 * np.cos(s)))
    >>> made = obvid.alignment(bend, noise=0.001, units="m")
    >>> [one["kind"] for one in made.report["elements"]]
    ['line', 'arc']
    >>> round(1 / made.report["elements"][1]["curvature_start"], 1)
    100.0
    """
    watched = watched_of(options)
    source = _with_heights(points)
    levels = None if heights is None else _source(heights)
    text = options_text({name.replace("_", "-"): value for name, value in options.items()})
    contour, files, said = C.c_void_p(), C.c_void_p(), C.c_void_p()
    error = C.POINTER(ErrorStruct)()
    with Run(**watched) as run:
        if lib.obvid_alignment(
            source._handle,
            None if levels is None else levels._handle,
            text,
            run,
            C.byref(contour),
            C.byref(files),
            C.byref(said),
            C.byref(error),
        ):
            raise raise_error(error)
    report = json.loads(taken_text(said) or "{}")
    made, remarks = taken_files(files)
    texts = {suffix: data.decode() for suffix, data in made}
    picture = texts.pop(".svg")
    tables = {name: texts[suffix] for suffix, name in _TABLES.items() if suffix in texts}
    assert contour.value is not None
    return Alignment(Contour(contour.value), report, tables, picture, remarks)
