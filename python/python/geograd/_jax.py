"""Calls of nodes on JAX's arrays, with their derivatives: what :mod:`geograd.jax` is made of.

A node is a primitive of JAX, and so is its derivative along directions, whose transpose is the node of cotangents. So JAX
has forward and reverse mode and their combinations from two rules. On a card of CUDA either is a kernel of Pallas.
"""

from __future__ import annotations

import functools

import jax
import jax.numpy as jnp
import numpy as np
from jax.extend.core import Primitive
from jax.interpreters import ad, batching, mlir

from geograd import _jax_pallas, _nodes


def lead_of(node, xs):
    """The leading shape that all arguments broadcast to."""
    shapes = []
    for (name, _, width), x in zip(node.takes, xs):
        if width and (x.ndim == 0 or x.shape[-1] != width):
            raise ValueError(f"{node.name}: `{name}` needs an array of shape (..., {width}), not {x.shape}")
        shapes.append(x.shape[:-1] if width else x.shape)
    return np.broadcast_shapes(*shapes)


def _computed(node, xs):
    """The results of a node as arrays of NumPy; all arguments have the leading shape."""
    xs = [np.asarray(x) for x in xs]
    lead = lead_of(node, xs)
    if 0 in lead:
        return [np.empty(_nodes.size(lead, width), xs[0].dtype) for width in node.gives]
    results = node.run([np.ascontiguousarray(x) for x in xs])
    return [np.asarray(r, xs[0].dtype).reshape(_nodes.size(lead, w)) for r, w in zip(results, node.gives)]


def _along(node, active, xs):
    """Arguments and directions of the node of directions, of those that are active: zeros for the others."""
    count = len(node.takes)
    given = iter(xs[count:])
    zeros = [next(given) if is_active else np.zeros_like(x) for x, is_active in zip(xs, active)]
    return [*xs[:count], *zeros]


class Kind:
    """A primitive: what it computes on the host, what its results look like, and its kernel for a card, if it has one.

    ``kernel(xs, interpret, **of)`` gives the results, or None where the host has to compute them.
    """

    def __init__(self, name, host, shapes, kernel=None):
        self.primitive = primitive = Primitive(name)
        primitive.multiple_results = True
        self.host, self.shapes, self.kernel = host, shapes, kernel
        primitive.def_impl(self._run)
        primitive.def_abstract_eval(
            lambda *xs, **of: [jax.core.ShapedArray(one.shape, one.dtype) for one in shapes(xs, **of)]
        )
        mlir.register_lowering(primitive, mlir.lower_fun(self._called, multiple_results=True))
        if kernel is not None:
            on_a_card = functools.partial(self._called, is_card=True)
            mlir.register_lowering(primitive, mlir.lower_fun(on_a_card, multiple_results=True), platform="cuda")
        batching.primitive_batchers[primitive] = self._batched

    def bind(self, *xs, **of):
        return self.primitive.bind(*xs, **of)

    def _run(self, *xs, **of):
        """The results outside of transforms: those of arrays on a card stay there."""
        way = _jax_pallas.setting()
        if self.kernel is not None and way != "off" and (way == "interpret" or _is_on_a_card(xs)):
            kept, key = of["node"].kept, (self.primitive.name, way, of.get("active"))
            if key not in kept:
                kept[key] = jax.jit(functools.partial(self.bind, **of))
            return kept[key](*xs)
        return [jnp.asarray(x) for x in self.host(xs, **of)]

    def _called(self, *xs, is_card=False, **of):
        way = _jax_pallas.setting()
        if self.kernel is not None and (is_card and way != "off" or way == "interpret"):
            results = self.kernel(xs, not is_card, **of)
            if results is not None:
                return results
        host = functools.partial(_tuple, self.host, tuple(of.items()))
        return jax.pure_callback(host, tuple(self.shapes(xs, **of)), *xs, vmap_method="broadcast_all")

    def _batched(self, xs, axes, **of):
        size = next(x.shape[axis] for x, axis in zip(xs, axes) if axis is not None)
        spread = [
            jnp.broadcast_to(x[None], (size, *x.shape)) if axis is None else jnp.moveaxis(x, axis, 0)
            for x, axis in zip(xs, axes)
        ]
        results = self.bind(*spread, **of)
        return results, [0] * len(results)


def _is_on_a_card(xs):
    """Whether arrays are on a card of CUDA."""
    if jax.default_backend() == "cpu":
        return False
    return any(device.platform == "gpu" for x in xs if isinstance(x, jax.Array) for device in x.devices())


