# SPDX-License-Identifier: Apache-2.0
"""Surfaces over fair contours: made, evaluated, checked, written, milled."""
from __future__ import annotations

import ctypes as C
import json
import os
import pathlib
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._library import ErrorStruct, Run, lib, options_text, raise_error, taken_text, watched_of
from .contour import Exported, taken_files, write_all
from .errors import NotProvedError, ObvidError
from .jobs import Source, read
from .reports import Array, Json, numbers_of

#: n x 2 or n x 3 numbers, a `Source`, or the path of a file.
SurfacePoints = Union[Source, str, "os.PathLike[str]", npt.ArrayLike]


class SurfaceSamples(NamedTuple):
    """Places of a surface."""

    points: Array  #: n x 3, units
    normal: Array  #: n x 3, of length 1, along du x dv; 0 where there is none
    k1: Array  #: larger principal curvature, 1/units
    k2: Array  #: smaller principal curvature, 1/units


class Toolpath(NamedTuple):
    """A program for a three-axis mill, as it was simulated."""

    program: str  #: G-code
    report: Json
    remarks: Tuple[str, ...]
    not_kept: Optional[ObvidError]  #: what was asked for and is not so; None: all is kept


class SurfaceBranch(NamedTuple):
    """One branch of a plane section."""

    points: Array  #: n x 3, units; of closed ones the first point is not repeated
    in_plane: Array  #: n x 2: y, z of stations, x, y of waterlines, x, z of buttocks
    parameters: Array  #: n x 3: patch, u, v
    closed: bool


class SurfaceSection(NamedTuple):
    """All branches of a surface in a plane."""

    name: str
    branches: Tuple[SurfaceBranch, ...]


class SurfaceCut(NamedTuple):
    """What planes have in common with a surface."""

    sections: Tuple[SurfaceSection, ...]
    report: Json  #: as of `obvid surface cut --json`; "hydrostatics" where a draught was given
    files: Dict[str, bytes]  #: by ending: ".csv", ".svg", ".dxf", ".json"
    remarks: Tuple[str, ...]
    not_kept: Optional[ObvidError]  #: contours that were refused or not proved


