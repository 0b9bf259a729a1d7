# SPDX-License-Identifier: Apache-2.0
"""The jobs of the program: read, fit, analyse, region, compare, suggest, why_not."""
from __future__ import annotations

import concurrent.futures
import ctypes as C
import json
import math
import os
import pathlib
from typing import Any, Callable, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, TypeVar, Union

import numpy as np
import numpy.typing as npt

from ._library import (
    CancelledFunction,
    ErrorStruct,
    ProgressFunction,
    Run,
    lib,
    options_text,
    raise_error,
    taken_text,
    watched_of,
)
from .contour import Contour, taken_files, write_all
from .errors import CancelledError, NoContourError, NotProvedError, ObvidError
from .reports import (
    Analysis,
    CarrierRow,
    DrawingAnalysis,
    Json,
    Suggestion,
    Table,
    Verification,
    carrier_rows,
    numbers_of,
    suggestions,
)
from .space import SpaceCurve

#: Heading, radius or curvature of some points: {index: value}, indices from 0, negative from the end.
AtPoints = Mapping[int, Union[float, str, Sequence[Optional[float]]]]


class Source:
    """What jobs read: points in memory, or a file (`read`). May be used by several threads."""

    __slots__ = ("_handle", "count")

    def __init__(self, handle: int, count: Optional[int] = None) -> None:
        self._handle = handle
        self.count = count  #: points that were given, None for files

    def __del__(self) -> None:
        handle, self._handle = getattr(self, "_handle", 0), 0
        if handle and lib is not None:
            lib.obvid_input_free(handle)

    def contour(
        self,
        *,
        curve: Union[int, str, None] = None,
        drawing: Optional[str] = None,
        cut: Union[str, Iterable[str], None] = None,
    ) -> Contour:
        """The contour of a contour file, or a curve of a drawing, or of a mesh's sections, as it is drawn."""
        out, error = C.c_void_p(), C.POINTER(ErrorStruct)()
        options = options_text({"curve": curve, "drawing": drawing, "cut": _planes(cut)})
        with Run(None, None) as run:
            if lib.obvid_stored(self._handle, options, run, C.byref(out), C.byref(error)):
                raise raise_error(error)
        assert out.value is not None
        return Contour(out.value)


    def space_curve(self) -> SpaceCurve:
        """The curve of a file of a curve in space, or of a chain of them."""
        out, error = C.c_void_p(), C.POINTER(ErrorStruct)()
        if lib.obvid_stored_space(self._handle, C.byref(out), C.byref(error)):
            raise raise_error(error)
        assert out.value is not None
        return SpaceCurve(out.value)


#: n x 2 numbers, a `Source`, or the path of a file.
Points = Union[Source, str, "os.PathLike[str]", npt.ArrayLike]


def read(path: Union[str, "os.PathLike[str]"]) -> Source:
    """Opens a file of points, a contour file or a drawing (DXF, SVG, GPX, GeoJSON, LandXML,
    OpenDRIVE; STEP, IGES and BREP where obvid-cad is installed)."""
    out, error = C.c_void_p(), C.POINTER(ErrorStruct)()
    if lib.obvid_read_file(os.fsencode(path), C.byref(out), C.byref(error)):
        raise raise_error(error)
    assert out.value is not None
    return Source(out.value)


def read_text(text: Union[str, bytes], name: str = "text") -> Source:
    """The same from memory; `name` stands in errors."""
    data = text.encode() if isinstance(text, str) else bytes(text)
    out, error = C.c_void_p(), C.POINTER(ErrorStruct)()
    if lib.obvid_read_text(data, len(data), name.encode(), C.byref(out), C.byref(error)):
        raise raise_error(error)
    assert out.value is not None
    return Source(out.value)


def read_contour(path: Union[str, "os.PathLike[str]"]) -> Contour:
    """The contour of a contour file, or the curve of a drawing that has one."""
    return read(path).contour()


