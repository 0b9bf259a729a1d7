# SPDX-License-Identifier: Apache-2.0
"""The C library behind the package (docs/c.md), loaded once, with the types of its functions."""
from __future__ import annotations

import ctypes as C
import json
import os
import pathlib
import signal
import threading
from typing import Any, Callable, Dict, Mapping, Optional

from .errors import CancelledError, ObvidError, error_of

ABI = 3

ProgressFunction = Callable[[str, float], None]
CancelledFunction = Callable[[], bool]


class ErrorStruct(C.Structure):
    _fields_ = [
        ("code", C.c_int),
        ("category", C.c_int),
        ("message", C.c_char_p),
        ("where", C.c_char_p),
        ("advice", C.c_char_p),
        ("points", C.POINTER(C.c_size_t)),
        ("point_count", C.c_size_t),
    ]


class NurbsStruct(C.Structure):
    _fields_ = [
        ("degree", C.c_int),
        ("count", C.c_size_t),
        ("knots", C.POINTER(C.c_double)),
        ("xy", C.POINTER(C.c_double)),
        ("weights", C.POINTER(C.c_double)),
    ]


_Progress = C.CFUNCTYPE(None, C.c_void_p, C.c_char_p, C.c_double)
_Cancelled = C.CFUNCTYPE(C.c_int, C.c_void_p)


class RunStruct(C.Structure):
    _fields_ = [
        ("user", C.c_void_p),
        ("progress", _Progress),
        ("cancelled", _Cancelled),
        ("threads", C.c_size_t),
    ]


def library_path() -> str:
    """Where the library is: OBVID_LIBRARY, or beside this file."""
    named = os.environ.get("OBVID_LIBRARY")
    if named:
        return os.path.abspath(named)  # the helper for CAD files is looked for beside it
    here = pathlib.Path(__file__).resolve().parent / "libobvid_c.so"
    if here.is_file():
        return str(here)
    raise ImportError(
        f"{here} is not there: install the wheel (tools/build_wheel), or set OBVID_LIBRARY to "
        "the libobvid_c.so of a build folder"
    )


