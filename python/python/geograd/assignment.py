"""One-to-one pairs of two lists: greedy, or of the largest sum.

Pairs are what ``geograd.iou.above`` gives: rows of ``a``, rows of ``b``, results. Pairs of different groups share no row, so
one call serves the pairs of all frames.
"""

import numpy as np

from . import _core


def _pairs(pairs):
    try:
        first, second, overlap = pairs
    except (TypeError, ValueError):
        raise TypeError("pairs: a tuple of first places, second places and overlaps is needed") from None
    return (
        np.ascontiguousarray(first, np.int64),
        np.ascontiguousarray(second, np.int64),
        np.ascontiguousarray(overlap, np.float64),
    )


def greedy(pairs):
    """The largest overlap first, then the largest one of those whose two ends are free, and so on."""
    return _core.assigned(*_pairs(pairs), True)


def largest(pairs):
    """The one-to-one pairs with the largest sum of overlaps, by first place; overlaps of zero or less are left out."""
    return _core.assigned(*_pairs(pairs), False)
