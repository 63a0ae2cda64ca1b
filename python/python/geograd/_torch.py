"""Calls of nodes on tensors, with their derivatives: what :mod:`geograd.torch` is made of."""

from __future__ import annotations

import math

import numpy as np
import torch

from torch.autograd import forward_ad

from geograd import _core, _cuda, _nodes

_FLOATS = (torch.float32, torch.float64)
_PLAIN = (torch.Tensor, torch.nn.Parameter)
_DEVICES = ("cpu", "cuda", "meta")


def lead_of(node, xs):
    """The leading shape that all arguments broadcast to."""
    shapes = []
    for (name, _, width), x in zip(node.takes, xs):
        shape = x.shape
        if width:
            if not shape or shape[-1] != width:
                raise ValueError(f"{node.name}: `{name}` needs a tensor of shape (..., {width}), not {tuple(shape)}")
            shape = shape[:-1]
        shapes.append(shape)
    first = shapes[0]
    return first if all(shape == first for shape in shapes) else torch.broadcast_shapes(*shapes)


def _lent(x, lead, width):
    """A tensor as an array of the leading shape; one item alone stays alone."""
    x = x.detach()
    if x.numel() != max(width, 1):
        size = _nodes.size(lead, width)
        x = x if x.shape == size else x.expand(size)
    elif x.dim() > bool(width):
        x = x.reshape((width,) if width else ())
    return (x if x.is_contiguous() else x.contiguous()).numpy()


def computed(node, xs):
    """The results of a node, as new tensors."""
    lead = lead_of(node, xs)
    if _cuda.is_there(xs[0]):
        return _cuda.computed(node, xs, lead)
    if 0 in lead:
        return [xs[0].new_empty(_nodes.size(lead, width)) for width in node.gives]
    arrays = [_lent(x, lead, width) for (_, _, width), x in zip(node.takes, xs)]
    results = []
    for result, width in zip(node.run(arrays), node.gives):
        flags = result.flags
        if not (flags.c_contiguous and flags.writeable):
            result = np.require(result, requirements=["C", "W"])
        size = (*lead, width) if width else lead
        result = torch.from_numpy(result)
        if result.shape != size:
            # All arguments were one item.
            result = result.expand(size).clone() if result.numel() != math.prod(size) else result.reshape(size)
        results.append(result)
    return results


@torch.library.custom_op("geograd::call", mutates_args=(), device_types=("cpu", "cuda"))
def call(name: str, xs: list[torch.Tensor]) -> list[torch.Tensor]:
    return computed(_nodes.named(name), xs)


@call.register_fake
def _(name, xs):
    node = _nodes.named(name)
    lead = lead_of(node, xs)
    return [xs[0].new_empty(_nodes.size(lead, width)) for width in node.gives]


def _summed(grads, xs):
    """Gradients by arguments that were broadcast."""
    return [grad if grad.shape == x.shape else grad.sum_to_size(x.shape) for grad, x in zip(grads, xs)]


def _whole(node, xs, bars):
    """Cotangents of all results, zeros for those that no one uses."""
    if len(bars) == 1 and bars[0] is not None:
        return bars
    lead = lead_of(node, xs)
    sizes = [_nodes.size(lead, width) for width in node.gives]
    return [xs[0].new_zeros(size) if bar is None else bar.expand(size) for bar, size in zip(bars, sizes)]


def _setup(ctx, inputs, output):
    ctx.node_name = inputs[0]
    # A recorded function lives as long as its results wait for their gradients.
    ctx.node = _nodes.named(inputs[0])
    ctx.save_for_backward(*inputs[1])


def _backward(ctx, bars):
    node = _nodes.named(ctx.node_name)
    xs = list(ctx.saved_tensors)
    grads = call(node.vjp().name, [*xs, *_whole(node, xs, bars)])
    return None, _summed(grads, xs)


call.register_autograd(_backward, setup_context=_setup)


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
    results = call(name, _batched(node, info.batch_size, in_dims[1], xs))
    return results, [0] * len(results)


class _Mapped(torch.autograd.Function):
    """A node with the rules that ``torch.func`` looks for."""

    @staticmethod
    def forward(name, *xs):
        return tuple(call(name, list(xs)))

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
        grads = _Mapped.apply(node.vjp().name, *xs, *_whole(node, xs, bars))
        return None, *_summed(grads, xs)

    @staticmethod
    def jvp(ctx, _, *tangents):
        node = _nodes.named(ctx.node_name)
        xs = list(ctx.saved_tensors)
        tangents = [torch.zeros_like(x) if t is None else t for x, t in zip(xs, tangents)]
        return _Mapped.apply(node.jvp().name, *xs, *tangents)[len(node.gives) :]

    @staticmethod
    def vmap(info, in_dims, name, *xs):
        node = _nodes.named(name)
        results = _Mapped.apply(name, *_batched(node, info.batch_size, in_dims[1:], xs))
        return results, tuple(0 for _ in results)


class _Eager(torch.autograd.Function):
    """A node on plain tensors: without the dispatcher, which takes longer than a hundred boxes."""

    @staticmethod
    def forward(ctx, node, *xs):
        ctx.node = node
        ctx.save_for_backward(*xs)
        ctx.save_for_forward(*xs)
        return tuple(computed(node, xs))

    @staticmethod
    def backward(ctx, *bars):
        node, xs = ctx.node, ctx.saved_tensors
        inputs = [*xs, *_whole(node, xs, bars)]
        grads = applied(node.vjp(), inputs)
        return None, *_summed(grads, xs)

    @staticmethod
    def jvp(ctx, _, *tangents):
        node, xs = ctx.node, ctx.saved_tensors
        tangents = [torch.zeros_like(x) if t is None else t for x, t in zip(xs, tangents)]
        return _Mapped.apply(node.jvp().name, *xs, *tangents)[len(node.gives) :]


