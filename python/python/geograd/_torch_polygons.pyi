# Written by stubs.py, from the table of the library.
from typing import Any, Literal, Sequence, TypeVar, Union

import torch
from numpy.typing import ArrayLike, NDArray

import geograd

Fill = Literal["even_odd", "nonzero"]
_Self = TypeVar("_Self", bound="Column")

class Column:
    """Columns whose vertices are tensors, with derivatives by these."""
    @property
    def vertices(self) -> torch.Tensor: ...
    @property
    def offsets(self) -> Any: ...
    def detach(self) -> Any:
        """The column without derivatives, of arrays."""
    def __len__(self) -> int: ...

class Polygons(Column):
    """A column of polygons, each of parts with holes."""
    def __init__(self, vertices: torch.Tensor, offsets: Union[geograd.Polygons, Sequence[ArrayLike]]) -> None: ...
    @classmethod
    def of(cls, polygons: Any, dtype: torch.dtype = ..., requires_grad: bool = ...) -> Polygons:
        """Polygons of lists, of geometries, of rings or of boxes."""
    @classmethod
    def rings(cls, vertices: torch.Tensor) -> Polygons:
        """Polygons of one ring of V vertices each, of shape (N, V, 2)."""

class Paths(Column):
    """Paths: vertices one after another, and where each path starts."""
    def __init__(self, vertices: torch.Tensor, offsets: Union[geograd.Paths, ArrayLike]) -> None: ...
    @classmethod
    def of(cls: type[_Self], paths: Any, dtype: torch.dtype = ..., requires_grad: bool = ...) -> _Self:
        """Paths of lists of vertices, or of geometries."""

class Rings(Paths):
    """Closed paths: the last vertex of each is joined with its first one."""

class Polylines(Paths):
    """Open paths, of the plane or of space."""

class Clouds(Paths):
    """Clouds of points of space, in any order."""

def contains(polygons: Any, points: Any, *, fill: Fill = ...) -> torch.Tensor:
    """Says whether polygons contain points, item by item, decided exactly; the border belongs to a polygon."""
def union_area(a: Any, b: Any) -> torch.Tensor:
    """The area that two polygons cover together, item by item."""

class _Overlay:
    __name__: str
    def __call__(self, a: Any, b: Any, *, fill: Fill = ..., valid: bool = ...) -> Polygons: ...

def buffer(
    column: Any, distance: Union[float, torch.Tensor], *, join: Literal["round", "mitre", "bevel"] = ..., limit: float = ...,
    end: Literal["round", "flat", "square"] = ..., chords: int = ..., tolerance: float = ..., fill: Fill = ..., valid: bool = ...,
) -> Polygons:
    """Polygons grown or shrunk by a distance, or the surroundings of polylines: differentiable by vertices and distance."""
def buffer_area(column: Any, distance: Union[float, torch.Tensor], *, fill: Fill = ...) -> torch.Tensor:
    """The area of polygons grown or shrunk by a distance, or of the surroundings of polylines, arcs exact."""
def buffer_perimeter(column: Any, distance: Union[float, torch.Tensor], *, fill: Fill = ...) -> torch.Tensor:
    """The perimeter of polygons grown or shrunk by a distance, or of the surroundings of polylines, arcs exact."""

difference: _Overlay
intersection: _Overlay
minkowski_sum: _Overlay
no_fit_polygon: _Overlay
symmetric_difference: _Overlay
union: _Overlay
