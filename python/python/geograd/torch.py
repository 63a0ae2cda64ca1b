"""Verbs and own functions as differentiable PyTorch operations.

``geograd.torch.iou(a, b, kind="Obb2")`` takes tensors of shape ``(..., 5)`` and gives a tensor of shape ``(...)``. Every
verb of :mod:`geograd` is here by its name, with derivatives of any order, ``torch.func`` and ``torch.compile``.
:func:`function` does the same for a function of your own. :class:`Polygons` have holes, parts, and derivatives of first order.

Tensors stay on the CPU: contiguous ones are lent to the library without a copy.
"""

from __future__ import annotations

import numpy as np
import torch

import geograd
from geograd import _nodes, _torch_polygons
from geograd._torch_polygons import Polygons, union_area

globals().update(_torch_polygons.OVERLAYS)
_ANY_POLYGONS = (Polygons, geograd.Polygons)

__all__ = ["check", "function", "Loss", "Polygons", "union_area", *_torch_polygons.OVERLAYS, *_nodes.LOSSES]


def _lead(node, xs):
    """The leading shape that all arguments broadcast to."""
    shapes = []
    for (name, _, width), x in zip(node.takes, xs):
        if width:
            if x.dim() == 0 or x.shape[-1] != width:
                raise ValueError(f"{node.name}: `{name}` needs a tensor of shape (..., {width}), not {tuple(x.shape)}")
            shapes.append(x.shape[:-1])
        else:
            shapes.append(x.shape)
    return torch.broadcast_shapes(*shapes)


def _lent(x, lead, width):
    """A tensor as an array of the leading shape; one item alone stays alone."""
    x = x.detach()
    if x.numel() != max(width, 1):
        x = x.expand(_nodes.size(lead, width))
    elif x.dim() > bool(width):
        x = x.reshape((width,) if width else ())
    return x.contiguous().numpy()


@torch.library.custom_op("geograd::call", mutates_args=(), device_types="cpu")
def _call(name: str, xs: list[torch.Tensor]) -> list[torch.Tensor]:
    node = _nodes.named(name)
    lead = _lead(node, xs)
    if 0 in lead:
        return [xs[0].new_empty(_nodes.size(lead, width)) for width in node.gives]
    arrays = [_lent(x, lead, width) for (_, _, width), x in zip(node.takes, xs)]
    results = []
    for result, width in zip(node.run(arrays), node.gives):
        result = torch.from_numpy(np.require(result, requirements=["C", "W"]))
        size = _nodes.size(lead, width)
        if result.numel() != int(np.prod(size)):
            # All arguments were one item.
            result = result.expand(size).clone()
        results.append(result.reshape(size))
    return results


@_call.register_fake
def _(name, xs):
    node = _nodes.named(name)
    lead = _lead(node, xs)
    return [xs[0].new_empty(_nodes.size(lead, width)) for width in node.gives]


def _summed(grads, xs):
    """Gradients by arguments that were broadcast."""
    return [grad.sum_to_size(x.shape) for grad, x in zip(grads, xs)]


def _whole(node, xs, bars):
    """Cotangents of all results, zeros for those that no one uses."""
    lead = _lead(node, xs)
    sizes = [_nodes.size(lead, width) for width in node.gives]
    return [
        xs[0].new_zeros(size) if bar is None else bar.expand(size) for bar, size in zip(bars, sizes)
    ]


def _setup(ctx, inputs, output):
    ctx.node_name = inputs[0]
    # A recorded function lives as long as its results wait for their gradients.
    ctx.node = _nodes.named(inputs[0])
    ctx.save_for_backward(*inputs[1])


def _backward(ctx, bars):
    node = _nodes.named(ctx.node_name)
    xs = list(ctx.saved_tensors)
    grads = _call(node.vjp().name, [*xs, *_whole(node, xs, bars)])
    return None, _summed(grads, xs)


