"""Writes the type stubs of the package and of its verbs on tensors and JAX's arrays, made of the table: `python stubs.py`;
`python stubs.py --check` fails when they are stale."""

import inspect
import keyword
import pathlib
import re
import sys

import geograd
import stubs_of_columns
from geograd import _core, _hulls, _points, _polygons
from geograd._elementary import ELEMENTARY
from geograd._verbs import describe, ordered

FOLDER = pathlib.Path(__file__).parent / "python" / "geograd"

HEAD = '''"""{doc}"""

# Written by stubs.py, from the table of the library.
from typing import Any, Callable, Iterable, Iterator, Literal, Optional, Sequence, Tuple, Type, TypeVar, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import assignment as assignment, metric as metric, suppression as suppression

__version__: str
WGSL: str
"""The functions that programs call in WGSL: once in every shader with functions that `wgsl` writes."""

Array = NDArray[Any]
Kind = Union[str, Type["Shape"], None, Sequence[Union[str, Type["Shape"], None]]]
Out = Any
Groups = Optional[Sequence[ArrayLike]]
Backend = Optional[Literal["cpu", "gpu"]]
Form = Literal["value", "value_grad", "vjp", "jacobian", "jvp", "hvp", "hessian"]
Fill = Literal["even_odd", "nonzero"]
Report = _core.Report

class Symbol:
    """A number of a function that is being recorded."""
    def __add__(self, other: Any) -> Symbol: ...
    def __radd__(self, other: Any) -> Symbol: ...
    def __sub__(self, other: Any) -> Symbol: ...
    def __rsub__(self, other: Any) -> Symbol: ...
    def __mul__(self, other: Any) -> Symbol: ...
    def __rmul__(self, other: Any) -> Symbol: ...
    def __truediv__(self, other: Any) -> Symbol: ...
    def __rtruediv__(self, other: Any) -> Symbol: ...
    def __floordiv__(self, other: Any) -> Symbol: ...
    def __rfloordiv__(self, other: Any) -> Symbol: ...
    def __mod__(self, other: Any) -> Symbol: ...
    def __rmod__(self, other: Any) -> Symbol: ...
    def __pow__(self, exponent: Any) -> Symbol: ...
    def __rpow__(self, base: Any) -> Symbol: ...
    def __neg__(self) -> Symbol: ...
    def __abs__(self) -> Symbol: ...
    def __lt__(self, other: Any) -> Truth: ...
    def __le__(self, other: Any) -> Truth: ...
    def __gt__(self, other: Any) -> Truth: ...
    def __ge__(self, other: Any) -> Truth: ...

class Truth:
    """The truth of a comparison in a function that is being recorded."""
    def __and__(self, other: Truth) -> Truth: ...
    def __or__(self, other: Truth) -> Truth: ...
    def __invert__(self) -> Truth: ...

class Shape:
    """Shapes of one kind: an array whose last axis has their numbers, or symbols."""
    @property
    def array(self) -> Array: ...
    @property
    def numbers(self) -> list[Any]: ...
    @classmethod
    def indexed(cls: type[_Self], shared: Union[ArrayLike, Shape], indices: ArrayLike) -> _Self:
        """Shapes made of rows of a shared array: of one by its index, or of several points. Numbers are read where they lie."""
    def gathered(self, derivatives: ArrayLike) -> Array:
        """The derivatives by the rows of the shared array from those by these shapes: sums in the order of shapes."""
    def __array__(self, dtype: Any = ..., copy: Optional[bool] = ...) -> Array: ...
    def __len__(self) -> int: ...
    def __getitem__(self: _Self, key: Any) -> _Self: ...
    def __iter__(self: _Self) -> Iterator[_Self]: ...
    def __eq__(self, other: object) -> Any:
        """Whether all numbers are equal, row by row; shapes of another kind differ."""
    def __ne__(self, other: object) -> Any: ...

_Self = TypeVar("_Self", bound=Shape)

class Paths:
    """Paths: vertices one after another, and where each path starts; the last offset is the number of vertices.

    `paths[i]` is an array of the vertices of one, `paths[i:j]`, and places or truths as an array, are paths.
    """
    def __init__(self, vertices: ArrayLike, offsets: ArrayLike) -> None: ...
    def buffer(
        self, distance: ArrayLike, *, join: Literal["round", "mitre", "bevel"] = ..., limit: float = ..., end: Literal["round", "flat", "square"] = ...,
        chords: int = ..., tolerance: Optional[float] = ..., fill: Fill = ..., valid: bool = ...,
    ) -> Polygons:
        """The polygons grown or shrunk by a distance."""
    @property
    def vertices(self) -> Array: ...
    @property
    def offsets(self) -> Array: ...
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, key: int) -> Array: ...
    @overload
    def __getitem__(self: _SelfPaths, key: Union[slice, ArrayLike]) -> _SelfPaths: ...
    def __iter__(self) -> Iterator[Array]: ...

_SelfPaths = TypeVar("_SelfPaths", bound=Paths)

class Rings(Paths):
    """Closed paths: the last vertex of each is joined with its first one."""
    @classmethod
    def of(cls, paths: Iterable[Any]) -> Rings: ...

class Polylines(Paths):
    """Open paths, of the plane or of space."""
    @classmethod
    def of(cls, paths: Iterable[Any]) -> Polylines: ...

class Clouds(Paths):
    """Clouds of points of space, in any order."""
    @classmethod
    def of(cls, clouds: Iterable[Any]) -> Clouds: ...

class Cells:
    """The cells of sites in a domain, by distance and weight."""
    def __init__(self, sites: ArrayLike, weights: Optional[ArrayLike] = ..., *, domain: Any) -> None: ...
    def __len__(self) -> int: ...
    @property
    def areas(self) -> Array:
        """The area of each cell, of shape (N,)."""
    @property
    def centroids(self) -> Array:
        """The centroid of each cell, of shape (N, 2)."""
    @property
    def first_moments(self) -> Array:
        """The integral over each cell of the way from its site, of shape (N, 2)."""
    @property
    def second_moments(self) -> Array:
        """The integral over each cell of the squared distance from its site, of shape (N,)."""
    @property
    def energy(self) -> float:
        """The sum over cells of the integral of the squared distance from the site less its weight."""
    @property
    def hidden(self) -> Array:
        """Whether each site has no cell."""
    def neighbours(self, site: int) -> Array:
        """The sites whose cells share a side with a site's cell."""
    def rings(self, site: int) -> list[Array]:
        """The rings of a cell, of shape (V, 2), counter-clockwise."""
    def area_slopes(self) -> tuple[Array, Array, Array]:
        """The derivatives of areas by weights: rows, columns, values."""
    def energy_hessian(self) -> tuple[Array, Array, Array]:
        """The second derivatives of the energy by x, y and weight of sites: rows, columns, blocks."""
    def areas_vjp(self, areas_bar: ArrayLike) -> tuple[Array, Array, Array]:
        """Cotangents of sites, of weights and of the domain's vertices from those of the areas."""
    def centroids_vjp(self, centroids_bar: ArrayLike) -> tuple[Array, Array, Array]:
        """Cotangents of sites, of weights and of the domain's vertices from those of the centroids."""

class CurvePath:
    """A path of straight lines, circular arcs, quadratic and cubic Bézier curves: letters of steps, and their numbers."""
    def __init__(self, steps: str, numbers: ArrayLike) -> None: ...
    @classmethod
    def of_svg(cls, path: str, *, tolerance: float | None = None) -> CurvePath:
        """The path in SVG's notation. Arcs must be those of circles."""
    @property
    def steps(self) -> str:
        """The letters of all steps."""
    @property
    def numbers(self) -> Array:
        """The numbers of all steps, of shape (K,)."""
    @property
    def length(self) -> float:
        """The length of all pieces."""
    @property
    def lengths(self) -> Array:
        """The length of each piece, of shape (P,): one for every step but ``M``, ``Z`` being the line back to the start."""
    @property
    def area(self) -> float:
        """The signed area of all contours, positive counter-clockwise."""
    @property
    def bounds(self) -> Optional[Array]:
        """The smallest box around the path, of shape (4,)."""
    def length_grad(self) -> tuple[float, Array]:
        """The length, and its derivatives by the numbers."""
    def lengths_vjp(self, lengths_bar: ArrayLike) -> tuple[Array, Array]:
        """The lengths of all pieces, and the cotangents of the numbers from those of the lengths."""
    def area_grad(self) -> tuple[float, Array]:
        """The signed area, and its derivatives by the numbers."""
    def reversed(self) -> CurvePath:
        """The path in the other direction."""
    def distance(self, points: ArrayLike) -> Array:
        """The distance of each point from the path."""
    def closest(self, points: ArrayLike) -> Array:
        """The place of the path that is nearest to each point, of shape (N, 2)."""
    def distance_vjp(self, points: ArrayLike, upstream: ArrayLike) -> tuple[Array, Array]:
        """Cotangents of the numbers and of the points, from those of the distances."""
    def winding_number(self, points: ArrayLike) -> Array:
        """How often the contours go around each point."""
    def contains(self, points: ArrayLike) -> Array:
        """True for each point around which the contours wind."""
    def flatten(self, tolerance: float) -> list[Array]:
        """The vertices of every contour with chords within a tolerance of the path, of shape (V, 2)."""

class Delaunay:
    """The Delaunay triangulation of points of the plane."""
    def __init__(self, points: ArrayLike) -> None: ...
    def __len__(self) -> int: ...
    @property
    def points(self) -> Array:
        """The points, of shape (N, 2)."""
    @property
    def triangles(self) -> Array:
        """The points of each triangle, of shape (T, 3)."""
    @property
    def neighbours(self) -> Array:
        """The triangle opposite each corner, of shape (T, 3): -1 at the hull."""
    @property
    def hull(self) -> Array:
        """The points of the convex hull, counter-clockwise."""
    @property
    def firsts(self) -> Array:
        """For each point the first one at its place."""
    @property
    def edges(self) -> Array:
        """The edges, each once, of shape (E, 2)."""
    @property
    def areas(self) -> Array:
        """The area of each triangle."""
    @property
    def circles(self) -> tuple[Array, Array]:
        """The centres and radii of the circles around the triangles."""
    def locate(self, places: ArrayLike) -> Array:
        """The triangle that contains each place, -1 outside of all, of shape (M,)."""
    def barycentric(self, places: ArrayLike) -> tuple[Array, Array]:
        """The triangle that contains each place, and the weights of its corners, of shape (M, 3)."""
    def barycentric_vjp(self, places: ArrayLike, weights_bar: ArrayLike) -> tuple[Array, Array]:
        """Cotangents of the points and of the places from those of the weights."""
    def areas_vjp(self, areas_bar: ArrayLike) -> Array:
        """Cotangents of the points from those of the areas."""

class Mesh:
    """A mesh of triangles, with a tree that is built once and serves all calls."""
    def __init__(self, vertices: Any, faces: Optional[ArrayLike] = ...) -> None: ...
    @property
    def vertices(self) -> Array:
        """The vertices, of shape (V, 3)."""
    @property
    def faces(self) -> Array:
        """The faces, of shape (F, 3)."""
    def __len__(self) -> int: ...
    def moved(self, vertices: ArrayLike) -> Mesh:
        """The mesh with its vertices at other places. The tree follows them in a fraction of the time of a new one."""
    def distance(self, points: ArrayLike) -> Array:
        """The distance of each point, at least 0."""
    def squared_distance(self, points: ArrayLike) -> Array:
        """The squared distance of each point."""
    def signed_distance(self, points: ArrayLike, *, winding: bool = ...) -> Array:
        """The distance of each point, negative inside. The mesh must be closed: each edge has two faces, in opposite directions.

        With ``winding`` any mesh will do: inside is where its winding number is above ½. The sign then jumps in holes.
        """
    def winding_number(self, points: ArrayLike) -> Array:
        """How often the mesh goes around each point: 1 inside a closed mesh and 0 outside, the mean of both on a face."""
    @property
    def edges(self) -> Array:
        """The edges of all faces, each once, of shape (E, 2)."""
    @property
    def hinges(self) -> Array:
        """The edges of two faces, of shape (H, 4): start, end, and the third corners of both faces."""
    def area(self) -> float:
        """The area of all faces."""
    def volume(self) -> float:
        """The volume inside a closed mesh, negative where faces look inward."""
    def centroid(self) -> Array:
        """The centroid of the volume inside a closed mesh."""
    def energy(self, kind: str, constants: Optional[ArrayLike] = ..., elements: Optional[ArrayLike] = ...) -> float:
        """A measure or an energy: ``"area"``, ``"volume"``, ``"dirichlet"``, ``"springs"`` or ``"bending"``."""
    def slopes(self, kind: str, constants: Optional[ArrayLike] = ..., elements: Optional[ArrayLike] = ...) -> Array:
        """The derivatives of an energy by the vertices, of shape (V, 3)."""
    def hessian(self, kind: str, constants: Optional[ArrayLike] = ..., elements: Optional[ArrayLike] = ...) -> tuple[Array, Array, Array]:
        """The second derivatives of an energy by the 3 V numbers of the vertices: rows, columns and values of a sparse matrix."""
    def laplacian(self) -> tuple[Array, Array, Array]:
        """The cotangent Laplacian, positive semidefinite: rows, columns and values of a sparse matrix with one row per vertex."""
    def closest(self, points: ArrayLike) -> tuple[Array, Array]:
        """The nearest point of the mesh for each point, and the index of its face."""
    def rays(self, starts: ArrayLike, directions: ArrayLike) -> tuple[Array, Array]:
        """Where each ray meets the mesh first: the parameter, by which its direction is multiplied, and the index of the face.

        A ray that misses has the parameter inf and the face -1.
        """
    def all_hits(self, starts: ArrayLike, directions: ArrayLike) -> tuple[Array, Array, Array]:
        """Every face that each ray meets: parameters, indices of rays and indices of faces, ray by ray in the order of parameters.

        A ray through an edge or a vertex meets every face there that is not edge-on.
        """
    def distance_to(self, solids: Shape) -> Array:
        """The distance of each solid from the faces, 0 where one meets it."""
    def closest_to(self, solids: Shape) -> tuple[Array, Array, Array]:
        """The nearest points of the mesh and of each solid, and the index of the face; where they meet, of the lowest face."""
    def touches(self, solids: Shape) -> Array:
        """Whether a face meets each solid: whether its distance is 0, found without the others."""
    def faces_within(self, solids: Shape, most: float) -> tuple[Array, Array]:
        """The faces whose distance from each solid is at most ``most``: indices of solids and of faces, solid by solid."""
    def distance_between(self, other: Mesh, poses: Any) -> Array:
        """The distance of the faces of another mesh from those of this one at each pose, 0 where they meet."""
    def closest_between(self, other: Mesh, poses: Any) -> tuple[Array, Array, Array]:
        """The nearest points of this mesh and of another one at each pose, in the frame of this one, and both faces, of shape (..., 2)."""
    def meets(self, other: Mesh, poses: Any) -> Array:
        """Whether faces of another mesh meet those of this one at each pose, found without the distance."""
    def pairs_within(self, other: Mesh, poses: Any, most: float) -> tuple[Array, Array]:
        """The faces of both meshes whose distance is at most ``most``: indices of poses, and pairs of shape (K, 2), pose by pose."""

class Cloud:
    """Points of space with a tree that is built once and serves all calls."""
    def __init__(self, points: ArrayLike) -> None: ...
    @property
    def points(self) -> Array:
        """The points, of shape (P, 3)."""
    def __len__(self) -> int: ...
    def nearest(self, queries: ArrayLike) -> Array:
        """The index of the point that is nearest to each query."""
    def distance(self, queries: ArrayLike) -> Array:
        """The distance of each query from its nearest point."""
    def squared_distance(self, queries: ArrayLike) -> Array:
        """The squared distance of each query from its nearest point."""
    def nearest_some(self, queries: ArrayLike, count: int) -> tuple[Array, Array]:
        """The indices of so many points that are nearest to each query, and their distances, in the order of these."""
    def within(self, queries: ArrayLike, radius: float) -> tuple[Array, Array]:
        """The indices of the points within a radius of each query, one query after another, and where each query starts."""
    def chamfer(self, other: Cloud, *, squared: bool = ...) -> float:
        """The mean squared distance of these points from the other cloud, plus that of the other cloud's points from this one."""
    def hausdorff(self, other: Cloud) -> tuple[float, int, int]:
        """The largest distance of a point of either cloud from the other one, and the pair that decides it: a point of each."""
    def f_score(self, other: Cloud, threshold: float) -> float:
        """The harmonic mean of the shares of both clouds that are as near to the other one."""

class Polygons:
    """A column of polygons, each of parts with holes."""
    def __init__(self, vertices: ArrayLike, offsets: Sequence[ArrayLike]) -> None: ...
    @classmethod
    def of(cls, polygons: Any) -> Polygons:
        """Polygons of a list, of geometries, of rings or of boxes."""
    @classmethod
    def from_shapely(cls, geometries: Any) -> Polygons:
        """Polygons of an array of shapely's polygons and multipolygons, or of a GeoSeries."""
    def to_shapely(self) -> Array:
        """An array of shapely's geometries: of a polygon of one part a Polygon, of any other a MultiPolygon."""
    @classmethod
    def from_arrow(cls, column: Any) -> Polygons:
        """Polygons of a GeoArrow column."""
    def to_arrow(self) -> Any:
        """A GeoArrow column of multipolygons."""
    @classmethod
    def concatenate(cls, columns: Iterable[Any]) -> Polygons:
        """The polygons of several columns, one after the other."""
    def tolist(self) -> list[list[list[Array]]]:
        """The polygons as lists of parts, each a list of rings of shape (V, 2)."""
    def union_all(self, *, valid: bool = ...) -> Polygons:
        """The union of all polygons of the column, a column of one."""
    def make_valid(self, *, fill: Fill = ...) -> Polygons:
        """The same areas as polygons that are valid by the OGC's rules."""
    @property
    def vertices(self) -> Array: ...
    @property
    def offsets(self) -> tuple[Array, Array, Array]: ...
    @property
    def bounds(self) -> Aabb2: ...
    def __len__(self) -> int: ...
    def __getitem__(self, key: Any) -> Polygons: ...
    def __iter__(self) -> Iterator[Polygons]: ...
    def __eq__(self, other: object) -> Any: ...
    def __ne__(self, other: object) -> Any: ...

class _Overlay:
    __name__: str
    def __call__(self, a: Any, b: Any, *, fill: Fill = ..., valid: bool = ...) -> Polygons: ...
    def vjp(self, a: Any, b: Any, upstream: ArrayLike, *, fill: Fill = ..., valid: bool = ...) -> tuple[Array, Array]:
        """Cotangents of the vertices of both columns, from those of the vertices of the result."""

class _Buffer:
    __name__: str
    def __call__(
        self, column: Any, distance: ArrayLike, *, join: Literal["round", "mitre", "bevel"] = ..., limit: float = ..., end: Literal["round", "flat", "square"] = ...,
        chords: int = ..., tolerance: Optional[float] = ..., fill: Fill = ..., valid: bool = ...,
    ) -> Polygons: ...
    def vjp(
        self, column: Any, distance: ArrayLike, upstream: ArrayLike, *, join: Literal["round", "mitre", "bevel"] = ..., limit: float = ..., end: Literal["round", "flat", "square"] = ...,
        chords: int = ..., tolerance: Optional[float] = ..., fill: Fill = ..., valid: bool = ...,
    ) -> tuple[Array, Array]:
        """Cotangents of the vertices of the column and of the distance, from those of the vertices of the result."""
    def curves(self, column: Any, distance: ArrayLike, *, fill: Fill = ...) -> list[Optional[CurvePath]]:
        """The border of each row's offset with round corners and ends, its arcs exact: a ``CurvePath``, ``None`` where nothing is left."""

buffer: _Buffer
"""{buffer}"""

class _BufferMeasure:
    __name__: str
    def __call__(self, column: Any, distance: ArrayLike, *, fill: Fill = ...) -> Array: ...
    def is_exact(self, column: Any, distance: ArrayLike, *, fill: Fill = ...) -> Array:
        """Says of each row whether its arcs are exact."""
    def value_grad(self, column: Any, distance: ArrayLike, *, fill: Fill = ...) -> tuple[Array, tuple[Array, Array]]:
        """Values, and the derivatives of each by the vertices of its row and by its distance."""
    def vjp(self, column: Any, distance: ArrayLike, upstream: ArrayLike, *, fill: Fill = ...) -> tuple[Array, Array]:
        """Cotangents of the vertices of the column and of the distance, from those of the values."""

buffer_area: _BufferMeasure
"""{buffer_area}"""
buffer_perimeter: _BufferMeasure
"""{buffer_perimeter}"""

class _UnionArea:
    __name__: str
    def __call__(self, a: Any, b: Any) -> Array: ...
    def value_grad(self, a: Any, b: Any) -> tuple[Array, tuple[Array, Array]]:
        """The value of every item, and its gradients by the vertices of both columns."""
    def vjp(self, a: Any, b: Any, upstream: ArrayLike) -> tuple[Array, Array]:
        """Cotangents of the vertices of both columns, from those of the values."""
    def all_pairs(self, a: Any, b: Any) -> Array:
        """Every polygon of `a` with every polygon of `b`: a matrix."""

union_area: _UnionArea
"""{union_area}"""

class HullMeasure:
    """A measure of the convex hulls of sets of points of space."""
    __name__: str
    def __call__(self, points: Any) -> Array:
        """The measure of every set."""
    def vjp(self, points: Any, upstream: ArrayLike) -> Array:
        """Cotangents of the points, from those of the measures."""
    def value_grad(self, points: Any) -> tuple[Array, Array]:
        """The measure of every set, one number, and its gradient by its points."""

class _Similarity:
    __name__: str
    def __call__(self, a: Any, b: Any) -> Array:
        """The distance of every item."""
    def vjp(self, a: Any, b: Any, upstream: ArrayLike) -> tuple[Array, Array]:
        """Cotangents of the vertices of both columns, from those of the distances."""
    def value_grad(self, a: Any, b: Any) -> tuple[Array, tuple[Array, Array]]:
        """The distance of every item, and its gradients by the vertices of both columns."""

hausdorff: _Similarity
"""{hausdorff}"""

frechet: _Similarity
"""{frechet}"""

def from_euler(order: str, angles: Any) -> Rotation3:
    """{from_euler}"""

def euler(rotation: Any, order: str) -> Any:
    """{euler}"""

def hull_faces(points: Any) -> tuple[Array, Array, Array]:
    """The faces of the convex hulls of sets of points of space: corners, where each face starts, where each hull starts."""

class _ConvexHull:
    __name__: str
    def __call__(self, points: Any) -> Polygons: ...
    def vjp(self, points: Any, upstream: ArrayLike) -> Array:
        """Cotangents of all points, from those of the vertices of the hulls."""

convex_hull: _ConvexHull
"""{convex_hull}"""

class _Procrustes:
    __name__: str
    def __call__(self, points: Any, targets: Any, weights: Optional[ArrayLike] = ..., *, rigid: bool = ...) -> tuple[Pose3, float]: ...
    def vjp(
        self, points: Any, targets: Any, weights: Optional[ArrayLike], pose_bar: ArrayLike, scale_bar: float = ..., *, rigid: bool = ...
    ) -> tuple[Array, Array, Array]:
        """Cotangents of points, targets and weights, from those of the pose and of the scale."""

procrustes: _Procrustes
"""{procrustes}"""

def contains(polygons: Any, points: Any, *, fill: Fill = ...) -> Array:
    """Says whether polygons contain points, item by item, decided exactly; the border belongs to a polygon."""

class Program:
    """The operations of a function, in the order in which they are carried out."""
    @property
    def dtype(self) -> str: ...
    @property
    def cost(self) -> int: ...
    def nodes(self) -> tuple[list[tuple[str, list[int], float]], list[int]]: ...
    def eval(self, input: Sequence[float]) -> list[float]: ...
    def wgsl(self, name: str = ...) -> str: ...
    def c(self, name: str = ...) -> str: ...
    def c_header(self, name: str = ...) -> str: ...
    def cuda(self, name: str = ...) -> str: ...
    def javascript(self, name: str = ...) -> str: ...

class Reports(Tuple[Any, ...]):
    """What the harness found out, a report for each format."""
    @property
    def passed(self) -> bool: ...

class _Forms:
    def row_max(self, a: Any, b: Any, *, groups: Groups = ..., {kind}backend: Backend = ...) -> tuple[Array, Array]:
        """The largest result of every row of `a`, and its row of `b`; -inf and -1 where `b`, or a group, has no rows of `b`."""
    def column_max(self, a: Any, b: Any, *, groups: Groups = ..., {kind}backend: Backend = ...) -> tuple[Array, Array]:
        """The largest result of every row of `b`, and its row of `a`; -inf and -1 where `a`, or a group, has no rows of `a`."""
    def all_pairs(self, a: Any, b: Any, *, {kind}out: Out = ..., backend: Backend = ...) -> Array:
        """Every row of `a` with every row of `b`: a matrix."""
    def above(
        self, a: Any, b: Any, threshold: float, *, groups: Groups = ..., {kind}backend: Backend = ...
    ) -> tuple[Array, Array, Array]:
        """Every pair, with groups every pair of a group, whose result is above a threshold: rows of `a`, rows of `b`, results."""
    def count_above(self, a: Any, b: Any, threshold: float, *, {kind}backend: Backend = ...) -> int:
        """How many pairs have a result above a threshold."""
    def row_min(
        self, a: Any, b: Any, *, within: Optional[float] = ..., groups: Groups = ...,
        lower: Optional[str] = ..., {kind}backend: Backend = ...
    ) -> tuple[Array, Array]:
        """The least result of every row of `a`, and its row of `b`; inf and -1 where none is at most `within`."""
    def column_min(
        self, a: Any, b: Any, *, within: Optional[float] = ..., groups: Groups = ...,
        lower: Optional[str] = ..., {kind}backend: Backend = ...
    ) -> tuple[Array, Array]:
        """The least result of every row of `b`, and its row of `a`; inf and -1 where none is at most `within`."""
    def nearest(
        self, a: Any, b: Any, *, within: Optional[float] = ..., groups: Groups = ...,
        lower: Optional[str] = ..., {kind}backend: Backend = ...
    ) -> tuple[Array, Array, Array]:
        """The least result of all pairs, or of every group, and its rows of `a` and of `b`; inf and -1 where there is none."""
    def below(
        self, a: Any, b: Any, limit: float, *, groups: Groups = ..., lower: Optional[str] = ..., {kind}backend: Backend = ...
    ) -> tuple[Array, Array, Array]:
        """Every pair, with groups every pair of a group, whose result is below a limit: rows of `a`, rows of `b`, results."""
    def count_below(
        self, a: Any, b: Any, limit: float, *, groups: Groups = ..., lower: Optional[str] = ..., {kind}backend: Backend = ...
    ) -> int:
        """How many pairs have a result below a limit."""
    def row_min_grad(
        self, a: Any, b: Any, *, within: Optional[float] = ..., groups: Groups = ...,
        lower: Optional[str] = ..., {kind}backend: Backend = ...
    ) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """What `row_min` returns, and the gradients of the sum of its finite results by both lists."""
    def column_min_grad(
        self, a: Any, b: Any, *, within: Optional[float] = ..., groups: Groups = ...,
        lower: Optional[str] = ..., {kind}backend: Backend = ...
    ) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """What `column_min` returns, and the gradients of the sum of its finite results by both lists."""
    def nearest_grad(
        self, a: Any, b: Any, *, within: Optional[float] = ..., groups: Groups = ...,
        lower: Optional[str] = ..., {kind}backend: Backend = ...
    ) -> tuple[tuple[Array, Array, Array], tuple[Array, Array]]:
        """What `nearest` returns, and the gradients of the sum of its finite results by both lists."""
    def sum(self, a: Any, b: Any, *, {kind}backend: Backend = ...) -> float:
        """The sum of the results of all pairs."""
    def mean(self, a: Any, b: Any, *, {kind}backend: Backend = ...) -> float:
        """The mean of the results of all pairs; zero where there are none."""
    def sum_grad(self, a: Any, b: Any, *, {kind}backend: Backend = ...) -> tuple[float, tuple[Array, Array]]:
        """The sum of the results of all pairs, and its gradients by both lists."""
    def mean_grad(self, a: Any, b: Any, *, {kind}backend: Backend = ...) -> tuple[float, tuple[Array, Array]]:
        """The mean of the results of all pairs, and its gradients by both lists."""
    def all_pairs_vjp(self, a: Any, b: Any, upstream: ArrayLike, *, {kind}backend: Backend = ...) -> tuple[Array, Array]:
        """Cotangents of both lists, for a matrix of those of all pairs."""
    def suppress(
        self, shapes: Any, scores: ArrayLike, overlap: float, *, classes: Optional[ArrayLike] = ..., score: Optional[float] = ...,
        most: Optional[int] = ..., groups: Optional[ArrayLike] = ..., kind: Kind = ...
    ) -> Array:
        """The places of the shapes that no better one, kept itself, overlaps by more than a threshold, the best first."""
    def aligned(self, *arguments: Any, {item}, **named: Any) -> Any:
        """Item i of every argument: the plain call under its name."""
    def value_grad(self, *arguments: Any, {item}, **named: Any) -> tuple[Array, Any]:
        """The value of every item, one number, and its gradient by every argument: of every item, also by one row that
        stands for all; sum over items for its gradient of the sum."""
    def vjp(self, *arguments: Any, {item}) -> Any:
        """Cotangents of the arguments; those of the result come last."""
    def jvp(self, *arguments: Any, {item}) -> tuple[Any, Any]:
        """The value and its derivative along directions, which come after the arguments."""
    def hvp(self, *arguments: Any, {item}) -> Any:
        """The derivative of the gradient along directions, which come after the arguments."""
    def jacobian(self, *arguments: Any, {item}, **named: Any) -> Array:
        """The derivatives of every number of the result by every number of the arguments."""
    def hessian(self, *arguments: Any, {item}, **named: Any) -> Array:
        """The second derivatives by all numbers of the arguments."""

class Verb(_Forms):
    """A function of shapes, of which the shapes choose the row."""
    __name__: str
    def program(self, *, kind: Kind, to: Kind = ..., form: Form = ..., double: bool = ...) -> Program: ...
    def replay(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., form: Form = ..., double: bool = ...) -> Program: ...
    def replayed(self, *item: Any, kind: Kind = ..., to: Kind = ...) -> Function:
        """A function of arrays by the decisions of a search for one item: its replay, which a card of CUDA runs, too."""
    def hints(self, *item: Any, kind: Kind = ..., to: Kind = ..., double: bool = ...) -> list[float]:
        """The hints of a search for one item, which its replay takes after the arguments."""
    def javascript(self, *, kind: Kind, to: Kind = ..., form: Form = ..., name: Optional[str] = ...) -> str: ...

class Function(_Forms):
    """A function that is recorded once, at its first call, and then runs on arrays."""
    __name__: str
    __wrapped__: Callable[..., Any]
    def __init__(self, function: Callable[..., Any]) -> None: ...
    def __call__(self, *arguments: Any, out: Out = ..., backend: Backend = ..., **named: Any) -> Any: ...
    def __get__(self, instance: object, owner: Any = ...) -> Function:
        """The function of an object's method."""
    @property
    def program(self) -> Program: ...
    def program_of(self, form: Form = ..., dtype: Any = ...) -> Program: ...
    def wgsl(self, name: Optional[str] = ...) -> str: ...
    def javascript(self, name: Optional[str] = ..., form: Form = ...) -> str: ...

def function(f: Callable[..., Any]) -> Function:
    """Records a function of annotated arguments once, and runs it on arrays, with all its derivatives."""

def check(
    f: Union[Function, Callable[..., Any]],
    gradient: Optional[Callable[..., Any]] = ...,
    *,
    vjp: Optional[Callable[..., Any]] = ...,
    takes: Any = ...,
    samples: int = ...,
    seed: int = ...,
    hard: bool = ...,
    inside: Optional[Callable[..., Any]] = ...,
    resolution: float = ...,
    relative_resolution: float = ...,
    jumps: Literal["never", "from zero", "anywhere"] = ...,
    points: Sequence[Any] = ...,
    dtype: Any = ...,
    name: Optional[str] = ...,
    quiet: bool = ...,
) -> Reports:
    """Runs the harness on the derivatives of a function, prints its report and returns it."""

def set_num_threads(threads: int) -> None:
    """Sets how many threads calls use, from 1 to 1024."""
def get_num_threads() -> int:
    """How many threads calls use: GEOGRAD_THREADS, or as many as there are processors."""
def sees(points: Union[Vec3, ArrayLike], camera: Union[Pinhole, BrownConrady, Fisheye]) -> Array:
    """Whether each camera sees each point of its frame, an array of truths: where not, the pixel of `project` means nothing."""
def where(condition: Any, a: Any, b: Any) -> Any:
    """`a` where the condition holds, else `b`."""
def clip(x: Any, low: Any, high: Any) -> Any:
    """The nearest value between two bounds; of symbols the derivative is shared at either."""
'''

