"""The stubs of columns of polygons and paths on tensors and on JAX's arrays: stubs.py writes them."""

from geograd import _polygons

COLUMNS = '''# Written by stubs.py, from the table of the library.
from typing import Any, Literal, Sequence, TypeVar, Union

{imports}
from numpy.typing import ArrayLike, NDArray

import geograd

Fill = Literal["even_odd", "nonzero"]
_Self = TypeVar("_Self", bound="Column")

class Column:
    """Columns whose vertices are {of}, with derivatives by these."""
    @property
    def vertices(self) -> {array}: ...
    @property
    def offsets(self) -> Any: ...
{detach}    def __len__(self) -> int: ...

class Polygons(Column):
    """A column of polygons, each of parts with holes."""
    def __init__(self, vertices: {given}, offsets: Union[geograd.Polygons, Sequence[ArrayLike]]) -> None: ...
    @classmethod
    def of(cls, {items}: Any, {options}) -> Polygons:
        """Polygons of lists, of geometries, of rings or of boxes."""
    @classmethod
    def rings(cls, vertices: {given}) -> Polygons:
        """Polygons of one ring of V vertices each, of shape (N, V, 2)."""

class Paths(Column):
    """Paths: vertices one after another, and where each path starts."""
    def __init__(self, vertices: {given}, offsets: Union[geograd.Paths, ArrayLike]) -> None: ...
    @classmethod
    def of(cls: type[_Self], {paths}: Any, {options}) -> _Self:
        """Paths of lists of vertices, or of geometries."""

class Rings(Paths):
    """Closed paths: the last vertex of each is joined with its first one."""

class Polylines(Paths):
    """Open paths, of the plane or of space."""

class Clouds(Paths):
    """Clouds of points of space, in any order."""

def contains(polygons: Any, points: Any, *, fill: Fill = ...) -> {array}:
    """Says whether polygons contain points, item by item, decided exactly; the border belongs to a polygon."""
def union_area(a: Any, b: Any) -> {array}:
    """The area that two polygons cover together, item by item."""
{further}'''

_TENSORS = {
    "imports": "import torch", "of": "tensors", "array": "torch.Tensor", "given": "torch.Tensor", "items": "polygons", "paths": "paths",
    "detach": "    def detach(self) -> Any:\n        \"\"\"The column without derivatives, of arrays.\"\"\"\n",
    "options": "dtype: torch.dtype = ..., requires_grad: bool = ...",
}
_ARRAYS = {
    "imports": "import jax", "of": "JAX's arrays", "array": "jax.Array", "given": "Union[jax.Array, NDArray[Any]]", "items": "items",
    "paths": "items", "detach": "", "options": "dtype: Any = ...", "further": "",
}
_OVERLAY = '''
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
'''


def _overlays():
    """The boolean operations, whose results are columns."""
    return _OVERLAY + "\n" + "".join(f"{name}: _Overlay\n" for name in sorted(_polygons.OVERLAYS))


ON_TENSORS = COLUMNS.format(**_TENSORS, further=_overlays())
ON_ARRAYS = COLUMNS.format(**_ARRAYS)