def _tuple(host, of, *xs):
    return tuple(host(xs, **dict(of)))


def _shapes(xs, node, **_):
    lead = xs[0].shape[:-1] if node.takes[0][2] else xs[0].shape
    return [jax.ShapeDtypeStruct(_nodes.size(lead, width), xs[0].dtype) for width in node.gives]


def _push_kernel(xs, interpret, node, active):
    is_given = (*[True] * len(node.takes), *active)
    return _jax_pallas.computed(node.jvp(), xs, is_given, len(node.gives), interpret)


#: The results of a node.
_CALL = Kind(
    "geograd_call", lambda xs, node: _computed(node, xs), _shapes,
    lambda xs, interpret, node: _jax_pallas.computed(node, xs, [True] * len(xs), 0, interpret),
)
#: The derivatives of its results along directions of the arguments that are active, which follow the arguments.
_PUSH = Kind(
    "geograd_push", lambda xs, node, active: _computed(node.jvp(), _along(node, active, xs))[len(node.gives) :], _shapes,
    _push_kernel,
)


def _pushed(node, xs, tangents):
    """Derivatives along tangents, some of which may be none."""
    active = tuple(t is not None and not isinstance(t, ad.Zero) for t in tangents)
    given = [ad.instantiate_zeros(t) for t, is_active in zip(tangents, active) if is_active]
    return _PUSH.bind(*xs, *given, node=node, active=active)


def _call_jvp(xs, tangents, *, node):
    return _CALL.bind(*xs, node=node), _pushed(node, xs, tangents)


def _push_jvp(inputs, tangents, *, node, active):
    count = len(node.takes)
    results = _PUSH.bind(*inputs, node=node, active=active)
    of_arguments = tangents[:count]
    if all(isinstance(t, ad.Zero) for t in of_arguments):
        # Linear in directions.
        given = iter(tangents[count:])
        directions = [next(given) if is_active else None for is_active in active]
        return results, _pushed(node, inputs[:count], directions)
    whole = [jnp.asarray(x) for x in _along_jax(inputs, active, count)]
    given = iter(tangents[count:])
    directions = [next(given) if is_active else None for is_active in active]
    return results, _pushed(node.jvp(), whole, [*of_arguments, *directions])[len(node.gives) :]


def _along_jax(xs, active, count):
    given = iter(xs[count:])
    return [*xs[:count], *[next(given) if is_active else jnp.zeros_like(x) for x, is_active in zip(xs, active)]]


def _push_transpose(bars, *inputs, node, active):
    count = len(node.takes)
    xs, directions = inputs[:count], inputs[count:]
    bars = [ad.instantiate_zeros(bar) for bar in bars]
    grads = _CALL.bind(*xs, *bars, node=node.vjp())
    of_active = [grad for grad, is_active in zip(grads, active) if is_active]
    linear = [grad if ad.is_undefined_primal(d) else None for grad, d in zip(of_active, directions)]
    return [None] * count + linear


ad.primitive_jvps[_CALL.primitive] = _call_jvp
ad.primitive_jvps[_PUSH.primitive] = _push_jvp
ad.primitive_transposes[_PUSH.primitive] = _push_transpose


def applied(node, arguments):
    """The results of a node on what a caller gives."""
    if len(arguments) != len(node.takes):
        names = ", ".join(name for name, _, _ in node.takes)
        raise TypeError(f"{node.name} takes {names}, not {len(arguments)} arguments")
    xs = [jnp.asarray(x) for x in arguments]
    for (name, _, _), x in zip(node.takes, xs):
        if jnp.issubdtype(x.dtype, jnp.floating) and x.dtype not in (jnp.float32, jnp.float64):
            raise TypeError(f"{node.name}: `{name}` is {x.dtype}: float32 and float64 are taken; convert with .astype")
    floats = [x.dtype for x in xs if jnp.issubdtype(x.dtype, jnp.floating)]
    dtype = jnp.float64 if any(d == jnp.float64 for d in floats) else jnp.float32
    lead = lead_of(node, xs)
    # Arguments are broadcast here, so that JAX itself sums their gradients.
    xs = [jnp.broadcast_to(x.astype(dtype), _nodes.size(lead, w)) for (_, _, w), x in zip(node.takes, xs)]
    results = _CALL.bind(*xs, node=node)
    return results[0] if len(results) == 1 and not node.is_tuple else tuple(results)
