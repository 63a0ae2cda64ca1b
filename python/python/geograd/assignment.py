"""One-to-one pairs of two lists: greedy, or of the largest sum.

Pairs are what ``geograd.iou.above`` gives: rows of ``a``, rows of ``b``, results. Pairs of different groups share no row, so
one call serves the pairs of all frames.
"""

from __future__ import annotations

from typing import Any, Optional, Sequence, Tuple

import numpy as np

from . import _core

#: Places in both lists, and what joins each pair.
Pairs = Tuple[Any, Any, Any]
Groups = Optional[Sequence[Any]]


def _pairs(pairs: Pairs) -> tuple[Any, Any, Any]:
    try:
        first, second, overlap = pairs
    except (TypeError, ValueError):
        raise TypeError("pairs: a tuple of first places, second places and overlaps is needed") from None
    return (
        np.ascontiguousarray(first, np.int64),
        np.ascontiguousarray(second, np.int64),
        np.ascontiguousarray(overlap, np.float64),
    )


def greedy(pairs: Pairs, groups: Groups = None) -> tuple[Any, Any, Any]:
    """The largest overlap first, then the largest one of those whose two ends are free, and so on.

    With ``groups``, the offsets of both lists, the pairs of one group come after those of another; groups run on all threads.
    """
    found: tuple[Any, Any, Any] = _core.assigned(*_pairs(pairs), True, groups)
    return found


def largest(pairs: Pairs, groups: Groups = None) -> tuple[Any, Any, Any]:
    """The one-to-one pairs with the largest sum of overlaps, by first place; overlaps of zero or less are left out.

    ``groups``, the offsets of both lists, change no result: groups run on all threads.
    """
    found: tuple[Any, Any, Any] = _core.assigned(*_pairs(pairs), False, groups)
    return found


def optimal(gains):
    """Rows and columns of the one-to-one pairs with the largest sum of a matrix of gains, by row.

    As many pairs as the shorter side has, those with negative gains included: what
    ``scipy.optimize.linear_sum_assignment(gains, maximize=True)`` gives.
    """
    return _core.assigned_matrix(np.ascontiguousarray(gains, np.float64))


def cheapest(costs, most=None):
    """Rows and columns of the one-to-one pairs with the smallest sum of a matrix of costs, by row.

    With ``most`` only pairs that cost less than it are joined: each saves ``most`` less its cost, and the sum of savings is
    the largest. Costs that are not finite are never joined then.
    """
    costs = np.ascontiguousarray(costs, np.float64)
    if most is None:
        return optimal(-costs)
    rows, columns = np.nonzero(costs < most)
    first, second, _ = largest((rows, columns, most - costs[rows, columns]))
    return first, second