def read_space(path: Union[str, "os.PathLike[str]"]) -> SpaceCurve:
    """The curve of a file that `fit_space` (or the program) wrote as .json."""
    return read(path).space_curve()


def verify(contour: Union[Contour, str, "os.PathLike[str]"]) -> Verification:
    """Proves a contour, or that of a contour file, again from its numbers alone. One that does not keep
    its promise gives a verification that does not hold, no exception.

    >>> import obvid
    >>> obvid.verify(obvid.fit([(0, 0), (10, 1), (19, 4), (26, 9)])).holds
    True
    """
    return (contour if isinstance(contour, Contour) else read_contour(contour)).verify()


def _array_of(points: npt.ArrayLike) -> npt.NDArray[np.float64]:
    array = numbers_of(points)
    if array.ndim != 2 or array.shape[1] not in (2, 3):
        raise ValueError(f"points are an array of n x 2 numbers, not of shape {array.shape}")
    if array.shape[1] == 3:
        if array.shape[0] and np.ptp(array[:, 2]) != 0.0:
            raise ValueError("z changes: fit_space forms it, points[:, :2] lies in a plane")
        array = np.ascontiguousarray(array[:, :2])
    return array


def _source_of_array(array: npt.NDArray[np.float64]) -> Source:
    out, error = C.c_void_p(), C.POINTER(ErrorStruct)()
    n = array.shape[0]
    if lib.obvid_points(array.ctypes.data, n, C.byref(out), C.byref(error)):
        raise raise_error(error)
    assert out.value is not None
    return Source(out.value, n)


def _source(points: Points) -> Source:
    if isinstance(points, Source):
        return points
    if isinstance(points, (str, os.PathLike)):
        return read(points)
    return _source_of_array(_array_of(points))


def _with_tolerances(points: Points, noise: npt.ArrayLike) -> Source:
    if isinstance(points, (Source, str, os.PathLike)):
        raise ValueError("a tolerance for each point goes with an array of points")
    array = _array_of(points)
    each = np.asarray(noise, dtype=float).ravel()
    if each.shape != (array.shape[0],):
        raise ValueError(f"{each.size} tolerances for {array.shape[0]} points")
    rows = [f"{x!r},{y!r},{t!r}" for (x, y), t in zip(array.tolist(), each.tolist())]
    made = read_text("\n".join(["x,y,tol", *rows]) + "\n", "points")
    made.count = array.shape[0]
    return made


def _range_text(ends: Sequence[Optional[float]]) -> str:
    """(40, 45) as "40..45"; None, or infinity, where there is no end."""
    low, high = ends
    if any(end is not None and math.isnan(end) for end in ends):
        raise ValueError("a range has no end that is not a number")
    words = ["" if end is None or math.isinf(end) else repr(float(end)) for end in (low, high)]
    return "..".join(words)


def _radius(value: Union[float, str, Sequence[Optional[float]]]) -> Union[float, str]:
    if isinstance(value, str):
        return value
    if isinstance(value, (int, float)):
        return "inf" if math.isinf(value) else value
    return _range_text(value)


def _at(values: Optional[AtPoints], source: Source) -> Optional[Dict[str, Any]]:
    if not values:
        return None
    out: Dict[str, Any] = {}
    for index, value in values.items():
        if index < 0 and source.count is None:
            raise ValueError("indices from the end need points in memory")
        at = index if index >= 0 else index + (source.count or 0)
        if at < 0:
            raise IndexError(f"there is no point {index}")
        out[str(at + 1)] = _radius(value)
    return out


_PLACING = ("columns", "skip", "mirror", "scale", "rotate", "move", "unordered", "drop_outliers", "cut")


def _planes(cut: Union[str, Iterable[str], None]) -> Optional[List[str]]:
    """Planes that cut a mesh: one text or several."""
    if cut is None:
        return None
    return [cut] if isinstance(cut, str) else [str(planes) for planes in cut]


