"""Scores of two boxes on tensors, item by item and of all pairs, with gradients: for stand-ins of torch libraries."""

from __future__ import annotations

from typing import Any, Callable, List, Optional, Sequence, Tuple

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor
from torch.autograd import forward_ad

import geograd.torch as _torch

from ._recorded import numbers

#: The same without types: ``geograd.torch`` makes its names of the table.
_on_tensors: Any = _torch

Array = NDArray[Any]


def array(x: Tensor) -> Array:
    """The numbers of a tensor in the memory of the processor."""
    made: Array = x.detach().cpu().contiguous().numpy()
    return made


def like(x: Array, tensor: Tensor) -> Tensor:
    """An array as a tensor where another one lies."""
    made = torch.from_numpy(np.require(x, requirements=["C", "W"]))
    return made if tensor.device.type == "cpu" else made.to(tensor.device)


def _transformed() -> bool:
    """Whether a compiler or ``torch.func`` looks on, for which the operators of ``geograd.torch`` have rules."""
    if torch.compiler.is_compiling() or getattr(forward_ad, "_current_level", 0) >= 0:
        return True
    return bool(getattr(torch._C, "_are_functorch_transforms_active", lambda: True)())


def _wants_gradient(*xs: Tensor) -> bool:
    return torch.is_grad_enabled() and any(x.requires_grad for x in xs)


class Score:
    """A number of two boxes, by a recorded function or by a verb of a kind of shape.

    Tensors on other devices are copied to the processor, and results back. Derivatives have any order.
    """

    def __init__(self, function: Any, kind: Optional[str] = None) -> None:
        self._f = function
        self._kind = {} if kind is None else {"kind": kind}
        # Here already: a compiler of graphs can make no operator.
        self._operator = _on_tensors.function(function) if kind is None else getattr(_on_tensors, function.__name__)

    def _exact(self, *xs: Tensor) -> Tensor:
        """The same by an operator of ``geograd.torch``."""
        device = xs[0].device
        found: Tensor = self._operator(*[x if x.device.type in ("cpu", "meta") else x.cpu() for x in xs], **self._kind)
        return found if found.device == device else found.to(device)

    def aligned(self, *xs: Tensor) -> Tensor:
        """Item i of both, of shape (..., k): a tensor of shape (...)."""
        if _transformed():
            return self._exact(*xs)
        if not _wants_gradient(*xs):
            return _aligned(self, xs, False)[0]
        found: Tensor = _Aligned.apply(self, *xs)
        return found

    def pairs(self, a: Tensor, b: Tensor) -> Tensor:
        """Every box of (..., N, k) with every one of (..., M, k): a tensor of shape (..., N, M)."""
        if _transformed():
            return self._exact(a.unsqueeze(-2), b.unsqueeze(-3))
        if not _wants_gradient(a, b):
            return _pairs(self, a, b)
        found: Tensor = _Pairs.apply(self, a, b)
        return found

    def suppressed(self, boxes: Tensor, scores: Tensor, overlap: float, classes: Optional[Tensor] = None) -> Tensor:
        """The places of boxes that no better one overlaps by more than a threshold, the best first."""
        of = None if classes is None else array(classes)
        # The library takes whole numbers of 32 bits.
        if of is not None and (of.dtype.kind not in "iu" or of.min(initial=0) < 0 or of.max(initial=0) >= 2**32):
            of = np.unique(of, return_inverse=True)[1].reshape(-1)
        kept = self._f.suppress(array(boxes), array(scores), float(overlap), classes=of, **self._kind)
        return like(np.asarray(kept, np.int64), boxes)

    def value(self, xs: Sequence[Array]) -> Array:
        return np.asarray(self._f.aligned(*xs, **self._kind))

    def value_grad(self, xs: Sequence[Array]) -> Tuple[Array, Tuple[Array, ...]]:
        found: Tuple[Array, Tuple[Array, ...]] = self._f.value_grad(*xs, **self._kind)
        return found

    def matrix(self, a: Array, b: Array) -> Array:
        return np.asarray(self._f.all_pairs(a, b, **self._kind))

    def matrix_vjp(self, a: Array, b: Array, upstream: Array) -> Tuple[Array, Array]:
        found: Tuple[Array, Array] = self._f.all_pairs_vjp(a, b, upstream, **self._kind)
        return found


class Kept:
    """Scores by their options, each made once, those of the first options before a compiler of graphs looks."""

    def __init__(self, make: Callable[..., Score], options: Tuple[Any, ...]) -> None:
        self._make = make
        self._scores = {options: make(*options)}

    def __call__(self, *options: Any) -> Score:
        if options not in self._scores:
            self._scores[options] = self._make(*options)
        return self._scores[options]


