# SPDX-License-Identifier: Apache-2.0
"""Reports of the jobs as values. Names are those of the program; None is "not known"."""
from __future__ import annotations

import dataclasses
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Type, TypeVar

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Json = Dict[str, Any]
_Report = TypeVar("_Report")


def numbers_of(points: npt.ArrayLike) -> Array:
    """An array of doubles in one piece; ValueError for what would lose something on the way."""
    if type(points) is np.ndarray and points.dtype == np.float64:
        return np.ascontiguousarray(points)
    if np.iscomplexobj(points):
        raise ValueError("points are real numbers, not complex ones")
    if np.any(getattr(points, "mask", False)):
        raise ValueError("some points are masked: leave them out first (numpy.ma.compress_rows)")
    try:
        return np.ascontiguousarray(points, dtype=np.float64)
    except OverflowError as error:
        raise ValueError(str(error)) from None


def _taken(kind: Type[_Report], values: Mapping[str, Any], **more: Any) -> _Report:
    """A report of the fields that it has among the values."""
    fields: Mapping[str, Any] = getattr(kind, "__dataclass_fields__")
    return kind(**{k: v for k, v in values.items() if k in fields and k not in more}, **more)


def column(rows: Sequence[Mapping[str, Any]], name: str) -> Array:
    """One figure of all rows; nan where it is not known."""
    return np.array([np.nan if r.get(name) is None else r[name] for r in rows], dtype=float)


@dataclasses.dataclass(frozen=True)
class Certificate:
    """What was proved of a contour from its numbers alone (docs/claims.md)."""

    proved: bool
    vertices: int  #: extrema of the curvature along the whole contour
    inflections: int
    corners: int
    curvature_steps: int
    self_intersections: Optional[int]
    through_points: bool
    inside_region: bool
    gaps_within_bounds: bool
    largest_move: float  #: units
    reason: str  #: why it is not proved; empty when it is
    position_gap: float  #: largest at a joint, of the size
    heading_gap: float  #: rad
    curvature_gap: float  #: of the larger curvature at the joint
    slope_gap: Optional[float]  #: of the largest slope beside the joint; None: not G3
    slope_steps: Optional[int]  #: joints of a G3 contour that are G2 only; None: not G3

    @classmethod
    def of(cls, values: Json) -> "Certificate":
        gaps = values["joint_gaps"]
        return _taken(
            cls,
            {"self_intersections": None, "slope_steps": None, **values},
            position_gap=gaps["position"],
            heading_gap=gaps["heading"],
            curvature_gap=gaps["curvature"],
            slope_gap=gaps.get("slope"),
        )


@dataclasses.dataclass(frozen=True)
class Segment:
    """Part of a contour between two stations (docs/claims.md, "Per part"). Lengths in units."""

    points: Tuple[Optional[int], Optional[int]]
    chord: float
    points_only_error: Optional[float]
    width: Optional[float]
    width_unrefined: Optional[float]
    deviation: Optional[float]
    inserted: int


@dataclasses.dataclass(frozen=True)
class FitReport:
    """How a contour was formed and what bounds its error. Lengths in units."""

    segments: Tuple[Segment, ...]
    tolerance: float
    largest_width: Optional[float]
    largest_deviation: Optional[float]
    largest_move: float
    vertices: int
    vertices_lower_bound: int  #: what the points force on curves that do not wind between them
    inflections: int
    inserted_points: int
    waviness: Optional[float]  #: hills of the slope of curvature on a run, 1 at least
    carrier_deviation: Optional[float]
    seconds: float
    headings_given: int
    curvatures_given: int
    heading_miss: float  #: largest, rad
    curvature_miss: float  #: largest, of the given curvature
    ranges_given: int  #: of headings and of curvatures
    #: Ranges at an end of which the contour lies: index of the point, "heading" or "curvature",
    #: "least" or "greatest".
    ranges_active: Tuple[Tuple[int, str, str], ...]

    @classmethod
    def of(cls, values: Json) -> "FitReport":
        given = values.get("given", {})
        unknown = dict.fromkeys(("points_only_error", "width", "width_unrefined", "deviation"))
        segments = tuple(
            _taken(Segment, {**unknown, **s}, points=tuple(s.get("points", (None, None))))
            for s in values["segments"]
        )
        return _taken(
            cls,
            {
                **dict.fromkeys(("carrier_deviation", "waviness", "largest_width", "largest_deviation")),
                "seconds": 0.0,
                **values,
            },
            segments=segments,
            headings_given=given.get("headings", 0),
            curvatures_given=given.get("curvatures", 0),
            heading_miss=given.get("heading_miss", 0.0),
            curvature_miss=given.get("curvature_miss", 0.0),
            ranges_given=given.get("heading_ranges", 0) + given.get("curvature_ranges", 0),
            ranges_active=tuple(
                (one["point"], one["datum"], one["end"]) for one in given.get("active", ())
            ),
        )


