"""Verbs, losses and own functions as differentiable PyTorch operations.

``geograd.torch.iou(a, b, kind="Obb2")`` takes tensors of shape ``(..., 5)`` and gives a tensor of shape ``(...)``. Every
verb of :mod:`geograd` is here by its name, with derivatives of any order, ``torch.func`` and ``torch.compile``, and with
the forms :meth:`Verb.all_pairs`, ``row_max``, ``above``, ``sum``, ``mean`` and ``suppress``. :func:`function` does the same
for a function of your own, :func:`check` checks a gradient. :class:`Polygons` have holes and parts; :class:`Rings`,
:class:`Polylines` and :class:`Clouds` are paths, and :class:`Mesh` is one of triangles, :class:`Cloud` one of points with a tree; :func:`barycentric` interpolates between points, :func:`cells` measures Voronoi and power cells. Their areas, overlaps and distances have derivatives of any order, too.

Losses: ``Loss``, ``IoULoss``, ``GIoULoss``, ``DIoULoss``, ``CIoULoss``, ``EIoULoss``, ``ProbIoULoss``, ``KFIoULoss``,
``GWDLoss``, ``KLDLoss``.

Tensors on the CPU are lent to the library without a copy where they are contiguous. Those on CUDA stay there: NVRTC
compiles the kernel that the library writes. Searches, paths and suppression need the CPU; a search decides by numbers, and
``geograd.distance.replayed(*item)`` is a function by its decisions for one item, which :func:`function` runs on either. Half
precision is computed in float32 in losses, and in verbs under ``torch.autocast``.
"""

from __future__ import annotations

from typing import Any, Callable, Optional

import numpy as np
import torch

import geograd
from geograd import _nodes, _torch
from geograd._function import Function, reduced
from geograd._losses import (
    CIoULoss, DIoULoss, EIoULoss, GIoULoss, GWDLoss, IoULoss, KFIoULoss, KLDLoss, Loss, ProbIoULoss,
)
from geograd._torch_cells import CellMeasures, cells
from geograd._torch_cloud import Cloud
from geograd._torch_curves import CurvePath
from geograd._torch_mesh import Mesh
from geograd._torch_places import PlaceWeights, barycentric
from geograd._torch_polygons import (
    Clouds, Paths, Polygons, Polylines, Rings, buffer, buffer_area, buffer_perimeter, contains, difference, intersection, minkowski_sum, no_fit_polygon,
    symmetric_difference, union, union_area,
)
from geograd._torch_verbs import *  # noqa: F403
from geograd._torch_verbs import __all__ as _VERBS, Verb

__all__ = [
    "check", "function", "Loss", "IoULoss", "GIoULoss", "DIoULoss", "CIoULoss", "EIoULoss", "ProbIoULoss", "KFIoULoss",
    "GWDLoss", "KLDLoss", "CellMeasures", "Cloud", "Clouds", "CurvePath", "Mesh", "Paths", "PlaceWeights", "Polygons", "Polylines", "Rings", "Verb", "barycentric", "buffer", "buffer_area", "buffer_perimeter", "cells", "contains",
    "difference", "intersection", "minkowski_sum", "no_fit_polygon", "symmetric_difference", "union", "union_area", *_VERBS,
]


@torch.compiler.assume_constant_result
def _kept(node: Any) -> str:
    """The name of a node that a compiled graph has: the graph keeps no object, so that the node stays for ever."""
    _COMPILED.add(node)
    return str(node.name)


_COMPILED: set[Any] = set()


