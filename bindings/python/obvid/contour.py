# SPDX-License-Identifier: Apache-2.0
"""Contours: evaluation, sampling, reports, files."""
from __future__ import annotations

import ctypes as C
import json
import os
import pathlib
from typing import Any, Dict, List, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._library import ErrorStruct, NurbsStruct, Run, lib, options_text, raise_error, taken_text
from .errors import NotProvedError, UsageError
from .reports import Array, Certificate, FitReport, Json, Verification

Places = npt.ArrayLike


class Samples(NamedTuple):
    """Places along a contour."""

    s: Array  #: arc length from the start, units
    points: Array  #: n x 2, units
    heading: Array  #: rad, unwrapped
    curvature: Array  #: 1/units, positive to the left


class BSpline(NamedTuple):
    """A rational B-spline as scipy names its parts: knots, control points (n x 2), degree."""

    t: Array
    c: Array
    k: int
    weights: Array

    def __call__(self, u: Places) -> Array:
        """Points at parameters in [t[k], t[-k-1]]; Cox and de Boor."""
        at = np.atleast_1d(np.asarray(u, dtype=float))
        h = np.column_stack([self.c * self.weights[:, None], self.weights])
        low, high = self.t[self.k], self.t[len(self.c)]
        if at.size and (at.min() < low or at.max() > high):
            raise ValueError(f"parameters lie between {low} and {high}")
        span = np.clip(np.searchsorted(self.t, at, side="right") - 1, self.k, len(self.c) - 1)
        d = np.array([h[span - self.k + j] for j in range(self.k + 1)])
        for r in range(1, self.k + 1):
            for j in range(self.k, r - 1, -1):
                left = self.t[span - self.k + j]
                right = self.t[span + 1 + j - r]
                a = ((at - left) / (right - left))[:, None]
                d[j] = (1.0 - a) * d[j - 1] + a * d[j]
        out: Array = d[self.k][:, :2] / d[self.k][:, 2:]
        return out if np.ndim(u) else np.asarray(out[0])


class Piece(NamedTuple):
    """A piece of a contour as its file says it (docs/formats.md): `kind` and its numbers."""

    kind: str
    values: Json


Exported = Tuple[List[Tuple[str, bytes]], Tuple[str, ...]]


def exported(function: Any, handle: int, ending: str, options: Json) -> Exported:
    """Files of an export, each with the suffix of its name, and what is to be said of them."""
    out, error = C.c_void_p(), C.POINTER(ErrorStruct)()
    names = {k.replace("_", "-"): v for k, v in options.items()}
    if "profile" in names:
        names["for"] = names.pop("profile")
    with Run(None, None) as run:
        if function(handle, ending.encode(), options_text(names), run, C.byref(out), C.byref(error)):
            raise raise_error(error)
    return taken_files(out)


def taken_files(out: "C.c_void_p") -> Exported:
    """What a call made, and the end of its handle."""
    try:
        files, size = [], C.c_size_t()
        for i in range(lib.obvid_files_count(out)):
            data = lib.obvid_files_data(out, i, C.byref(size))
            files.append((lib.obvid_files_suffix(out, i).decode(), C.string_at(data, size.value)))
        remarks: List[str] = []
        while (remark := lib.obvid_files_remark(out, len(remarks))) is not None:
            remarks.append(remark.decode())
    finally:
        lib.obvid_files_free(out)
    return files, tuple(remarks)


def only_text(made: Exported) -> str:
    """The text of an export that is one file."""
    if len(made[0]) != 1:
        raise UsageError(203, f"this format makes {len(made[0])} files", advice="write()")
    return made[0][0][1].decode()


def write_all(target: pathlib.Path, made: Exported) -> List[str]:
    """Writes the files, each whole or not at all; returns what is to be said of them."""
    files, remarks = made
    for suffix, data in files:
        file = target.with_name(target.stem + suffix + target.suffix)
        temporary = file.with_name(f".{file.name}.{os.getpid()}.tmp")
        try:
            with open(temporary, "wb") as out:
                out.write(data)
                out.flush()
                os.fsync(out.fileno())
            os.replace(temporary, file)
        except BaseException:
            temporary.unlink(missing_ok=True)
            raise
    return list(remarks)