class Surface:
    """A model of NURBS patches: made by `skin`, `surface` and `read_surface`. May be read by several
    threads at once.

    >>> import obvid
    >>> cylinder = obvid.surface("revolve", [[(3, 0, 0), (3, 0, 5)]], axis="z")
    >>> cylinder
    <obvid.Surface: 1 patch, surface of revolution>
    >>> places = cylinder([(0, 0), (0.5, 1)])
    >>> [round(float(abs(k)), 12) for k in places.k1 + places.k2]
    [0.333333333333, 0.333333333333]
    """

    __slots__ = ("_handle", "report", "__weakref__")

    def __init__(self, handle: int, report: Json) -> None:
        self._handle = handle
        self.report = report  #: as of `obvid surface KIND --json`

    def __del__(self) -> None:
        handle, self._handle = getattr(self, "_handle", 0), 0
        if handle and lib is not None:
            lib.obvid_surface_free(handle)

    def __repr__(self) -> str:
        n = self.patch_count
        patches = "1 patch" if n == 1 else f"{n} patches"
        return f"<obvid.Surface: {patches}, {self.report['kind']}>"

    @property
    def patch_count(self) -> int:
        return int(lib.obvid_surface_patches(self._handle))

    @property
    def warnings(self) -> Tuple[str, ...]:
        out: List[str] = []
        while (warning := lib.obvid_surface_warning(self._handle, len(out))) is not None:
            out.append(warning.decode())
        return tuple(out)

    def __call__(self, uv: npt.ArrayLike, patch: int = 0) -> SurfaceSamples:
        """Places of a patch at n x 2 shares u, v from 0 to 1."""
        at = np.ascontiguousarray(uv, dtype=np.float64).reshape(-1, 2)
        n = at.shape[0]
        xyz, normal, kappa = np.empty((n, 3)), np.empty((n, 3)), np.empty((n, 2))
        error = C.POINTER(ErrorStruct)()
        if lib.obvid_surface_evaluate(
            self._handle, patch, at.ctypes.data, n, xyz.ctypes.data, normal.ctypes.data,
            kappa.ctypes.data, C.byref(error),
        ):  # fmt: skip
            raise raise_error(error)
        return SurfaceSamples(xyz, normal, kappa[:, 0], kappa[:, 1])

    def check(
        self,
        *,
        samples: int = 65,
        against: Optional[Union[str, "os.PathLike[str]"]] = None,
        meeting: Optional[float] = None,
    ) -> Json:
        """Curvatures, joints of patches, monotone parameter lines: as `obvid surface check --json`.
        `against` is the path of a file of points or of a surface: "deviation" of the report says how
        far they are apart. Borders nearer than `meeting` (units) meet [1e-5 of the size]."""
        out, error = C.c_void_p(), C.POINTER(ErrorStruct)()
        given: Dict[str, Any] = {"samples": samples}
        if against is not None:
            given["against"] = os.fspath(against)
        if meeting is not None:
            given["meeting"] = meeting
        options = options_text(given)
        with Run(None, None) as run:
            code = lib.obvid_surface_check(self._handle, options, run, C.byref(out), C.byref(error))
            said = taken_text(out)
        if code:
            raise raise_error(error, said)
        values: Json = json.loads(said or "{}")
        return values

    def data(self, ending: str, **options: Any) -> bytes:
        """A file of the surface: "json", "step", "iges", "brep", "stl", "obj", "glb", "ply", "html",
        "svg". Options: chord_tolerance, mesh_angle (degrees), colour, view, step; against (path of a
        file of points or of a surface) with colour="deviation" of "html" and "svg"."""
        files, _ = self._files(ending.lstrip("."), options)
        return files[0][1]

    def write(self, path: Union[str, "os.PathLike[str]"], **options: Any) -> List[str]:
        """Writes a file whose extension determines the format; returns what is to be said of it."""
        target = pathlib.Path(path)
        return write_all(target, self._files(target.suffix.lstrip("."), options))

    def cut(self, **options: Any) -> SurfaceCut:
        """Sections by planes and what floats. Options as of `obvid surface cut`: plane ("nx,ny,nz,d" or a
        list of these), stations, waterlines, buttocks ("1,2.5", "every:0.5", "count:20"), tolerance,
        fair, draught, half, density.

        >>> import obvid
        >>> tube = obvid.surface("revolve", [[(3, 0, 0), (3, 0, 5)]], axis="z")
        >>> [len(section.branches) for section in tube.cut(waterlines="1,2").sections]
        [1, 1]
        """
        made, report, remarks, failed = self._made(lib.obvid_surface_cut, options)
        by_ending = dict(made)
        told: Json = json.loads(by_ending[".json"])
        sections = tuple(
            SurfaceSection(one["name"], tuple(_branch(b) for b in one["branches"]))
            for one in told["sections"]
        )
        return SurfaceCut(sections, report, by_ending, remarks, failed)

    def toolpath(self, **options: Any) -> Toolpath:
        """A program for a three-axis mill. Options as of `obvid toolpath`: cutter, diameter, corner_radius,
        strategy, scallop, step_over, angle, along_v, one_way, tolerance, safe_z, allowance, step_down,
        steep_angle, rest_of, rest_corner, up, stock, entry, ramp, ramp_height, spindle, feed, plunge_feed, rapid_feed, acceleration,
        controller, motion."""
        made, report, remarks, failed = self._made(lib.obvid_surface_toolpath, options)
        return Toolpath(made[0][1].decode(), report, remarks, failed)

    def _made(
        self, job: Any, options: Dict[str, Any]
    ) -> Tuple[List[Tuple[str, bytes]], Json, Tuple[str, ...], Optional[ObvidError]]:
        """Files, report and remarks of a job on the surface, and why it is not all that was asked for."""
        files, said, error = C.c_void_p(), C.c_void_p(), C.POINTER(ErrorStruct)()
        text = options_text({k.replace("_", "-"): v for k, v in options.items() if v is not None})
        with Run(None, None) as run:
            code = job(self._handle, text, run, C.byref(files), C.byref(said), C.byref(error))
            report = taken_text(said)
        failed = raise_error(error, report) if code else None
        if not files.value:
            assert failed is not None
            raise failed
        made, remarks = taken_files(files)
        return made, json.loads(report or "{}"), remarks, failed

    def _files(self, ending: str, options: Dict[str, Any]) -> Exported:
        out, error = C.c_void_p(), C.POINTER(ErrorStruct)()
        text = options_text({k.replace("_", "-"): v for k, v in options.items()})
        with Run(None, None) as run:
            if lib.obvid_surface_export(
                self._handle, ending.encode(), text, run, C.byref(out), C.byref(error)
            ):
                raise raise_error(error)
        return taken_files(out)


