"""Verbs, losses and own functions as differentiable JAX functions, computed on the CPU by the library, on a card by Pallas.

``geograd.jax.iou(a, b, kind="Obb2")`` takes arrays of shape ``(..., 5)`` and gives one of shape ``(...)``;
``geograd.jax.iou.all_pairs(a, b, kind="Obb2")`` gives a matrix. ``jit``, ``grad``, ``vmap``, forward mode (``jvp``,
``jacfwd``, ``hessian``) and derivatives of any order work; under ``jit`` the library runs in a callback on the host.

Arrays on a card of CUDA stay there: the library's program becomes a kernel of Pallas. Such kernels check no shape. In float32 they have
the library's bits but for few last digits; sines, exponentials and angles of float64 are those of CUDA's own library. The host computes
searches, paths, columns, and programs of more than 6,000 operations, such as gradients of freely rotated boxes of space, which take
minutes to compile. ``GEOGRAD_JAX_PALLAS=off`` leaves all to the host; ``interpret`` runs kernels on the CPU, for tests. JAX on other
cards computes on the host. On an H200, 1 number in 300,000 of float32 and 1 in 20 of float64 had another last digit.

:class:`Polygons` (with holes and parts), :class:`Rings`, :class:`Polylines` and :class:`Clouds` are columns, trees with one leaf:
``geograd.jax.iou(polygons, others)`` and the other verbs of columns have derivatives by every vertex. ``union``,
``intersection``, ``difference`` and ``symmetric_difference`` give such polygons, with first derivatives; under ``jit``, which needs
to know how many vertices they have, ``capacity=`` says so, and the result is a :class:`PolygonBuffer`.

A :class:`Mesh` has queries with derivatives by points, rays, solids, poses and vertices; ``cells``, ``buffer_area``,
``buffer_perimeter``, ``barycentric`` and :class:`CurvePath` are those of :mod:`geograd`. The host computes them, with first derivatives backwards; distances, closest
points and rays of a mesh, its energies, and ``barycentric`` have further ones (``jacrev`` of ``grad``).

Losses: ``loss("giou", a, b)``, and by their names ``iou_loss``, ``giou_loss``, ``diou_loss``, ``ciou_loss``, ``eiou_loss``,
``probiou_loss``, ``kfiou_loss``, ``gwd_loss``, ``kld_loss``.
"""

from __future__ import annotations

from typing import Any, Callable, Literal, Optional, Protocol, Union

import jax.numpy as jnp

import geograd
from geograd import _jax, _nodes
from geograd._function import Function, reduced
from geograd._jax_columns import Clouds, Paths, Polygons, Polylines, Rings, contains, union_area
from geograd._jax_mesh import Mesh
from geograd._jax_overlays import PolygonBuffer, difference, intersection, minkowski_sum, no_fit_polygon, symmetric_difference, union
from geograd._jax_plane import CellMeasures, CurvePath, PlaceWeights, barycentric, buffer_area, buffer_perimeter, cells
from geograd._jax_verbs import *  # noqa: F403
from geograd._jax_verbs import __all__ as _VERBS, Verb

__all__ = [
    "function", "loss", "iou_loss", "giou_loss", "diou_loss", "ciou_loss", "eiou_loss", "probiou_loss", "kfiou_loss", "gwd_loss",
    "kld_loss", "CellMeasures", "Clouds", "CurvePath", "Mesh", "Paths", "PlaceWeights", "PolygonBuffer", "Polygons", "Polylines", "Rings", "Verb", "barycentric", "buffer_area",
    "buffer_perimeter", "cells", "contains", "difference",
    "intersection", "minkowski_sum", "no_fit_polygon", "symmetric_difference", "union", "union_area", *_VERBS,
]

Reduction = Literal["mean", "sum", "none"]
Array = Any


class _OnArrays:
    """A function of one's own on JAX's arrays."""

    def __init__(self, f: Function) -> None:
        self._node = _nodes.of_function(f)
        self.__name__ = f.__name__
        self.__qualname__ = getattr(f, "__qualname__", f.__name__)
        self.__module__ = f.__module__
        self.__doc__ = f.__doc__
        self.__wrapped__ = f

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        f = self.__wrapped__
        arguments = f._given(arguments, named)
        columns = [jnp.asarray(x) for x in arguments]
        return _jax.applied(self._node, _nodes.split(self.__name__, f._leaves, f._names, columns))

    def __repr__(self) -> str:
        return f"<geograd.jax.function of {self.__wrapped__!r}>"

    def __reduce__(self) -> Any:
        return reduced(self, function, self.__wrapped__, ".__wrapped__.__wrapped__")


def function(f: Callable[..., Any]) -> Callable[..., Any]:
    """A function of your own on JAX's arrays: ``f`` is a ``geograd.function``, or becomes one."""
    return _OnArrays(f if isinstance(f, Function) else geograd.function(f))


def loss(
    verb: str,
    prediction: Array,
    target: Array,
    *,
    kind: str = "Obb2",
    reduction: Reduction = "mean",
    weight: Optional[Array] = None,
    avg_factor: Union[float, Array, None] = None,
) -> Array:
    """One minus a score of two boxes, reduced: ``loss("giou", a, b)``.

    ``reduction`` is ``"mean"``, ``"sum"`` or ``"none"``; the mean of no boxes is 0. ``weight`` is a factor of each box's
    loss, of which the mean counts; ``avg_factor`` divides the sum in place of the number of boxes.
    """
    return _reduced(1 - _score(verb, prediction, target, kind), reduction, weight, avg_factor)