def _placing(o: Mapping[str, Any]) -> Dict[str, Any]:
    """What is done with an input before anything else."""
    out: Dict[str, Any] = {name: o.get(name) for name in ("skip", "mirror", "scale", "rotate", "unordered")}
    out["drop-outliers"] = o.get("drop_outliers")
    out["cut"] = _planes(o.get("cut"))
    if o.get("columns") is not None:
        out["columns"] = ",".join(str(int(i) + 1) for i in o["columns"])
    if o.get("move") is not None:
        out["move"] = ",".join(repr(float(v)) for v in o["move"])
    return out


def _fit_options(
    source: Source, o: Mapping[str, Any], more: Iterable[str] = ()
) -> Optional[bytes]:
    known = {
        "carrier", "noise", "tolerance", "convex", "primitives", "closed", "corners",
        "corner_angle", "start_heading", "end_heading", "start_radius", "end_radius", "heading",
        "radius", "curvature", "units", "curve", "drawing", "chord_tolerance", "prefer",
        "continuity", *_PLACING, *more,
    }  # fmt: skip
    unknown = sorted(set(o) - known)
    if unknown:
        raise TypeError(f"unknown option {unknown[0]!r}; there are {', '.join(sorted(known))}")
    closed, corners = o.get("closed"), o.get("corners")
    if isinstance(corners, (int, np.integer)) and not isinstance(corners, bool):
        corners = [corners]
    options: Dict[str, Any] = {
        name.replace("_", "-"): o.get(name)
        for name in ("along", "carrier", "noise", "tolerance", "corner_angle", "units", "curve", "drawing",
                     "chord_tolerance", "prefer", "continuity", "construction", "fixation",
                     "align", "enlarge", "curvature_range")
    }  # fmt: skip
    options.update(_placing(o))
    options["convex"] = True if o.get("convex") else None
    options["primitives"] = True if o.get("primitives") else None
    options["closed"] = True if closed is True else None
    options["open"] = True if closed is False else None
    options["no-corners"] = True if corners is False else None
    if corners is not None and not isinstance(corners, bool):
        options["corner-at"] = [int(i) + 1 for i in corners]
    for name in ("start_heading", "end_heading", "start_radius", "end_radius"):
        if o.get(name) is not None:
            options[name.replace("_", "-")] = _radius(o[name])
    if o.get("insert") is not None:
        options["insert"] = [int(i) + 1 for i in np.ravel(o["insert"])]
    options["heading-at"] = _at(o.get("heading"), source)
    options["radius-at"] = _at(o.get("radius"), source)
    options["kappa-at"] = _at(o.get("curvature"), source)
    return options_text(options)


def _prepared(points: Points, options: Dict[str, Any]) -> Source:
    noise = options.get("noise")
    if noise is not None and not isinstance(noise, str) and np.ndim(noise) == 1:
        del options["noise"]
        return _with_tolerances(points, noise)
    if isinstance(noise, np.number):
        options["noise"] = float(noise)
    return _source(points)


_CONSTRUCTION = ("construction", "fixation")

#: Series of so many points take milliseconds: Ctrl-C waits for them.
_SHORT = 300


def _fitted(source: Source, text: Optional[bytes], run: Any) -> Contour:
    out, error = C.c_void_p(), C.POINTER(ErrorStruct)()
    code = lib.obvid_fit(source._handle, text, run, C.byref(out), None, C.byref(error))
    made = Contour(out.value) if out.value else None
    if code:
        raised = raise_error(error)
        if isinstance(raised, NotProvedError):
            raised.contour = made
        raise raised
    assert made is not None
    return made


