"""Verbs and own functions as differentiable JAX functions, computed on the CPU by the library.

``geograd.jax.iou(a, b, kind="Obb2")`` takes arrays of shape ``(..., 5)`` and gives one of shape ``(...)``. ``jit``,
``grad``, ``vmap`` and derivatives of any order work; the library runs in a callback on the host.
"""

from __future__ import annotations

import functools

import jax
import jax.numpy as jnp
import numpy as np

import geograd
from geograd import _nodes

__all__ = ["function"]


def _lead(node, xs):
    shapes = []
    for (name, _, width), x in zip(node.takes, xs):
        if width and (x.ndim == 0 or x.shape[-1] != width):
            raise ValueError(f"{node.name}: `{name}` needs an array of shape (..., {width}), not {x.shape}")
        shapes.append(x.shape[:-1] if width else x.shape)
    return np.broadcast_shapes(*shapes)


def _on_host(node, *xs):
    xs = [np.asarray(x) for x in xs]
    lead = _lead(node, xs)
    if 0 in lead:
        return tuple(np.empty(_nodes.size(lead, width), xs[0].dtype) for width in node.gives)
    arrays = [np.broadcast_to(x, _nodes.size(lead, width)) for (_, _, width), x in zip(node.takes, xs)]
    results = node.run([np.ascontiguousarray(x) for x in arrays])
    return tuple(np.asarray(r, xs[0].dtype).reshape(_nodes.size(lead, w)) for r, w in zip(results, node.gives))


def _of(node):
    """The function of a node, made once."""
    if "jax" not in node.kept:
        node.kept["jax"] = _made(node)
    return node.kept["jax"]


def _made(node):
    # JAX compiles anew for every callback that it has not seen.
    on_host = functools.partial(_on_host, node)

    def call(*xs):
        lead = _lead(node, xs)
        shapes = tuple(jax.ShapeDtypeStruct(_nodes.size(lead, width), xs[0].dtype) for width in node.gives)
        return jax.pure_callback(on_host, shapes, *xs, vmap_method="broadcast_all")

    whole = jax.custom_vjp(call)

    def forward(*xs):
        return whole(*xs), xs

    def backward(xs, bars):
        grads = _of(node.vjp())(*xs, *bars)
        return tuple(grads)

    whole.defvjp(forward, backward)

    def spread(*xs):
        # Arguments are broadcast outside, so that JAX itself sums their gradients.
        lead = _lead(node, xs)
        return whole(*[jnp.broadcast_to(x, _nodes.size(lead, w)) for (_, _, w), x in zip(node.takes, xs)])

    return spread


def _apply(node, arguments):
    if len(arguments) != len(node.takes):
        names = ", ".join(name for name, _, _ in node.takes)
        raise TypeError(f"{node.name} takes {names}, not {len(arguments)} arguments")
    xs = [jnp.asarray(x) for x in arguments]
    for (name, _, _), x in zip(node.takes, xs):
        if jnp.issubdtype(x.dtype, jnp.floating) and x.dtype not in (jnp.float32, jnp.float64):
            raise TypeError(f"{node.name}: `{name}` is {x.dtype}: float32 and float64 are taken")
    floats = [x.dtype for x in xs if jnp.issubdtype(x.dtype, jnp.floating)]
    dtype = jnp.float64 if any(d == jnp.float64 for d in floats) else jnp.float32
    results = _of(node)(*[x.astype(dtype) for x in xs])
    return results[0] if len(results) == 1 and not node.is_tuple else results


class _Verb:
    """A verb on JAX's arrays."""

    def __init__(self, name):
        self.__name__ = self.__qualname__ = name
        self.__doc__ = getattr(geograd, name).__doc__

    def __repr__(self):
        return f"<geograd.jax.{self.__name__}>"

    def __reduce__(self):
        return (_verb, (self.__name__,))

    def __call__(self, *arguments, kind=None):
        return _apply(_nodes.of_verb(self.__name__, kind, len(arguments)), arguments)


@functools.lru_cache(maxsize=None)
def _verb(name):
    return _Verb(name)


def function(f):
    """A function of your own on JAX's arrays: ``f`` is a ``geograd.function``, or becomes one."""
    f = f if isinstance(f, geograd.Function) else geograd.function(f)
    node = _nodes.of_function(f)

    @functools.wraps(f)
    def on_arrays(*arguments):
        return _apply(node, _nodes.split(node.name, f._leaves, f._names, arguments))

    return on_arrays


def __getattr__(name):
    if name in geograd._VERBS:
        return _verb(name)
    raise AttributeError(f"module 'geograd.jax' has no attribute {name!r}")


def __dir__():
    return sorted([*globals(), *geograd._VERBS])
