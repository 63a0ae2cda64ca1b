"""Results that the library computes on the host, as functions of JAX's arrays with derivatives backwards."""

from __future__ import annotations

from typing import Any, Callable, Optional, Sequence, Tuple

import jax
import jax.numpy as jnp
import numpy as np

Array = Any


def floats(*arrays: Array) -> Tuple[Array, ...]:
    """Arrays in one format of floats."""
    xs = tuple(jnp.asarray(x) for x in arrays)
    dtype = jnp.result_type(*xs)
    dtype = dtype if jnp.issubdtype(dtype, jnp.floating) else jnp.result_type(float)
    return tuple(x.astype(dtype) for x in xs)


def hosted(
    xs: Tuple[Array, ...],
    shapes: Sequence[Tuple[int, ...]],
    value: Callable[..., Any],
    *,
    records: Tuple[int, ...] = (0,),
    search: Callable[..., Any] = lambda *_: np.zeros(0),
    again: Optional[Callable[..., Any]] = None,
) -> Tuple[Array, ...]:
    """Results of some shapes with first derivatives by arrays, and the record of the search for them.

    ``search`` gives whole numbers of the shape ``records``. ``value`` gives the list of results of them; with a list of their cotangents,
    those of all arrays. Both get arrays of NumPy in float64. ``again`` gives the first result in operations of JAX, given the record,
    that result and the arrays: derivatives of derivatives are its own.
    """
    dtype = xs[0].dtype
    into = tuple(jax.ShapeDtypeStruct(x.shape, dtype) for x in xs)
    outs = *(jax.ShapeDtypeStruct(shape, dtype) for shape in shapes), jax.ShapeDtypeStruct(records, jnp.int32)

    def wide(xs: Any) -> Any:
        return [np.ascontiguousarray(x, np.float64) for x in xs]

    def found(*xs: Any) -> Any:
        xs = wide(xs)
        record = np.asarray(search(*xs), np.int64).reshape(records)
        made = value(*xs, record, None)
        return *(np.asarray(own, dtype).reshape(shape) for own, shape in zip(made, shapes)), record.astype(np.int32)

    def back(record: Any, bars: Any, *xs: Any) -> Any:
        parts = value(*wide(xs), np.ascontiguousarray(record, np.int64), wide(bars))
        return tuple(np.asarray(part, dtype).reshape(x.shape) for part, x in zip(parts, xs))

    def forward(*xs: Array) -> Any:
        return jax.pure_callback(found, outs, *xs, vmap_method="sequential")

    def ahead(*xs: Array) -> Any:
        # Not the callback, which has no derivatives.
        made = call(*xs)
        return made, (made, xs)

    def cotangents(record: Array, made: Array, bars: Any, xs: Any) -> Any:
        return jax.pure_callback(back, into, record, bars, *xs, vmap_method="sequential")

    def backward(kept: Any, bars: Any) -> Any:
        made, xs = kept
        own = cotangents if again is None else _differentiable(cotangents, again)
        return own(made[-1], made[0], tuple(bars[:-1]), xs)

    call = jax.custom_vjp(forward)
    call.defvjp(ahead, backward)
    made: Tuple[Array, ...] = call(*xs)
    return made


def _differentiable(cotangents: Callable[..., Any], again: Callable[..., Any]) -> Callable[..., Any]:
    """Cotangents by a record, a result, its cotangents and arrays, with derivatives of their own."""

    def ahead(record: Array, made: Array, bars: Any, xs: Any) -> Any:
        return call(record, made, bars, xs), (record, made, bars, xs)

    def backward(kept: Any, by: Any) -> Any:
        record, made, bars, xs = kept

        def pulled(bars: Any, xs: Any) -> Any:
            return jax.vjp(lambda *xs: again(record, made, *xs), *xs)[1](bars[0])

        by_bars, by_xs = jax.vjp(pulled, bars, xs)[1](by)
        return np.zeros(record.shape, jax.dtypes.float0), jnp.zeros_like(made), by_bars, by_xs

    call = jax.custom_vjp(cotangents)
    call.defvjp(ahead, backward)
    return call