def fit(
    points: Points,
    *,
    progress: Optional[ProgressFunction] = None,
    cancelled: Optional[CancelledFunction] = None,
    **options: Any,
) -> Contour:
    """Forms a contour of monotone curvature through points, and proves it.

    Args:
        points: n x 2 numbers (anything numpy takes), a path, or what `read` returned.
        carrier: "spiral" (default), "arcs", "conics", "beziers", "clothoids", "bspline", "cubic",
            "baseline".
        continuity: of spirals. "G2": of the curvature; "G3": of its slope too. Default: G3 as far as
            it costs no vertex, G2 where `prefer` chooses headings.
        noise: how far points may move, units; "rounding": half a unit of the last digit;
            "auto": estimated from their scatter; an array: one for each point. Default: points are met exactly.
        tolerance: width of the region within which the error bound is found, units; default 3e-6 of
            the size.
        closed: True or False; default: as the points say.
        corners: indices of points where the contour may turn at once; False: none.
        corner_angle: chords that turn by more make a corner, degrees.
        primitives: True takes lines and arcs over where points lie on them.
        convex: True allows no inflection.
        start_heading, end_heading: degrees, or "natural"; start_radius, end_radius: units, inf is
            straight.
        heading, radius, curvature: {index: value} of single points; degrees, units, 1/units. Indices
            count from 0, negative ones from the end.
            All of these take a range (low, high) too, None for an end of a radius or curvature that
            is none: heading={4: (76, 78)}, end_radius=(None, -400).
        prefer: "fair" (default), "centre", "least-change", "least-curvature".
        construction: in place of a carrier a construction of the papers, which promises nothing:
            "arcs", "ellipses", "clothoids", "spline", "parabolas"; `prefer` then knows "neighbours"
            too. fixation: order of parabolas, 1 or 2.
        units: "mm", "in", ... of the points.
        curve, drawing, chord_tolerance: of a drawing, as the program takes them.
        cut: planes that cut a mesh (STL, PLY, OBJ), "z=12" or several; every section is a curve.
        columns, skip: of a list of points, the columns of x and y from 0, and lines to leave out.
        mirror, scale, rotate, move: of the input, in this order: "x" or "y" (across that axis), a
            factor, degrees about the origin, (dx, dy).
        progress: called with a stage and a fraction; cancelled: asked often, True ends the work.

    Raises:
        NoContourError: there is no such contour; `points` of the error are those in the way.
        NotProvedError: formed, but it does not keep its promise; `contour` of the error is it.
        InputError, UsageError, CancelledError.

    >>> import obvid
    >>> c = obvid.fit([(0, 0), (10, 1), (19, 4), (26, 9), (30, 16)], heading={0: 0})
    >>> c.report.headings_given, round(abs(float(c.heading(0.0))), 12)
    (1, 0.0)
    """
    source = _prepared(points, options) if options else _source(points)
    text = _fit_options(source, options, _CONSTRUCTION) if options else None
    short = source.count is not None and source.count <= _SHORT
    if short and progress is None and cancelled is None:
        return _fitted(source, text, None)
    with Run(progress, cancelled) as run:
        return _fitted(source, text, run)


def fit_space(
    points: Points,
    *,
    along: Optional[Union[str, Sequence[float]]] = None,
    progress: Optional[ProgressFunction] = None,
    cancelled: Optional[CancelledFunction] = None,
    **options: Any,
) -> SpaceCurve:
    """Forms a fair curve through points in space, and proves it.

    Points of a plane give a contour in it; others a curve whose projection and whose heights over it
    are fair. Corners cut the series into parts.

    Args:
        points: n x 3 numbers, the path of a file with columns x, y, z, or what `read` returned.
        along: direction of the projection, "X", "Y", "Z" or three numbers. Default: the plane of the
            points, else the best of four.
        Others as of `fit`, without constructions; headings and radii need `along`.

    Raises:
        What `fit` raises; NotProvedError has the curve as `contour`.

    >>> import obvid
    >>> c = obvid.fit_space([(0, 0, 0), (9, 0, 0), (18, 0, 0), (18, 9, 0), (18, 18, 3), (18, 27, 9)],
    ...                     corners=[2])
    >>> c.part_count, c.corners[0].point
    (2, 2)
    """
    if isinstance(points, (Source, str, os.PathLike)):
        source = _source(points)
    else:
        array = numbers_of(points)
        if array.ndim != 2 or array.shape[1] != 3:
            raise ValueError(f"points in space are n x 3 numbers, not of shape {array.shape}")
        given, failed = C.c_void_p(), C.POINTER(ErrorStruct)()
        n = array.shape[0]
        if lib.obvid_space_points(array.ctypes.data, n, C.byref(given), C.byref(failed)):
            raise raise_error(failed)
        assert given.value is not None
        source = Source(given.value, n)
    if isinstance(options.get("noise"), np.number):
        options["noise"] = float(options["noise"])
    if along is not None and not isinstance(along, str):
        along = ",".join(repr(float(one)) for one in along)
    text = _fit_options(source, {**options, "along": along}, ("along",))
    out, error = C.c_void_p(), C.POINTER(ErrorStruct)()
    with Run(progress, cancelled) as run:
        code = lib.obvid_fit_space(source._handle, text, run, C.byref(out), None, C.byref(error))
        made = SpaceCurve(out.value) if out.value else None
        if code:
            raised = raise_error(error)
            if isinstance(raised, NotProvedError):
                raised.contour = made
            raise raised
    assert made is not None
    return made