def kept(*options: Any) -> Callable[[Callable[..., Score]], Kept]:
    """Makes the scores that a function makes once for every choice of options, and those of these options now."""
    return lambda make: Kept(make, options)


class _Aligned(torch.autograd.Function):
    """Value and gradient in one pass: a score is one number, so that the gradient is as wide as the boxes."""

    @staticmethod
    def forward(ctx: Any, score: Score, *xs: Tensor) -> Tensor:
        ctx.score = score
        ctx.save_for_backward(*xs)
        value, ctx.grads = _aligned(score, xs, True)
        return value

    @staticmethod
    def backward(ctx: Any, *bars: Tensor) -> Any:
        (bar,) = bars
        xs = ctx.saved_tensors
        if torch.is_grad_enabled():
            return (None, *_again(ctx, lambda *xs: ctx.score._exact(*xs), bar))
        if ctx.grads is None:
            return (None, *[torch.zeros_like(x) if need else None for x, need in zip(xs, ctx.needs_input_grad[1:])])
        wide = bar.unsqueeze(-1)
        out = []
        for x, grad, need in zip(xs, ctx.grads, ctx.needs_input_grad[1:]):
            grad = grad.reshape(x.shape)
            out.append((grad * (wide if grad.dim() > bar.dim() else bar)).to(x.dtype) if need else None)
        return (None, *out)


class _Pairs(torch.autograd.Function):
    """All pairs, without a matrix of gradients."""

    @staticmethod
    def forward(ctx: Any, score: Score, a: Tensor, b: Tensor) -> Tensor:
        ctx.score = score
        ctx.save_for_backward(a, b)
        return _pairs(score, a, b)

    @staticmethod
    def backward(ctx: Any, *bars: Tensor) -> Any:
        (bar,) = bars
        a, b = ctx.saved_tensors
        if torch.is_grad_enabled():
            return (None, *_again(ctx, lambda a, b: ctx.score._exact(a.unsqueeze(-2), b.unsqueeze(-3)), bar))
        if bar.numel() == 0:
            return None, torch.zeros_like(a), torch.zeros_like(b)
        if a.dim() == 2 and b.dim() == 2:
            by_a, by_b = ctx.score.matrix_vjp(array(a), array(b), array(bar))
            return None, like(by_a, a), like(by_b, b)
        lead = bar.shape[:-2]
        lists = zip(_apart(a, lead), _apart(b, lead), bar.reshape(-1, *bar.shape[-2:]))
        grads = [ctx.score.matrix_vjp(array(x), array(y), array(up)) for x, y, up in lists]
        by = [torch.stack([like(g[k], x) for g in grads]).reshape(*lead, *x.shape[-2:]) for k, x in enumerate((a, b))]
        return None, by[0].sum_to_size(a.shape), by[1].sum_to_size(b.shape)


def _aligned(score: Score, xs: Sequence[Tensor], with_grads: bool) -> Tuple[Tensor, Optional[List[Tensor]]]:
    """The values of all items, and their gradients where they are wanted."""
    first = xs[0]
    lead = first.shape[:-1]
    if 0 in lead:
        return first.new_zeros(lead), None
    arrays = [array(x) for x in xs]
    if not with_grads:
        return like(np.asarray(score.value(arrays)), first).reshape(lead), None
    value, grads = score.value_grad(arrays)
    return like(np.asarray(value), first).reshape(lead), [like(np.asarray(grad), first) for grad in grads]


def _pairs(score: Score, a: Tensor, b: Tensor) -> Tensor:
    """The matrices of all pairs of lists."""
    if a.dim() == 2 and b.dim() == 2:
        return like(score.matrix(array(a), array(b)), a)
    lead = np.broadcast_shapes(tuple(a.shape[:-2]), tuple(b.shape[:-2]))
    size = (*lead, a.shape[-2], b.shape[-2])
    found = [like(score.matrix(array(x), array(y)), a) for x, y in zip(_apart(a, lead), _apart(b, lead))]
    return torch.stack(found).reshape(size) if found else a.new_zeros(size)


def _apart(x: Tensor, lead: Sequence[int]) -> Tensor:
    """The lists of boxes of a batch."""
    return x.expand(*lead, *x.shape[-2:]).reshape(-1, *x.shape[-2:])


def _again(ctx: Any, f: Callable[..., Tensor], bar: Tensor) -> Sequence[Optional[Tensor]]:
    """The gradient as a function that has a gradient."""
    xs = ctx.saved_tensors
    with torch.enable_grad():
        wanted = [x for x, need in zip(xs, ctx.needs_input_grad[1:]) if need]
        grads = iter(torch.autograd.grad(f(*xs), wanted, bar, create_graph=True))
    return [next(grads) if need else None for need in ctx.needs_input_grad[1:]]


__all__ = ["Array", "Score", "array", "kept", "like", "numbers"]