def _score(verb: str, a: Array, b: Array, kind: str) -> Array:
    return _jax.applied(_nodes.of_verb(verb, kind, 2), (a, b))


def _reduced(losses: Array, reduction: Reduction, weight: Optional[Array], avg_factor: Any) -> Array:
    if reduction not in ("mean", "sum", "none"):
        raise ValueError(f"reduction is 'mean', 'sum' or 'none', not {reduction!r}")
    if weight is not None:
        weight = jnp.asarray(weight)
        losses = losses * (weight.mean(-1) if weight.ndim == losses.ndim + 1 else weight)
    if avg_factor is not None and reduction == "sum":
        raise ValueError("avg_factor is for the reductions 'mean' and 'none': it divides the sum of a mean")
    if reduction == "none":
        return losses
    if avg_factor is not None:
        return losses.sum() / jnp.maximum(avg_factor, 1e-7)
    return losses.sum() / max(losses.size, 1) if reduction == "mean" else losses.sum()


class NamedLoss(Protocol):
    """A loss of one score; see :func:`loss`."""

    def __call__(
        self,
        prediction: Array,
        target: Array,
        *,
        kind: str = "Obb2",
        reduction: Reduction = "mean",
        weight: Optional[Array] = None,
        avg_factor: Union[float, Array, None] = None,
    ) -> Array: ...


def _named(verb: str) -> NamedLoss:
    def named(
        prediction: Array,
        target: Array,
        *,
        kind: str = "Obb2",
        reduction: Reduction = "mean",
        weight: Optional[Array] = None,
        avg_factor: Union[float, Array, None] = None,
    ) -> Array:
        return loss(verb, prediction, target, kind=kind, reduction=reduction, weight=weight, avg_factor=avg_factor)

    named.__name__ = named.__qualname__ = f"{verb}_loss"
    named.__doc__ = f"One minus :func:`geograd.{verb}`, reduced; see :func:`loss`."
    return named


iou_loss = _named("iou")
giou_loss = _named("giou")
diou_loss = _named("diou")
ciou_loss = _named("ciou")
eiou_loss = _named("eiou")
probiou_loss = _named("probiou")


def _root(x: Array) -> Array:
    """The square root, with derivative zero at zero, where boxes are equal."""
    return jnp.where(x > 0, jnp.sqrt(jnp.where(x > 0, x, 1.0)), 0.0)


def _bounded(distance: Array, fun: str, tau: float) -> Array:
    if fun not in ("log1p", "sqrt", "none"):
        raise ValueError(f"fun is 'log1p', 'sqrt' or 'none', not {fun!r}")
    distance = jnp.log1p(distance) if fun == "log1p" else _root(distance) if fun == "sqrt" else distance
    return 1 - 1 / (tau + distance) if tau >= 1 else distance


def _sizes(x: Array) -> Array:
    return x[..., 2:4] if x.shape[-1] == 5 else x[..., 3:6]


def kfiou_loss(
    prediction: Array,
    target: Array,
    *,
    kind: str = "Obb2",
    reduction: Reduction = "mean",
    weight: Optional[Array] = None,
    avg_factor: Union[float, Array, None] = None,
) -> Array:
    """The bound of :func:`geograd.kfiou` less it, reduced: 0 for boxes of equal shape, blind to their centres.

    Another loss has to place boxes; :class:`geograd.torch.KFIoULoss` has one of centres beside it.
    """
    bound = 1 / 3 if jnp.shape(prediction)[-1] == 5 else 1 / (2**2.5 - 1)
    losses = jnp.maximum(bound - _score("kfiou", prediction, target, kind), 0)
    return _reduced(losses, reduction, weight, avg_factor)


def gwd_loss(
    prediction: Array,
    target: Array,
    *,
    kind: str = "Obb2",
    reduction: Reduction = "mean",
    fun: str = "log1p",
    tau: float = 1.0,
    normalize: bool = True,
    weight: Optional[Array] = None,
    avg_factor: Union[float, Array, None] = None,
) -> Array:
    """The loss by :func:`geograd.wasserstein`, as :class:`geograd.torch.GWDLoss`."""
    distance = _score("wasserstein", prediction, target, kind)
    if normalize:
        a, b = _sizes(jnp.asarray(prediction)), _sizes(jnp.asarray(target))
        product = a.prod(-1) * b.prod(-1)
        distance = distance / jnp.where(product > 0, product, 1.0) ** (0.5 / a.shape[-1])
    return _reduced(_bounded(distance, fun, tau), reduction, weight, avg_factor)


def kld_loss(
    prediction: Array,
    target: Array,
    *,
    kind: str = "Obb2",
    reduction: Reduction = "mean",
    fun: str = "log1p",
    tau: float = 1.0,
    sqrt: bool = True,
    weight: Optional[Array] = None,
    avg_factor: Union[float, Array, None] = None,
) -> Array:
    """The loss by :func:`geograd.kullback_leibler` of the target from the prediction, as :class:`geograd.torch.KLDLoss`."""
    divergence = _score("kullback_leibler", target, prediction, kind)
    return _reduced(_bounded(_root(divergence) if sqrt else divergence, fun, tau), reduction, weight, avg_factor)
