# SPDX-License-Identifier: Apache-2.0
"""What can go wrong: one exception for each category of error, with the code of the program."""
from __future__ import annotations

import json
from typing import Any, Dict, List, Optional, Type


class ObvidError(Exception):
    """Base of all errors of Obvid.

    Attributes:
        code: number of the error, 401 for E401 (`obvid explain E401`).
        message: one sentence.
        where: file and line, point, or option that it is about; may be empty.
        advice: what to do; may be empty.
        points: indices (from 0) of the points that it is about.
        report: the report of the job where there is one, else None.
    """

    def __init__(
        self,
        code: int,
        message: str,
        where: str = "",
        advice: str = "",
        points: Optional[List[int]] = None,
        report: Optional[str] = None,
    ) -> None:
        self.code = code
        self.message = message
        self.where = where
        self.advice = advice
        self.points = points or []
        self.report: Optional[Dict[str, Any]] = json.loads(report) if report else None
        text = f"E{code}: {message}"
        if where:
            text += f" ({where})"
        if advice:
            text += f"; {advice}"
        super().__init__(text)

    def __reduce__(self) -> Any:
        report = json.dumps(self.report) if self.report is not None else None
        return (
            type(self),
            (self.code, self.message, self.where, self.advice, self.points, report),
        )


class InternalError(ObvidError):
    """A fault of Obvid or of the machine (E1xx)."""


class CancelledError(ObvidError):
    """The work was cancelled (E103)."""


class UsageError(ObvidError, ValueError):
    """An option or a call that is not possible (E2xx)."""


class InputError(ObvidError, ValueError):
    """The input cannot be read (E3xx)."""


class NoContourError(ObvidError):
    """No such contour exists (E4xx); `why_not` says what would do."""


class NotProvedError(ObvidError):
    """A contour was formed and does not keep its promise (E5xx).

    Attributes:
        contour: the contour that was formed, or None.
        surface: the surface, where it was one.
    """

    contour: Any = None
    surface: Any = None


_CATEGORIES: Dict[int, Type[ObvidError]] = {
    1: InternalError,
    2: UsageError,
    3: InputError,
    4: NoContourError,
    5: NotProvedError,
}


def error_of(
    code: int,
    category: int,
    message: str,
    where: str,
    advice: str,
    points: List[int],
    report: Optional[str],
) -> ObvidError:
    """The exception of an error of the library."""
    kind: Type[ObvidError] = _CATEGORIES.get(category, InternalError)
    if code == 103:
        kind = CancelledError
    return kind(code, message, where, advice, points, report)