ITEM = "kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..."


def documented(text, indent):
    lines = text.replace("\\", "\\\\").splitlines()
    if len(lines) == 1:
        return f'{indent}"""{lines[0]}"""'
    return "\n".join([f'{indent}"""{lines[0]}', *[f"{indent}{line}".rstrip() for line in lines[1:]], f'{indent}"""'])


def field_groups(fields):
    """The attributes of a shape: numbers, and parts of several."""
    made = {}
    for name, _, _ in fields:
        head, _, rest = name.partition(".")
        head, _, item = head.partition("[")
        head = head + "_" if keyword.iskeyword(head) else head
        made.setdefault(head or "items", []).append((rest, bool(item)))
    for head, parts in made.items():
        names = tuple(rest for rest, _ in parts)
        if parts[0][1]:
            kind = "list[Any]"
        elif names == ("x", "y"):
            kind = "Vec2"
        elif names == ("x", "y", "z"):
            kind = "Vec3"
        else:
            kind = "Any"
        yield head, kind


#: Paths by their kinds; of the plane and of space they have one class.
PATHS = {"ring": "Rings", "polyline": "Polylines", "polyline3": "Polylines", "cloud3": "Clouds"}


def overloads(name):
    """The calls of a verb, each with the types that it takes and gives: one for all rows that differ in neither."""
    made, by_result = {}, {}
    for row in ordered(name):
        names = [argument for argument, _, _ in row["takes"]] + (["paths"] if row["sort"] == "fold" else [])
        kinds = tuple({"number": "ArrayLike", **PATHS}.get(kind, kind) for kind in row["kinds"])
        (_, gives, size), *more = row["gives"]
        result = "Any" if more else gives if size else "Array"
        takes = ", ".join(f"{argument}: {kind}" for argument, kind in zip(names, kinds))
        by_result.setdefault(kinds, {})[result] = takes
    for kinds, results in by_result.items():
        if len(results) > 1 and all(result not in ("Any", "Array") for result in results):
            # One of them by `to`.
            for result, takes in results.items():
                made[kinds, result] = takes, f"Union[Type[{result}], Literal[\"{result}\"]]"
        else:
            (result, takes), *more = results.items()
            made[kinds, "Any" if more else result] = takes, "Kind = ..."
    return [(takes, to, result) for (_, result), (takes, to) in made.items()]