def _branch(told: Json) -> SurfaceBranch:
    points, in_plane, parameters = (
        np.array(told[key], dtype=np.float64) for key in ("points", "in_plane", "parameters")
    )
    return SurfaceBranch(points, in_plane, parameters, bool(told["closed"]))


def _input(points: SurfacePoints) -> Source:
    if isinstance(points, Source):
        return points
    if isinstance(points, (str, os.PathLike)):
        return read(points)
    array = numbers_of(points)
    if array.ndim == 2 and array.shape[1] == 2:
        array = np.column_stack([array, np.zeros(len(array))])
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"points are an array of n x 3 numbers, not of shape {array.shape}")
    array = np.ascontiguousarray(array)
    out, error = C.c_void_p(), C.POINTER(ErrorStruct)()
    if lib.obvid_space_points(array.ctypes.data, len(array), C.byref(out), C.byref(error)):
        raise raise_error(error)
    assert out.value is not None
    return Source(out.value, len(array))


def surface(
    kind: str,
    inputs: Sequence[SurfacePoints],
    *,
    across: Sequence[SurfacePoints] = (),
    **options: Any,
) -> Surface:
    """A surface of a kind: "skin" (sections), "ruled", "revolve", "coons", "gordon" (curves, with
    `across`), "grid", "id" (one grid: a file, or an array of rows x columns x 3), "scatter" (points in any
    order: a file, or an array of n x 3), "offset", "trim" (by `plane` or `contour`, with `keep`), "fillet" (of two
    `faces`, by a ball of `radius`), "match" (a `border` `to` another), "convert".

    Options have the names of `obvid surface KIND`: tolerance, noise, closed, match, spacing, axis,
    axis_point, angle, direction, apex, near, control, distance, up, steepest,
    drop_outliers, units, ...
    Raises `NotProvedError` where section contours are formed but not proved; its `surface` is there.
    """
    watched = watched_of(options)
    if kind in ("grid", "id") and len(inputs) == 1 and not isinstance(inputs[0], (Source, str, os.PathLike)):
        array = np.asarray(inputs[0], dtype=np.float64)
        if array.ndim == 3:
            options["row"] = array.shape[1]
            inputs = [array.reshape(-1, array.shape[2])]
    first, second = [_input(one) for one in inputs], [_input(one) for one in across]
    handles = [(C.c_void_p * len(some))(*[one._handle for one in some]) for some in (first, second)]
    text = options_text({k.replace("_", "-"): v for k, v in options.items()})
    out, said, error = C.c_void_p(), C.c_void_p(), C.POINTER(ErrorStruct)()
    with Run(**watched) as run:
        code = lib.obvid_surface_make(
            kind.encode(), handles[0], len(first), handles[1], len(second), text, run,
            C.byref(out), C.byref(said), C.byref(error),
        )  # fmt: skip
        report = taken_text(said)
    failed = raise_error(error, report) if code else None
    made = Surface(out.value, json.loads(report or "{}")) if out.value else None
    if failed is not None:
        if made is not None and isinstance(failed, NotProvedError):
            failed.surface = made
        raise failed
    assert made is not None
    return made


def skin(sections: Sequence[SurfacePoints], **options: Any) -> Surface:
    """A surface through section contours, each of them fair; options of `surface`.

    >>> import numpy as np, obvid
    >>> t = np.linspace(0, 2, 9)
    >>> rows = [np.column_stack([np.exp(t) * np.cos(t), np.exp(t) * np.sin(t), 0 * t + z]) for z in (0, 1, 3)]
    >>> hull = obvid.skin(rows)
    >>> hull.report["skin"]["proved"]
    3
    """
    return surface("skin", sections, **options)


def read_surface(path: Union[str, "os.PathLike[str]"]) -> Surface:
    """A stored surface (.json, control points; STEP, IGES and BREP where obvid-cad is installed)."""
    return surface("convert", [path])


def toolpath(surface: Union[Surface, str, "os.PathLike[str]"], **options: Any) -> Toolpath:
    """A program for a three-axis mill over a surface, or that of a file; options of `Surface.toolpath`."""
    return (surface if isinstance(surface, Surface) else read_surface(surface)).toolpath(**options)
