"""Verbs and own functions on arrays of a card of CUDA: CuPy's, Numba's, JAX's and others; torch is not needed.

``geograd.cuda.iou(a, b, kind="Obb2")`` takes any objects with ``__cuda_array_interface__`` or DLPack, reads them where they
are, and gives a :class:`Array`, which ``cupy.asarray`` takes without a copy. Every verb of :mod:`geograd` that is a straight line
is here by its name, with ``value_grad``, ``vjp``, ``jvp``, ``all_pairs`` and reductions of all pairs; :func:`function` does the
same for a function of your own. Tensors of torch have :mod:`geograd.torch`.

NVRTC compiles a kernel at the first call, by the package ``cuda-bindings``. All runs on the stream that other streams wait for.
Kernels check no shape: invalid rows have results without a meaning, rows with NaN have NaN.
"""

from __future__ import annotations

import ctypes
import math
from typing import Any, Callable, Sequence

import numpy as np

import geograd

from . import _nodes
from ._cuda_arrays import Array, Memory, View, viewed
from ._cuda_kernels import Unavailable, text_of
from ._cuda_pairs import List, Pairs
from ._function import Function

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


class _Calls:
    """The forms of a node on arrays."""

    __name__: str

    def _node(self, count: int, kind: Any, to: Any) -> Any:
        raise NotImplementedError

    def _run(self, form: str, arguments: Sequence[Any], kind: Any, to: Any = None) -> list[Array]:
        count = len(arguments) // 2 if form == "jvp" else len(arguments) - (form == "vjp")
        node = self._node(count, kind, to)
        takes, gives = list(node.takes), list(node.gives)
        widths = [width for _, _, width in takes]
        if form == "value_grad":
            if gives != [0]:
                raise ValueError(f"{self.__name__}: value_grad is of one number")
            gives = [*gives, *widths]
        elif form == "vjp":
            takes, gives = [*takes, *(("upstream", None, width) for width in gives)], widths
        elif form == "jvp":
            takes, gives = [*takes, *((f"along {name}", None, width) for name, _, width in takes)], [*gives, *gives]
        if len(arguments) != len(takes):
            raise TypeError(f"{node.name} takes {', '.join(name for name, _, _ in takes)}, not {len(arguments)} arguments")
        names = [name for name, _, _ in takes]
        views = [viewed(x, name) for x, name in zip(arguments, names)]
        space = Memory(views, names)
        leads = [_lead(view, width, name) for view, (name, _, width) in zip(views, takes)]
        lead = np.broadcast_shapes(*leads)
        outs = [space.new((*lead, width) if width else lead, "number") for width in gives]
        total = math.prod(lead)
        if total:
            sizes: list[tuple[Any, Any]] = [(total, _COUNT), (lead[-1] if len(lead) > 1 else 1, _COUNT)]
            for view, own, name in zip(views, leads, names):
                step, inner = _steps(view, own, lead, name)
                sizes += [(view.address, _ADDRESS), (step, _COUNT), (inner, _COUNT)]
            sizes += [(out.address, _ADDRESS) for out in outs]
            kernel = space.kernel(node, ("rows", form), lambda: text_of(node, form, space.number == "double"))
            space.run(kernel, total, sizes)
        return outs

    def __call__(self, *arguments: Any, kind: Any = None, to: Any = None) -> Any:
        """The results of every item."""
        outs = self._run("value", arguments, kind, to)
        return outs[0] if len(outs) == 1 else tuple(outs)

    def value_grad(self, *arguments: Any, kind: Any = None) -> tuple[Array, tuple[Array, ...]]:
        """The value of every item, one number, and its gradient by every argument."""
        value, *gradients = self._run("value_grad", arguments, kind)
        return value, tuple(gradients)

    def vjp(self, *arguments: Any, kind: Any = None, to: Any = None) -> tuple[Array, ...]:
        """Cotangents of the arguments; that of the result comes last."""
        return tuple(self._run("vjp", arguments, kind, to))

    def jvp(self, *arguments: Any, kind: Any = None, to: Any = None) -> tuple[Array, ...]:
        """The value and its derivative along directions, which come after the arguments."""
        return tuple(self._run("jvp", arguments, kind, to))

    def _pairs(self, a: Any, b: Any, kind: Any, own: int = 0) -> tuple[Pairs, Any]:
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
        return Pairs(Memory(views, names), node, lists, own), node

    def all_pairs(self, a: Any, b: Any, *, kind: Any = None) -> Array:
        """Every row of ``a`` with every row of ``b``: a matrix."""
        node = self._node(2, kind, None)
        lists = []
        for x, (name, _, width), axis in zip((a, b), node.takes, (1, 0)):
            view = viewed(x, name)
            if len(_lead(view, width, name)) != 1:
                raise ValueError(f"`{name}`: a list of rows is needed, not shape {view.shape}")
            lists.append(_Wide(view, axis))
        (matrix,) = self._run("value", lists, kind)
        return matrix

    def row_max(self, a: Any, b: Any, *, kind: Any = None) -> tuple[Array, Array]:
        """The largest result of every row of ``a``, and its row of ``b``; -inf and -1 where there is none."""
        return self._pairs(a, b, kind)[0].extreme(">")

    def row_min(self, a: Any, b: Any, *, kind: Any = None) -> tuple[Array, Array]:
        """The smallest result of every row of ``a``, and its row of ``b``; inf and -1 where there is none."""
        return self._pairs(a, b, kind)[0].extreme("<")

    def column_max(self, a: Any, b: Any, *, kind: Any = None) -> tuple[Array, Array]:
        """The largest result of every row of ``b``, and its row of ``a``."""
        return self._pairs(a, b, kind, 1)[0].extreme(">")

    def column_min(self, a: Any, b: Any, *, kind: Any = None) -> tuple[Array, Array]:
        """The smallest result of every row of ``b``, and its row of ``a``."""
        return self._pairs(a, b, kind, 1)[0].extreme("<")

    def above(self, a: Any, b: Any, threshold: float, *, kind: Any = None) -> tuple[Array, Array, Array]:
        """Every pair whose result is above a threshold: rows of ``a``, rows of ``b``, results."""
        return self._pairs(a, b, kind)[0].found(">", float(threshold))

    def below(self, a: Any, b: Any, threshold: float, *, kind: Any = None) -> tuple[Array, Array, Array]:
        """Every pair whose result is below a threshold."""
        return self._pairs(a, b, kind)[0].found("<", float(threshold))

    def count_above(self, a: Any, b: Any, threshold: float, *, kind: Any = None) -> int:
        """How many pairs have a result above a threshold."""
        return self._pairs(a, b, kind)[0].count(">", float(threshold))

    def sum(self, a: Any, b: Any, *, kind: Any = None) -> Array:
        """The sum of the results of all pairs, as an array of one number."""
        return self._pairs(a, b, kind)[0].total()

    def sum_grad(self, a: Any, b: Any, *, kind: Any = None) -> tuple[Array, tuple[Array, Array]]:
        """The sum of the results of all pairs, and its gradients by both lists."""
        pairs, node = self._pairs(a, b, kind)
        widths = [max(width, 1) for _, _, width in node.takes]
        gives = [1, *widths]
        by_a = pairs.sums("value_grad", gives, 1, widths[0])
        by_b = self._pairs(a, b, kind, 1)[0].sums("value_grad", gives, 1 + widths[0], widths[1])
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


