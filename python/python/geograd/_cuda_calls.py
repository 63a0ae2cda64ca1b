"""The forms of verbs and own functions on arrays of a card: item by item, and of all pairs of two lists."""

from __future__ import annotations

import ctypes
import math
from typing import Any, Optional, Sequence

import numpy as np

from ._cuda_arrays import Array, Memory, Out, View, given, host_of, viewed
from ._cuda_kernels import text_of
from ._cuda_pairs import List, Pairs, ranges_of

_COUNT, _ADDRESS = ctypes.c_longlong, ctypes.c_void_p


def _lead(view: View, width: int, name: str) -> tuple[int, ...]:
    """The axes in front of the numbers of a row, which lie beside each other."""
    if not width:
        return view.shape
    if not view.shape or view.shape[-1] != width:
        raise ValueError(f"`{name}`: shape (..., {width}) is needed, not {view.shape}")
    if width > 1 and view.strides[-1] != 1:
        raise ValueError(f"`{name}`: the numbers of a row must lie beside each other; pass a contiguous copy")
    return view.shape[:-1]


def _steps(view: View, own: Sequence[int], lead: Sequence[int], name: str) -> tuple[int, int]:
    """The steps between rows of the last axis but one, and of the last one, of an array broadcast to the leading shape."""
    strides = [0] * (len(lead) - len(own)) + [
        0 if size == 1 else stride for size, stride in zip(own, view.strides)
    ]
    if len(lead) == 0:
        return 0, 0
    if len(lead) == 1:
        return strides[0], 0
    step = strides[-2]
    for k in range(len(lead) - 2):
        # All axes but the last one are one axis.
        if lead[k] > 1 and strides[k] != strides[-2] * math.prod(lead[k + 1 : -1]):
            raise ValueError(f"`{name}`: its leading axes are no list; pass a contiguous copy")
    return step, strides[-1]


def _flat(out: Any) -> list[Any]:
    """Places for results, in order."""
    if isinstance(out, (tuple, list)):
        return [one for part in out for one in _flat(part)]
    return [out]


def _wanted(out: Any, names: Sequence[str]) -> list[Any]:
    """What the caller has for each result: an array, or None for what is not wanted."""
    places = _flat(out)
    if len(places) != len(names):
        raise ValueError(
            f"out: {len(places)} arrays where {len(names)} are needed ({', '.join(names)}; None for what is not wanted)"
        )
    return places