def gradients(name):
    """The type of the gradients of a verb: one by every argument, or the only one."""
    counts = {len(row["kinds"]) == 1 for row in ordered(name)}
    return "Any" if len(counts) > 1 else "Array" if True in counts else "tuple[Array, ...]"


def polygons(verb):
    """The overloads of a verb for polygons and sets of points: what each takes and gives."""
    if verb in _polygons.VERBS:
        takes, gives = _polygons.VERBS[verb]
        yield takes.replace("point: Vec2", "point: Union[Vec2, Array]"), "Array" if gives == "number" else gives
        for takes, _ in _polygons.FURTHER.get(verb, []):
            # One of several shapes, in either place.
            takes = re.sub(r": (\w+(?:, \w+)* or \w+)", lambda own: f": Union[{own[1].replace(' or ', ', ')}]", takes)
            pair = re.findall(r"\w+: (?:Union\[.*?\]|\w+)", takes)
            yield from ((", ".join(own), "Array") for own in ([pair, pair[::-1]] if "Union" in takes else [pair]))
    if verb in _points.VERBS:
        yield "points: Union[Paths, Polygons]", _points.VERBS[verb] or "Array"


def stubs():
    of = {name: inspect.cleandoc(getattr(geograd, name).__doc__) for name in ("buffer", "buffer_area", "buffer_perimeter", "union_area", "convex_hull", "procrustes", "euler", "from_euler", "hausdorff", "frechet")}
    lines = [HEAD.format(doc=geograd.__doc__, **of, item=ITEM, kind="kind: Kind = ..., ").replace("Report = _core.Report\n", "")]
    for name, count in ELEMENTARY.items():
        symbolic = ["x: Symbol"] if count == 1 else ["a: Symbol, b: Union[Symbol, float]", "a: float, b: Symbol"]
        takes = "x: ArrayLike" if count == 1 else "a: ArrayLike, b: ArrayLike"
        for own, gives in [*((own, "Symbol") for own in symbolic), (takes, "Any")]:
            lines.append(f"@overload\ndef {name}({own}) -> {gives}:\n" + documented(getattr(geograd, name).__doc__, "    "))
    for name, fields, _ in sorted(_core.shapes()):
        if fields:
            cls = getattr(geograd, name)
            lines.append(f"\nclass {name}(Shape):\n" + documented(cls.__doc__, "    "))
            lines.append("    def __init__(self, *numbers: Any, **named: Any) -> None: ...")
            for head, kind in field_groups(fields):
                lines.append(f"    @property\n    def {head}(self) -> {kind}: ...")
            if name in ("Vec2", "Vec3"):
                lines.append(VECTOR.format(name=name))
    for name in sorted(_core.verbs()):
        lines.append(f"\nclass _{name}(Verb):\n" + documented(describe(name), "    "))
        for takes, to, result in overloads(name):
            lines.append("    @overload")
            lines.append(f"    def __call__(self, {takes}, /, *, kind: None = ..., to: {to}, out: Out = ..., backend: Backend = ...) -> {result}: ...")
        for takes, gives in polygons(name):
            lines.append(f"    @overload\n    def __call__(self, {takes}, /) -> {gives}: ...")
        lines.append("    @overload\n    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...")
        lines.append(f"    def value_grad(self, *arguments: Any, {ITEM}, **named: Any) -> tuple[Array, {gradients(name)}]: ...")
        lines.append(f"\n{name}: _{name}")
    for name, own in sorted(_hulls.MEASURES.items()):
        lines.append(f"\n{name}: HullMeasure\n" + documented(own.__doc__, ""))
    for name in sorted(_polygons.OVERLAYS):
        lines.append(f"\n{name}: _Overlay\n" + documented(_polygons.OVERLAYS[name].__doc__, ""))
    return "\n".join(lines) + "\n"