class Verb(_Calls):
    """A verb on arrays of a card."""

    def __init__(self, name: str) -> None:
        self.__name__ = self.__qualname__ = name

    def _node(self, count: int, kind: Any, to: Any) -> Any:
        return _nodes.of_verb(self.__name__, kind, count, to)

    def __repr__(self) -> str:
        return f"<geograd.cuda.{self.__name__}>"

    def __reduce__(self) -> Any:
        return _verb, (self.__name__,)


class _Own(_Calls):
    """A function of one's own on arrays of a card."""

    def __init__(self, f: Function) -> None:
        self.__name__, self.__wrapped__ = f.__name__, f

    def _node(self, count: int, kind: Any, to: Any) -> Any:
        if kind is not None or to is not None:
            raise TypeError("kind= and to= choose a row of a verb; a function of one's own has the shapes of its annotations")
        return _nodes.of_function(self.__wrapped__)


def function(f: Callable[..., Any]) -> _Own:
    """A function of your own on arrays of a card: ``f`` is a ``geograd.function``, or becomes one.

    An argument of several shapes is as many arrays.
    """
    return _Own(f if isinstance(f, Function) else geograd.function(f))


_VERBS = {name: Verb(name) for name in geograd._VERBS}


def _verb(name: str) -> Verb:
    return _VERBS[name]


def __getattr__(name: str) -> Verb:
    try:
        return _VERBS[name]
    except KeyError:
        raise AttributeError(f"geograd.cuda has no {name!r}; {_nodes.alike(name, _VERBS)}") from None


__all__ = ["Array", "Unavailable", "Verb", "function", *sorted(_VERBS)]
globals().update(_VERBS)
