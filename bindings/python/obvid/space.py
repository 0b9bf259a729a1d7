# SPDX-License-Identifier: Apache-2.0
"""Curves in space: evaluation, corners, files."""
from __future__ import annotations

import ctypes as C
import json
import os
import pathlib
from typing import Any, Dict, List, NamedTuple, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._library import ErrorStruct, Run, lib, raise_error, taken_text
from .contour import exported, only_text, write_all
from .errors import NotProvedError
from .reports import Array, Json

Places = npt.ArrayLike


class SpaceSamples(NamedTuple):
    """Places along a curve in space."""

    s: Array  #: arc length from the start, units
    points: Array  #: n x 3, units
    tangent: Array  #: n x 3, of length 1
    curvature: Array  #: 1/units, 0 or more
    torsion: Array  #: 1/units, right-handed positive; nan where the curvature is 0


class Corner(NamedTuple):
    """Where two parts of a curve in space meet."""

    point: int  #: index of the point, from 0
    turn: float  #: angle between both tangents, rad


class SpaceVerification(NamedTuple):
    """Whether curves in space keep what their file says; `json` is all that was found."""

    holds: bool
    json: Json


class SpaceCurve:
    """A fair curve through points in space, or one for each part between corners: made by
    `fit_space`, `read_space` and `SpaceCurve.from_json`. May be read by several threads at once; can
    be pickled and copied.

    >>> import obvid
    >>> c = obvid.fit_space([(0, 0, 0), (10, 1, 1), (19, 4, 3), (26, 9, 6), (30, 16, 10)])
    >>> c
    <obvid.SpaceCurve: 1 part through 5 points, proved>
    >>> bool(abs(c.at_length(0.0)).max() < 1e-9)
    True
    """

    __slots__ = ("_handle", "_cache", "__weakref__")

    def __init__(self, handle: int) -> None:
        self._handle = handle
        self._cache: Dict[str, Any] = {}

    def __del__(self) -> None:
        handle, self._handle = getattr(self, "_handle", 0), 0
        if handle and lib is not None:
            lib.obvid_space_free(handle)

    def __repr__(self) -> str:
        parts = "1 part" if self.part_count == 1 else f"{self.part_count} parts"
        verdict = "proved" if self.proved else "not proved"
        return f"<obvid.SpaceCurve: {parts} through {len(self.points)} points, {verdict}>"

    @property
    def part_count(self) -> int:
        return int(lib.obvid_space_parts(self._handle))

    @property
    def closed(self) -> bool:
        return bool(lib.obvid_space_closed(self._handle))

    @property
    def part_lengths(self) -> Array:
        """Arc length of each part, units."""
        if "lengths" not in self._cache:
            self._cache["lengths"] = np.array(
                [lib.obvid_space_length(self._handle, k) for k in range(self.part_count)]
            )
        lengths: Array = self._cache["lengths"]
        return lengths.copy()

    @property
    def length(self) -> float:
        """Arc length of all parts, units."""
        return float(self.part_lengths.sum())

    def to_dict(self) -> Json:
        """The file (docs/formats.md) as a dictionary."""
        if "file" not in self._cache:
            self._cache["file"] = json.loads(self.text("json"))
        return dict(self._cache["file"])

    @property
    def parts(self) -> List[Json]:
        """Each part as its file has it."""
        file = self.to_dict()
        return list(file.get("parts", [file]))

    @property
    def corners(self) -> Tuple[Corner, ...]:
        return tuple(Corner(c["point"], c["turn"]) for c in self.to_dict().get("corners", ()))

    @property
    def units(self) -> str:
        return str(self.to_dict()["units"])

    @property
    def points(self) -> Array:
        """Points of the series, n x 3."""
        return np.array(self.to_dict()["points"], dtype=float).reshape(-1, 3)

    @property
    def proved(self) -> bool:
        """Whether the contours of all parts are proved."""
        contours = [
            part[name]
            for part in self.parts
            for name in ("contour", "projection", "heights")
            if name in part
        ]
        return all(one["certificate"]["proved"] for one in contours)

    @property
    def warnings(self) -> Tuple[str, ...]:
        """What was to be warned of when the curve was formed; none of one that was read."""
        out: List[str] = []
        while (one := lib.obvid_space_warning(self._handle, len(out))) is not None:
            out.append(one.decode())
        return tuple(out)

    # ---- evaluation ---------------------------------------------------------------------------

    def _evaluate(self, part: int, s: Array) -> SpaceSamples:
        places = np.ascontiguousarray(s, dtype=float)
        n = places.size
        points, tangent = np.empty((n, 3)), np.empty((n, 3))
        curvature, torsion = np.empty(n), np.empty(n)
        error = C.POINTER(ErrorStruct)()
        code = lib.obvid_space_evaluate(
            self._handle,
            part,
            places.ctypes.data,
            n,
            points.ctypes.data,
            tangent.ctypes.data,
            curvature.ctypes.data,
            torsion.ctypes.data,
            C.byref(error),
        )
        if code:
            raise raise_error(error)
        return SpaceSamples(places, points, tangent, curvature, torsion)

    def evaluate(self, s: Places) -> SpaceSamples:
        """All there is to know at arc lengths from the start; in a corner of the part behind it."""
        places = np.atleast_1d(np.asarray(s, dtype=float)).ravel()
        lengths = self.part_lengths
        starts = np.concatenate([[0.0], np.cumsum(lengths)[:-1]])
        if places.size and not (places.min() >= 0.0 and places.max() <= self.length):
            raise ValueError(f"arc lengths lie between 0 and {self.length}")
        part = np.clip(np.searchsorted(starts, places, side="right") - 1, 0, len(lengths) - 1)
        n = places.size
        out = SpaceSamples(places, np.empty((n, 3)), np.empty((n, 3)), np.empty(n), np.empty(n))
        for k in range(len(lengths)):
            own = part == k
            if not own.any():
                continue
            found = self._evaluate(k, np.clip(places[own] - starts[k], 0.0, lengths[k]))
            for to, values in zip(out[1:], found[1:]):
                to[own] = values
        return out

    def at_length(self, s: Places) -> Array:
        """Points at arc lengths from the start, shape of `s` plus 3."""
        return self.evaluate(s).points.reshape(np.shape(s) + (3,))

    def sample(self, n: int) -> SpaceSamples:
        """`n` places at equal steps of arc length, both ends included."""
        if n < 2:
            raise ValueError("at least 2 samples are needed")
        return self.evaluate(np.minimum(np.linspace(0.0, self.length, n), self.length))

    # ---- files and proofs ---------------------------------------------------------------------

    def text(self, ending: str, **options: Any) -> str:
        """The curve in a text format, by its file extension: "json", "step", "dxf", "csv", ...

        Options are those of the program: output_tolerance, samples, step, units.
        """
        ending = ending.lstrip(".")
        return only_text(exported(lib.obvid_space_export, self._handle, ending, options))

    def write(self, path: Union[str, "os.PathLike[str]"], **options: Any) -> List[str]:
        """Writes the curve to a file whose extension determines the format; returns what is to be
        said of it. A format that joins points by one curve has a file for each part, NAME-1, ..."""
        target = pathlib.Path(path)
        ending = target.suffix.lstrip(".")
        return write_all(target, exported(lib.obvid_space_export, self._handle, ending, options))

    def verify(self) -> SpaceVerification:
        """Proves the curve again from its numbers alone."""
        out, error = C.c_void_p(), C.POINTER(ErrorStruct)()
        with Run(None, None) as run:
            code = lib.obvid_verify_space(self._handle, run, C.byref(out), C.byref(error))
        text = taken_text(out)
        if code:
            raised = raise_error(error)
            if not isinstance(raised, NotProvedError) or text is None:
                raise raised
        assert text is not None
        values = json.loads(text)
        return SpaceVerification(bool(values["holds"]), values)

    @classmethod
    def from_json(cls, text: Union[str, bytes]) -> "SpaceCurve":
        """The curve of a file in memory."""
        from .jobs import read_text

        return read_text(text, "curve.json").space_curve()

    def __reduce__(self) -> Any:
        return SpaceCurve.from_json, (self.text("json"),)


__all__ = ["Corner", "SpaceCurve", "SpaceSamples", "SpaceVerification"]