def _report(name: str, source: Source, text: Optional[bytes], watched: Dict[str, Any]) -> Json:
    out, error = C.c_void_p(), C.POINTER(ErrorStruct)()
    with Run(**watched) as run:
        code = getattr(lib, "obvid_" + name)(
            source._handle, text, run, C.byref(out), C.byref(error)
        )
        said = taken_text(out)
        if code:
            raise raise_error(error, said)
    values: Json = json.loads(said) if said is not None else {}
    return values


def analyse(
    points: Points,
    *,
    units: Optional[str] = None,
    curve: Union[int, str, None] = None,
    drawing: Optional[str] = None,
    progress: Optional[ProgressFunction] = None,
    cancelled: Optional[CancelledFunction] = None,
    **placing: Any,
) -> Union[Analysis, DrawingAnalysis]:
    """What points say before a curve is formed; of a drawing, what a comb of its curves would show.
    Others as of `fit`: columns, skip, mirror, scale, rotate, move, unordered, drop_outliers, cut.

    >>> import obvid
    >>> a = obvid.analyse([(0, 0), (10, 1), (19, 4), (26, 9), (30, 16)])
    >>> a.vertices, a.runs[0].direction
    (0, 1)
    """
    options = _analyse_options({"units": units, "curve": curve, "drawing": drawing}, placing)
    watched = {"progress": progress, "cancelled": cancelled}
    values = _report("analyse", _source(points), options, watched)
    return Analysis.of(values) if "segments" in values else DrawingAnalysis.of(values)


def _analyse_options(options: Mapping[str, Any], placing: Mapping[str, Any]) -> Optional[bytes]:
    unknown = sorted(set(placing) - set(_PLACING))
    if unknown:
        raise TypeError(f"unknown option {unknown[0]!r}; there are {', '.join(_PLACING)}")
    return options_text({**options, **_placing(placing)})


def analyse_file(
    points: Points,
    path: Union[str, "os.PathLike[str]"],
    *,
    units: Optional[str] = None,
    curve: Union[int, str, None] = None,
    drawing: Optional[str] = None,
    plot: Optional[str] = None,
    curvature_range: Optional[str] = None,
    progress: Optional[ProgressFunction] = None,
    cancelled: Optional[CancelledFunction] = None,
    **placing: Any,
) -> List[str]:
    """Writes what `analyse` finds: .csv, .json the tables; of a drawing .svg the curve that is asked
    for, else the longest. Returns what is to be said of it."""
    options = {"units": units, "curve": curve, "drawing": drawing, "plot": plot, "curvature-range": curvature_range}
    watched = {"progress": progress, "cancelled": cancelled}
    return _file_of("analyse_file", _source(points), path, _analyse_options(options, placing), watched)