def _load() -> C.CDLL:
    lib = C.CDLL(library_path())
    lib.obvid_abi.restype = C.c_int
    if lib.obvid_abi() != ABI:
        raise ImportError(
            f"{library_path()} has ABI {lib.obvid_abi()}, this package needs {ABI}: "
            "install both from the same version"
        )
    handle, text, size = C.c_void_p, C.c_char_p, C.c_size_t
    out = C.POINTER(C.c_void_p)
    error = C.POINTER(C.POINTER(ErrorStruct))
    run = C.POINTER(RunStruct)
    types: Dict[str, Any] = {
        "obvid_version": (text, []),
        "obvid_error_free": (None, [C.POINTER(ErrorStruct)]),
        "obvid_free": (None, [handle]),
        "obvid_points": (C.c_int, [handle, size, out, error]),
        "obvid_read_text": (C.c_int, [text, size, text, out, error]),
        "obvid_read_file": (C.c_int, [text, out, error]),
        "obvid_input_free": (None, [handle]),
        "obvid_fit": (C.c_int, [handle, text, run, out, out, error]),
        "obvid_stored": (C.c_int, [handle, text, run, out, error]),
        "obvid_verify": (C.c_int, [handle, run, out, error]),
        "obvid_contour_pieces": (size, [handle]),
        "obvid_contour_closed": (C.c_int, [handle]),
        "obvid_contour_length": (C.c_double, [handle]),
        "obvid_contour_warning": (text, [handle, size]),
        "obvid_contour_free": (None, [handle]),
        "obvid_evaluate": (C.c_int, [handle, C.c_int, handle, size, handle, handle, handle, error]),
        "obvid_derivatives": (C.c_int, [handle, handle, size, C.c_int, handle, error]),
        "obvid_contour_nurbs": (C.c_int, [handle, C.POINTER(C.POINTER(NurbsStruct)), error]),
        "obvid_nurbs_free": (None, [C.POINTER(NurbsStruct)]),
        "obvid_export": (C.c_int, [handle, text, text, run, out, error]),
        "obvid_surface_make": (
            C.c_int,
            [text, handle, size, handle, size, text, run, out, out, error],
        ),
        "obvid_surface_check": (C.c_int, [handle, text, run, out, error]),
        "obvid_surface_export": (C.c_int, [handle, text, text, run, out, error]),
        "obvid_alignment": (C.c_int, [handle, handle, text, run, out, out, out, error]),
        "obvid_compare_curves": (C.c_int, [handle, size, text, run, out, out, error]),
        "obvid_cut": (C.c_int, [handle, size, text, run, out, out, error]),
        "obvid_surface_toolpath": (C.c_int, [handle, text, run, out, out, error]),
        "obvid_surface_cut": (C.c_int, [handle, text, run, out, out, error]),
        "obvid_spline": (C.c_int, [handle, handle, text, text, run, out, out, out, error]),
        "obvid_nurbs_make": (C.c_int, [handle, text, text, run, out, out, out, error]),
        "obvid_surface_patches": (size, [handle]),
        "obvid_surface_warning": (text, [handle, size]),
        "obvid_surface_evaluate": (
            C.c_int,
            [handle, size, handle, size, handle, handle, handle, error],
        ),
        "obvid_surface_free": (None, [handle]),
        "obvid_worksheet": (C.c_int, [handle, text, text, run, out, error]),
        "obvid_analyse_file": (C.c_int, [handle, text, text, run, out, error]),
        "obvid_compare_file": (C.c_int, [handle, text, text, run, out, error]),
        "obvid_suggest_file": (C.c_int, [handle, text, text, run, out, error]),
        "obvid_why_not_file": (C.c_int, [handle, text, text, run, out, error]),
        "obvid_explain": (C.c_int, [text, out, error]),
        "obvid_space_points": (C.c_int, [handle, size, out, error]),
        "obvid_fit_space": (C.c_int, [handle, text, run, out, out, error]),
        "obvid_stored_space": (C.c_int, [handle, out, error]),
        "obvid_verify_space": (C.c_int, [handle, run, out, error]),
        "obvid_space_parts": (size, [handle]),
        "obvid_space_closed": (C.c_int, [handle]),
        "obvid_space_length": (C.c_double, [handle, size]),
        "obvid_space_warning": (text, [handle, size]),
        "obvid_space_evaluate": (
            C.c_int,
            [handle, size, handle, size, handle, handle, handle, handle, error],
        ),
        "obvid_space_export": (C.c_int, [handle, text, text, run, out, error]),
        "obvid_space_free": (None, [handle]),
        "obvid_region_arcs": (C.c_int, [handle, handle, handle, handle, error]),
        "obvid_joint_limit": (C.c_double, []),
        "obvid_space_audit": (C.c_int, [C.c_int, size, handle, handle, handle, run, out, error]),
        "obvid_verify_file": (C.c_int, [handle, text, run, out, error]),
        "obvid_surface_check_file": (C.c_int, [handle, text, text, run, out, error]),
        "obvid_surface_branches": (C.c_int, [handle, text, text, run, out, error]),
        "obvid_files_count": (size, [handle]),
        "obvid_files_suffix": (text, [handle, size]),
        "obvid_files_data": (handle, [handle, size, C.POINTER(C.c_size_t)]),
        "obvid_files_remark": (text, [handle, size]),
        "obvid_files_free": (None, [handle]),
    }
    for job in ("why_not", "suggest", "analyse", "region", "compare"):
        types["obvid_" + job] = (C.c_int, [handle, text, run, out, error])
    for name, (restype, argtypes) in types.items():
        function = getattr(lib, name)
        function.restype, function.argtypes = restype, argtypes
    return lib


lib = _load()
version: str = lib.obvid_version().decode()


