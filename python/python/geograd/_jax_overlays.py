"""Boolean operations of polygons on JAX's arrays: polygons where their number of vertices is known when they are computed,
else in memory of a stated size."""

from __future__ import annotations

from typing import Any, Optional, Tuple, Union, overload

import jax
import jax.numpy as jnp
import numpy as np

import geograd
from geograd import _core, _polygons
from geograd._jax_columns import Polygons

Array = Any


@jax.tree_util.register_pytree_node_class
class PolygonBuffer:
    """Polygons in memory of a fixed size, which ``jit`` needs: what a boolean operation with ``capacity=`` gives.

    ``vertices`` has the shape (capacity, 2); those after the last ring are zero. ``rings``, ``parts`` and ``polygons`` are
    offsets as those of :class:`Polygons`: where each ring starts among the vertices, each part among the rings, each polygon
    among the parts. Rings and parts that are not there start where the last one ends. Parts run counter-clockwise, holes
    clockwise. It is a tree; vertices have first derivatives.
    """

    def __init__(self, vertices: Array, rings: Array, parts: Array, polygons: Array) -> None:
        self.vertices, self.rings, self.parts, self.polygons = vertices, rings, parts, polygons

    def __len__(self) -> int:
        return int(self.polygons.shape[-1]) - 1

    def __repr__(self) -> str:
        return f"<geograd.jax.PolygonBuffer {len(self)} in {self.vertices.shape[-2]} vertices>"

    def edges(self) -> Tuple[Array, Array, Array]:
        """The start and the end of every edge, of shape (capacity, 2), and the polygon of each.

        Edges that are not there have both ends at the origin and are of the polygon ``len(self)``, which
        ``jax.ops.segment_sum(..., num_segments=len(self))`` leaves out.

        >>> start, end, of = geograd.jax.union(a, b, capacity=100).edges()
        >>> cross = start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0]
        >>> areas = jax.ops.segment_sum(cross / 2, of, num_segments=len(a))
        """
        places = jnp.arange(self.vertices.shape[0])
        ring = jnp.searchsorted(self.rings, places, side="right") - 1
        is_there = places < self.rings[-1]
        ring = jnp.where(is_there, ring, 0)
        following = jnp.where(places + 1 == self.rings[ring + 1], self.rings[ring], places + 1)
        following = jnp.where(is_there, following, places)
        part = jnp.searchsorted(self.parts, ring, side="right") - 1
        polygon = jnp.searchsorted(self.polygons, part, side="right") - 1
        return self.vertices, self.vertices[following], jnp.where(is_there, polygon, len(self))

    def trimmed(self) -> Polygons:
        """The polygons without the memory that they leave, outside of ``jit``."""
        rings, parts, polygons = (np.asarray(own) for own in (self.rings, self.parts, self.polygons))
        parts = parts[: polygons[-1] + 1]
        rings = rings[: parts[-1] + 1]
        return Polygons(self.vertices[: rings[-1]], (rings, parts, polygons))

    def tree_flatten(self) -> Tuple[Tuple[Array, ...], None]:
        return (self.vertices, self.rings, self.parts, self.polygons), None

    @classmethod
    def tree_unflatten(cls, _: None, children: Any) -> PolygonBuffer:
        return cls(*children)


def _pulled(record: Any, bar: Array, shapes: Any) -> Any:
    """Cotangents of the vertices of both columns."""
    call = lambda bar: tuple(np.asarray(own) for own in record.vjp(np.ascontiguousarray(bar)))
    return jax.pure_callback(call, shapes, bar, vmap_method="sequential")