def region(points: Points, **options: Any) -> Table:
    """Where every fair contour through the points must lie: a row for each segment.

    Args:
        insert: segments, from 0, that get a point in their middle; `tolerance`: insert points until
            no region is wider.
        prefer: tangents that are not given: "fair" (default), "centre", "neighbours",
            "least-change", "least-curvature".
        construction: "arcs", "ellipses", "clothoids", "spline", "parabolas": `json["construction"]`
            of the table has the columns and rows of these. fixation: order of parabolas, 1 or 2.
        Others as of `fit`.

    >>> import obvid
    >>> r = obvid.region([(0, 0), (10, 1), (19, 4), (26, 9), (30, 16)], construction="arcs")
    >>> len(r), bool(r["width"].max() < 0.5)
    (4, True)
    >>> r.json["construction"]["columns"][:2]
    ['R', "R'"]
    """
    watched = watched_of(options)
    source = _prepared(points, options)
    text = _fit_options(source, options, (*_CONSTRUCTION, "insert"))
    values = _report("region", source, text, watched)
    return Table(tuple(values["segments"]), values)


#: An arc of a boundary: x, y, heading and curvature where it begins (0: a line), and its length.
BoundaryArc = Tuple[float, float, float, float, float]


def region_arcs(
    start: Sequence[float], end: Sequence[float]
) -> Optional[Tuple[List[BoundaryArc], List[BoundaryArc]]]:
    """Both boundaries of the region between two elements (x, y, heading in rad, curvature), each as one or
    two arcs from `start` to `end`; None where no curve of monotone curvature has these elements.

    >>> import obvid
    >>> first, second = obvid.region_arcs((0, 0, 0.3, 0.0), (10, 0, -0.4, -0.2))
    >>> [len(first), len(second), first[0][3], second[-1][3]]
    [2, 2, 0.0, -0.2]
    """
    given = [(C.c_double * 4)(*map(float, element)) for element in (start, end)]
    arcs, counts, error = (C.c_double * 20)(), (C.c_size_t * 2)(), C.POINTER(ErrorStruct)()
    if lib.obvid_region_arcs(*given, arcs, counts, C.byref(error)):
        raise raise_error(error)
    if not (counts[0] and counts[1]):
        return None
    rows: List[BoundaryArc] = [
        (arcs[k], arcs[k + 1], arcs[k + 2], arcs[k + 3], arcs[k + 4]) for k in range(0, 5 * (counts[0] + counts[1]), 5)
    ]
    return rows[: counts[0]], rows[counts[0] :]


def space_audit(
    points: npt.ArrayLike, knots: Sequence[float], degree: int, weights: Optional[Sequence[float]] = None
) -> Json:
    """The curvature of a NURBS curve in space, n x 3 control points: "places" of its extrema, "steps" at joints that are
    not G2, "largest_turn", "largest_step", "largest_curvature". Found at places of each span, not proved.

    >>> import obvid
    >>> obvid.space_audit([(0, 0, 0), (1, 2, 0), (2, 0, 1)], [0, 0, 0, 1, 1, 1], 2)["vertices"]
    1
    """
    flat = np.ascontiguousarray(points, dtype=np.float64)
    if flat.ndim != 2 or flat.shape[1] != 3:
        raise ValueError("control points are an array of n x 3 numbers")
    if len(knots) != len(flat) + degree + 1 or (weights is not None and len(weights) != len(flat)):
        raise ValueError("a curve of n points has n + degree + 1 knots, and n weights")
    at, of = np.ascontiguousarray(knots, dtype=np.float64), None
    if weights is not None:
        of = np.ascontiguousarray(weights, dtype=np.float64)
    said, error = C.c_void_p(), C.POINTER(ErrorStruct)()
    code = lib.obvid_space_audit(
        degree, len(flat), at.ctypes.data, flat.ctypes.data, None if of is None else of.ctypes.data, None,
        C.byref(said), C.byref(error),
    )  # fmt: skip
    if code:
        raise raise_error(error)
    values: Json = json.loads(taken_text(said) or "{}")
    return values