def raise_error(error: Any, report: Optional[str] = None) -> ObvidError:
    """The exception of an error of the library, which is freed."""
    e = error.contents
    made = error_of(
        e.code,
        e.category,
        e.message.decode(),
        e.where.decode(),
        e.advice.decode(),
        [e.points[i] for i in range(e.point_count)],
        report,
    )
    lib.obvid_error_free(error)
    return made


def taken_text(pointer: C.c_void_p) -> Optional[str]:
    """The text that the library returned, which is freed."""
    if not pointer.value:
        return None
    text = C.string_at(pointer.value).decode()
    lib.obvid_free(pointer)
    return text


def options_text(options: Mapping[str, Any]) -> Optional[bytes]:
    """Options as the library takes them: JSON, or nothing."""
    given = {name: value for name, value in options.items() if value is not None}
    return json.dumps(given, allow_nan=False).encode() if given else None


class _Watched:
    """What the callbacks of one call need; Ctrl-C and exceptions of callbacks wait in `raised`."""

    __slots__ = ("progress", "cancelled", "raised")

    def __init__(
        self, progress: Optional[ProgressFunction], cancelled: Optional[CancelledFunction]
    ) -> None:
        self.progress = progress
        self.cancelled = cancelled
        self.raised: Optional[BaseException] = None


_watched: Dict[int, _Watched] = {}
_watched_lock = threading.Lock()
_next_key = 1


def _tell_progress(key: int, stage: bytes, fraction: float) -> None:
    watched = _watched[key]
    try:
        if watched.progress is not None and watched.raised is None:
            watched.progress(stage.decode(), fraction)
    except BaseException as raised:  # an exception cannot pass through C
        watched.raised = raised


def _ask_cancelled(key: int) -> int:
    watched = _watched[key]
    try:
        if watched.raised is not None:
            return 1
        return 1 if watched.cancelled is not None and watched.cancelled() else 0
    except BaseException as raised:
        watched.raised = raised
        return 1


_on_progress = _Progress(_tell_progress)
_on_cancelled = _Cancelled(_ask_cancelled)


def watched_of(options: Dict[str, Any]) -> Dict[str, Any]:
    """What of the options of a job is for its `Run`, taken out of them."""
    return {name: options.pop(name, None) for name in ("progress", "cancelled", "threads")}


class Run:
    """Callbacks and threads of one call: `with Run(progress, cancelled) as run: lib.obvid_fit(..., run, ...)`.

    Ctrl-C ends the work, and an exception of a callback is raised again behind the call. Python
    would raise KeyboardInterrupt inside the callback, where C cannot take it: while the library
    works, the default handler of the main thread is one that remembers.
    """

    __slots__ = ("watched", "threads", "key", "handler")

    def __init__(
        self,
        progress: Optional[ProgressFunction] = None,
        cancelled: Optional[CancelledFunction] = None,
        threads: Optional[int] = None,
    ) -> None:
        self.watched = _Watched(progress, cancelled)
        self.threads = 0 if threads is None else threads
        self.key = 0
        self.handler: Any = None

    def _interrupted(self, number: int, frame: Any) -> None:
        self.watched.raised = KeyboardInterrupt()

    def __enter__(self) -> RunStruct:
        global _next_key
        with _watched_lock:
            self.key = _next_key
            _next_key += 1
            _watched[self.key] = self.watched
        if threading.current_thread() is threading.main_thread():
            if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
                self.handler = signal.signal(signal.SIGINT, self._interrupted)
        return RunStruct(self.key, _on_progress, _on_cancelled, self.threads)

    def __exit__(self, kind: Any, value: Any, trace: Any) -> None:
        if self.handler is not None:
            signal.signal(signal.SIGINT, self.handler)
        with _watched_lock:
            del _watched[self.key]
        raised = self.watched.raised
        if raised is not None and (value is None or isinstance(value, CancelledError)):
            raise raised from None