class Overlay:
    """An operation on polygons of JAX's arrays: see the one of :mod:`geograd`.

    How many vertices the result has depends on numbers. So the plain call, which gives :class:`Polygons`, works where numbers
    are known: outside of ``jit`` and ``vmap``, within ``grad``, ``vjp`` and ``jacrev``. With ``capacity``, the largest number of
    vertices of all results together, it gives a :class:`PolygonBuffer`, also under ``jit`` and ``vmap``; results of more
    vertices are an error where they are computed. Derivatives are of first order and backwards: the vertices of the result
    have them by those of both inputs.
    """

    def __init__(self, name: str) -> None:
        self.__name__ = self.__qualname__ = name
        self.__doc__ = f"{_polygons.OVERLAYS[name].__doc__}\n{Overlay.__doc__}"

    def __repr__(self) -> str:
        return f"<geograd.jax.{self.__name__}>"

    @overload
    def __call__(self, a: Any, b: Any, *, fill: str = ..., valid: bool = ..., capacity: None = ...) -> Polygons: ...
    @overload
    def __call__(self, a: Any, b: Any, *, fill: str = ..., valid: bool = ..., capacity: int) -> PolygonBuffer: ...
    def __call__(
        self, a: Any, b: Any, *, fill: str = "even_odd", valid: bool = False, capacity: Optional[int] = None
    ) -> Union[Polygons, PolygonBuffer]:
        a, b = (x if isinstance(x, Polygons) else Polygons.of(geograd.Polygons.of(x)) for x in (a, b))
        dtype = jnp.result_type(a.vertices, b.vertices)
        xs = tuple(own.vertices.astype(dtype) for own in (a, b))
        layouts = a.layout, b.layout
        if capacity is None:
            return self._eager(xs, layouts, fill, valid)
        if capacity < 0:
            raise ValueError(f"capacity: a number of vertices from 0 on is needed, not {capacity}")
        return self._buffered(xs, layouts, fill, valid, int(capacity))

    def _computed(self, xs: Any, layouts: Any, fill: str, valid: bool) -> Any:
        """The result of arrays of numbers, and its record."""
        columns = [layout.dressed(np.asarray(x)) for layout, x in zip(layouts, xs)]
        return _core.polygon_overlay(self.__name__, *columns, fill, valid, True)

    def _eager(self, xs: Any, layouts: Any, fill: str, valid: bool) -> Polygons:
        known: Any = []

        def host(*xs: Array) -> Array:
            try:
                known[:] = self._computed(xs, layouts, fill, valid)
            except jax.errors.TracerArrayConversionError as error:
                raise TypeError(
                    f"geograd.jax.{self.__name__} has a result whose number of vertices depends on numbers, which jit and vmap "
                    "do not know: pass capacity=, the largest number of vertices of the result"
                ) from error
            return jnp.asarray(known[0].vertices)

        shapes = tuple(jax.ShapeDtypeStruct(x.shape, x.dtype) for x in xs)
        call = jax.custom_vjp(host)
        call.defvjp(lambda *xs: (host(*xs), None), lambda _, bar: _pulled(known[1], bar, shapes))
        vertices = call(*xs)
        return Polygons(vertices, geograd.Polygons(known[0]))

    def _buffered(self, xs: Any, layouts: Any, fill: str, valid: bool, capacity: int) -> PolygonBuffer:
        dtype, count = xs[0].dtype, max(layout.count for layout in layouts)
        count = 0 if 0 in (layout.count for layout in layouts) else count
        rings = capacity // 3 + 1
        shapes = (
            jax.ShapeDtypeStruct((capacity, 2), dtype),
            *[jax.ShapeDtypeStruct((size,), jnp.int32) for size in (rings, rings, count + 1)],
        )

        def host(*xs: Array) -> Any:
            made, _ = self._computed(xs, layouts, fill, valid)
            own = made.vertices
            if len(own) > capacity:
                raise ValueError(f"geograd.jax.{self.__name__} has {len(own)} vertices, and capacity is {capacity}")
            vertices = np.zeros((capacity, 2), dtype)
            vertices[: len(own)] = own
            lists = [np.concatenate([x, np.full(size - len(x), x[-1])]) for x, size in zip(made.offsets, (rings, rings, count + 1))]
            return (vertices, *[x.astype(np.int32) for x in lists])

        def back(*xs: Array) -> Any:
            *xs, bar = xs
            made, record = self._computed(xs, layouts, fill, valid)
            return tuple(np.asarray(own) for own in record.vjp(np.ascontiguousarray(bar[: len(made.vertices)])))

        called = lambda *xs: jax.pure_callback(host, shapes, *xs, vmap_method="sequential")
        into = tuple(jax.ShapeDtypeStruct(x.shape, x.dtype) for x in xs)
        call = jax.custom_vjp(called)
        call.defvjp(
            lambda *xs: (called(*xs), xs),
            lambda xs, bars: jax.pure_callback(back, into, *xs, bars[0], vmap_method="sequential"),
        )
        return PolygonBuffer(*call(*xs))


union = Overlay("union")
intersection = Overlay("intersection")
difference = Overlay("difference")
symmetric_difference = Overlay("symmetric_difference")
minkowski_sum = Overlay("minkowski_sum")
no_fit_polygon = Overlay("no_fit_polygon")
