# SPDX-License-Identifier: Apache-2.0
"""Contours of many series on the workers of a Dask cluster (docs/batch.md).

>>> import obvid.dask                                                  # doctest: +SKIP
>>> from distributed import Client                                     # doctest: +SKIP
>>> made = obvid.dask.fit_many(series, Client("scheduler:8786"), noise=0.01)   # doctest: +SKIP
"""
from __future__ import annotations

from typing import Any, Iterable, List, Optional, Union

from .contour import Contour
from .errors import ObvidError
from .jobs import Points, fit

__all__ = ["fit_many"]


def _fit_chunk(chunk: List[Points], options: Any) -> List[Union[Contour, ObvidError, ValueError]]:
    out: List[Union[Contour, ObvidError, ValueError]] = []
    for points in chunk:
        try:
            out.append(fit(points, **options))
        except (ObvidError, ValueError) as error:
            out.append(error)
    return out


def fit_many(
    series: Iterable[Points],
    client: Optional[Any] = None,
    *,
    chunk: int = 100,
    **options: Any,
) -> List[Union[Contour, ObvidError, ValueError]]:
    """What `fit` makes of each series, in their order; the error in its place where it makes none.

    The scheduler looks after the workers: a chunk whose worker dies is given to another one. A chunk
    that several workers have died of ends the call with Dask's `KilledWorker`.

    Args:
        series: as of `fit`; paths are opened by the workers.
        client: a `distributed.Client`; default: the current one.
        chunk: series of a task. A task costs some 2 ms, a contour of 100 points some 0.3 ms.
        Others as of `fit`.
    """
    if chunk < 1:
        raise ValueError("a chunk has one series at least")
    if client is None:
        from distributed import get_client

        client = get_client()
    all_series = list(series)
    chunks = [all_series[i : i + chunk] for i in range(0, len(all_series), chunk)]
    # not pure: equal chunks are tasks of their own, and nothing is looked up by a digest of all points
    futures = client.map(_fit_chunk, chunks, options=options, pure=False)
    return [one for made in client.gather(futures) for one in made]