VECTOR = '''    def __add__(self, other: {name}) -> {name}: ...
    def __sub__(self, other: {name}) -> {name}: ...
    def __mul__(self, factor: Any) -> {name}: ...
    def __rmul__(self, factor: Any) -> {name}: ...
    def __truediv__(self, factor: Any) -> {name}: ...
    def __neg__(self) -> {name}: ...
    def dot(self, other: {name}) -> Any: ...
    def length(self) -> Any: ...'''

ON_TENSORS = '''# Written by stubs.py, from the table of the library.
from typing import Any, Generic, Optional, Sequence, Type, TypeVar, Union

import torch

from geograd import Paths as _Paths, Polygons as _Polygons, Shape
from geograd._torch_polygons import Column

Kind = Union[str, Type[Shape], None, Sequence[Union[str, Type[Shape], None]]]
Argument = Union[torch.Tensor, float]
Offsets = Union[torch.Tensor, Sequence[int], Any]
_Column = Union[Column, _Polygons, _Paths]
_Result = TypeVar("_Result", covariant=True)

class Verb(Generic[_Result]):
    """A verb on tensors, with derivatives of any order."""
    __name__: str
    def __init__(self, name: str) -> None: ...
    def __call__(self, *arguments: Union[Argument, _Column], kind: Kind = ..., to: Kind = ...) -> _Result: ...
    def all_pairs(self, a: Union[torch.Tensor, _Column], b: Union[torch.Tensor, _Column], *, kind: Kind = ...) -> torch.Tensor: ...
    def sum(self, a: torch.Tensor, b: torch.Tensor, *, kind: Kind = ...) -> torch.Tensor: ...
    def mean(self, a: torch.Tensor, b: torch.Tensor, *, kind: Kind = ...) -> torch.Tensor: ...
    def row_max(
        self, a: torch.Tensor, b: torch.Tensor, *, groups: Optional[Sequence[Offsets]] = ..., kind: Kind = ...
    ) -> tuple[torch.Tensor, torch.Tensor]: ...
    def column_max(
        self, a: torch.Tensor, b: torch.Tensor, *, groups: Optional[Sequence[Offsets]] = ..., kind: Kind = ...
    ) -> tuple[torch.Tensor, torch.Tensor]: ...
    def above(
        self, a: torch.Tensor, b: torch.Tensor, threshold: float, *, groups: Optional[Sequence[Offsets]] = ..., kind: Kind = ...
    ) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]: ...
    def count_above(self, a: torch.Tensor, b: torch.Tensor, threshold: float, *, kind: Kind = ...) -> int: ...
    def row_min(
        self, a: torch.Tensor, b: torch.Tensor, *, within: Optional[float] = ...,
        groups: Optional[Sequence[Offsets]] = ..., lower: Optional[str] = ..., kind: Kind = ...
    ) -> tuple[torch.Tensor, torch.Tensor]: ...
    def column_min(
        self, a: torch.Tensor, b: torch.Tensor, *, within: Optional[float] = ...,
        groups: Optional[Sequence[Offsets]] = ..., lower: Optional[str] = ..., kind: Kind = ...
    ) -> tuple[torch.Tensor, torch.Tensor]: ...
    def nearest(
        self, a: torch.Tensor, b: torch.Tensor, *, within: Optional[float] = ...,
        groups: Optional[Sequence[Offsets]] = ..., lower: Optional[str] = ..., kind: Kind = ...
    ) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]: ...
    def below(
        self, a: torch.Tensor, b: torch.Tensor, limit: float, *, groups: Optional[Sequence[Offsets]] = ..., lower: Optional[str] = ..., kind: Kind = ...
    ) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]: ...
    def count_below(self, a: torch.Tensor, b: torch.Tensor, limit: float, *, kind: Kind = ...) -> int: ...
    def suppress(
        self, shapes: torch.Tensor, scores: torch.Tensor, overlap: float, *, classes: Optional[Offsets] = ...,
        score: Optional[float] = ..., most: Optional[int] = ..., groups: Optional[Offsets] = ..., kind: Kind = ...
    ) -> torch.Tensor: ...

'''