_call.register_autograd(_backward, setup_context=_setup)


def _batched(node, size, in_dims, xs):
    """Arguments with the mapped axis in front, all of the same rank where they have it."""
    moved = []
    for x, d in zip(xs, in_dims):
        moved.append(x if d is None else x.movedim(d, 0))
    ranks = [x.dim() - (d is not None) - bool(t[2]) for x, d, t in zip(moved, in_dims, node.takes)]
    rank = max(ranks)
    out = []
    for x, d, own in zip(moved, in_dims, ranks):
        if d is not None:
            x = x.reshape(x.shape[0], *[1] * (rank - own), *x.shape[1:])
        out.append(x)
    # One argument at least has the axis, so that results have it, too.
    return out


@torch.library.register_vmap("geograd::call")
def _(info, in_dims, name, xs):
    node = _nodes.named(name)
    results = _call(name, _batched(node, info.batch_size, in_dims[1], xs))
    return results, [0] * len(results)


class _Function(torch.autograd.Function):
    """The same with the rules that ``torch.func`` looks for."""

    @staticmethod
    def forward(name, *xs):
        return tuple(_call(name, list(xs)))

    @staticmethod
    def setup_context(ctx, inputs, output):
        ctx.node_name = inputs[0]
        ctx.node = _nodes.named(inputs[0])
        ctx.save_for_backward(*inputs[1:])
        ctx.save_for_forward(*inputs[1:])

    @staticmethod
    def backward(ctx, *bars):
        node = _nodes.named(ctx.node_name)
        xs = list(ctx.saved_tensors)
        grads = _Function.apply(node.vjp().name, *xs, *_whole(node, xs, bars))
        return None, *_summed(grads, xs)

    @staticmethod
    def jvp(ctx, _, *tangents):
        node = _nodes.named(ctx.node_name)
        xs = list(ctx.saved_tensors)
        tangents = [torch.zeros_like(x) if t is None else t for x, t in zip(xs, tangents)]
        return _Function.apply(node.jvp().name, *xs, *tangents)[len(node.gives) :]

    @staticmethod
    def vmap(info, in_dims, name, *xs):
        node = _nodes.named(name)
        results = _Function.apply(name, *_batched(node, info.batch_size, in_dims[1:], xs))
        return results, tuple(0 for _ in results)


def _tensors(name, arguments):
    """Arguments as tensors of one format on the CPU."""
    found = [x for x in arguments if isinstance(x, torch.Tensor)]
    if not found:
        raise TypeError(f"geograd.torch.{name} takes tensors; geograd.{name} takes NumPy arrays")
    for x in found:
        if x.device.type not in ("cpu", "meta"):
            raise TypeError(
                f"geograd.torch.{name} computes on the CPU, and a tensor is on {x.device}: "
                "move it with .cpu(), and the result back with .to(device); gradients follow"
            )
        if x.is_floating_point() and x.dtype not in (torch.float32, torch.float64):
            raise TypeError(f"geograd.torch.{name} takes float32 and float64, not {x.dtype}: convert with .float()")
        if x.is_complex():
            raise TypeError(f"geograd.torch.{name} takes float32 and float64, not {x.dtype}")
    floats = [x.dtype for x in found if x.is_floating_point()]
    dtype = torch.float32 if floats and all(d == torch.float32 for d in floats) else torch.float64
    return [
        x.to(dtype) if isinstance(x, torch.Tensor) else torch.as_tensor(x, dtype=dtype) for x in arguments
    ]


@torch.compiler.assume_constant_result
def _known(verb, kind, count):
    """The name of a node, and whether it gives a tuple: constants of a compiled function."""
    node = _nodes.of_verb(verb, kind, count)
    return node.name, node.is_tuple


