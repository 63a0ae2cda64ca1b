"""Verbs and own functions on arrays of a card of CUDA: CuPy's, Numba's, JAX's and others; torch is not needed.

``geograd.cuda.iou(a, b, kind="Obb2")`` takes any objects with ``__cuda_array_interface__`` or DLPack, reads them where they
are, and gives an :class:`Array`, which ``cupy.asarray`` takes without a copy. Every verb of :mod:`geograd` that is a straight
line is here by its name, with ``value_grad``, ``vjp``, ``jvp``, ``all_pairs`` and reductions of all pairs; :func:`function`
does the same for a function of your own, such as a search by the decisions of one item, ``geograd.distance.replayed(*item)``.
Searches themselves run on the processor. Tensors of torch have :mod:`geograd.torch`.

``out=`` takes results: one array, or for several a tuple or a list, with None for what is not wanted. They are in C order, in the
format of the arguments, and share no memory with them. An error leaves them as they were. ``groups=(offsets_a, offsets_b)`` keeps
pairs of reductions within groups; offsets are lists, or arrays of the processor or of the card.

NVRTC compiles a kernel at the first call, by the package ``cuda-bindings``. All runs on the stream that other streams wait for;
a call with ``out=`` of a stream that does not wait, or of DLPack, ends when the results are there. Kernels check no shape: invalid
rows have results without a meaning, rows with NaN have NaN.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable

import geograd
from geograd import _nodes
from geograd._cuda_arrays import Array, OnCard
from geograd._cuda_calls import Calls
from geograd._cuda_kernels import Unavailable
from geograd._cuda_verbs import *  # noqa: F403
from geograd._cuda_verbs import __all__ as _VERBS, Verb
from geograd._function import Function

if TYPE_CHECKING:
    # The types of all forms, which verbs and own functions share.
    _Calls = Verb[Any]
else:
    _Calls = Calls


class OwnFunction(_Calls):
    """A function of one's own on arrays of a card."""

    def __init__(self, f: Function) -> None:
        self.__name__, self.__wrapped__ = f.__name__, f

    def _node(self, count: int, kind: Any, to: Any) -> Any:
        if kind is not None or to is not None:
            raise TypeError("kind= and to= choose a row of a verb; a function of one's own has the shapes of its annotations")
        return _nodes.of_function(self.__wrapped__)


def function(f: Callable[..., Any]) -> OwnFunction:
    """A function of your own on arrays of a card: ``f`` is a ``geograd.function``, or becomes one.

    An argument of several shapes is as many arrays.
    """
    return OwnFunction(f if isinstance(f, Function) else geograd.function(f))


if not TYPE_CHECKING:
    # Type checkers would believe that every name is there.
    def __getattr__(name):
        raise AttributeError(f"geograd.cuda has no {name!r}; {_nodes.alike(name, _VERBS)}")


__all__ = ["Array", "OnCard", "OwnFunction", "Unavailable", "Verb", "function", *_VERBS]