#: Headings (rad) and curvatures (of the largest) of a joint that differ by less are one.
JOINT_LIMIT: float = lib.obvid_joint_limit()


def worksheet(
    points: Points, path: Union[str, "os.PathLike[str]"], **options: Any
) -> List[str]:
    """Writes what `region` finds to a file: .csv, .tex, .json the tables; .svg, .dxf the limiting arcs,
    adjacent circles, tangents and triangles. Options of `region`. Returns what is to be said of it.
    """
    watched = watched_of(options)
    source = _prepared(points, options)
    text = _fit_options(source, options, (*_CONSTRUCTION, "insert"))
    return _file_of("worksheet", source, path, text, watched)


def _file_of(
    job: str,
    source: "Source",
    path: Union[str, "os.PathLike[str]"],
    options: Optional[bytes],
    watched: Mapping[str, Any],
) -> List[str]:
    """What a job of the library makes of points for one file, written."""
    target = pathlib.Path(path)
    out, error = C.c_void_p(), C.POINTER(ErrorStruct)()
    with Run(**watched) as run:
        ending = target.suffix.lstrip(".").encode()
        work = getattr(lib, "obvid_" + job)
        if work(source._handle, options, ending, run, C.byref(out), C.byref(error)):
            raise raise_error(error)
    return write_all(target, taken_files(out))


def compare(points: Points, **options: Any) -> List[CarrierRow]:
    """All curve families through the same points, side by side. Options of `fit`."""
    watched = watched_of(options)
    source = _prepared(points, options)
    return carrier_rows(_report("compare", source, _fit_options(source, options), watched))


def compare_file(points: Points, path: Union[str, "os.PathLike[str]"], **options: Any) -> List[str]:
    """Writes what `compare` finds: .svg the carriers side by side; .csv, .json the table. Options of `fit`
    and ``curvature_range``. Returns what is to be said of it."""
    return _fit_file("compare_file", points, path, options, ("curvature_range",))


def suggest_file(points: Points, path: Union[str, "os.PathLike[str]"], **options: Any) -> List[str]:
    """Writes what `suggest` finds: .svg a chart, .json the table. Options of `fit`."""
    return _fit_file("suggest_file", points, path, options)


def why_not_file(points: Points, path: Union[str, "os.PathLike[str]"], **options: Any) -> List[str]:
    """Writes the nearest contour that there is where `fit` finds none, as a picture: .svg. Options of `fit`."""
    return _fit_file("why_not_file", points, path, options)


def _fit_file(
    job: str,
    points: Points,
    path: Union[str, "os.PathLike[str]"],
    options: Dict[str, Any],
    more: Tuple[str, ...] = (),
) -> List[str]:
    watched = watched_of(options)
    source = _prepared(points, options)
    return _file_of(job, source, path, _fit_options(source, options, more), watched)


def compare_curves(
    curves: Sequence[Points],
    path: Union[None, str, "os.PathLike[str]"] = None,
    **options: Any,
) -> Dict[str, Any]:
    """Several curves laid over each other: how far they are from the first one, along its normals.
    Points are formed with options of `fit`; contour files and curves of drawings are taken as they
    are. ``align="chord"``: airfoils are compared on one chord, too. `path`: a picture (.svg,
    ``enlarge=50``) or a table of all places (.csv).

    >>> import math, obvid
    >>> circle = lambda r: [(r * math.cos(k / 5), r * math.sin(k / 5)) for k in range(16)]
    >>> found = obvid.compare_curves([circle(2), circle(2.25)], noise=1e-9)
    >>> round(found["as_they_lie"][0]["root_mean_square"], 6)
    0.25
    """
    watched = watched_of(options)
    sources = [_source(one) for one in curves]
    if not sources:
        raise ValueError("two curves at least are laid over each other")
    handles = (C.c_void_p * len(sources))(*(one._handle for one in sources))
    text = _fit_options(sources[0], options, ("align", "enlarge"))
    files, said, error = C.c_void_p(), C.c_void_p(), C.POINTER(ErrorStruct)()
    with Run(**watched) as run:
        if lib.obvid_compare_curves(
            handles, len(sources), text, run, C.byref(files), C.byref(said), C.byref(error)
        ):
            raise raise_error(error)
    made, _ = taken_files(files)
    if path is not None:
        target = pathlib.Path(path)
        kinds = {suffix: data for suffix, data in made}
        if target.suffix not in kinds:
            raise ValueError(f"{target}: a comparison of curves is written as {', '.join(kinds)}")
        target.write_bytes(kinds[target.suffix])
    values: Dict[str, Any] = json.loads(taken_text(said) or "{}")
    return values