def _apply(name, is_tuple, arguments):
    xs = _tensors(name.split("(")[0], arguments)
    if torch.compiler.is_compiling():
        results = _call(name, xs)
    else:
        node = _nodes.named(name)
        if len(arguments) != len(node.takes):
            names = ", ".join(name for name, _, _ in node.takes)
            raise TypeError(f"{node.name} takes {names}, not {len(arguments)} arguments")
        _lead(node, xs)
        results = _Function.apply(name, *xs)
    return tuple(results) if is_tuple else results[0]


class _Verb:
    """A verb on tensors."""

    def __init__(self, name):
        self.__name__ = self.__qualname__ = name

    # The table has it, which a compiler of graphs must not ask.
    @property
    def __doc__(self):
        return getattr(geograd, self.__name__).__doc__

    def __repr__(self):
        return f"<geograd.torch.{self.__name__}>"

    def __reduce__(self):
        return (_verb, (self.__name__,))

    def __call__(self, *arguments, kind=None):
        if any(isinstance(x, _ANY_POLYGONS) for x in arguments):
            return _torch_polygons.run(self.__name__, arguments)
        return _apply(*_known(self.__name__, kind, len(arguments)), arguments)


_VERBS = {name: _Verb(name) for name in geograd._VERBS}


def _verb(name):
    return _VERBS[name]


@torch.compiler.assume_constant_result
def _kept(node):
    """The name of a node that a compiled graph has: the graph keeps no object, so that the node stays for ever."""
    _COMPILED.add(node)
    return node.name


_COMPILED = set()


def function(f):
    """A function of your own on tensors: ``f`` is a ``geograd.function``, or becomes one.

    Arguments are tensors of shape ``(..., k)``, ``k`` numbers by the annotation of the argument; lone numbers have the
    shape ``(...)``. The result has as many axes in front.
    """
    f = f if isinstance(f, geograd.Function) else geograd.function(f)
    node = _nodes.of_function(f)
    is_tuple, leaves, names = node.is_tuple, f._leaves, tuple(f._names)

    def on_tensors(*arguments):
        name = _kept(node) if torch.compiler.is_compiling() else node.name
        return _apply(name, is_tuple, _nodes.split(name, leaves, names, arguments))

    on_tensors.__name__ = on_tensors.__qualname__ = f.__name__
    on_tensors.__doc__ = f.__doc__
    on_tensors.__wrapped__ = f
    return on_tensors


class Loss(torch.nn.Module):
    """One minus a score of two boxes, reduced: ``Loss("giou", kind="Obb2")``.

    ``reduction`` is ``"mean"``, ``"sum"`` or ``"none"``; the mean of no boxes is 0, with gradient 0. The module has no
    parameters and no state.
    """

    def __init__(self, verb, kind="Obb2", reduction="mean"):
        super().__init__()
        if reduction not in ("mean", "sum", "none"):
            raise ValueError(f"reduction is 'mean', 'sum' or 'none', not {reduction!r}")
        self.verb, self.kind, self.reduction = verb, kind, reduction
        _nodes.of_verb(verb, kind, 2)
        self._score = _verb(verb)

    def forward(self, prediction, target):
        return self._reduced(1 - self._score(prediction, target, kind=self.kind))

    def _reduced(self, loss):
        if self.reduction == "none":
            return loss
        # An image without objects has no boxes, and its loss is no number less.
        return loss.sum() / max(loss.numel(), 1) if self.reduction == "mean" else loss.sum()

    def extra_repr(self):
        return f"{self.verb!r}, kind={self.kind!r}, reduction={self.reduction!r}"


#: The size at which the smooth L1 loss of centres becomes linear, of mmrotate.
_BETA = 1 / 9