class Calls:
    """The forms of a node on arrays."""

    __name__: str

    def _node(self, count: int, kind: Any, to: Any) -> Any:
        raise NotImplementedError

    def _run(self, form: str, arguments: Sequence[Any], kind: Any, to: Any = None, out: Any = None) -> list[Any]:
        count = len(arguments) // 2 if form == "jvp" else len(arguments) - (form == "vjp")
        node = self._node(count, kind, to)
        takes, gives = list(node.takes), list(node.gives)
        widths = [width for _, _, width in takes]
        values = ["value"] if len(gives) == 1 else [f"value {k}" for k in range(len(gives))]
        slopes = [f"by {name}" for name, _, _ in takes]
        results = values
        if form == "value_grad":
            if gives != [0]:
                raise ValueError(f"{self.__name__}: value_grad is of one number")
            gives, results = [*gives, *widths], [*values, *slopes]
        elif form == "vjp":
            takes, gives, results = [*takes, *(("upstream", None, width) for width in gives)], widths, slopes
        elif form == "jvp":
            takes = [*takes, *((f"along {name}", None, width) for name, _, width in takes)]
            gives, results = [*gives, *gives], [*values, *(f"{name} along" for name in values)]
        if len(arguments) != len(takes):
            raise TypeError(f"{node.name} takes {', '.join(name for name, _, _ in takes)}, not {len(arguments)} arguments")
        names = [name for name, _, _ in takes]
        views = [viewed(x, name) for x, name in zip(arguments, names)]
        space = Memory(views, names)
        leads = [_lead(view, width, name) for view, (name, _, width) in zip(views, takes)]
        lead = np.broadcast_shapes(*leads)
        sizes = [(*lead, width) if width else lead for width in gives]
        targets: list[Optional[Out]] = [None] * len(gives)
        places: list[Any] = targets
        if out is not None:
            places = _wanted(out, results)
            targets = given(places, results, sizes, views, space)
        # The kernel writes all results, also those that nobody wants.
        outs = [space.new(size, "number") if target is None else target for size, target in zip(sizes, targets)]
        total = math.prod(lead)
        if total:
            settings: list[tuple[Any, Any]] = [(total, _COUNT), (lead[-1] if len(lead) > 1 else 1, _COUNT)]
            for view, own, name in zip(views, leads, names):
                step, inner = _steps(view, own, lead, name)
                settings += [(view.address, _ADDRESS), (step, _COUNT), (inner, _COUNT)]
            settings += [(one.address, _ADDRESS) for one in outs]
            kernel = space.kernel(node, ("rows", form), lambda: text_of(node, form, space.number == "double"))
            space.run(kernel, total, settings)
            if any(target is not None and target.waits for target in targets):
                space.wait()
        return outs if out is None else places

    def __call__(self, *arguments: Any, kind: Any = None, to: Any = None, out: Any = None) -> Any:
        """The results of every item."""
        outs = self._run("value", arguments, kind, to, out)
        return outs[0] if len(outs) == 1 else tuple(outs)

    def value_grad(self, *arguments: Any, kind: Any = None, out: Any = None) -> Any:
        """The value of every item, one number, and its gradient by every argument."""
        value, *gradients = self._run("value_grad", arguments, kind, None, out)
        return value, tuple(gradients)

    def vjp(self, *arguments: Any, kind: Any = None, to: Any = None, out: Any = None) -> Any:
        """Cotangents of the arguments; that of the result comes last."""
        return tuple(self._run("vjp", arguments, kind, to, out))

    def jvp(self, *arguments: Any, kind: Any = None, to: Any = None, out: Any = None) -> Any:
        """The value and its derivative along directions, which come after the arguments."""
        return tuple(self._run("jvp", arguments, kind, to, out))

    def _pairs(self, a: Any, b: Any, kind: Any, own: int = 0, groups: Any = None) -> tuple[Pairs, Any]:
        node = self._node(2, kind, None)
        names = [name for name, _, _ in node.takes]
        if len(names) != 2 or node.gives != [0]:
            raise TypeError(f"{node.name}: forms of pairs are of two arguments and one number")
        views, lists = [viewed(a, names[0]), viewed(b, names[1])], []
        for view, (name, _, width) in zip(views, node.takes):
            lead = _lead(view, width, name)
            if len(lead) != 1:
                raise ValueError(f"`{name}`: a list of rows is needed, not shape {view.shape}")
            lists.append(List(view, lead[0], view.strides[0], max(width, 1)))
        space, ranges = Memory(views, names), None
        if groups is not None:
            offsets = [host_of(x, "groups") for x in groups]
            low, high = ranges_of(offsets, own, [x.count for x in lists])
            ranges = space.card.uploaded(low), space.card.uploaded(high)
        return Pairs(space, node, lists, own, ranges), node

    def all_pairs(self, a: Any, b: Any, *, kind: Any = None, out: Any = None) -> Any:
        """Every row of ``a`` with every row of ``b``: a matrix."""
        node = self._node(2, kind, None)
        lists = []
        for x, (name, _, width), axis in zip((a, b), node.takes, (1, 0)):
            view = viewed(x, name)
            if len(_lead(view, width, name)) != 1:
                raise ValueError(f"`{name}`: a list of rows is needed, not shape {view.shape}")
            lists.append(_Wide(view, axis))
        (matrix,) = self._run("value", lists, kind, None, out)
        return matrix

    def row_max(self, a: Any, b: Any, *, groups: Any = None, kind: Any = None) -> tuple[Array, Array]:
        """The largest result of every row of ``a``, and its row of ``b``; -inf and -1 where there is none.

        ``groups`` are the offsets of both lists: rows of a group have pairs with those of the same one.
        """
        return self._pairs(a, b, kind, 0, groups)[0].extreme(">")

    def row_min(self, a: Any, b: Any, *, groups: Any = None, kind: Any = None) -> tuple[Array, Array]:
        """The smallest result of every row of ``a``, and its row of ``b``; inf and -1 where there is none."""
        return self._pairs(a, b, kind, 0, groups)[0].extreme("<")

    def column_max(self, a: Any, b: Any, *, groups: Any = None, kind: Any = None) -> tuple[Array, Array]:
        """The largest result of every row of ``b``, and its row of ``a``."""
        return self._pairs(a, b, kind, 1, groups)[0].extreme(">")

    def column_min(self, a: Any, b: Any, *, groups: Any = None, kind: Any = None) -> tuple[Array, Array]:
        """The smallest result of every row of ``b``, and its row of ``a``."""
        return self._pairs(a, b, kind, 1, groups)[0].extreme("<")

    def above(self, a: Any, b: Any, threshold: float, *, groups: Any = None, kind: Any = None) -> tuple[Array, Array, Array]:
        """Every pair, with groups every pair of a group, whose result is above a threshold: rows of ``a``, rows of ``b``,
        results."""
        return self._pairs(a, b, kind, 0, groups)[0].found(">", float(threshold))

    def below(self, a: Any, b: Any, limit: float, *, groups: Any = None, kind: Any = None) -> tuple[Array, Array, Array]:
        """Every pair, with groups every pair of a group, whose result is below a limit."""
        return self._pairs(a, b, kind, 0, groups)[0].found("<", float(limit))

    def count_above(self, a: Any, b: Any, threshold: float, *, groups: Any = None, kind: Any = None) -> int:
        """How many pairs have a result above a threshold."""
        return self._pairs(a, b, kind, 0, groups)[0].count(">", float(threshold))

    def count_below(self, a: Any, b: Any, limit: float, *, groups: Any = None, kind: Any = None) -> int:
        """How many pairs have a result below a limit."""
        return self._pairs(a, b, kind, 0, groups)[0].count("<", float(limit))

    def sum(self, a: Any, b: Any, *, groups: Any = None, kind: Any = None) -> Array:
        """The sum of the results of all pairs, with groups of those of a group, as an array of one number."""
        return self._pairs(a, b, kind, 0, groups)[0].total()

    def sum_grad(self, a: Any, b: Any, *, groups: Any = None, kind: Any = None) -> tuple[Array, tuple[Array, Array]]:
        """The sum of the results of all pairs, with groups of those of a group, and its gradients by both lists."""
        pairs, node = self._pairs(a, b, kind, 0, groups)
        widths = [max(width, 1) for _, _, width in node.takes]
        gives = [1, *widths]
        by_a = pairs.sums("value_grad", gives, 1, widths[0])
        by_b = self._pairs(a, b, kind, 1, groups)[0].sums("value_grad", gives, 1 + widths[0], widths[1])
        return pairs.total(), (by_a, by_b)


class _Wide:
    """A list with an axis of one row: before its own, or after it."""

    def __init__(self, view: View, axis: int) -> None:
        self._view, self._axis = view, axis

    @property
    def __cuda_array_interface__(self) -> dict[str, Any]:
        view, size = self._view, self._view.dtype.itemsize
        shape, strides = list(view.shape), [stride * size for stride in view.strides]
        shape.insert(self._axis, 1)
        strides.insert(self._axis, 0)
        return {
            "shape": tuple(shape), "typestr": view.dtype.str, "data": (view.address, False), "strides": tuple(strides),
            "version": 3, "stream": None,
        }