def _places(at: Places) -> Tuple[Array, Tuple[int, ...]]:
    array = np.asarray(at, dtype=float)
    return np.ascontiguousarray(array.ravel()), array.shape


class Contour:
    """A contour through points: made by `fit`, `read_contour` and `Contour.from_json`.

    Parameters of `c(t)` count pieces: 2.5 is the middle of the third piece. Lengths are in `units`,
    headings in radians, curvatures in 1/units, positive where the contour turns left. May be read by
    several threads at once; can be pickled and copied.

    >>> import numpy as np, obvid
    >>> c = obvid.fit([(0, 0), (10, 1), (19, 4), (26, 9), (30, 16)])
    >>> c.proved, c.certificate.vertices
    (True, 0)
    >>> np.allclose(c(0.0), (0, 0)), np.allclose(c(len(c.pieces)), (30, 16))
    (True, True)
    """

    __slots__ = ("_handle", "_cache", "__weakref__")

    def __init__(self, handle: int) -> None:
        self._handle = handle
        self._cache: Dict[str, Any] = {}

    def __del__(self) -> None:
        handle, self._handle = getattr(self, "_handle", 0), 0
        if handle and lib is not None:
            lib.obvid_contour_free(handle)

    # ---- what it is ---------------------------------------------------------------------------

    def __repr__(self) -> str:
        verdict = "proved" if self.proved else "not proved"
        vertices = self.certificate.vertices if self.certificate is not None else "?"
        return (
            f"<obvid.Contour: {self.carrier}, {self.piece_count} pieces through "
            f"{len(self.points)} points, {vertices} vertices, {verdict}>"
        )

    @property
    def piece_count(self) -> int:
        return int(lib.obvid_contour_pieces(self._handle))

    @property
    def closed(self) -> bool:
        return bool(lib.obvid_contour_closed(self._handle))

    @property
    def length(self) -> float:
        """Arc length, units."""
        if "length" not in self._cache:
            self._cache["length"] = float(lib.obvid_contour_length(self._handle))
        return float(self._cache["length"])

    @property
    def domain(self) -> Tuple[float, float]:
        """Parameters of `c(t)`: from 0 to the number of pieces."""
        return 0.0, float(self.piece_count)

    def to_dict(self) -> Json:
        """The contour file (docs/formats.md) as a dictionary."""
        if "file" not in self._cache:
            self._cache["file"] = json.loads(self.text("json"))
        return dict(self._cache["file"])

    @property
    def units(self) -> str:
        return str(self.to_dict()["units"])

    @property
    def carrier(self) -> str:
        return str(self.to_dict()["carrier"])

    @property
    def continuity(self) -> str:
        """"G3" where slopes of curvature are continuous but at `certificate.slope_steps` joints."""
        return str(self.to_dict().get("continuity", "G2"))

    @property
    def points(self) -> Array:
        """Points of the series, n x 2."""
        return np.array(self.to_dict()["points"], dtype=float).reshape(-1, 2)

    @property
    def pieces(self) -> List[Piece]:
        return [
            Piece(p["type"], {k: v for k, v in p.items() if k != "type"})
            for p in self.to_dict()["pieces"]
        ]

    @property
    def report(self) -> Optional[FitReport]:
        """How it was formed; None for curves that were only read."""
        if "report" not in self._cache:
            values = self.to_dict().get("report")
            self._cache["report"] = FitReport.of(values) if values else None
        report: Optional[FitReport] = self._cache["report"]
        return report

    @property
    def certificate(self) -> Optional[Certificate]:
        """What was proved of it; None for curves that were only read."""
        if "certificate" not in self._cache:
            values = self.to_dict().get("certificate")
            self._cache["certificate"] = Certificate.of(values) if values else None
        certificate: Optional[Certificate] = self._cache["certificate"]
        return certificate

    @property
    def proved(self) -> bool:
        return self.certificate is not None and self.certificate.proved

    @property
    def warnings(self) -> Tuple[str, ...]:
        """What was to be warned of when the contour was formed; none of one that was read."""
        out: List[str] = []
        while (one := lib.obvid_contour_warning(self._handle, len(out))) is not None:
            out.append(one.decode())
        return tuple(out)

    # ---- evaluation ---------------------------------------------------------------------------

    def _evaluate(
        self, at: Places, by: int, want: Tuple[bool, bool, bool]
    ) -> Tuple[Array, Array, Array]:
        places, shape = _places(at)
        n = places.size
        xy = np.empty((n, 2)) if want[0] else np.empty((0, 2))
        heading = np.empty(n) if want[1] else np.empty(0)
        curvature = np.empty(n) if want[2] else np.empty(0)
        error = C.POINTER(ErrorStruct)()
        code = lib.obvid_evaluate(
            self._handle,
            by,
            places.ctypes.data,
            n,
            xy.ctypes.data if want[0] else None,
            heading.ctypes.data if want[1] else None,
            curvature.ctypes.data if want[2] else None,
            C.byref(error),
        )
        if code:
            raise raise_error(error)
        return (
            xy.reshape(shape + (2,)) if want[0] else xy,
            heading.reshape(shape) if want[1] else heading,
            curvature.reshape(shape) if want[2] else curvature,
        )

    def __call__(self, t: Places, nu: int = 0) -> Array:
        """Points at parameters, shape of `t` plus 2; with `nu` the derivative of that order (1 to
        3) by the parameter of the piece."""
        if nu == 0:
            return self._evaluate(t, 1, (True, False, False))[0]
        places, shape = _places(t)
        xy = np.empty((places.size, 2))
        error = C.POINTER(ErrorStruct)()
        code = lib.obvid_derivatives(
            self._handle, places.ctypes.data, places.size, nu, xy.ctypes.data, C.byref(error)
        )
        if code:
            raise raise_error(error)
        return xy.reshape(shape + (2,))

    def at_length(self, s: Places) -> Array:
        """Points at arc lengths from the start."""
        return self._evaluate(s, 0, (True, False, False))[0]

    def heading(self, t: Places, *, by_length: bool = False) -> Array:
        """Directions at parameters (or arc lengths), rad."""
        return self._evaluate(t, 0 if by_length else 1, (False, True, False))[1]

    def curvature(self, t: Places, *, by_length: bool = False) -> Array:
        """Curvatures at parameters (or arc lengths), 1/units, positive to the left."""
        return self._evaluate(t, 0 if by_length else 1, (False, False, True))[2]

    def sample(self, n: int, spacing: str = "uniform") -> Samples:
        """`n` places along the contour, both ends included.

        spacing: "uniform" in arc length; "cosine", dense at both ends as panel codes like it;
        "curvature", chords of about one height over the curve.
        """
        if n < 2:
            raise ValueError("at least 2 samples are needed")
        length = self.length
        f = np.linspace(0.0, 1.0, n)
        if spacing == "uniform":
            s = length * f
        elif spacing == "cosine":
            s = 0.5 * length * (1.0 - np.cos(np.pi * f))
        elif spacing == "curvature":
            fine = np.linspace(0.0, length, max(2001, 8 * n))
            kappa = np.abs(self.curvature(fine, by_length=True))
            density = np.sqrt(kappa) + 0.25 * np.sqrt(max(float(kappa.mean()), 1.0 / length))
            steps = 0.5 * (density[1:] + density[:-1]) * np.diff(fine)
            total = np.concatenate([[0.0], np.cumsum(steps)])
            s = np.interp(f * total[-1], total, fine)
        else:
            raise ValueError('spacing is "uniform", "cosine" or "curvature"')
        s[-1] = length
        points, heading, curvature = self._evaluate(s, 0, (True, True, True))
        return Samples(s, points, heading, curvature)

    def __array__(self, dtype: Any = None, copy: Any = None) -> Array:
        """Points along the contour: 32 for each piece, at least 200, evenly in arc length."""
        points = self.sample(max(200, 32 * self.piece_count + 1)).points
        return points if dtype is None else points.astype(dtype)

    def to_bspline(self, *, smooth: bool = False) -> BSpline:
        """The contour as one rational B-spline, `(t, c, k, weights)`.

        Without `smooth` it has the control points of the pieces: piece i over [i, i + 1], inner knots of
        multiplicity k. UsageError where the pieces are not of one degree. With `smooth` it is the curve
        of the contour's STEP file: of a higher degree, C1 at every joint but corners (multiplicity
        k - 1), so that CAD kernels find nothing to split. InputError for clothoids, which are no
        B-splines.
        """
        if smooth:
            return self._smooth_bspline()
        spline = self.to_dict().get("bspline")
        if spline is None:
            raise UsageError(
                203,
                "the pieces of this contour are no single B-spline without raising degrees",
                advice="to_bspline(smooth=True)" if self.carrier != "clothoids" else "c.pieces",
            )
        return BSpline(
            np.array(spline["knots"], dtype=float),
            np.array(spline["points"], dtype=float),
            int(spline["degree"]),
            np.array(spline["weights"], dtype=float),
        )

    def _smooth_bspline(self) -> BSpline:
        out, error = C.POINTER(NurbsStruct)(), C.POINTER(ErrorStruct)()
        if lib.obvid_contour_nurbs(self._handle, C.byref(out), C.byref(error)):
            raise raise_error(error)
        try:
            nurbs = out.contents
            n, k = int(nurbs.count), int(nurbs.degree)

            def taken(numbers: Any, size: int) -> Array:
                return np.array(np.ctypeslib.as_array(numbers, (size,)), dtype=float)

            return BSpline(
                taken(nurbs.knots, n + k + 1),
                taken(nurbs.xy, 2 * n).reshape(n, 2),
                k,
                taken(nurbs.weights, n),
            )
        finally:
            lib.obvid_nurbs_free(out)

    # ---- files and proofs ---------------------------------------------------------------------

    def text(self, ending: str, **options: Any) -> str:
        """The contour in a text format, by its file extension: "json", "svg", "dxf", "step", "nc", ...

        Options are those of the program: output_tolerance, samples, sample_step, feed, decimals, controller,
        motion, svg, plot, curvature_range, step, dxf, face, units, profile (`--for`).
        """
        return only_text(exported(lib.obvid_export, self._handle, ending.lstrip("."), options))

    def write(self, path: Union[str, "os.PathLike[str]"], **options: Any) -> List[str]:
        """Writes the contour to a file whose extension determines the format; returns what is to be said of
        it. Options as of `text`. Files are written whole or not at all."""
        target = pathlib.Path(path)
        ending = target.suffix.lstrip(".")
        return write_all(target, exported(lib.obvid_export, self._handle, ending, options))

    def verify(self) -> Verification:
        """Proves the contour again from its numbers alone. A contour that does not keep its promise
        gives a verification that does not hold, no exception."""
        out, error = C.c_void_p(), C.POINTER(ErrorStruct)()
        with Run(None, None) as run:
            code = lib.obvid_verify(self._handle, run, C.byref(out), C.byref(error))
            text = taken_text(out)
            if code:
                raised = raise_error(error)
                if not isinstance(raised, NotProvedError) or text is None:
                    raise raised
        assert text is not None
        return Verification.of(json.loads(text))

    @classmethod
    def from_json(cls, text: Union[str, bytes]) -> "Contour":
        """The contour of a contour file in memory."""
        from .jobs import read_text

        return read_text(text, "contour.json").contour()

    def __reduce__(self) -> Any:
        return Contour.from_json, (self.text("json"),)

    # ---- pictures -----------------------------------------------------------------------------

    def _repr_svg_(self) -> str:
        return self.text("svg")

    def plot(self, ax: Any = None, *, comb: bool = True, points: bool = True) -> Any:
        """Draws contour, curvature comb and points with matplotlib; returns the axes."""
        import matplotlib.pyplot as plt  # type: ignore[import]

        if ax is None:
            ax = plt.figure().add_subplot()
        places = self.sample(max(400, 16 * self.piece_count))
        ax.plot(*places.points.T)
        if comb:
            largest = float(np.abs(places.curvature).max())
            size = float(np.ptp(places.points, axis=0).max())
            scale = 0.15 * size / largest if largest > 0.0 else 0.0
            normal = np.column_stack([-np.sin(places.heading), np.cos(places.heading)])
            tips = places.points - scale * places.curvature[:, None] * normal
            ax.plot(*tips.T, linewidth=0.6)
        if points:
            ax.plot(*self.points.T, "o", markersize=3)
        ax.set_aspect("equal")
        return ax


__all__ = ["BSpline", "Contour", "Piece", "Samples"]