ON_ARRAYS = '''# Written by stubs.py, from the table of the library.
from typing import Any, Generic, Sequence, Type, TypeVar, Union

import jax
from jax.typing import ArrayLike

from geograd import Paths as _Paths, Polygons as _Polygons, Shape
from geograd._jax_columns import Column

Kind = Union[str, Type[Shape], None, Sequence[Union[str, Type[Shape], None]]]
_Column = Union[Column, _Polygons, _Paths]
_Result = TypeVar("_Result", covariant=True)

class Verb(Generic[_Result]):
    """A verb on JAX's arrays, with derivatives of any order."""
    __name__: str
    def __init__(self, name: str) -> None: ...
    def __call__(self, *arguments: Union[ArrayLike, _Column], kind: Kind = ..., to: Kind = ...) -> _Result: ...
    def all_pairs(self, a: Union[ArrayLike, _Column], b: Union[ArrayLike, _Column], *, kind: Kind = ...) -> jax.Array: ...

'''


ON_CARDS = '''# Written by stubs.py, from the table of the library.
from typing import Any, Generic, Optional, Sequence, Type, TypeVar, Union, overload

from numpy.typing import ArrayLike

from geograd import Shape
from geograd._cuda_arrays import Array, OnCard

Kind = Union[str, Type[Shape], None, Sequence[Union[str, Type[Shape], None]]]
Groups = Optional[Sequence[Union[ArrayLike, OnCard]]]
_Result = TypeVar("_Result", covariant=True)
_Out = TypeVar("_Out", bound=OnCard)

class Verb(Generic[_Result]):
    """A verb on arrays of a card."""
    __name__: str
    def __init__(self, name: str) -> None: ...
    @overload
    def __call__(self, *arguments: OnCard, kind: Kind = ..., to: Kind = ..., out: None = ...) -> _Result: ...
    @overload
    def __call__(self, *arguments: OnCard, kind: Kind = ..., to: Kind = ..., out: _Out) -> _Out: ...
    @overload
    def __call__(self, *arguments: OnCard, kind: Kind = ..., to: Kind = ..., out: Sequence[Optional[OnCard]]) -> Any: ...
    @overload
    def value_grad(self, *arguments: OnCard, kind: Kind = ..., out: None = ...) -> tuple[Array, tuple[Array, ...]]: ...
    @overload
    def value_grad(self, *arguments: OnCard, kind: Kind = ..., out: Sequence[Any]) -> tuple[Any, tuple[Any, ...]]: ...
    @overload
    def vjp(self, *arguments: OnCard, kind: Kind = ..., to: Kind = ..., out: None = ...) -> tuple[Array, ...]: ...
    @overload
    def vjp(self, *arguments: OnCard, kind: Kind = ..., to: Kind = ..., out: Union[OnCard, Sequence[Any]]) -> tuple[Any, ...]: ...
    @overload
    def jvp(self, *arguments: OnCard, kind: Kind = ..., to: Kind = ..., out: None = ...) -> tuple[Array, ...]: ...
    @overload
    def jvp(self, *arguments: OnCard, kind: Kind = ..., to: Kind = ..., out: Sequence[Any]) -> tuple[Any, ...]: ...
    @overload
    def all_pairs(self, a: OnCard, b: OnCard, *, kind: Kind = ..., out: None = ...) -> Array: ...
    @overload
    def all_pairs(self, a: OnCard, b: OnCard, *, kind: Kind = ..., out: _Out) -> _Out: ...
    def row_max(
        self, a: OnCard, b: OnCard, *, groups: Groups = ..., kind: Kind = ...
    ) -> tuple[Array, Array]: ...
    def row_min(
        self, a: OnCard, b: OnCard, *, groups: Groups = ..., kind: Kind = ...
    ) -> tuple[Array, Array]: ...
    def column_max(
        self, a: OnCard, b: OnCard, *, groups: Groups = ..., kind: Kind = ...
    ) -> tuple[Array, Array]: ...
    def column_min(
        self, a: OnCard, b: OnCard, *, groups: Groups = ..., kind: Kind = ...
    ) -> tuple[Array, Array]: ...
    def above(
        self, a: OnCard, b: OnCard, threshold: float, *, groups: Groups = ..., kind: Kind = ...
    ) -> tuple[Array, Array, Array]: ...
    def below(
        self, a: OnCard, b: OnCard, limit: float, *, groups: Groups = ..., kind: Kind = ...
    ) -> tuple[Array, Array, Array]: ...
    def count_above(
        self, a: OnCard, b: OnCard, threshold: float, *, groups: Groups = ..., kind: Kind = ...
    ) -> int: ...
    def count_below(
        self, a: OnCard, b: OnCard, limit: float, *, groups: Groups = ..., kind: Kind = ...
    ) -> int: ...
    def sum(
        self, a: OnCard, b: OnCard, *, groups: Groups = ..., kind: Kind = ...
    ) -> Array: ...
    def sum_grad(
        self, a: OnCard, b: OnCard, *, groups: Groups = ..., kind: Kind = ...
    ) -> tuple[Array, tuple[Array, Array]]: ...

'''


def verbs_on(head, result):
    """The verbs on tensors or arrays."""
    lines = [head.rstrip("\n"), "", f"__all__ = {sorted(_core.verbs())!r}".replace("'", '"'), ""]
    for name in sorted(_core.verbs()):
        several = any(len(row["gives"]) > 1 for row in ordered(name))
        lines.append(f"{name}: Verb[{'Any' if several else result}]")
    return "\n".join(lines) + "\n"


def all_stubs():
    return {
        "__init__.pyi": stubs(),
        "_torch_verbs.pyi": verbs_on(ON_TENSORS, "torch.Tensor"),
        "_jax_verbs.pyi": verbs_on(ON_ARRAYS, "jax.Array"),
        "_cuda_verbs.pyi": verbs_on(ON_CARDS, "Array"),
        "_torch_polygons.pyi": stubs_of_columns.ON_TENSORS,
        "_jax_columns.pyi": stubs_of_columns.ON_ARRAYS,
    }


if __name__ == "__main__":
    for name, text in all_stubs().items():
        if "--check" not in sys.argv:
            (FOLDER / name).write_text(text)
        elif (FOLDER / name).read_text() != text:
            sys.exit(f"{FOLDER / name} is stale: run python {__file__}")