class _OnTensors:
    """A function of one's own on tensors."""

    def __init__(self, f: Function) -> None:
        self._node = _nodes.of_function(f)
        self._is_tuple, self._leaves, self._names = self._node.is_tuple, f._leaves, tuple(f._names)
        self.__name__ = f.__name__
        self.__qualname__ = getattr(f, "__qualname__", f.__name__)
        self.__module__ = f.__module__
        self.__doc__ = f.__doc__
        self.__wrapped__ = f

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        if torch.compiler.is_compiling():
            name = _kept(self._node)
            columns = _nodes.split(name, self._leaves, self._names, arguments)
            results = _torch.call(name, _torch.tensors(self.__name__, columns))
            return tuple(results) if self._is_tuple else results[0]
        arguments = self.__wrapped__._given(arguments, named)
        columns = _nodes.split(self.__name__, self._leaves, self._names, arguments)
        return _torch.of_node(self._node, self.__name__, columns)

    def __repr__(self) -> str:
        return f"<geograd.torch.function of {self.__wrapped__!r}>"

    def __reduce__(self) -> Any:
        return reduced(self, function, self.__wrapped__, ".__wrapped__.__wrapped__")


def function(f: Callable[..., Any]) -> Callable[..., Any]:
    """A function of your own on tensors: ``f`` is a ``geograd.function``, or becomes one.

    Arguments are tensors of shape ``(..., k)``, ``k`` numbers by the annotation of the argument; lone numbers have the
    shape ``(...)``. The result has as many axes in front.
    """
    return _OnTensors(f if isinstance(f, Function) else geograd.function(f))


def check(
    fn: Callable[..., Any],
    *inputs: Any,
    samples: int = 200,
    spread: float = 0.1,
    seed: int = 1,
    quiet: bool = False,
) -> geograd.Reports:
    """Runs the harness on the gradient that autograd has of ``fn``, prints its report and returns it.

    ``fn`` takes tensors; its results are summed. ``inputs`` are examples of its arguments: the harness checks ``fn`` at
    them, and at ``samples`` random inputs around them, whose numbers differ by ``spread`` times their size, or times the
    size of the whole argument where a number is zero. Tensors that require no gradient stay as they are, unless none does.
    """
    inputs = [torch.as_tensor(x) for x in inputs]
    free = [k for k, x in enumerate(inputs) if x.requires_grad and x.is_floating_point()]
    if not free:
        free = [k for k, x in enumerate(inputs) if x.is_floating_point()]
    sizes = [inputs[k].numel() for k in free]
    ends = np.cumsum([0, *sizes])

    def arguments(row: Any, grad: bool) -> list[torch.Tensor]:
        row = torch.from_numpy(np.array(row, dtype=np.float64))
        own = list(inputs)
        for k, low, high in zip(free, ends, ends[1:]):
            own[k] = row[low:high].reshape(inputs[k].shape).to(inputs[k].dtype).detach().requires_grad_(grad)
        return own

    def value(row: Any) -> float:
        with torch.no_grad():
            return float(fn(*arguments(row, False)).sum())

    def gradient(row: Any) -> Any:
        own = arguments(row, True)
        with torch.enable_grad():
            total = fn(*own).sum()
        grads = torch.autograd.grad(total, [own[k] for k in free], allow_unused=True)
        parts = [torch.zeros_like(own[k]) if g is None else g for k, g in zip(free, grads)]
        return np.concatenate([part.detach().double().reshape(-1).numpy() for part in parts])

    parts = [inputs[k].detach().double().reshape(-1).numpy() for k in free]
    sizes = [np.where(part != 0, np.abs(part), np.abs(part).max(initial=0) or 1.0) for part in parts]
    point, size = np.concatenate(parts), np.concatenate(sizes)
    rng = np.random.default_rng(seed)
    points = [point, *(point + spread * size * rng.standard_normal((samples, len(point))))]

    def inside(row: Any) -> bool:
        try:
            return bool(np.isfinite(value(row)))
        except (ValueError, RuntimeError):
            return False

    single = all(inputs[k].dtype == torch.float32 for k in free)
    name = getattr(fn, "__name__", type(fn).__name__)
    dtype = np.float32 if single else np.float64
    return geograd.check(
        value, gradient, takes=[len(point)], points=points, samples=0, hard=False, inside=inside, seed=seed, name=name, dtype=dtype,
        quiet=quiet
    )
