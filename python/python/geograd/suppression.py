"""Suppression of pairs whose overlaps are known: soft, by clusters, by the whole matrix.

Pairs are what ``geograd.iou.above(boxes, boxes, threshold)`` gives: rows, rows, overlaps, of which a pair counts once in either
order. ``score`` is the least score that counts, before suppression and after, ``most`` the most detections that are kept.
Detections of two ``classes`` do not suppress each other. ``geograd.iou.suppress`` finds the pairs itself, and keeps or drops.
"""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .assignment import _pairs


def _run(
    method: str, scores: Any, pairs: Any, threshold: float, sigma: Any, score: Any, most: Any, classes: Any, upstream: Any = None
) -> Any:
    first, second, overlap = _pairs(pairs)
    low, high = np.minimum(first, second), np.maximum(first, second)
    # Each pair once, also where both orders are there; a box does not suppress itself.
    _, places = np.unique(np.stack([low, high]), axis=1, return_index=True)
    once = np.zeros(len(first), bool)
    once[places] = True
    once &= low != high
    classes = None if classes is None else np.asarray(classes).tolist()
    scores = np.ascontiguousarray(scores, np.float64)
    found = _core.suppressed(
        method, scores, first[once], second[once], overlap[once], (float(threshold), score, most, classes), sigma, upstream
    )
    return found, once


def soft(
    scores: ArrayLike, pairs: Any, *, threshold: float = 0.0, sigma: Optional[float] = None, score: Optional[float] = None,
    most: Optional[int] = None, classes: Optional[ArrayLike] = None,
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Places and lowered scores of the detections that are kept, the best first (Bodla et al. 2017).

    Scores fall by ``1 - overlap`` for overlaps above the threshold; with ``sigma`` by ``exp(-overlap**2 / sigma)`` for all.
    """
    places, lowered = _run("soft", scores, pairs, threshold, sigma, score, most, classes)[0]
    return places, lowered


def soft_vjp(
    scores: ArrayLike, pairs: Any, upstream: ArrayLike, *, threshold: float = 0.0, sigma: Optional[float] = None, score: Optional[float] = None,
    most: Optional[int] = None, classes: Optional[ArrayLike] = None,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Cotangents of all scores and of the overlaps of all pairs, from those of the scores that :func:`soft` gives."""
    scores, bars = np.asarray(scores, np.float64), np.asarray(upstream, np.float64).tolist()
    (_, both), once = _run("soft", scores, pairs, threshold, sigma, score, most, classes, bars)
    by_pairs = np.zeros(len(once))
    by_pairs[once] = both[len(scores) :]
    return both[: len(scores)], by_pairs


def matrix(
    scores: ArrayLike, pairs: Any, *, sigma: Optional[float] = None, score: Optional[float] = None, most: Optional[int] = None,
    classes: Optional[ArrayLike] = None,
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Places and lowered scores of the detections that are kept, the best first (matrix NMS, Wang et al. 2020).

    Every score falls once, by the overlaps with all better detections, less what these have lost themselves.
    """
    places, lowered = _run("matrix", scores, pairs, 0.0, sigma, score, most, classes)[0]
    return places, lowered


def cluster(
    scores: ArrayLike, pairs: Any, *, threshold: float = 0.5, score: Optional[float] = None, most: Optional[int] = None,
    classes: Optional[ArrayLike] = None,
) -> NDArray[np.int64]:
    """The places that usual suppression keeps, the best first, found round by round (cluster NMS, Zheng et al. 2021)."""
    places: NDArray[np.int64] = _run("cluster", scores, pairs, threshold, None, score, most, classes)[0][0]
    return places
