# SPDX-License-Identifier: Apache-2.0
"""Splines of tables, and NURBS curves and surfaces of control points."""
from __future__ import annotations

import ctypes as C
import json
import os
import pathlib
from typing import Any, List, Mapping, NamedTuple, Optional, Sequence, Union

import numpy.typing as npt

from ._library import ErrorStruct, Run, lib, options_text, raise_error, taken_text, watched_of
from .contour import taken_files, write_all
from .errors import UsageError
from .jobs import Source, read, read_text
from .reports import Json, numbers_of
from .surfaces import Surface

#: A file, what `read` and `read_text` return, columns by their names, or rows of numbers.
TableLike = Union[Source, str, "os.PathLike[str]", Mapping[str, npt.ArrayLike], npt.ArrayLike]


def _cells(value: object) -> str:
    return "" if value is None else repr(float(value))  # type: ignore[arg-type]


def _table(given: TableLike, names: Sequence[str]) -> Source:
    """Columns of other lengths end with empty cells: the last row has no integral."""
    if isinstance(given, Source):
        return given
    if isinstance(given, (str, os.PathLike)):
        return read(given)
    if isinstance(given, Mapping):
        head: Sequence[str] = [str(name) for name in given]
        columns = [numbers_of(column).tolist() for column in given.values()]
        count = max((len(column) for column in columns), default=0)
        rows = [[column[i] if i < len(column) else None for column in columns] for i in range(count)]
    else:
        array = numbers_of(given)
        if array.ndim != 2 or not 2 <= array.shape[1] <= len(names):
            raise UsageError(203, f"rows of 2 to {len(names)} numbers are expected", "table")
        head, rows = names[: array.shape[1]], array.tolist()
    lines = [",".join(head), *(",".join(map(_cells, row)) for row in rows)]
    return read_text("\n".join(lines) + "\n", "table")


class _Made(NamedTuple):
    surface: Optional[Surface]
    files: Optional[Any]
    report: Json


def _call(function: Any, inputs: Sequence[Any], options: Mapping[str, Any], ending: Optional[str],
          watched: Mapping[str, Any]) -> _Made:
    text = options_text({name.replace("_", "-"): value for name, value in options.items()})
    surface, files, said = C.c_void_p(), C.c_void_p(), C.c_void_p()
    error = C.POINTER(ErrorStruct)()
    with Run(**watched) as run:
        if function(*inputs, text, None if ending is None else ending.encode(), run, C.byref(surface),
                    C.byref(files), C.byref(said), C.byref(error)):
            raise raise_error(error)
    report = json.loads(taken_text(said) or "{}")
    patch = None if surface.value is None else Surface(surface.value, {"kind": "graph", **report})
    return _Made(patch, taken_files(files) if files.value else None, report)


class Spline:
    """An integro-differential spline of a table, or a NURBS curve or surface of control points."""

    __slots__ = ("report", "surface", "_function", "_inputs", "_sources", "_options")

    def __init__(self, function: Any, sources: Sequence[Optional[Source]], options: Mapping[str, Any],
                 watched: Mapping[str, Any]) -> None:
        self._function, self._sources, self._options = function, sources, options
        self._inputs = [None if one is None else one._handle for one in sources]
        made = _call(function, self._inputs, options, None, watched)
        self.report: Json = made.report  #: as of `obvid spline --json`, `obvid nurbs --json`
        #: of functions of two variables the graph, of nets the surface; else None
        self.surface: Optional[Surface] = made.surface

    def text(self, ending: str) -> str:
        """A file: "csv", "json", "svg", "dxf"; of control points "csv", "json", "dxf", "step", "iges",
        "brep". Formed anew with every call."""
        made = _call(self._function, self._inputs, self._options, ending, {})
        assert made.files is not None
        return str(made.files[0][0][1].decode())

    def write(self, path: Union[str, "os.PathLike[str]"]) -> List[str]:
        """Writes a file by its extension; surfaces in all their formats (`Surface.write`)."""
        target = pathlib.Path(path)
        ending = target.suffix.lower().lstrip(".")
        if self.surface is not None and ending not in ("csv", "json"):
            return self.surface.write(path)
        return write_all(target, ([("", self.text(ending).encode())], ()))


def spline(table: TableLike, against: Optional[TableLike] = None, **options: Any) -> Spline:
    """A spline of even degree that keeps values, derivatives and the integral over every cell: of a
    function (columns x and f; integral over the cell that a row begins, slope, second), of a curve
    (`curve=True`: x, y, z) or of a function of two variables (x, y and f). `against`: more of the same,
    by which errors are measured. Options as of `obvid spline`: degree, smooth, compare, tolerance,
    samples; progress, cancelled.

    >>> import obvid
    >>> made = obvid.spline({"x": [0, 1, 2], "f": [0, 1, 0]}, {"x": [0.5, 1.5], "f": [0.75, 0.5]})
    >>> made.report["rows"][0]["largest_error"]
    0.25
    """
    watched = watched_of(options)
    names = ("x", "y", "z") if options.get("curve") else ("x", "f")
    more = None if against is None else _table(against, names)
    return Spline(lib.obvid_spline, [_table(table, names), more], options, watched)


def _by_point(given: Any) -> Any:
    """Points count from 0, and from the end below 0 they do not."""
    if isinstance(given, Mapping):
        return {str(int(point) + 1): value for point, value in given.items()}
    return given


def nurbs(points: TableLike, **options: Any) -> Spline:
    """A NURBS curve of control points (x, y, z, w), or the surface of a net (columns row and col too).
    Options as of `obvid nurbs`: degree, degree_v, knots, knots_v, weight_at and move ({point from 0:
    value}), units, samples; progress, cancelled.

    >>> import obvid
    >>> made = obvid.nurbs([(0, 0), (1, 2), (3, 3), (5, 3), (7, 2), (8, 0)], move={3: 0.8})
    >>> made.report["degree"], round(made.report["rows_of_weights"][3]["b"], 12)
    (3, 0.8)
    """
    watched = watched_of(options)
    for name in ("knots", "knots_v"):
        if options.get(name) is not None and not isinstance(options[name], str):
            options[name] = ",".join(repr(float(one)) for one in options[name])
    for name in ("weight_at", "move"):
        options[name] = _by_point(options.get(name))
    return Spline(lib.obvid_nurbs_make, [_table(points, ("x", "y", "z", "w"))], options, watched)