class _Less(torch.autograd.Function):
    """The sum or the mean of one minus a score: one step of autograd in place of four."""

    @staticmethod
    def forward(ctx, node, is_mean, *xs):
        ctx.node = node
        ctx.save_for_backward(*xs)
        loss = 1 - computed(node, xs)[0]
        ctx.size, ctx.count = loss.shape, max(loss.numel(), 1) if is_mean else 1
        return loss.sum() / ctx.count if is_mean else loss.sum()

    @staticmethod
    def backward(ctx, bar):
        xs = ctx.saved_tensors
        bar = -(bar / ctx.count).expand(ctx.size)
        return None, None, *_summed(applied(ctx.node.vjp(), [*xs, bar]), xs)


def reduced_less(verb, kind, is_mean, xs):
    """The sum or the mean of one minus a verb of tensors of one format; None where it has to be taken step by step."""
    if torch.compiler.is_compiling() or is_transformed() or has_tangents() or any(type(x) not in _PLAIN for x in xs):
        return None
    return _Less.apply(_nodes.of_verb(verb, kind, len(xs)), is_mean, *xs)


def is_transformed():
    """Whether a transform of ``torch.func`` or a mode of the dispatcher is active."""
    return torch._C._are_functorch_transforms_active() or torch._C._len_torch_dispatch_stack() > 0


def applied(node, xs):
    """The results of a node on tensors of one format, with their derivatives."""
    if torch.compiler.is_compiling():
        return tuple(call(node.name, xs))
    if is_transformed() or any(type(x) not in _PLAIN for x in xs):
        return _Mapped.apply(node.name, *xs)
    has_gradient = torch.is_grad_enabled() and any(x.requires_grad for x in xs)
    if has_gradient or has_tangents():
        return _Eager.apply(node, *xs)
    return tuple(computed(node, xs))


def lacks(name, x, lacks_it):
    """Raises an error for what a device does not compute."""
    if lacks_it and _cuda.is_there(x):
        raise TypeError(
            f"geograd.torch.{name} computes on the CPU, and a tensor is on {x.device}: move it with .cpu(), and the result back"
        )


def tensors(name, arguments, casts=False):
    """Arguments as tensors of one format and device; half precision is float32 under autocast, or if asked to."""
    dtypes, device = set(), None
    for x in arguments:
        if isinstance(x, torch.Tensor):
            if x.device.type not in _DEVICES:
                raise TypeError(
                    f"geograd.torch.{name} computes on the CPU and on CUDA, and a tensor is on {x.device}: "
                    "move it with .cpu(), and the result back with .to(device); gradients follow"
                )
            if device is not None and x.device != device:
                raise TypeError(f"geograd.torch.{name}: one tensor is on {device}, another on {x.device}")
            dtypes.add(x.dtype)
            device = x.device
    if len(dtypes) == 1 and len(arguments) == sum(isinstance(x, torch.Tensor) for x in arguments):
        (dtype,) = dtypes
        if dtype in _FLOATS:
            return list(arguments)
    if not dtypes:
        raise TypeError(f"geograd.torch.{name} takes tensors; geograd.{name} takes NumPy arrays")
    floats = {dtype for dtype in dtypes if dtype.is_floating_point}
    for dtype in dtypes - set(_FLOATS):
        if dtype.is_complex:
            raise TypeError(f"geograd.torch.{name} takes float32 and float64, not {dtype}")
        if dtype.is_floating_point and not (casts or torch.is_autocast_enabled(device.type)):
            raise TypeError(
                f"geograd.torch.{name} takes float32 and float64, not {dtype}: convert with .float(); "
                "under torch.autocast this happens by itself"
            )
    # Double, for whole numbers alone and for half precision beside double.
    dtype = torch.float64 if torch.float64 in floats or not floats else torch.float32
    return [x.to(dtype) if isinstance(x, torch.Tensor) else torch.as_tensor(x, dtype=dtype, device=device) for x in arguments]


@torch.compiler.assume_constant_result
def _known(verb, kind, count, to):
    """The name of a node, and whether it gives a tuple: constants of a compiled function."""
    node = _nodes.of_verb(verb, kind, count, to)
    return node.name, node.is_tuple


def of_verb(verb, arguments, kind, to=None, casts=False):
    """The results of a verb on tensors."""
    if torch.compiler.is_compiling():
        name, is_tuple = _known(verb, kind, len(arguments), to)
        results = call(name, tensors(verb, arguments, casts))
        return tuple(results) if is_tuple else results[0]
    return of_node(_nodes.of_verb(verb, kind, len(arguments), to), verb, arguments, casts)


def of_node(node, name, arguments, casts=False):
    """The results of a node on what a caller gives."""
    xs = tensors(name, arguments, casts)
    if len(xs) != len(node.takes):
        names = ", ".join(name for name, _, _ in node.takes)
        raise TypeError(f"{node.name} takes {names}, not {len(xs)} arguments")
    results = applied(node, xs)
    return tuple(results) if node.is_tuple else results[0]


@torch.library.custom_op("geograd::valid", mutates_args=(), device_types=("cpu", "cuda"))
def valid(kind: str, x: torch.Tensor) -> torch.Tensor:
    """Whether each row is a shape: of finite numbers within the limits of the kind."""
    rows = x.detach().reshape(-1, x.shape[-1]).double().cpu().contiguous().numpy()
    return torch.from_numpy(_core.valid(kind, rows)).reshape(x.shape[:-1]).to(x.device)


@valid.register_fake
def _(kind, x):
    return x.new_empty(x.shape[:-1], dtype=torch.bool)



def has_tangents():
    """Whether forward-mode differentiation is active."""
    return forward_ad._current_level >= 0