@dataclasses.dataclass(frozen=True)
class Run:
    """Points between which the adjacent curvatures change one way."""

    first_point: int
    last_point: int
    direction: int  #: 1 increasing, -1 decreasing, 0 constant


@dataclasses.dataclass(frozen=True)
class Analysis:
    """What points say before any curve is formed; `json` holds all that the program prints."""

    units: str
    size: float
    curvature: Array  #: of the adjacent circles, one for each point, nan at open ends; 1/units
    turning: Array  #: of the chords at each point, rad
    chord: Array  #: one for each segment
    heading: Array  #: of each chord, rad
    points_only_error: Array  #: of each segment, nan where it is not known
    runs: Tuple[Run, ...]
    vertices: int
    vertices_lower_bound: int
    inflections: int
    inflections_lower_bound: int
    warnings: Tuple[str, ...]
    json: Json = dataclasses.field(repr=False)

    @classmethod
    def of(cls, values: Json) -> "Analysis":
        points, segments = values["points"], values["segments"]
        return _taken(
            cls,
            values,
            curvature=column(points, "kappa"),
            turning=column(points, "turning"),
            chord=column(segments, "chord"),
            heading=column(segments, "heading"),
            points_only_error=column(segments, "points_only_error"),
            runs=tuple(_taken(Run, r) for r in values["runs"]),
            warnings=tuple(values.get("warnings", ())),
            json=values,
        )


@dataclasses.dataclass(frozen=True)
class DrawingAnalysis:
    """What a curvature comb would show of the curves of a drawing; `json` is all of it."""

    curves: Tuple[Json, ...]
    json: Json = dataclasses.field(repr=False)

    @classmethod
    def of(cls, values: Json) -> "DrawingAnalysis":
        return cls(tuple(values["curves"]), values)


@dataclasses.dataclass(frozen=True)
class Table:
    """Rows of a report, and its columns as arrays: `region["width"]`; `json` is all of it."""

    rows: Tuple[Json, ...]
    json: Json = dataclasses.field(repr=False)

    def __getitem__(self, name: str) -> Array:
        if not any(name in row for row in self.rows):
            raise KeyError(name)
        return column(self.rows, name)

    def __len__(self) -> int:
        return len(self.rows)


@dataclasses.dataclass(frozen=True)
class CarrierRow:
    """One curve family in `compare`."""

    carrier: str
    refusal: Optional[Json]
    pieces: Optional[int] = None
    control_points: Optional[int] = None
    continuity: Optional[int] = None
    follows: Optional[str] = None  #: continuity of the spirals that it follows, "G2" or "G3"
    vertices: Optional[int] = None
    inflections: Optional[int] = None
    error_bound: Optional[float] = None
    deviation: Optional[float] = None
    outside: Optional[float] = None
    seconds: Optional[float] = None
    monotone: Optional[bool] = None
    reason: str = ""


@dataclasses.dataclass(frozen=True)
class Suggestion:
    """How many vertices a tolerance would need."""

    tolerance: float
    formed: bool
    proved: bool
    vertices: Optional[int]
    refusal: str = ""
    option: str = ""  #: of ``obvid fit`` for this contour: ``--noise 0.1 --open``


@dataclasses.dataclass(frozen=True)
class Verification:
    """Whether a contour keeps what its file says."""

    holds: bool
    false_claim: Optional[str]  #: what the file says and is not so
    not_checked: Tuple[str, ...]
    certificate: Certificate

    @classmethod
    def of(cls, values: Json) -> "Verification":
        return cls(
            values["holds"],
            values["false_claim"]["what"] if values["false_claim"] else None,
            tuple(values["not_checked"]),
            Certificate.of(values["certificate"]),
        )


def carrier_rows(values: Json) -> List[CarrierRow]:
    return [_taken(CarrierRow, row) for row in values["carriers"]]


def suggestions(values: Json) -> List[Suggestion]:
    return [_taken(Suggestion, {"vertices": None, **row}) for row in values["rows"]]
