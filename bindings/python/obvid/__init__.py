# SPDX-License-Identifier: Apache-2.0
"""Obvid: fair contours through points, proved.

>>> import obvid
>>> c = obvid.fit([(0, 0), (10, 1), (19, 4), (26, 9), (30, 16)], noise=0.01)
>>> c.proved, c.certificate.vertices, c.certificate.inflections
(True, 0, 0)

Lengths are in units of the points, angles of arrays in radians, of options in degrees, indices count
from 0. docs/python.md explains it with pictures.
"""
from ._library import version as __version__
from .alignments import Alignment, alignment
from .contour import BSpline, Contour, Piece, Samples
from .cutting import CutProgram, cut
from .errors import (
    CancelledError,
    InputError,
    InternalError,
    NoContourError,
    NotProvedError,
    ObvidError,
    UsageError,
)
from .jobs import (
    Source,
    analyse,
    analyse_file,
    compare,
    compare_curves,
    compare_file,
    explain,
    fit,
    fit_many,
    fit_space,
    many,
    read,
    read_contour,
    read_space,
    read_text,
    JOINT_LIMIT,
    region,
    region_arcs,
    space_audit,
    suggest,
    suggest_file,
    verify,
    why_not,
    why_not_file,
    worksheet,
)
from .reports import (
    Analysis,
    CarrierRow,
    Certificate,
    DrawingAnalysis,
    FitReport,
    Segment,
    Suggestion,
    Table,
    Verification,
)
from .splines import Spline, nurbs, spline
from .space import Corner, SpaceCurve, SpaceSamples, SpaceVerification
from .surfaces import (
    Surface,
    SurfaceBranch,
    SurfaceCut,
    SurfaceSamples,
    SurfaceSection,
    Toolpath,
    read_surface,
    skin,
    surface,
    toolpath,
)

__all__ = [
    "Alignment", "Analysis", "BSpline", "CancelledError", "CarrierRow", "Certificate", "Contour",
    "Corner", "CutProgram", "DrawingAnalysis", "FitReport", "InputError", "InternalError", "NoContourError",
    "NotProvedError", "ObvidError", "Piece", "Samples", "Segment", "Source", "SpaceCurve",
    "SpaceSamples", "SpaceVerification", "Spline", "Suggestion", "Surface", "SurfaceBranch", "SurfaceCut",
    "SurfaceSamples", "SurfaceSection", "Table", "Toolpath",
    "UsageError", "Verification",
    "JOINT_LIMIT", "__version__", "alignment", "analyse", "analyse_file", "compare", "compare_curves", "compare_file", "cut", "explain", "fit", "fit_many", "fit_space", "many", "nurbs", "read", "read_contour",
    "read_space", "read_surface", "read_text", "region", "region_arcs", "space_audit", "skin", "spline", "suggest", "suggest_file", "surface", "toolpath",
    "verify", "why_not", "why_not_file", "worksheet",
]  # fmt: skip
