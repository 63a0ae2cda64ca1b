"""Cells of sites, measures of round offsets and paths of curves on JAX's arrays."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional, Tuple, Union

import jax
import jax.numpy as jnp
import numpy as np

import geograd
from geograd._jax_columns import Polygons, Polylines
from geograd._jax_host import floats, hosted
from geograd._record_formulas import weights

Array = Any


class CellMeasures(NamedTuple):
    """Measures of the cells of N sites."""

    #: The areas, of shape (N,).
    areas: Array
    #: The centroids, of shape (N, 2).
    centroids: Array
    #: The energy of transport: one number.
    energy: Array


def cells(sites: Array, weights: Optional[Array] = None, *, domain: Any) -> CellMeasures:
    """Areas, centroids and energy of the cells of sites, of shape (N, 2), in a domain: :class:`geograd.Cells` in JAX.

    Results have first derivatives backwards by sites and weights; the domain is known numbers.
    """
    if np.ndim(sites) != 2 or np.shape(sites)[1] != 2:
        raise ValueError(f"sites: an array of shape (N, 2) is needed, not {np.shape(sites)}")
    count = np.shape(sites)[0]
    xs = floats(sites, jnp.zeros(count) if weights is None else weights)

    def value(sites: Any, weights: Any, _: Any, bars: Any) -> Any:
        made = geograd.Cells(sites, weights, domain=domain)
        if bars is None:
            return made.areas, made.centroids, made.energy
        areas, centroids, energy = bars
        by_sites, by_weights, _ = made.areas_vjp(areas)
        further = made.centroids_vjp(centroids)
        return by_sites + further[0] - 2.0 * energy * made.first_moments, by_weights + further[1] - energy * made.areas

    return CellMeasures(*hosted(xs, [(count,), (count, 2), ()], value)[:3])


class PlaceWeights(NamedTuple):
    """For each of M places the points of the triangle that contains it, and their weights."""

    #: The numbers of the points, of shape (M, 3).
    corners: Array
    #: The weights, of shape (M, 3): from 0 to 1 with the sum 1, zeros outside of all triangles.
    weights: Array


def barycentric(points: Array, places: Array) -> PlaceWeights:
    """Points around places in the Delaunay triangulation of points, and their weights: :meth:`geograd.Delaunay.barycentric` in JAX.

    ``points`` has the shape (N, 2), ``places`` (M, 2). Weights have derivatives of any order backwards by both. The mean of
    numbers at the points by these weights is their linear interpolation.

    >>> heights = jnp.array([10.0, 20.0, 30.0])
    >>> corners, weights = geograd.jax.barycentric(jnp.array([[0.0, 0], [4, 0], [0, 4]]), jnp.array([[1.0, 2]]))
    >>> (heights[corners] * weights).sum(1)
    """
    for name, own in (("points", points), ("places", places)):
        if np.ndim(own) != 2 or np.shape(own)[1] != 2:
            raise ValueError(f"{name}: an array of shape (K, 2) is needed, not {np.shape(own)}")
    shape = (np.shape(places)[0], 3)

    def search(points: Any, places: Any) -> Any:
        made = geograd.Delaunay(points)
        return made._corners(made.locate(places))

    def value(points: Any, places: Any, _: Any, bars: Any) -> Any:
        made = geograd.Delaunay(points)
        return [made.barycentric(places)[1]] if bars is None else made.barycentric_vjp(places, bars[0])

    def again(corners: Any, made: Any, points: Any, places: Any) -> Any:
        # Outside of all triangles all corners are the same.
        return weights(jnp, corners, corners[:, 0] != corners[:, 1], points, places)

    found, corners = hosted(floats(points, places), [shape], value, records=shape, search=search, again=again)
    return PlaceWeights(corners, found)


class BufferMeasure:
    """A measure of round offsets of a column on JAX's arrays, with first derivatives backwards."""

    def __init__(self, name: str) -> None:
        self._measure = getattr(geograd, name)
        self.__name__ = self.__qualname__ = name
        self.__doc__ = f"{self._measure.__doc__}\n    {type(self).__doc__}"

    def __repr__(self) -> str:
        return f"<geograd.jax.{self.__name__}>"

    def __call__(self, column: Union[Polygons, Polylines], distance: Array, *, fill: str = "even_odd") -> Array:
        if not isinstance(column, (Polygons, Polylines)):
            column = Polygons.of(geograd.Polygons.of(column))
        layout, count = column.layout, len(column)
        xs = floats(column.vertices, distance)

        def value(vertices: Any, distance: Any, _: Any, bars: Any) -> Any:
            own = layout.dressed(vertices)
            return [self._measure(own, distance, fill=fill)] if bars is None else self._measure.vjp(own, distance, bars[0], fill=fill)

        return hosted(xs, [(count,)], value)[0]


