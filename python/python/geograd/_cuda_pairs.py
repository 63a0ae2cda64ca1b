"""Reductions of all pairs on a card, without their matrix: extremes, pairs beyond a threshold, sums with gradients.

A space has the memory, the stream and the kernels: of torch's tensors, or of other arrays.
"""

from __future__ import annotations

import ctypes
import math
from typing import Any, Callable, Optional, Protocol, Sequence

import numpy as np
from numpy.typing import NDArray

from ._cuda_kernels import NUMBERS, Kernel, Walk, functions_of, joined_extremes, joined_sums, text_of

#: As many threads as keep a card busy.
_ENOUGH = 1 << 17
#: A chunk of fewer pairs costs more than it gains.
_LEAST = 16
#: Sums that one thread adds.
_AT_ONCE = 512
_COUNT, _ADDRESS = ctypes.c_longlong, ctypes.c_void_p


class Space(Protocol):
    """Where arrays are."""

    @property
    def number(self) -> str:
        """The type of numbers in C."""

    def new(self, size: Sequence[int], kind: str) -> Any:
        """A new array: of ``"number"``, of ``"double"``, or of ``"place"``, whole numbers of 64 bits."""

    def address(self, x: Any) -> int:
        """Where an array begins."""

    def kernel(self, node: Any, key: Any, text: Callable[[], str]) -> Kernel:
        """The kernel of a text, made once for a node and a key."""

    def run(self, kernel: Kernel, threads: int, arguments: Sequence[tuple[Any, Any]]) -> None:
        """Launches a kernel."""

    def starts(self, counts: Any) -> tuple[Any, int]:
        """The sum of the counts before each, and of all."""


class List:
    """Rows of an argument: the array, how many rows, the step between rows and the width of a row in numbers."""

    def __init__(self, array: Any, count: int, step: int, width: int) -> None:
        self.array, self.count, self.step, self.width = array, count, step, width


def ranges_of(groups: Sequence[Any], own: int, counts: Sequence[int]) -> tuple[NDArray[Any], NDArray[Any]]:
    """The first row and the one after the last row of the others, of every own row, by the offsets of both lists."""
    if len(groups) != 2:
        raise TypeError("groups: the offsets of both lists are needed")
    offsets = [np.asarray(x) for x in groups]
    for name, x, count in zip("ab", offsets, counts):
        if x.size and x.dtype.kind not in "iu":
            raise TypeError(f"groups: the offsets of `{name}` are whole numbers, not {x.dtype}")
        if x.ndim != 1 or len(x) != len(offsets[0]) or len(x) == 0 or x[0] != 0 or x[-1] != count or (x[1:] < x[:-1]).any():
            raise ValueError(f"groups: the offsets of `{name}` must rise from 0 to {count}, as many as of the other list")
    sizes, others = np.diff(offsets[own]), offsets[1 - own].astype(np.int64)
    return np.repeat(others[:-1], sizes), np.repeat(others[1:], sizes)


#: The first row and the one after the last row of the others, of every own row; None for all.
Ranges = Optional[tuple[Any, Any]]


