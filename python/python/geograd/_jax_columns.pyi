# Written by stubs.py, from the table of the library.
from typing import Any, Literal, Sequence, TypeVar, Union

import jax
from numpy.typing import ArrayLike, NDArray

import geograd

Fill = Literal["even_odd", "nonzero"]
_Self = TypeVar("_Self", bound="Column")

class Column:
    """Columns whose vertices are JAX's arrays, with derivatives by these."""
    @property
    def vertices(self) -> jax.Array: ...
    @property
    def offsets(self) -> Any: ...
    def __len__(self) -> int: ...

class Polygons(Column):
    """A column of polygons, each of parts with holes."""
    def __init__(self, vertices: Union[jax.Array, NDArray[Any]], offsets: Union[geograd.Polygons, Sequence[ArrayLike]]) -> None: ...
    @classmethod
    def of(cls, items: Any, dtype: Any = ...) -> Polygons:
        """Polygons of lists, of geometries, of rings or of boxes."""
    @classmethod
    def rings(cls, vertices: Union[jax.Array, NDArray[Any]]) -> Polygons:
        """Polygons of one ring of V vertices each, of shape (N, V, 2)."""

class Paths(Column):
    """Paths: vertices one after another, and where each path starts."""
    def __init__(self, vertices: Union[jax.Array, NDArray[Any]], offsets: Union[geograd.Paths, ArrayLike]) -> None: ...
    @classmethod
    def of(cls: type[_Self], items: Any, dtype: Any = ...) -> _Self:
        """Paths of lists of vertices, or of geometries."""

class Rings(Paths):
    """Closed paths: the last vertex of each is joined with its first one."""

class Polylines(Paths):
    """Open paths, of the plane or of space."""

class Clouds(Paths):
    """Clouds of points of space, in any order."""

def contains(polygons: Any, points: Any, *, fill: Fill = ...) -> jax.Array:
    """Says whether polygons contain points, item by item, decided exactly; the border belongs to a polygon."""
def union_area(a: Any, b: Any) -> jax.Array:
    """The area that two polygons cover together, item by item."""