buffer_area = BufferMeasure("buffer_area")
buffer_perimeter = BufferMeasure("buffer_perimeter")


@jax.tree_util.register_pytree_node_class
class CurvePath:
    """A path of lines, circular arcs and Bézier curves whose numbers are an array: :class:`geograd.CurvePath` in JAX.

    Results have first derivatives backwards by the numbers and by points. It is a tree with one leaf, the numbers.

    >>> path = geograd.jax.CurvePath("MAZ", jnp.array([0, 0, 2, 0, 1.0]))
    >>> jax.grad(lambda path: path.area())(path).numbers
    """

    __module__ = "geograd.jax"

    def __init__(self, steps: str, numbers: Array) -> None:
        (self.numbers,) = floats(numbers)
        self.steps = steps

    def __repr__(self) -> str:
        return f"<geograd.jax.CurvePath {self.steps}>"

    def tree_flatten(self) -> Tuple[Tuple[Array], str]:
        return (self.numbers,), self.steps

    @classmethod
    def tree_unflatten(cls, steps: str, children: Any) -> CurvePath:
        path = object.__new__(cls)
        path.steps, (path.numbers,) = steps, children
        return path

    def _measured(self, name: str) -> Array:
        steps = self.steps

        def value(numbers: Any, _: Any, bars: Any) -> Any:
            found, slopes = getattr(geograd.CurvePath(steps, numbers), f"{name}_grad")()
            return [found] if bars is None else [bars[0] * slopes]

        return hosted((self.numbers,), [()], value)[0]

    def length(self) -> Array:
        """The length of all pieces."""
        return self._measured("length")

    def lengths(self) -> Array:
        """The length of each piece, of shape (P,)."""
        steps = self.steps

        def value(numbers: Any, _: Any, bars: Any) -> Any:
            path = geograd.CurvePath(steps, numbers)
            return [path.lengths] if bars is None else [path.lengths_vjp(bars[0])[1]]

        count = sum(letter != "M" for letter in steps)
        return hosted((self.numbers,), [(count,)], value)[0]

    def area(self) -> Array:
        """The signed area of all contours, positive counter-clockwise. A straight line closes those that are open."""
        return self._measured("area")

    def distance(self, points: Array) -> Array:
        """The distance of each point, of shape (..., 2), from the path; derivative zero on it."""
        if np.ndim(points) == 0 or np.shape(points)[-1] != 2:
            raise ValueError(f"points: an array of shape (..., 2) is needed, not {np.shape(points)}")
        xs, steps = floats(points, self.numbers), self.steps
        shape = xs[0].shape[:-1]

        def value(points: Any, numbers: Any, _: Any, bars: Any) -> Any:
            path, rows = geograd.CurvePath(steps, numbers), points.reshape(-1, 2)
            if bars is None:
                return [path.distance(rows)]
            by_numbers, by_points = path.distance_vjp(rows, bars[0].reshape(-1))
            return np.asarray(by_points), np.asarray(by_numbers)

        return hosted(xs, [shape], value)[0]