class Pairs:
    """All pairs of two lists on a space: ``own`` is the list (0 or 1) whose rows have results."""

    def __init__(self, space: Space, node: Any, lists: Sequence[List], own: int = 0, ranges: Ranges = None) -> None:
        self._space, self._node, self._lists, self._swapped, self._ranges = space, node, lists, own, ranges
        self._own, self._other = lists[own], lists[1 - own]
        self._places = ["own", "other"] if own == 0 else ["other", "own"]
        wanted = -(-_ENOUGH // max(self._own.count, 1))
        self._chunks = max(1, min(wanted, -(-self._other.count // _LEAST)))

    def _walk(self, form: str, gives: int, kind: Any, text: Callable[[Walk, str], str], more: Sequence[tuple[Any, Any]],
              weights: Optional[tuple[Any, int, int]] = None) -> None:
        """Runs a kernel over all pairs. ``weights`` are an array and its steps by rows and others."""
        space, node = self._space, self._node
        takes = [(x.width, place) for x, place in zip(self._lists, self._places)]
        if weights is not None:
            takes.append((1, "both"))

        def made() -> str:
            functions = functions_of(text_of(node, form, space.number == "double"))
            return text(Walk(space.number, takes, gives), functions)

        kernel = space.kernel(node, (form, self._swapped, *kind), made)
        low, high = (None, None) if self._ranges is None else map(space.address, self._ranges)
        arguments: list[tuple[Any, Any]] = [(self._own.count, _COUNT), (self._other.count, _COUNT), (self._chunks, _COUNT)]
        arguments += [(low or 0, _ADDRESS), (high or 0, _ADDRESS)]
        for own in self._lists:
            arguments += [(space.address(own.array), _ADDRESS), (own.step, _COUNT)]
        if weights is not None:
            array, step, inner = weights
            arguments += [(space.address(array), _ADDRESS), (step, _COUNT), (inner, _COUNT)]
        space.run(kernel, self._own.count * self._chunks, [*arguments, *more])

    def _number(self, x: float) -> tuple[Any, Any]:
        return (x, NUMBERS[self._space.number])

    def extreme(self, sign: str) -> tuple[Any, Any]:
        """The largest (``">"``) or the smallest (``"<"``) result of every own row, and its place; -inf or inf and -1 of none."""
        space, rows = self._space, self._own.count
        values, places = space.new((rows,), "number"), space.new((rows,), "place")
        if rows == 0:
            return values, places
        partial, at = space.new((rows, self._chunks), "number"), space.new((rows, self._chunks), "place")
        start = self._number(-math.inf if sign == ">" else math.inf)
        to = lambda *arrays: [(space.address(x), _ADDRESS) for x in arrays]
        self._walk("value", 1, ("extreme", sign), lambda walk, own: walk.extreme(own, sign), [start, *to(partial, at)])
        kernel = space.kernel(self._node, ("joined", sign), lambda: joined_extremes(space.number, sign))
        space.run(kernel, rows, [(rows, _COUNT), (self._chunks, _COUNT), *to(partial, at, values, places)])
        return values, places

    def _counts(self, sign: str, threshold: float) -> Any:
        counts = self._space.new((self._own.count, self._chunks), "place")
        if self._own.count:
            more = [self._number(threshold), (self._space.address(counts), _ADDRESS)]
            self._walk("value", 1, ("counts", sign), lambda walk, own: walk.counts(own, sign), more)
        return counts

    def count(self, sign: str, threshold: float) -> int:
        """How many pairs are beyond a threshold."""
        return self._space.starts(self._counts(sign, threshold))[1]

    def found(self, sign: str, threshold: float) -> tuple[Any, Any, Any]:
        """The pairs beyond a threshold, in the order of rows: own rows, others, results."""
        space = self._space
        starts, total = space.starts(self._counts(sign, threshold))
        rows, others, values = space.new((total,), "place"), space.new((total,), "place"), space.new((total,), "number")
        if total:
            more = [self._number(threshold), *[(space.address(x), _ADDRESS) for x in (starts, rows, others, values)]]
            self._walk("value", 1, ("found", sign), lambda walk, own: walk.found(own, sign), more)
        return rows, others, values

    def sums(self, form: str, gives: Sequence[int], first: int, width: int, factor: float = 1.0,
             weights: Optional[tuple[Any, int, int]] = None) -> Any:
        """The sums over all others of ``width`` results of a form from the one at ``first`` on, times a factor: own rows."""
        space, rows = self._space, self._own.count
        out = space.new((rows, width), "number")
        if rows == 0:
            return out
        totals = space.new((rows, self._chunks, width), "double")
        more = [(space.address(totals), _ADDRESS)]
        kind = ("sums", first, width, weights is not None)
        self._walk(form, sum(gives), kind, lambda walk, own: walk.sums(own, first, width), more, weights)
        self._added(totals, rows, self._chunks, width, rows * self._chunks, factor, out, space.number)
        return out

    def total(self, factor: float = 1.0) -> Any:
        """The sum of all results times a factor: an array of one number."""
        space, rows = self._space, self._own.count
        out = space.new((1,), "number")
        totals = space.new((max(rows, 1), self._chunks), "double")
        if rows:
            more = [(space.address(totals), _ADDRESS)]
            self._walk("value", 1, ("sums", 0, 1, False), lambda walk, own: walk.sums(own, 0, 1), more)
        # One thread alone would read all of them one after the other.
        left = rows * self._chunks
        while left > _AT_ONCE:
            groups = -(-left // _AT_ONCE)
            fewer = space.new((groups,), "double")
            self._added(totals, groups, _AT_ONCE, 1, left, 1.0, fewer, "double")
            totals, left = fewer, groups
        self._added(totals, 1, left, 1, left, factor, out, space.number)
        return out

    def _added(self, totals: Any, rows: int, chunks: int, width: int, of: int, factor: float, out: Any, number: str) -> None:
        space = self._space
        kernel = space.kernel(self._node, ("added", number), lambda: joined_sums(number))
        sizes = [(rows, _COUNT), (chunks, _COUNT), (width, _COUNT), (of, _COUNT), (factor, ctypes.c_double)]
        space.run(kernel, rows * width, [*sizes, (space.address(totals), _ADDRESS), (space.address(out), _ADDRESS)])