class KFIoULoss(Loss):
    """The loss of shapes by :func:`geograd.kfiou` and that of centres (Yang et al. 2023), reduced: 0 for equal boxes.

    ``kfiou`` is blind to centres and at most 1/3 (of boxes in space ``1 / (2 ** 2.5 - 1)``), so its part of the loss is
    that bound less ``kfiou``: the gradient is that of ``1 - kfiou``. The part of centres is ``centers`` times the smooth
    L1 loss, linear from 1/9, of their offset along the target's axes, over the target's size. The paper and mmrotate
    measure it from anchors, which a loss of boxes has not. ``centers=0`` leaves it out; another loss has to place
    boxes then. ``Loss("kfiou")`` is plainly ``1 - kfiou``.
    """

    def __init__(self, kind="Obb2", reduction="mean", centers=1.0):
        super().__init__("kfiou", kind, reduction)
        self.centers = centers
        node = _nodes.of_verb("kfiou", kind, 2)
        self._is_flat = len(getattr(geograd, node.base.kinds[0])._fields) == 5
        self._bound = 1 / 3 if self._is_flat else 1 / (2**2.5 - 1)

    def forward(self, prediction, target):
        # Rounding alone makes the first part negative.
        loss = (self._bound - self._score(prediction, target, kind=self.kind)).clamp(min=0)
        if self.centers:
            loss = loss + self.centers * self._apart(prediction, target)
        return self._reduced(loss)

    def _apart(self, prediction, target):
        """The smooth L1 loss of the offset of centres, summed over the axes."""
        if self._is_flat:
            heading = target[..., 4]
            axes = _turned(prediction[..., :2] - target[..., :2], heading.cos(), heading.sin())
            size = target[..., 2:4]
        else:
            axes = _in_frame(prediction[..., :3] - target[..., :3], target[..., 6:10])
            size = target[..., 3:6]
        # A flat target has no share of an offset across it: its unit is that of length.
        share = (axes / torch.where(size > 0, size, torch.ones_like(size))).abs()
        return torch.where(share < _BETA, share * share * (0.5 / _BETA), share - 0.5 * _BETA).sum(-1)

    def extra_repr(self):
        return f"{super().extra_repr()}, centers={self.centers}"


def _turned(offset, cos, sin):
    """A vector of the plane in a frame whose first axis is (cos, sin)."""
    x, y = offset[..., 0], offset[..., 1]
    return torch.stack([cos * x + sin * y, cos * y - sin * x], -1)


def _in_frame(offset, quaternion):
    """A vector of space in the frame that a quaternion of any length (w, x, y, z) turns to."""
    unit = quaternion / quaternion.norm(dim=-1, keepdim=True)
    w, v = unit[..., :1], -unit[..., 1:]
    offset, v = torch.broadcast_tensors(offset, v)
    twice = 2 * torch.linalg.cross(v, offset)
    return offset + w * twice + torch.linalg.cross(v, twice)


def _loss(name, verb):
    def __init__(self, kind="Obb2", reduction="mean"):
        Loss.__init__(self, verb, kind, reduction)

    doc = f"One minus :func:`geograd.{verb}`, reduced."
    return type(name, (Loss,), {"__init__": __init__, "__doc__": doc, "__module__": __name__})


def check(fn, *inputs, samples=200, spread=0.1, seed=1, quiet=False):
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

    def arguments(row, grad):
        row = torch.from_numpy(np.array(row, dtype=np.float64))
        own = list(inputs)
        for k, low, high in zip(free, ends, ends[1:]):
            own[k] = row[low:high].reshape(inputs[k].shape).to(inputs[k].dtype).detach().requires_grad_(grad)
        return own

    def value(row):
        with torch.no_grad():
            return float(fn(*arguments(row, False)).sum())

    def gradient(row):
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

    def inside(row):
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


def __getattr__(name):
    if name in _nodes.LOSSES:
        made = _loss(name, _nodes.LOSSES[name])
        globals()[name] = made
        return made
    if name in geograd._VERBS:
        return _verb(name)
    raise AttributeError(f"module 'geograd.torch' has no attribute {name!r}")


def __dir__():
    return sorted([*globals(), *geograd._VERBS, *_nodes.LOSSES])
