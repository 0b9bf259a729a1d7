# SPDX-License-Identifier: Apache-2.0
"""Outlines of drawings as one program for a mill, a laser or a torch."""
from __future__ import annotations

import ctypes as C
import json
import os
import pathlib
from typing import Any, List, NamedTuple, Sequence, Tuple, Union

from ._library import ErrorStruct, Run, lib, options_text, raise_error, taken_text, watched_of
from .contour import Contour, taken_files, write_all
from .errors import UsageError
from .jobs import Source, read, read_text
from .reports import Json

Drawing = Union[Source, Contour, str, "os.PathLike[str]"]


class CutProgram(NamedTuple):
    """A program that was read back, and how it looks."""

    program: str  #: G-code
    picture: str  #: SVG
    drawing: str  #: DXF of outlines, paths, edges of the cut and rapid moves
    report: Json  #: outlines in the order of cutting, figures; docs/schema/cut.schema.json
    remarks: Tuple[str, ...]
    table: str  #: CSV of the outlines

    def write(self, path: Union[str, "os.PathLike[str]"]) -> List[str]:
        """Writes .svg the picture, .dxf the drawing, .csv the table, .nc, .ngc, .gcode or .tap the program."""
        target = pathlib.Path(path)
        programs = dict.fromkeys((".nc", ".ngc", ".gcode", ".tap"), self.program)
        others = {".svg": self.picture, ".dxf": self.drawing, ".csv": self.table}
        text = {**others, **programs}.get(target.suffix.lower())
        if text is None:
            raise UsageError(202, "there is no such file of a cut", str(path))
        return write_all(target, ([("", text.encode())], self.remarks))


def _source(drawing: Drawing) -> Source:
    if isinstance(drawing, Source):
        return drawing
    return read_text(drawing.text("json"), "contour") if isinstance(drawing, Contour) else read(drawing)


def cut(drawings: Union[Drawing, Sequence[Drawing]], **options: Any) -> CutProgram:
    """Every curve of drawings and contour files in one program. Options as of `obvid cut`: diameter,
    depth, pass_depth, side, laser, plasma, lead_in, tabs, ramp, feed, controller, motion, curve, ...;
    progress, cancelled. Lengths in units of the drawing.

    >>> import obvid
    >>> plate = obvid.read_text('<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="30mm" '
    ...     'viewBox="0 0 40 30"><rect width="40" height="30"/><circle cx="20" cy="15" r="8"/></svg>')
    >>> made = obvid.cut(plate, diameter=3, depth=5)
    >>> [(one["side"], round(one["length"], 2)) for one in made.report["outlines"]]
    [('inside', 40.84), ('outside', 149.42)]
    >>> made.report["report"]["beyond"] <= 0.01
    True
    """
    watched = watched_of(options)
    alone = isinstance(drawings, (Source, Contour, str, os.PathLike))
    given: Sequence[Drawing] = [drawings] if alone else drawings  # type: ignore[list-item,assignment]
    sources = [_source(one) for one in given]
    handles = (C.c_void_p * len(sources))(*(one._handle for one in sources))
    start = options.get("start")
    if start is not None and not isinstance(start, str):
        options["start"] = ",".join(repr(float(v)) for v in start)
    text = options_text({name.replace("_", "-"): value for name, value in options.items()})
    files, said, error = C.c_void_p(), C.c_void_p(), C.POINTER(ErrorStruct)()
    with Run(**watched) as run:
        if lib.obvid_cut(
            handles, len(sources), text, run, C.byref(files), C.byref(said), C.byref(error)
        ):
            raise raise_error(error)
    report = json.loads(taken_text(said) or "{}")
    made, remarks = taken_files(files)
    program, picture, drawing, table = (data.decode() for _, data in made)
    return CutProgram(program, picture, drawing, report, remarks, table)