def suggest(points: Points, **options: Any) -> List[Suggestion]:
    """How many vertices which tolerance would need; a tolerance that gives no contour has a row that says
    so. Options of `fit`."""
    watched = watched_of(options)
    source = _prepared(points, options)
    try:
        values = _report("suggest", source, _fit_options(source, options), watched)
    except ObvidError as none_kept:
        if none_kept.report is None:
            raise
        values = none_kept.report
    return suggestions(values)


def why_not(points: Points, **options: Any) -> Optional[NoContourError]:
    """Why `fit` finds no contour and what would do (`advice`, `points`); None where there is one.
    Takes some 15 times as long as `fit`."""
    watched = watched_of(options)
    source = _prepared(points, options)
    try:
        _report("why_not", source, _fit_options(source, options), watched)
    except NoContourError as reason:
        return reason
    return None


def explain(code: Union[str, int, None] = None) -> Any:
    """What an error code means and what helps; without one all of them.

    >>> import obvid
    >>> obvid.explain("E401")["code"]
    'E401'
    """
    text, error = C.c_void_p(), C.POINTER(ErrorStruct)()
    asked = None if code is None else str(code).encode()
    if lib.obvid_explain(asked, C.byref(text), C.byref(error)):
        raise raise_error(error)
    return json.loads(taken_text(text) or "null")


Result = TypeVar("Result")


def many(
    job: Callable[..., Result],
    inputs: Iterable[Any],
    *,
    workers: Optional[int] = None,
    errors: str = "raise",
    options: Optional[Sequence[Mapping[str, Any]]] = None,
    **common: Any,
) -> List[Union[Result, ObvidError, ValueError]]:
    """What a function of this package makes of many inputs on several threads, in their order:
    `fit`, `alignment`, `cut`, `spline`, `nurbs`, `analyse`, `region`, ...

    workers: threads, default one for each processor. errors: "raise" raises the first one in order,
    "return" puts exceptions in the places of their inputs. options: one mapping for each input, on
    top of the common options of the job.

    >>> import obvid
    >>> tables = [[(x, n * x * x) for x in range(5)] for n in (1, 2)]
    >>> [round(made.report["rows"][0]["integral"], 6) for made in obvid.many(obvid.spline, tables)]
    [21.333333, 42.666667]
    """
    if errors not in ("raise", "return"):
        raise ValueError('errors is "raise" or "return"')
    all_inputs = list(inputs)
    each = list(options) if options is not None else [{} for _ in all_inputs]
    if len(each) != len(all_inputs):
        raise ValueError(f"{len(each)} options for {len(all_inputs)} inputs")

    def one(k: int) -> Union[Result, ObvidError, ValueError]:
        try:
            return job(all_inputs[k], **{**common, **each[k]})
        except CancelledError:
            raise
        except (ObvidError, ValueError) as error:
            return error

    with concurrent.futures.ThreadPoolExecutor(workers or os.cpu_count() or 1) as pool:
        made = list(pool.map(one, range(len(all_inputs))))
    if errors == "raise":
        for result in made:
            if isinstance(result, Exception):
                raise result
    return made


def fit_many(series: Iterable[Points], **options: Any) -> List[Union[Contour, ObvidError, ValueError]]:
    """Contours of many series: `many` of the job `fit`."""
    return many(fit, series, **options)
