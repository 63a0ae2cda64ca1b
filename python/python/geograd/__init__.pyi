"""Exact IoU, distances and overlaps of boxes and polygons on NumPy arrays, with exact gradients.

Every verb (``geograd.iou``, ``geograd.distance``, ...) takes shapes: arrays whose last axis has the numbers of one::

    a, b = geograd.Obb2(A), geograd.Obb2(B)            # A and B of shape (N, 5)
    value = geograd.iou(a, b)                          # (N,)
    value, (by_a, by_b) = geograd.iou.value_grad(a, b)
    matrix = geograd.iou.all_pairs(a, b)               # (N, N)
    value = geograd.iou(A, B, kind="Obb2")             # the same on plain arrays

``@geograd.function`` records a function of your own once and gives it the same forms; ``geograd.check`` checks a gradient.
"""

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
"""Polygons grown (a positive distance) or shrunk (a negative one), or the surroundings of open paths, row by row.

``distance`` is one number, or one per row. Corners that open are joined by an arc (``join="round"``), by both edges up
to their crossing (``"mitre"``, cut ``limit`` distances from the corner) or by a straight line (``"bevel"``). Paths end
in half a circle (``end="round"``), a line through the end (``"flat"``) or one a distance beyond it (``"square"``).
An arc has ``chords`` per quarter of a turn; with a ``tolerance``, as many as keep them within that length of the arc.

A polygon may be of any kind, crossing itself included: ``fill`` says what is inside. The distance zero gives the
polygon itself, a distance that leaves nothing a polygon without parts; paths have a positive distance, or no parts.

The vertices of the result have derivatives by those of the column and by the distance (``vjp``). Edges of it may
cross by a rounding; with ``valid=True`` it is valid by the OGC's rules, as :func:`geograd.union` says.

>>> square = geograd.Polygons.of([[(0, 0), (4, 0), (4, 4), (0, 4)]])
>>> geograd.area(geograd.buffer(square, 1.0, join="mitre"))
array([36.])"""

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
"""The area of polygons grown (a positive distance) or shrunk (a negative one), or of the surroundings of open paths,
row by row, with round corners and ends whose arcs are exact: no chords.

``distance`` is one number, or one per row. A polygon may be of any kind: ``fill`` says what is inside. A row that the distance empties has 0. The area grows by the perimeter.

The vertices of the column and the distance have exact derivatives (``value_grad``, ``vjp``): those of the motion of the
border. Where it cannot be certain of the arcs, such as for a path that lies along itself, 128 chords or more per quarter
of a turn stand for them; ``is_exact`` tells.

>>> square = geograd.Polygons.of([[(0, 0), (4, 0), (4, 4), (0, 4)]])
>>> geograd.buffer_area(square, 1.0)
array([35.14159265])"""
buffer_perimeter: _BufferMeasure
"""The perimeter, holes included, of polygons grown (a positive distance) or shrunk (a negative one), or of the surroundings of open paths,
row by row, with round corners and ends whose arcs are exact: no chords.

``distance`` is one number, or one per row. A polygon may be of any kind: ``fill`` says what is inside. A row that the distance empties has 0.

The vertices of the column and the distance have exact derivatives (``value_grad``, ``vjp``): those of the motion of the
border. Where it cannot be certain of the arcs, such as for a path that lies along itself, 128 chords or more per quarter
of a turn stand for them; ``is_exact`` tells.

>>> square = geograd.Polygons.of([[(0, 0), (4, 0), (4, 4), (0, 4)]])
>>> geograd.buffer_perimeter(square, 1.0)
array([22.28318531])"""

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
"""The area that two polygons cover together, item by item, in squared units of length."""

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
"""Hausdorff's distance, as shapely's: the largest one of a vertex of either figure from the other's edges.

A distance of two columns of figures of the plane, item by item: ``Polylines``, ``Rings``, ``Polygons``, lists of paths, or
    shapely's geometries. One item stands for all. An item without vertices has the distance NaN and derivatives of zero.

    Gradients are by all vertices, of their shape. The pair that decides has them all: a vertex, and the ends of an edge or
    another vertex.
    """

frechet: _Similarity
"""The discrete Fréchet distance, as shapely's: the shortest leash for walks along the vertices of both paths.

A distance of two columns of figures of the plane, item by item: ``Polylines``, ``Rings``, ``Polygons``, lists of paths, or
    shapely's geometries. One item stands for all. An item without vertices has the distance NaN and derivatives of zero.

    Gradients are by all vertices, of their shape. The pair that decides has them all: a vertex, and the ends of an edge or
    another vertex.
    """

def from_euler(order: str, angles: Any) -> Rotation3:
    """The rotations of three angles in radians about the axes that the order names, each an axis of the body as the turns
before have left it: ``"ZYX"`` takes yaw, pitch, roll. SciPy has the same capital letters.

``angles`` are an array of shape ``(..., 3)``, or three numbers or symbols of a :class:`geograd.function`."""

def euler(rotation: Any, order: str) -> Any:
    """The three angles in radians of rotations about the axes that the order names, as :func:`geograd.from_euler` takes
them: an array of shape ``(..., 3)``, or of symbols a tuple.

The first and the third are from -pi to pi, the middle one from -pi/2 to pi/2, or from 0 to pi where the first and the
third axis are equal. Exactly at either end of the middle one's range only the sum or the difference of the others is
determined: they share it equally."""

def hull_faces(points: Any) -> tuple[Array, Array, Array]:
    """The faces of the convex hulls of sets of points of space: corners, where each face starts, where each hull starts."""

class _ConvexHull:
    __name__: str
    def __call__(self, points: Any) -> Polygons: ...
    def vjp(self, points: Any, upstream: ArrayLike) -> Array:
        """Cotangents of all points, from those of the vertices of the hulls."""

convex_hull: _ConvexHull
"""The convex hull of each set of points, as polygons.

Sets are a list of arrays of shape (P, 2), paths, or the vertices of polygons. Points on a line have a hull without parts."""

class _Procrustes:
    __name__: str
    def __call__(self, points: Any, targets: Any, weights: Optional[ArrayLike] = ..., *, rigid: bool = ...) -> tuple[Pose3, float]: ...
    def vjp(
        self, points: Any, targets: Any, weights: Optional[ArrayLike], pose_bar: ArrayLike, scale_bar: float = ..., *, rigid: bool = ...
    ) -> tuple[Array, Array, Array]:
        """Cotangents of points, targets and weights, from those of the pose and of the scale."""

procrustes: _Procrustes
"""The motion that brings points of space closest to targets, by the sum of weighted squared distances.

Takes points and targets of shape (P, 3) and weights of shape (P,), by default ones. Gives a ``Pose3``, applied second,
and a scale, applied first: ``pose * (scale * point)``. With ``rigid=True`` the scale is 1."""

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
    def row_max(self, a: Any, b: Any, *, groups: Groups = ..., kind: Kind = ..., backend: Backend = ...) -> tuple[Array, Array]:
        """The largest result of every row of `a`, and its row of `b`; -inf and -1 where `b`, or a group, has no rows of `b`."""
    def column_max(self, a: Any, b: Any, *, groups: Groups = ..., kind: Kind = ..., backend: Backend = ...) -> tuple[Array, Array]:
        """The largest result of every row of `b`, and its row of `a`; -inf and -1 where `a`, or a group, has no rows of `a`."""
    def all_pairs(self, a: Any, b: Any, *, kind: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array:
        """Every row of `a` with every row of `b`: a matrix."""
    def above(
        self, a: Any, b: Any, threshold: float, *, groups: Groups = ..., kind: Kind = ..., backend: Backend = ...
    ) -> tuple[Array, Array, Array]:
        """Every pair, with groups every pair of a group, whose result is above a threshold: rows of `a`, rows of `b`, results."""
    def count_above(self, a: Any, b: Any, threshold: float, *, kind: Kind = ..., backend: Backend = ...) -> int:
        """How many pairs have a result above a threshold."""
    def row_min(
        self, a: Any, b: Any, *, within: Optional[float] = ..., groups: Groups = ...,
        lower: Optional[str] = ..., kind: Kind = ..., backend: Backend = ...
    ) -> tuple[Array, Array]:
        """The least result of every row of `a`, and its row of `b`; inf and -1 where none is at most `within`."""
    def column_min(
        self, a: Any, b: Any, *, within: Optional[float] = ..., groups: Groups = ...,
        lower: Optional[str] = ..., kind: Kind = ..., backend: Backend = ...
    ) -> tuple[Array, Array]:
        """The least result of every row of `b`, and its row of `a`; inf and -1 where none is at most `within`."""
    def nearest(
        self, a: Any, b: Any, *, within: Optional[float] = ..., groups: Groups = ...,
        lower: Optional[str] = ..., kind: Kind = ..., backend: Backend = ...
    ) -> tuple[Array, Array, Array]:
        """The least result of all pairs, or of every group, and its rows of `a` and of `b`; inf and -1 where there is none."""
    def below(
        self, a: Any, b: Any, limit: float, *, groups: Groups = ..., lower: Optional[str] = ..., kind: Kind = ..., backend: Backend = ...
    ) -> tuple[Array, Array, Array]:
        """Every pair, with groups every pair of a group, whose result is below a limit: rows of `a`, rows of `b`, results."""
    def count_below(
        self, a: Any, b: Any, limit: float, *, groups: Groups = ..., lower: Optional[str] = ..., kind: Kind = ..., backend: Backend = ...
    ) -> int:
        """How many pairs have a result below a limit."""
    def row_min_grad(
        self, a: Any, b: Any, *, within: Optional[float] = ..., groups: Groups = ...,
        lower: Optional[str] = ..., kind: Kind = ..., backend: Backend = ...
    ) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """What `row_min` returns, and the gradients of the sum of its finite results by both lists."""
    def column_min_grad(
        self, a: Any, b: Any, *, within: Optional[float] = ..., groups: Groups = ...,
        lower: Optional[str] = ..., kind: Kind = ..., backend: Backend = ...
    ) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """What `column_min` returns, and the gradients of the sum of its finite results by both lists."""
    def nearest_grad(
        self, a: Any, b: Any, *, within: Optional[float] = ..., groups: Groups = ...,
        lower: Optional[str] = ..., kind: Kind = ..., backend: Backend = ...
    ) -> tuple[tuple[Array, Array, Array], tuple[Array, Array]]:
        """What `nearest` returns, and the gradients of the sum of its finite results by both lists."""
    def sum(self, a: Any, b: Any, *, kind: Kind = ..., backend: Backend = ...) -> float:
        """The sum of the results of all pairs."""
    def mean(self, a: Any, b: Any, *, kind: Kind = ..., backend: Backend = ...) -> float:
        """The mean of the results of all pairs; zero where there are none."""
    def sum_grad(self, a: Any, b: Any, *, kind: Kind = ..., backend: Backend = ...) -> tuple[float, tuple[Array, Array]]:
        """The sum of the results of all pairs, and its gradients by both lists."""
    def mean_grad(self, a: Any, b: Any, *, kind: Kind = ..., backend: Backend = ...) -> tuple[float, tuple[Array, Array]]:
        """The mean of the results of all pairs, and its gradients by both lists."""
    def all_pairs_vjp(self, a: Any, b: Any, upstream: ArrayLike, *, kind: Kind = ..., backend: Backend = ...) -> tuple[Array, Array]:
        """Cotangents of both lists, for a matrix of those of all pairs."""
    def suppress(
        self, shapes: Any, scores: ArrayLike, overlap: float, *, classes: Optional[ArrayLike] = ..., score: Optional[float] = ...,
        most: Optional[int] = ..., groups: Optional[ArrayLike] = ..., kind: Kind = ...
    ) -> Array:
        """The places of the shapes that no better one, kept itself, overlaps by more than a threshold, the best first."""
    def aligned(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> Any:
        """Item i of every argument: the plain call under its name."""
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Any]:
        """The value of every item, one number, and its gradient by every argument: of every item, also by one row that
        stands for all; sum over items for its gradient of the sum."""
    def vjp(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any:
        """Cotangents of the arguments; those of the result come last."""
    def jvp(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> tuple[Any, Any]:
        """The value and its derivative along directions, which come after the arguments."""
    def hvp(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any:
        """The derivative of the gradient along directions, which come after the arguments."""
    def jacobian(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> Array:
        """The derivatives of every number of the result by every number of the arguments."""
    def hessian(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> Array:
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

@overload
def sqrt(x: Symbol) -> Symbol:
    """The square root; NaN below zero. Of symbols with derivative zero at zero."""
@overload
def sqrt(x: ArrayLike) -> Any:
    """The square root; NaN below zero. Of symbols with derivative zero at zero."""
@overload
def square(x: Symbol) -> Symbol:
    """The square."""
@overload
def square(x: ArrayLike) -> Any:
    """The square."""
@overload
def sin(x: Symbol) -> Symbol:
    """The sine of an angle in radians."""
@overload
def sin(x: ArrayLike) -> Any:
    """The sine of an angle in radians."""
@overload
def cos(x: Symbol) -> Symbol:
    """The cosine of an angle in radians."""
@overload
def cos(x: ArrayLike) -> Any:
    """The cosine of an angle in radians."""
@overload
def tan(x: Symbol) -> Symbol:
    """The tangent of an angle in radians."""
@overload
def tan(x: ArrayLike) -> Any:
    """The tangent of an angle in radians."""
@overload
def exp(x: Symbol) -> Symbol:
    """The exponential."""
@overload
def exp(x: ArrayLike) -> Any:
    """The exponential."""
@overload
def log(x: Symbol) -> Symbol:
    """The natural logarithm."""
@overload
def log(x: ArrayLike) -> Any:
    """The natural logarithm."""
@overload
def cbrt(x: Symbol) -> Symbol:
    """The cube root; of symbols with derivative zero at zero."""
@overload
def cbrt(x: ArrayLike) -> Any:
    """The cube root; of symbols with derivative zero at zero."""
@overload
def exp2(x: Symbol) -> Symbol:
    """Two to a power; of symbols right to x roundings."""
@overload
def exp2(x: ArrayLike) -> Any:
    """Two to a power; of symbols right to x roundings."""
@overload
def expm1(x: Symbol) -> Symbol:
    """The exponential less one, right near zero."""
@overload
def expm1(x: ArrayLike) -> Any:
    """The exponential less one, right near zero."""
@overload
def log1p(x: Symbol) -> Symbol:
    """The natural logarithm of one more, right near zero."""
@overload
def log1p(x: ArrayLike) -> Any:
    """The natural logarithm of one more, right near zero."""
@overload
def log2(x: Symbol) -> Symbol:
    """The logarithm to the base 2."""
@overload
def log2(x: ArrayLike) -> Any:
    """The logarithm to the base 2."""
@overload
def log10(x: Symbol) -> Symbol:
    """The logarithm to the base 10."""
@overload
def log10(x: ArrayLike) -> Any:
    """The logarithm to the base 10."""
@overload
def logaddexp(a: Symbol, b: Union[Symbol, float]) -> Symbol:
    """The logarithm of the sum of two exponentials, without overflow."""
@overload
def logaddexp(a: float, b: Symbol) -> Symbol:
    """The logarithm of the sum of two exponentials, without overflow."""
@overload
def logaddexp(a: ArrayLike, b: ArrayLike) -> Any:
    """The logarithm of the sum of two exponentials, without overflow."""
@overload
def sinh(x: Symbol) -> Symbol:
    """The hyperbolic sine."""
@overload
def sinh(x: ArrayLike) -> Any:
    """The hyperbolic sine."""
@overload
def cosh(x: Symbol) -> Symbol:
    """The hyperbolic cosine."""
@overload
def cosh(x: ArrayLike) -> Any:
    """The hyperbolic cosine."""
@overload
def tanh(x: Symbol) -> Symbol:
    """The hyperbolic tangent."""
@overload
def tanh(x: ArrayLike) -> Any:
    """The hyperbolic tangent."""
@overload
def arcsinh(x: Symbol) -> Symbol:
    """The inverse of the hyperbolic sine."""
@overload
def arcsinh(x: ArrayLike) -> Any:
    """The inverse of the hyperbolic sine."""
@overload
def arccosh(x: Symbol) -> Symbol:
    """The inverse of the hyperbolic cosine; NaN below 1."""
@overload
def arccosh(x: ArrayLike) -> Any:
    """The inverse of the hyperbolic cosine; NaN below 1."""
@overload
def arctanh(x: Symbol) -> Symbol:
    """The inverse of the hyperbolic tangent; NaN beyond 1."""
@overload
def arctanh(x: ArrayLike) -> Any:
    """The inverse of the hyperbolic tangent; NaN beyond 1."""
@overload
def arcsin(x: Symbol) -> Symbol:
    """The angle in radians with a sine; NaN beyond 1, of symbols with derivative zero at 1 and -1."""
@overload
def arcsin(x: ArrayLike) -> Any:
    """The angle in radians with a sine; NaN beyond 1, of symbols with derivative zero at 1 and -1."""
@overload
def arccos(x: Symbol) -> Symbol:
    """The angle in radians with a cosine; NaN beyond 1, of symbols with derivative zero at 1 and -1."""
@overload
def arccos(x: ArrayLike) -> Any:
    """The angle in radians with a cosine; NaN beyond 1, of symbols with derivative zero at 1 and -1."""
@overload
def arctan(x: Symbol) -> Symbol:
    """The angle in radians with a tangent."""
@overload
def arctan(x: ArrayLike) -> Any:
    """The angle in radians with a tangent."""
@overload
def power(a: Symbol, b: Union[Symbol, float]) -> Symbol:
    """A power; of symbols with an exponent that is a symbol NaN below zero, and right to b log(a) roundings."""
@overload
def power(a: float, b: Symbol) -> Symbol:
    """A power; of symbols with an exponent that is a symbol NaN below zero, and right to b log(a) roundings."""
@overload
def power(a: ArrayLike, b: ArrayLike) -> Any:
    """A power; of symbols with an exponent that is a symbol NaN below zero, and right to b log(a) roundings."""
@overload
def floor(x: Symbol) -> Symbol:
    """The largest whole number that is not above; of symbols with derivative zero."""
@overload
def floor(x: ArrayLike) -> Any:
    """The largest whole number that is not above; of symbols with derivative zero."""
@overload
def ceil(x: Symbol) -> Symbol:
    """The smallest whole number that is not below; of symbols with derivative zero."""
@overload
def ceil(x: ArrayLike) -> Any:
    """The smallest whole number that is not below; of symbols with derivative zero."""
@overload
def trunc(x: Symbol) -> Symbol:
    """The whole number without the digits after the point; of symbols with derivative zero."""
@overload
def trunc(x: ArrayLike) -> Any:
    """The whole number without the digits after the point; of symbols with derivative zero."""
@overload
def rint(x: Symbol) -> Symbol:
    """The nearest whole number, of two the even one; of symbols with derivative zero."""
@overload
def rint(x: ArrayLike) -> Any:
    """The nearest whole number, of two the even one; of symbols with derivative zero."""
@overload
def sign(x: Symbol) -> Symbol:
    """1, -1 or 0; of symbols with derivative zero."""
@overload
def sign(x: ArrayLike) -> Any:
    """1, -1 or 0; of symbols with derivative zero."""
@overload
def mod(a: Symbol, b: Union[Symbol, float]) -> Symbol:
    """The rest of a division, zero or of the sign of b; of symbols right to the rounding of a."""
@overload
def mod(a: float, b: Symbol) -> Symbol:
    """The rest of a division, zero or of the sign of b; of symbols right to the rounding of a."""
@overload
def mod(a: ArrayLike, b: ArrayLike) -> Any:
    """The rest of a division, zero or of the sign of b; of symbols right to the rounding of a."""
@overload
def arctan2(a: Symbol, b: Union[Symbol, float]) -> Symbol:
    """The angle of the vector (b, a) in radians, from -pi to pi."""
@overload
def arctan2(a: float, b: Symbol) -> Symbol:
    """The angle of the vector (b, a) in radians, from -pi to pi."""
@overload
def arctan2(a: ArrayLike, b: ArrayLike) -> Any:
    """The angle of the vector (b, a) in radians, from -pi to pi."""
@overload
def hypot(a: Symbol, b: Union[Symbol, float]) -> Symbol:
    """The length of the vector (a, b), with derivative zero at the origin."""
@overload
def hypot(a: float, b: Symbol) -> Symbol:
    """The length of the vector (a, b), with derivative zero at the origin."""
@overload
def hypot(a: ArrayLike, b: ArrayLike) -> Any:
    """The length of the vector (a, b), with derivative zero at the origin."""
@overload
def copysign(a: Symbol, b: Union[Symbol, float]) -> Symbol:
    """The magnitude of a with the sign of b."""
@overload
def copysign(a: float, b: Symbol) -> Symbol:
    """The magnitude of a with the sign of b."""
@overload
def copysign(a: ArrayLike, b: ArrayLike) -> Any:
    """The magnitude of a with the sign of b."""
@overload
def minimum(a: Symbol, b: Union[Symbol, float]) -> Symbol:
    """The smaller one; of symbols an exact tie shares the derivative."""
@overload
def minimum(a: float, b: Symbol) -> Symbol:
    """The smaller one; of symbols an exact tie shares the derivative."""
@overload
def minimum(a: ArrayLike, b: ArrayLike) -> Any:
    """The smaller one; of symbols an exact tie shares the derivative."""
@overload
def maximum(a: Symbol, b: Union[Symbol, float]) -> Symbol:
    """The larger one; of symbols an exact tie shares the derivative."""
@overload
def maximum(a: float, b: Symbol) -> Symbol:
    """The larger one; of symbols an exact tie shares the derivative."""
@overload
def maximum(a: ArrayLike, b: ArrayLike) -> Any:
    """The larger one; of symbols an exact tie shares the derivative."""

class Aabb2(Shape):
    """An axis-aligned box in the plane, by two corners: torchvision's xyxy.

    An array whose last axis has its numbers, in this order:

        min.x: coordinate, at most max.x
        min.y: coordinate, at most max.y
        max.x: coordinate, at least min.x
        max.y: coordinate, at least min.y
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def min(self) -> Vec2: ...
    @property
    def max(self) -> Vec2: ...

class Aabb3(Shape):
    """An axis-aligned box in space, by two corners.

    An array whose last axis has its numbers, in this order:

        min.x: coordinate, at most max.x
        min.y: coordinate, at most max.y
        min.z: coordinate, at most max.z
        max.x: coordinate, at least min.x
        max.y: coordinate, at least min.y
        max.z: coordinate, at least min.z
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def min(self) -> Vec3: ...
    @property
    def max(self) -> Vec3: ...

class Arc2(Shape):
    """A circular arc of the plane from one point to another. The bulge is the tangent of a quarter of the
    angle that it sweeps counter-clockwise, as in DXF files: 0 is straight, 1 half a circle.

    An array whose last axis has its numbers, in this order:

        from.x: coordinate
        from.y: coordinate
        to.x: coordinate
        to.y: coordinate
        bulge: number
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def from_(self) -> Vec2: ...
    @property
    def to(self) -> Vec2: ...
    @property
    def bulge(self) -> Any: ...

class AreaMoments(Shape):
    """The second moments of an area: integrals of x * x, y * y and x * y.

    An array whose last axis has its numbers, in this order:

        xx: number
        yy: number
        xy: number
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def xx(self) -> Any: ...
    @property
    def yy(self) -> Any: ...
    @property
    def xy(self) -> Any: ...

class BrownConrady(Shape):
    """A camera with the distortion of Brown and Conrady: k1, k2, k3 and p1, p2 of OpenCV, whose vector has
    k3 last.

    An array whose last axis has its numbers, in this order:

        pinhole.fx: length, above 0
        pinhole.fy: length, above 0
        pinhole.cx: coordinate
        pinhole.cy: coordinate
        radial[0]: length
        radial[1]: length
        radial[2]: length
        tangential[0]: length
        tangential[1]: length
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def pinhole(self) -> Any: ...
    @property
    def radial(self) -> list[Any]: ...
    @property
    def tangential(self) -> list[Any]: ...

class Capsule2(Shape):
    """All points at most a radius from a segment of the plane.

    An array whose last axis has its numbers, in this order:

        from.x: coordinate
        from.y: coordinate
        to.x: coordinate
        to.y: coordinate
        radius: length, at least 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def from_(self) -> Vec2: ...
    @property
    def to(self) -> Vec2: ...
    @property
    def radius(self) -> Any: ...

class Capsule3(Shape):
    """All points at most a radius from a segment of space.

    An array whose last axis has its numbers, in this order:

        start.x: coordinate
        start.y: coordinate
        start.z: coordinate
        end.x: coordinate
        end.y: coordinate
        end.z: coordinate
        radius: length, at least 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def start(self) -> Vec3: ...
    @property
    def end(self) -> Vec3: ...
    @property
    def radius(self) -> Any: ...

class Chord(Shape):
    """The part of a line in a shape, by parameters of the line.

    An array whose last axis has its numbers, in this order:

        enter: least parameter in lengths of the direction; 0 for a miss
        exit: greatest parameter in lengths of the direction; 0 for a miss
        found: 1 where the line meets the shape, else 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def enter(self) -> Any: ...
    @property
    def exit(self) -> Any: ...
    @property
    def found(self) -> Any: ...

class Circle(Shape):
    """A disc of the plane.

    An array whose last axis has its numbers, in this order:

        x: coordinate
        y: coordinate
        radius: length, at least 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def x(self) -> Any: ...
    @property
    def y(self) -> Any: ...
    @property
    def radius(self) -> Any: ...

class ClosestOnSegments(Shape):
    """The nearest points of two segments, and where they are: 0 at the start, 1 at the end.

    An array whose last axis has its numbers, in this order:

        on_a.x: coordinate
        on_a.y: coordinate
        on_b.x: coordinate
        on_b.y: coordinate
        along_a: share of the way along a
        along_b: share of the way along b
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def on_a(self) -> Vec2: ...
    @property
    def on_b(self) -> Vec2: ...
    @property
    def along_a(self) -> Any: ...
    @property
    def along_b(self) -> Any: ...

class CommonLine3(Shape):
    """The line that two planes share.

    An array whose last axis has its numbers, in this order:

        point.x: coordinate
        point.y: coordinate
        point.z: coordinate
        direction.x: part of a direction
        direction.y: part of a direction
        direction.z: part of a direction
        found: 1 where there is one, else 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def point(self) -> Vec3: ...
    @property
    def direction(self) -> Vec3: ...
    @property
    def found(self) -> Any: ...

class CommonPart(Shape):
    """The part that two segments share.

    An array whose last axis has its numbers, in this order:

        from.x: coordinate
        from.y: coordinate
        to.x: coordinate
        to.y: coordinate
        kind: 0 for nothing, 1 for a point, 2 for a segment
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def from_(self) -> Vec2: ...
    @property
    def to(self) -> Vec2: ...
    @property
    def kind(self) -> Any: ...

class CommonPoint(Shape):
    """The point in which two lines cross, and its parameters on both.

    An array whose last axis has its numbers, in this order:

        point.x: coordinate
        point.y: coordinate
        along_a: distance from a's point in lengths of its direction; 0 for parallel lines
        along_b: distance from b's point in lengths of its direction; 0 for parallel lines
        found: 1 where the lines cross, 0 where they are parallel
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def point(self) -> Vec2: ...
    @property
    def along_a(self) -> Any: ...
    @property
    def along_b(self) -> Any: ...
    @property
    def found(self) -> Any: ...

class CommonPoint3(Shape):
    """The point that three planes share.

    An array whose last axis has its numbers, in this order:

        point.x: coordinate
        point.y: coordinate
        point.z: coordinate
        found: 1 where there is one, else 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def point(self) -> Vec3: ...
    @property
    def found(self) -> Any: ...

class Cone(Shape):
    """A cone: its apex and the middle of its base, which differ, and the base's radius.

    An array whose last axis has its numbers, in this order:

        apex.x: coordinate, not all parts 0
        apex.y: coordinate, not all parts 0
        apex.z: coordinate, not all parts 0
        base.x: coordinate, not all parts 0
        base.y: coordinate, not all parts 0
        base.z: coordinate, not all parts 0
        radius: length, at least 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def apex(self) -> Vec3: ...
    @property
    def base(self) -> Vec3: ...
    @property
    def radius(self) -> Any: ...

class Contact(Shape):
    """How deep two shapes are in each other, and the direction of the shortest shift of the second one
    that parts them.

    An array whose last axis has its numbers, in this order:

        depth: length, 0 where the shapes are apart
        direction.x: coordinate
        direction.y: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def depth(self) -> Any: ...
    @property
    def direction(self) -> Vec2: ...

class Contact3(Shape):
    """How deep two shapes are in each other, and the direction of the shortest shift of the second one
    that parts them.

    An array whose last axis has its numbers, in this order:

        depth: length, 0 where the shapes are apart
        direction.x: coordinate
        direction.y: coordinate
        direction.z: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def depth(self) -> Any: ...
    @property
    def direction(self) -> Vec3: ...

class Contacts3(Shape):
    """The contact of two shapes: the direction from a to b in which they must part, and up to eight pairs
    of points.

    An array whose last axis has its numbers, in this order:

        normal.x: part of a direction
        normal.y: part of a direction
        normal.z: part of a direction
        count: how many pairs of points there are; the others are zero
        points[0].on_a.x: coordinate
        points[0].on_a.y: coordinate
        points[0].on_a.z: coordinate
        points[0].on_b.x: coordinate
        points[0].on_b.y: coordinate
        points[0].on_b.z: coordinate
        points[0].gap: number
        points[1].on_a.x: coordinate
        points[1].on_a.y: coordinate
        points[1].on_a.z: coordinate
        points[1].on_b.x: coordinate
        points[1].on_b.y: coordinate
        points[1].on_b.z: coordinate
        points[1].gap: number
        points[2].on_a.x: coordinate
        points[2].on_a.y: coordinate
        points[2].on_a.z: coordinate
        points[2].on_b.x: coordinate
        points[2].on_b.y: coordinate
        points[2].on_b.z: coordinate
        points[2].gap: number
        points[3].on_a.x: coordinate
        points[3].on_a.y: coordinate
        points[3].on_a.z: coordinate
        points[3].on_b.x: coordinate
        points[3].on_b.y: coordinate
        points[3].on_b.z: coordinate
        points[3].gap: number
        points[4].on_a.x: coordinate
        points[4].on_a.y: coordinate
        points[4].on_a.z: coordinate
        points[4].on_b.x: coordinate
        points[4].on_b.y: coordinate
        points[4].on_b.z: coordinate
        points[4].gap: number
        points[5].on_a.x: coordinate
        points[5].on_a.y: coordinate
        points[5].on_a.z: coordinate
        points[5].on_b.x: coordinate
        points[5].on_b.y: coordinate
        points[5].on_b.z: coordinate
        points[5].gap: number
        points[6].on_a.x: coordinate
        points[6].on_a.y: coordinate
        points[6].on_a.z: coordinate
        points[6].on_b.x: coordinate
        points[6].on_b.y: coordinate
        points[6].on_b.z: coordinate
        points[6].gap: number
        points[7].on_a.x: coordinate
        points[7].on_a.y: coordinate
        points[7].on_a.z: coordinate
        points[7].on_b.x: coordinate
        points[7].on_b.y: coordinate
        points[7].on_b.z: coordinate
        points[7].gap: number
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def normal(self) -> Vec3: ...
    @property
    def count(self) -> Any: ...
    @property
    def points(self) -> list[Any]: ...

class ConvexPolygon5(Shape):
    """A convex polygon of up to 5 vertices, in counter-clockwise order. The last number is how many
    vertices count; those after them are not read.

    An array whose last axis has its numbers, in this order:

        vertices[0].x: coordinate
        vertices[0].y: coordinate
        vertices[1].x: coordinate
        vertices[1].y: coordinate
        vertices[2].x: coordinate
        vertices[2].y: coordinate
        vertices[3].x: coordinate
        vertices[3].y: coordinate
        vertices[4].x: coordinate
        vertices[4].y: coordinate
        codes[0]: how many vertices count, a whole number
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def vertices(self) -> list[Any]: ...
    @property
    def codes(self) -> list[Any]: ...

class ConvexPolygon6(Shape):
    """A convex polygon of up to 6 vertices, in counter-clockwise order. The last number is how many
    vertices count; those after them are not read.

    An array whose last axis has its numbers, in this order:

        vertices[0].x: coordinate
        vertices[0].y: coordinate
        vertices[1].x: coordinate
        vertices[1].y: coordinate
        vertices[2].x: coordinate
        vertices[2].y: coordinate
        vertices[3].x: coordinate
        vertices[3].y: coordinate
        vertices[4].x: coordinate
        vertices[4].y: coordinate
        vertices[5].x: coordinate
        vertices[5].y: coordinate
        codes[0]: how many vertices count, a whole number
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def vertices(self) -> list[Any]: ...
    @property
    def codes(self) -> list[Any]: ...

class Cubic2(Shape):
    """A cubic Bezier curve of the plane, by its control points.

    An array whose last axis has its numbers, in this order:

        points[0].x: coordinate
        points[0].y: coordinate
        points[1].x: coordinate
        points[1].y: coordinate
        points[2].x: coordinate
        points[2].y: coordinate
        points[3].x: coordinate
        points[3].y: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def points(self) -> list[Any]: ...

class Cxcywh(Shape):
    """Cxcywh.

    An array whose last axis has its numbers, in this order:

        center.x: coordinate
        center.y: coordinate
        size.x: length, at least 0
        size.y: length, at least 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def center(self) -> Vec2: ...
    @property
    def size(self) -> Vec2: ...

class Cylinder(Shape):
    """A cylinder around the segment from the middle of one end to that of the other, which differ.

    An array whose last axis has its numbers, in this order:

        start.x: coordinate, not all parts 0
        start.y: coordinate, not all parts 0
        start.z: coordinate, not all parts 0
        end.x: coordinate, not all parts 0
        end.y: coordinate, not all parts 0
        end.z: coordinate, not all parts 0
        radius: length, at least 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def start(self) -> Vec3: ...
    @property
    def end(self) -> Vec3: ...
    @property
    def radius(self) -> Any: ...

class Detectron2Box(Shape):
    """detectron2's RotatedBoxes: a rotated box in an image, where y points down, with an angle in degrees
    that grows counter-clockwise to the viewer.

    An array whose last axis has its numbers, in this order:

        center.x: coordinate
        center.y: coordinate
        size.x: length, at least 0
        size.y: length, at least 0
        heading.value: angle in degrees
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def center(self) -> Vec2: ...
    @property
    def size(self) -> Vec2: ...
    @property
    def heading(self) -> Any: ...

class Disc(Shape):
    """A flat disc: the centre, a vector of any length orthogonal to it, and the radius.

    An array whose last axis has its numbers, in this order:

        x: coordinate
        y: coordinate
        z: coordinate
        nx: part of a direction, not all parts 0
        ny: part of a direction, not all parts 0
        nz: part of a direction, not all parts 0
        radius: length, at least 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def x(self) -> Any: ...
    @property
    def y(self) -> Any: ...
    @property
    def z(self) -> Any: ...
    @property
    def nx(self) -> Any: ...
    @property
    def ny(self) -> Any: ...
    @property
    def nz(self) -> Any: ...
    @property
    def radius(self) -> Any: ...

class Ellipsoid(Shape):
    """An ellipsoid: the centre, half of the extents along its own axes, and the rotation of these as a
    quaternion (w, x, y, z) of any length.

    An array whose last axis has its numbers, in this order:

        x: coordinate
        y: coordinate
        z: coordinate
        a: length, at least 0
        b: length, at least 0
        c: length, at least 0
        qw: part of a quaternion, not all parts 0
        qx: part of a quaternion, not all parts 0
        qy: part of a quaternion, not all parts 0
        qz: part of a quaternion, not all parts 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def x(self) -> Any: ...
    @property
    def y(self) -> Any: ...
    @property
    def z(self) -> Any: ...
    @property
    def a(self) -> Any: ...
    @property
    def b(self) -> Any: ...
    @property
    def c(self) -> Any: ...
    @property
    def qw(self) -> Any: ...
    @property
    def qx(self) -> Any: ...
    @property
    def qy(self) -> Any: ...
    @property
    def qz(self) -> Any: ...

class Exponent(Shape):
    """The power of alpha_iou, above 0.

    An array whose last axis has its numbers, in this order:

        alpha: power, above 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def alpha(self) -> Any: ...

class Fisheye(Shape):
    """A fisheye camera of Kannala and Brandt, with k1 to k4 of OpenCV's fisheye model.

    An array whose last axis has its numbers, in this order:

        pinhole.fx: length, above 0
        pinhole.fy: length, above 0
        pinhole.cx: coordinate
        pinhole.cy: coordinate
        radial[0]: length
        radial[1]: length
        radial[2]: length
        radial[3]: length
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def pinhole(self) -> Any: ...
    @property
    def radial(self) -> list[Any]: ...

class Hit(Shape):
    """The first point of a ray on the border of a shape, and the normal there, out of the shape.

    An array whose last axis has its numbers, in this order:

        parameter: distance in lengths of the direction; the largest finite number for a miss
        point.x: coordinate
        point.y: coordinate
        normal.x: coordinate
        normal.y: coordinate
        kind: 0 for a miss, 1 for a hit from outside, 2 from inside, where the ray leaves
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def parameter(self) -> Any: ...
    @property
    def point(self) -> Vec2: ...
    @property
    def normal(self) -> Vec2: ...
    @property
    def kind(self) -> Any: ...

class Hit3(Shape):
    """The first point of a ray on the border of a shape of space, and the normal there, out of the shape.

    An array whose last axis has its numbers, in this order:

        parameter: distance in lengths of the direction; the largest finite number for a miss
        point.x: coordinate
        point.y: coordinate
        point.z: coordinate
        normal.x: part of a direction
        normal.y: part of a direction
        normal.z: part of a direction
        kind: 0 for a miss, 1 for a hit from outside, 2 from inside, where the ray leaves
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def parameter(self) -> Any: ...
    @property
    def point(self) -> Vec3: ...
    @property
    def normal(self) -> Vec3: ...
    @property
    def kind(self) -> Any: ...

class Hull3_8(Shape):
    """The convex hull of up to 8 vertices of space, in any order. The last number is how many vertices
    count; those after them are not read.

    An array whose last axis has its numbers, in this order:

        vertices[0].x: coordinate
        vertices[0].y: coordinate
        vertices[0].z: coordinate
        vertices[1].x: coordinate
        vertices[1].y: coordinate
        vertices[1].z: coordinate
        vertices[2].x: coordinate
        vertices[2].y: coordinate
        vertices[2].z: coordinate
        vertices[3].x: coordinate
        vertices[3].y: coordinate
        vertices[3].z: coordinate
        vertices[4].x: coordinate
        vertices[4].y: coordinate
        vertices[4].z: coordinate
        vertices[5].x: coordinate
        vertices[5].y: coordinate
        vertices[5].z: coordinate
        vertices[6].x: coordinate
        vertices[6].y: coordinate
        vertices[6].z: coordinate
        vertices[7].x: coordinate
        vertices[7].y: coordinate
        vertices[7].z: coordinate
        codes[0]: how many vertices count, a whole number
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def vertices(self) -> list[Any]: ...
    @property
    def codes(self) -> list[Any]: ...

class ImageBox(Shape):
    """A rotated box in an image, where y points down. The angle turns from x towards y, clockwise to the
    viewer; the width lies along it. As Obb2 it is the box in a frame with y upwards; read with y
    downwards both have the same numbers.

    An array whose last axis has its numbers, in this order:

        center.x: coordinate
        center.y: coordinate
        size.x: length, at least 0
        size.y: length, at least 0
        heading.radians: angle in radians
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def center(self) -> Vec2: ...
    @property
    def size(self) -> Vec2: ...
    @property
    def heading(self) -> Any: ...

class Impact3(Shape):
    """The first touch of two moving bodies: its time, the place on the first body, and the direction in
    which the second one is in the way.

    An array whose last axis has its numbers, in this order:

        time: time from 0 to 1; the largest finite number for a miss
        point.x: coordinate
        point.y: coordinate
        point.z: coordinate
        normal.x: part of a direction
        normal.y: part of a direction
        normal.z: part of a direction
        kind: 0 for a miss, 1 for an impact, 2 where the bodies touch at time 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def time(self) -> Any: ...
    @property
    def point(self) -> Vec3: ...
    @property
    def normal(self) -> Vec3: ...
    @property
    def kind(self) -> Any: ...

class Interval(Shape):
    """An interval of numbers.

    An array whose last axis has its numbers, in this order:

        min: length, at most max
        max: length, at least min
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def min(self) -> Any: ...
    @property
    def max(self) -> Any: ...

class KittiBox(Shape):
    """A box of KITTI's labels, in the frame of a camera: x to the right, y down, z ahead. The location is
    the middle of the bottom face; rotation_y turns about the y axis and is 0 for travel to the right.

    An array whose last axis has its numbers, in this order:

        height: length, at least 0
        width: length, at least 0
        length: length, at least 0
        location.x: coordinate
        location.y: coordinate
        location.z: coordinate
        rotation_y: angle in radians
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def height(self) -> Any: ...
    @property
    def width(self) -> Any: ...
    @property
    def length(self) -> Any: ...
    @property
    def location(self) -> Vec3: ...
    @property
    def rotation_y(self) -> Any: ...

class Le135(Shape):
    """mmrotate's le135, a rotated box in an image, where y points down. The angle turns from x towards y,
    clockwise to the viewer; the width lies along it. The width is the longer side, the angle in [-pi/4,
    3 pi/4).

    An array whose last axis has its numbers, in this order:

        center.x: coordinate
        center.y: coordinate
        size.x: length, at least 0
        size.y: length, at least 0
        heading.radians: angle in radians
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def center(self) -> Vec2: ...
    @property
    def size(self) -> Vec2: ...
    @property
    def heading(self) -> Any: ...

class Le90(Shape):
    """mmrotate's le90, a rotated box in an image, where y points down. The angle turns from x towards y,
    clockwise to the viewer; the width lies along it. The width is the longer side, the angle in [-pi/2,
    pi/2).

    An array whose last axis has its numbers, in this order:

        center.x: coordinate
        center.y: coordinate
        size.x: length, at least 0
        size.y: length, at least 0
        heading.radians: angle in radians
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def center(self) -> Vec2: ...
    @property
    def size(self) -> Vec2: ...
    @property
    def heading(self) -> Any: ...

class LidarBox(Shape):
    """A box of OpenPCDet: the centre, length, width, height, and the heading about the z axis, which
    points up: counter-clockwise seen from above, 0 for travel along x.

    An array whose last axis has its numbers, in this order:

        center.x: coordinate
        center.y: coordinate
        center.z: coordinate
        size.x: length, at least 0
        size.y: length, at least 0
        size.z: length, at least 0
        heading: angle in radians
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def center(self) -> Vec3: ...
    @property
    def size(self) -> Vec3: ...
    @property
    def heading(self) -> Any: ...

class Line2(Shape):
    """A line of the plane: a point of it, and a direction of any length.

    An array whose last axis has its numbers, in this order:

        point.x: coordinate
        point.y: coordinate
        direction.x: coordinate, not all parts 0
        direction.y: coordinate, not all parts 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def point(self) -> Vec2: ...
    @property
    def direction(self) -> Vec2: ...

class Line3(Shape):
    """A line of space: a point of it, and a direction of any length.

    An array whose last axis has its numbers, in this order:

        point.x: coordinate
        point.y: coordinate
        point.z: coordinate
        direction.x: part of a direction, not all parts 0
        direction.y: part of a direction, not all parts 0
        direction.z: part of a direction, not all parts 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def point(self) -> Vec3: ...
    @property
    def direction(self) -> Vec3: ...

class Motion3(Shape):
    """A motion of a body from time 0 to time 1: the centre of its turn at time 0, the way of that centre,
    and the turn as a rotation vector in radians.

    An array whose last axis has its numbers, in this order:

        center.x: coordinate
        center.y: coordinate
        center.z: coordinate
        velocity.x: part of a direction
        velocity.y: part of a direction
        velocity.z: part of a direction
        turn.x: part of a rotation vector in radians
        turn.y: part of a rotation vector in radians
        turn.z: part of a rotation vector in radians
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def center(self) -> Vec3: ...
    @property
    def velocity(self) -> Vec3: ...
    @property
    def turn(self) -> Vec3: ...

class NuScenesBox(Shape):
    """A box of nuScenes: the centre, width, length, height, and the rotation as a quaternion (w, x, y, z)
    of any length; the direction of travel is its own x axis.

    An array whose last axis has its numbers, in this order:

        translation.x: coordinate
        translation.y: coordinate
        translation.z: coordinate
        width: length, at least 0
        length: length, at least 0
        height: length, at least 0
        rotation.w: part of a quaternion, not all parts 0
        rotation.x: part of a quaternion, not all parts 0
        rotation.y: part of a quaternion, not all parts 0
        rotation.z: part of a quaternion, not all parts 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def translation(self) -> Vec3: ...
    @property
    def width(self) -> Any: ...
    @property
    def length(self) -> Any: ...
    @property
    def height(self) -> Any: ...
    @property
    def rotation(self) -> Any: ...

class Obb2(Shape):
    """A rotated box in the plane. The heading turns from x towards y: counter-clockwise where y points up,
    clockwise in an image, where y points down. The width lies along the heading, the height across it.
    detectron2's and torchvision's (cxcywhr) angle is -heading in degrees.

    An array whose last axis has its numbers, in this order:

        x: coordinate
        y: coordinate
        width: length, at least 0
        height: length, at least 0
        heading: angle in radians
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def x(self) -> Any: ...
    @property
    def y(self) -> Any: ...
    @property
    def width(self) -> Any: ...
    @property
    def height(self) -> Any: ...
    @property
    def heading(self) -> Any: ...

class Obb3(Shape):
    """A box in space of any orientation: centre, sizes along its own axes, and the quaternion (w, x, y,
    z), of any length, that turns the axes of space to its own.

    An array whose last axis has its numbers, in this order:

        x: coordinate
        y: coordinate
        z: coordinate
        dx: length, at least 0
        dy: length, at least 0
        dz: length, at least 0
        qw: part of a quaternion, not all parts 0
        qx: part of a quaternion, not all parts 0
        qy: part of a quaternion, not all parts 0
        qz: part of a quaternion, not all parts 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def x(self) -> Any: ...
    @property
    def y(self) -> Any: ...
    @property
    def z(self) -> Any: ...
    @property
    def dx(self) -> Any: ...
    @property
    def dy(self) -> Any: ...
    @property
    def dz(self) -> Any: ...
    @property
    def qw(self) -> Any: ...
    @property
    def qx(self) -> Any: ...
    @property
    def qy(self) -> Any: ...
    @property
    def qz(self) -> Any: ...

class OpenCvBox(Shape):
    """The box of OpenCV's minAreaRect since 4.5.1, but in radians: a rotated box in an image, where y
    points down. The angle turns from x towards y, clockwise to the viewer; the width lies along it.
    Either side may be the longer one; the angle is in (0, pi/2].

    An array whose last axis has its numbers, in this order:

        center.x: coordinate
        center.y: coordinate
        size.x: length, at least 0
        size.y: length, at least 0
        heading.radians: angle in radians
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def center(self) -> Vec2: ...
    @property
    def size(self) -> Vec2: ...
    @property
    def heading(self) -> Any: ...

class Pinhole(Shape):
    """A camera without distortion: focal lengths and the principal point, in pixels.

    An array whose last axis has its numbers, in this order:

        fx: length, above 0
        fy: length, above 0
        cx: coordinate
        cy: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def fx(self) -> Any: ...
    @property
    def fy(self) -> Any: ...
    @property
    def cx(self) -> Any: ...
    @property
    def cy(self) -> Any: ...

class Plane3(Shape):
    """The plane of all points p with normal . p = offset, and the half-space behind it; the normal has any
    length.

    An array whose last axis has its numbers, in this order:

        normal.x: part of a direction, not all parts 0
        normal.y: part of a direction, not all parts 0
        normal.z: part of a direction, not all parts 0
        offset: distance from the origin
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def normal(self) -> Vec3: ...
    @property
    def offset(self) -> Any: ...

class Plane3x6(Shape):
    """Plane3x6.

    An array whose last axis has its numbers, in this order:

        [0].normal.x: part of a direction, not all parts 0
        [0].normal.y: part of a direction, not all parts 0
        [0].normal.z: part of a direction, not all parts 0
        [0].offset: distance from the origin
        [1].normal.x: part of a direction, not all parts 0
        [1].normal.y: part of a direction, not all parts 0
        [1].normal.z: part of a direction, not all parts 0
        [1].offset: distance from the origin
        [2].normal.x: part of a direction, not all parts 0
        [2].normal.y: part of a direction, not all parts 0
        [2].normal.z: part of a direction, not all parts 0
        [2].offset: distance from the origin
        [3].normal.x: part of a direction, not all parts 0
        [3].normal.y: part of a direction, not all parts 0
        [3].normal.z: part of a direction, not all parts 0
        [3].offset: distance from the origin
        [4].normal.x: part of a direction, not all parts 0
        [4].normal.y: part of a direction, not all parts 0
        [4].normal.z: part of a direction, not all parts 0
        [4].offset: distance from the origin
        [5].normal.x: part of a direction, not all parts 0
        [5].normal.y: part of a direction, not all parts 0
        [5].normal.z: part of a direction, not all parts 0
        [5].offset: distance from the origin
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def items(self) -> list[Any]: ...

class PointPair(Shape):
    """A point of each of two shapes.

    An array whose last axis has its numbers, in this order:

        on_a.x: coordinate
        on_a.y: coordinate
        on_b.x: coordinate
        on_b.y: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def on_a(self) -> Vec2: ...
    @property
    def on_b(self) -> Vec2: ...

class PointPair3(Shape):
    """A point of each of two shapes of space.

    An array whose last axis has its numbers, in this order:

        on_a.x: coordinate
        on_a.y: coordinate
        on_a.z: coordinate
        on_b.x: coordinate
        on_b.y: coordinate
        on_b.z: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def on_a(self) -> Vec3: ...
    @property
    def on_b(self) -> Vec3: ...

class Pose2(Shape):
    """A turn about the origin, by its cosine and sine, and then a shift.

    An array whose last axis has its numbers, in this order:

        rotation.cos: part of a direction, not all parts 0
        rotation.sin: part of a direction, not all parts 0
        translation.x: coordinate
        translation.y: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def rotation(self) -> Any: ...
    @property
    def translation(self) -> Vec2: ...

class Pose3(Shape):
    """Pose3.

    An array whose last axis has its numbers, in this order:

        rotation.w: part of a quaternion, not all parts 0
        rotation.x: part of a quaternion, not all parts 0
        rotation.y: part of a quaternion, not all parts 0
        rotation.z: part of a quaternion, not all parts 0
        translation.x: coordinate
        translation.y: coordinate
        translation.z: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def rotation(self) -> Any: ...
    @property
    def translation(self) -> Vec3: ...

class Quadratic2(Shape):
    """A quadratic Bezier curve of the plane, by its control points.

    An array whose last axis has its numbers, in this order:

        points[0].x: coordinate
        points[0].y: coordinate
        points[1].x: coordinate
        points[1].y: coordinate
        points[2].x: coordinate
        points[2].y: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def points(self) -> list[Any]: ...

class Ray2(Shape):
    """Half a line of the plane: its start, and a direction of any length.

    An array whose last axis has its numbers, in this order:

        point.x: coordinate
        point.y: coordinate
        direction.x: coordinate, not all parts 0
        direction.y: coordinate, not all parts 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def point(self) -> Vec2: ...
    @property
    def direction(self) -> Vec2: ...

class Ray3(Shape):
    """Half a line of space: its start, and a direction of any length.

    An array whose last axis has its numbers, in this order:

        point.x: coordinate
        point.y: coordinate
        point.z: coordinate
        direction.x: part of a direction, not all parts 0
        direction.y: part of a direction, not all parts 0
        direction.z: part of a direction, not all parts 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def point(self) -> Vec3: ...
    @property
    def direction(self) -> Vec3: ...

class Rotation3(Shape):
    """A rotation of space: a quaternion of any length.

    An array whose last axis has its numbers, in this order:

        w: part of a quaternion, not all parts 0
        x: part of a quaternion, not all parts 0
        y: part of a quaternion, not all parts 0
        z: part of a quaternion, not all parts 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def w(self) -> Any: ...
    @property
    def x(self) -> Any: ...
    @property
    def y(self) -> Any: ...
    @property
    def z(self) -> Any: ...

class RoundBox3(Shape):
    """All points at most a radius from a box of any orientation; see Obb3.

    An array whose last axis has its numbers, in this order:

        x: coordinate
        y: coordinate
        z: coordinate
        dx: length, at least 0
        dy: length, at least 0
        dz: length, at least 0
        qw: part of a quaternion, not all parts 0
        qx: part of a quaternion, not all parts 0
        qy: part of a quaternion, not all parts 0
        qz: part of a quaternion, not all parts 0
        radius: length, at least 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def x(self) -> Any: ...
    @property
    def y(self) -> Any: ...
    @property
    def z(self) -> Any: ...
    @property
    def dx(self) -> Any: ...
    @property
    def dy(self) -> Any: ...
    @property
    def dz(self) -> Any: ...
    @property
    def qw(self) -> Any: ...
    @property
    def qx(self) -> Any: ...
    @property
    def qy(self) -> Any: ...
    @property
    def qz(self) -> Any: ...
    @property
    def radius(self) -> Any: ...

class Segment2(Shape):
    """A segment of the plane, from one end to the other.

    An array whose last axis has its numbers, in this order:

        from.x: coordinate
        from.y: coordinate
        to.x: coordinate
        to.y: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def from_(self) -> Vec2: ...
    @property
    def to(self) -> Vec2: ...

class Segment3(Shape):
    """A segment of space, from one end to the other.

    An array whose last axis has its numbers, in this order:

        start.x: coordinate
        start.y: coordinate
        start.z: coordinate
        end.x: coordinate
        end.y: coordinate
        end.z: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def start(self) -> Vec3: ...
    @property
    def end(self) -> Vec3: ...

class Sphere(Shape):
    """A ball.

    An array whose last axis has its numbers, in this order:

        x: coordinate
        y: coordinate
        z: coordinate
        radius: length, at least 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def x(self) -> Any: ...
    @property
    def y(self) -> Any: ...
    @property
    def z(self) -> Any: ...
    @property
    def radius(self) -> Any: ...

class Symmetric3(Shape):
    """A symmetric matrix of three rows.

    An array whose last axis has its numbers, in this order:

        xx: number
        yy: number
        zz: number
        xy: number
        xz: number
        yz: number
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def xx(self) -> Any: ...
    @property
    def yy(self) -> Any: ...
    @property
    def zz(self) -> Any: ...
    @property
    def xy(self) -> Any: ...
    @property
    def xz(self) -> Any: ...
    @property
    def yz(self) -> Any: ...

class Tetrahedron(Shape):
    """A tetrahedron.

    An array whose last axis has its numbers, in this order:

        a.x: coordinate
        a.y: coordinate
        a.z: coordinate
        b.x: coordinate
        b.y: coordinate
        b.z: coordinate
        c.x: coordinate
        c.y: coordinate
        c.z: coordinate
        d.x: coordinate
        d.y: coordinate
        d.z: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def a(self) -> Vec3: ...
    @property
    def b(self) -> Vec3: ...
    @property
    def c(self) -> Vec3: ...
    @property
    def d(self) -> Vec3: ...

class Triangle2(Shape):
    """A triangle of the plane, by its corners in any order.

    An array whose last axis has its numbers, in this order:

        a.x: coordinate
        a.y: coordinate
        b.x: coordinate
        b.y: coordinate
        c.x: coordinate
        c.y: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def a(self) -> Vec2: ...
    @property
    def b(self) -> Vec2: ...
    @property
    def c(self) -> Vec2: ...

class Triangle3(Shape):
    """A triangle of space.

    An array whose last axis has its numbers, in this order:

        a.x: coordinate
        a.y: coordinate
        a.z: coordinate
        b.x: coordinate
        b.y: coordinate
        b.z: coordinate
        c.x: coordinate
        c.y: coordinate
        c.z: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def a(self) -> Vec3: ...
    @property
    def b(self) -> Vec3: ...
    @property
    def c(self) -> Vec3: ...

class Vec2(Shape):
    """A point of the plane, or a vector.

    An array whose last axis has its numbers, in this order:

        x: coordinate
        y: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def x(self) -> Any: ...
    @property
    def y(self) -> Any: ...
    def __add__(self, other: Vec2) -> Vec2: ...
    def __sub__(self, other: Vec2) -> Vec2: ...
    def __mul__(self, factor: Any) -> Vec2: ...
    def __rmul__(self, factor: Any) -> Vec2: ...
    def __truediv__(self, factor: Any) -> Vec2: ...
    def __neg__(self) -> Vec2: ...
    def dot(self, other: Vec2) -> Any: ...
    def length(self) -> Any: ...

class Vec2x4(Shape):
    """A quadrilateral: its corners one after another, either way round.

    An array whose last axis has its numbers, in this order:

        [0].x: coordinate
        [0].y: coordinate
        [1].x: coordinate
        [1].y: coordinate
        [2].x: coordinate
        [2].y: coordinate
        [3].x: coordinate
        [3].y: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def items(self) -> list[Any]: ...

class Vec3(Shape):
    """A point of space, or a vector.

    An array whose last axis has its numbers, in this order:

        x: coordinate
        y: coordinate
        z: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def x(self) -> Any: ...
    @property
    def y(self) -> Any: ...
    @property
    def z(self) -> Any: ...
    def __add__(self, other: Vec3) -> Vec3: ...
    def __sub__(self, other: Vec3) -> Vec3: ...
    def __mul__(self, factor: Any) -> Vec3: ...
    def __rmul__(self, factor: Any) -> Vec3: ...
    def __truediv__(self, factor: Any) -> Vec3: ...
    def __neg__(self) -> Vec3: ...
    def dot(self, other: Vec3) -> Any: ...
    def length(self) -> Any: ...

class Vec3x2(Shape):
    """Vec3x2.

    An array whose last axis has its numbers, in this order:

        [0].x: coordinate
        [0].y: coordinate
        [0].z: coordinate
        [1].x: coordinate
        [1].y: coordinate
        [1].z: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def items(self) -> list[Any]: ...

class Vec3x3(Shape):
    """Vec3x3.

    An array whose last axis has its numbers, in this order:

        [0].x: coordinate
        [0].y: coordinate
        [0].z: coordinate
        [1].x: coordinate
        [1].y: coordinate
        [1].z: coordinate
        [2].x: coordinate
        [2].y: coordinate
        [2].z: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def items(self) -> list[Any]: ...

class Vec3x8(Shape):
    """Vec3x8.

    An array whose last axis has its numbers, in this order:

        [0].x: coordinate
        [0].y: coordinate
        [0].z: coordinate
        [1].x: coordinate
        [1].y: coordinate
        [1].z: coordinate
        [2].x: coordinate
        [2].y: coordinate
        [2].z: coordinate
        [3].x: coordinate
        [3].y: coordinate
        [3].z: coordinate
        [4].x: coordinate
        [4].y: coordinate
        [4].z: coordinate
        [5].x: coordinate
        [5].y: coordinate
        [5].z: coordinate
        [6].x: coordinate
        [6].y: coordinate
        [6].z: coordinate
        [7].x: coordinate
        [7].y: coordinate
        [7].z: coordinate
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def items(self) -> list[Any]: ...

class Xywh(Shape):
    """Xywh.

    An array whose last axis has its numbers, in this order:

        min.x: coordinate
        min.y: coordinate
        size.x: length, at least 0
        size.y: length, at least 0
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def min(self) -> Vec2: ...
    @property
    def size(self) -> Vec2: ...

class Xyxyr(Shape):
    """The bounds of a box before it is turned about its centre, and the angle, from x towards y.

    An array whose last axis has its numbers, in this order:

        min.x: coordinate, at most max.x
        min.y: coordinate, at most max.y
        max.x: coordinate, at least min.x
        max.y: coordinate, at least min.y
        heading: angle in radians
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def min(self) -> Vec2: ...
    @property
    def max(self) -> Vec2: ...
    @property
    def heading(self) -> Any: ...

class YawBox3(Shape):
    """An upright box in space: centre, sizes along its own axes (length, width, height), and the heading
    about the z axis, which points up: counter-clockwise seen from above.

    An array whose last axis has its numbers, in this order:

        x: coordinate
        y: coordinate
        z: coordinate
        dx: length, at least 0
        dy: length, at least 0
        dz: length, at least 0
        heading: angle in radians
    """
    def __init__(self, *numbers: Any, **named: Any) -> None: ...
    @property
    def x(self) -> Any: ...
    @property
    def y(self) -> Any: ...
    @property
    def z(self) -> Any: ...
    @property
    def dx(self) -> Any: ...
    @property
    def dy(self) -> Any: ...
    @property
    def dz(self) -> Any: ...
    @property
    def heading(self) -> Any: ...

class _adjoint(Verb):
    """A twist, turn and shift, of frame b in frame a, by the pose a_from_b: the adjoint.

    Rows:
        adjoint(pose: Pose3, turn: Vec3, shift: Vec3) -> Vec3, Vec3
    """
    @overload
    def __call__(self, pose: Pose3, turn: Vec3, shift: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

adjoint: _adjoint

class _adjoint_transposed(Verb):
    """A moment and a force of frame a in frame b, by the pose a_from_b: the transposed adjoint.

    Rows:
        adjoint_transposed(pose: Pose3, moment: Vec3, force: Vec3) -> Vec3, Vec3
    """
    @overload
    def __call__(self, pose: Pose3, moment: Vec3, force: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

adjoint_transposed: _adjoint_transposed

class _alpha_iou(Verb):
    """The IoU of two boxes to a power.

    Rows:
        alpha_iou(a: Aabb3, b: Aabb3) -> number
            The IoU of two axis-aligned boxes to the power three, its paper's choice.
        alpha_iou(a: YawBox3, b: YawBox3) -> number
            The IoU of two upright boxes to the power three, its paper's choice.
        alpha_iou(a: Aabb2, b: Aabb2, power: Exponent) -> number
            A power of the IoU of two axis-aligned boxes.
        alpha_iou(a: Obb2, b: Obb2, power: Exponent) -> number
            A power of the IoU of two rotated boxes.
    """
    @overload
    def __call__(self, a: Aabb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, power: Exponent, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, power: Exponent, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

alpha_iou: _alpha_iou

class _angle(Verb):
    """The angle between two rotations or vectors, in radians.

    Rows:
        angle(a: Rotation3, b: Rotation3) -> number
            The angle in radians between two rotations, 0 to π.
        angle(a: Vec3, b: Vec3) -> number
            The angle in radians between two points, 0 to π.
    """
    @overload
    def __call__(self, a: Rotation3, b: Rotation3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Vec3, b: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

angle: _angle

class _area(Verb):
    """The area of shapes of the plane.

    Rows:
        area(shape: Aabb2) -> number
            The area of an axis-aligned box.
        area(shape: Capsule2) -> number
            The area of a capsule.
        area(shape: Circle) -> number
            The area of a circle.
        area(polygon: ConvexPolygon6) -> number
            The area of a convex polygon of up to N vertices. Nothing is searched for.
        area(shape: Disc) -> number
            The area of a disc.
        area(shape: Obb2) -> number
            The area of a rotated box.
        area(shape: Triangle2) -> number
            The area of a triangle.
        area(shape: Triangle3) -> number
            The area of a triangle of space.
        area(paths: ring) -> number
            The area of a ring, whichever way it turns: the magnitude of its signed area, as often as it winds around each region. Derivative zero at area zero.
        area(polygons: Polygons) -> number
            The area of polygons: holes do not count.
    """
    @overload
    def __call__(self, shape: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Capsule2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, polygon: ConvexPolygon6, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Disc, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, paths: Rings, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, polygons: Polygons, /) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

area: _area

class _axes(Verb):
    """The images of the axes of a rotation: the columns of its matrix.

    Rows:
        axes(rotation: Rotation3) -> Vec3x3
    """
    @overload
    def __call__(self, rotation: Rotation3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3x3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

axes: _axes

class _between(Verb):
    """The motion from one pose to another at constant velocity and turn: the origin moves along a straight line. It jumps at half turns.

    Rows:
        between(start: Pose3, end: Pose3) -> Motion3
    """
    @overload
    def __call__(self, start: Pose3, end: Pose3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Motion3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

between: _between

class _bhattacharyya(Verb):
    """The Bhattacharyya distance of two rotated boxes as Gaussians whose standard deviations are half the sizes.

    Rows:
        bhattacharyya(a: Obb2, b: Obb2) -> number
        bhattacharyya(a: Obb3, b: Obb3) -> number
            The Bhattacharyya distance of two boxes of any orientation as Gaussians whose standard deviations are half the sizes.
    """
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

bhattacharyya: _bhattacharyya

class _bounding(Verb):
    """The smallest axis-aligned box around the shape.

    Rows:
        bounding(shape: Capsule2) -> Aabb2
        bounding(shape: Capsule3) -> Aabb3
        bounding(shape: Circle) -> Aabb2
        bounding(shape: Cone) -> Aabb3
        bounding(shape: Cylinder) -> Aabb3
        bounding(shape: Disc) -> Aabb3
        bounding(shape: Ellipsoid) -> Aabb3
        bounding(shape: Obb2) -> Aabb2
        bounding(shape: Obb3) -> Aabb3
        bounding(shape: RoundBox3) -> Aabb3
        bounding(shape: Segment2) -> Aabb2
        bounding(shape: Segment3) -> Aabb3
        bounding(shape: Sphere) -> Aabb3
        bounding(shape: Tetrahedron) -> Aabb3
        bounding(shape: Triangle2) -> Aabb2
        bounding(shape: Triangle3) -> Aabb3
        bounding(shape: YawBox3) -> Aabb3
    """
    @overload
    def __call__(self, shape: Capsule2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb2: ...
    @overload
    def __call__(self, shape: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb3: ...
    @overload
    def __call__(self, shape: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb2: ...
    @overload
    def __call__(self, shape: Cone, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb3: ...
    @overload
    def __call__(self, shape: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb3: ...
    @overload
    def __call__(self, shape: Disc, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb3: ...
    @overload
    def __call__(self, shape: Ellipsoid, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb3: ...
    @overload
    def __call__(self, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb2: ...
    @overload
    def __call__(self, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb3: ...
    @overload
    def __call__(self, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb3: ...
    @overload
    def __call__(self, shape: Segment2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb2: ...
    @overload
    def __call__(self, shape: Segment3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb3: ...
    @overload
    def __call__(self, shape: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb3: ...
    @overload
    def __call__(self, shape: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb3: ...
    @overload
    def __call__(self, shape: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb2: ...
    @overload
    def __call__(self, shape: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb3: ...
    @overload
    def __call__(self, shape: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

bounding: _bounding

class _centroid(Verb):
    """The centre of the area, of the volume, or of points.

    Rows:
        centroid(shape: Cone) -> Vec3
            The centre of the volume of a cone.
        centroid(shape: Cylinder) -> Vec3
            The centre of the volume of a cylinder.
        centroid(shape: Hull3_8) -> Vec3
            The centre of the volume of a convex hull of up to N vertices. It jumps where the hull becomes flat, which has the centre of its area.
        centroid(shape: Tetrahedron) -> Vec3
            The centre of the volume of a tetrahedron.
        centroid(shape: Triangle2) -> Vec2
            The centroid of a triangle.
        centroid(ring: Vec2x4) -> Vec2
            The centroid of four vertices.
        centroid(paths: cloud3) -> Vec3
            The mean of points of space; zero without points.
        centroid(paths: ring) -> Vec2
            The centroid of the area of a ring; its value jumps where the area is zero.
        centroid(polygons: Polygons) -> Vec2
            The centroid of the area of polygons; the mean of the vertices where the area is zero.
    """
    @overload
    def __call__(self, shape: Cone, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3: ...
    @overload
    def __call__(self, shape: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3: ...
    @overload
    def __call__(self, shape: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3: ...
    @overload
    def __call__(self, shape: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3: ...
    @overload
    def __call__(self, shape: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec2: ...
    @overload
    def __call__(self, ring: Vec2x4, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec2: ...
    @overload
    def __call__(self, paths: Clouds, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3: ...
    @overload
    def __call__(self, paths: Rings, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec2: ...
    @overload
    def __call__(self, polygons: Polygons, /) -> Vec2: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

centroid: _centroid

class _ciou(Verb):
    """The complete IoU of two boxes: the distance IoU less a term of the proportions.

    Rows:
        ciou(a: Aabb2, b: Aabb2) -> number
            The complete IoU of two axis-aligned boxes. It takes the axis-aligned box around both.
        ciou(a: Aabb3, b: Aabb3) -> number
            The complete IoU of two axis-aligned boxes. It takes the axis-aligned box around both.
        ciou(a: Obb2, b: Obb2) -> number
            The complete IoU of two rotated boxes. It takes the convex hull of both.
        ciou(a: Obb3, b: Obb3) -> number
            The complete IoU of two boxes of any orientation. It takes the smaller box around both along the axes of either.
        ciou(a: YawBox3, b: YawBox3) -> number
            The complete IoU of two upright boxes. It takes the convex hull of the grounds times the height of both.
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

ciou: _ciou

class _ciou_aabb(Verb):
    """The complete IoU of two rotated boxes by the diagonal of the box around both.

    Rows:
        ciou_aabb(a: Obb2, b: Obb2) -> number
        ciou_aabb(a: Obb3, b: Obb3) -> number
            The complete IoU of two boxes of any orientation by the box around both along the axes of the world.
        ciou_aabb(a: YawBox3, b: YawBox3) -> number
            The complete IoU of two upright boxes by the box around both along the axes of the world.
    """
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

ciou_aabb: _ciou_aabb

class _ciou_fixed_weight(Verb):
    """The complete IoU of two axis-aligned boxes, its weight a constant in the gradient.

    Rows:
        ciou_fixed_weight(a: Aabb2, b: Aabb2) -> number
        ciou_fixed_weight(a: Aabb3, b: Aabb3) -> number
            The complete IoU whose weight counts as a constant: the value is that of ciou, the derivatives leave the weight's out.
        ciou_fixed_weight(a: Obb2, b: Obb2) -> number
            The complete IoU of two rotated boxes, its weight a constant in the gradient.
        ciou_fixed_weight(a: Obb3, b: Obb3) -> number
            The complete IoU whose weight counts as a constant: the value is that of ciou, the derivatives leave the weight's out.
        ciou_fixed_weight(a: YawBox3, b: YawBox3) -> number
            The complete IoU whose weight counts as a constant: the value is that of ciou, the derivatives leave the weight's out.
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

ciou_fixed_weight: _ciou_fixed_weight

class _ciou_hull(Verb):
    """The complete IoU of two axis-aligned boxes by the diameter of the convex hull.

    Rows:
        ciou_hull(a: Aabb2, b: Aabb2) -> number
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

ciou_hull: _ciou_hull

class _ciou_rectangle(Verb):
    """The complete IoU of two upright boxes by the rectangle of least area around both grounds times the height of both.

    Rows:
        ciou_rectangle(a: YawBox3, b: YawBox3) -> number
    """
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

ciou_rectangle: _ciou_rectangle

class _circumcircle(Verb):
    """The circle through three points (circumcircle). It jumps where they are on one line.

    Rows:
        circumcircle(a: Vec2, b: Vec2, c: Vec2) -> Circle
    """
    @overload
    def __call__(self, a: Vec2, b: Vec2, c: Vec2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Circle: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

circumcircle: _circumcircle

class _clearance(Verb):
    """The least signed distance of two capsules of space along their motions. Hulls have up to N vertices. Its time is of Clearance3.

    Rows:
        clearance(a: Capsule3, motion_of_a: Motion3, b: Capsule3, motion_of_b: Motion3) -> number
        clearance(a: Capsule3, motion_of_a: Motion3, b: Obb3, motion_of_b: Motion3) -> number
            The least signed distance of a capsule of space and a box of any orientation along their motions. Hulls have up to N vertices. Its time is of Clearance3.
        clearance(a: Hull3_8, motion_of_a: Motion3, b: Hull3_8, motion_of_b: Motion3) -> number
            The least signed distance of two convex hulls along their motions. Hulls have up to N vertices. Its time is of Clearance3.
        clearance(a: Obb3, motion_of_a: Motion3, b: Obb3, motion_of_b: Motion3) -> number
            The least signed distance of two boxes of any orientation along their motions. Hulls have up to N vertices. Its time is of Clearance3.
        clearance(a: Sphere, motion_of_a: Motion3, b: Obb3, motion_of_b: Motion3) -> number
            The least signed distance of a ball and a box of any orientation along their motions. Hulls have up to N vertices. Its time is of Clearance3.
        clearance(a: Vec3, motion_of_a: Motion3, b: Obb3, motion_of_b: Motion3) -> number
            The least signed distance of a point and a box of any orientation along their motions. Hulls have up to N vertices. Its time is of Clearance3.
    """
    @overload
    def __call__(self, a: Capsule3, motion_of_a: Motion3, b: Capsule3, motion_of_b: Motion3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Capsule3, motion_of_a: Motion3, b: Obb3, motion_of_b: Motion3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Hull3_8, motion_of_a: Motion3, b: Hull3_8, motion_of_b: Motion3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, motion_of_a: Motion3, b: Obb3, motion_of_b: Motion3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Sphere, motion_of_a: Motion3, b: Obb3, motion_of_b: Motion3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Vec3, motion_of_a: Motion3, b: Obb3, motion_of_b: Motion3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

clearance: _clearance

class _closest_points(Verb):
    """The nearest points of two shapes. They jump where another feature becomes the nearest.

    Rows:
        closest_points(a: Aabb2, b: Aabb2) -> PointPair
            The nearest points of two axis-aligned boxes. Points jump to another nearest feature.
        closest_points(a: Aabb3, b: Aabb3) -> PointPair3
            The nearest points of two axis-aligned boxes. Points jump to another nearest feature.
        closest_points(a: Capsule2, b: Capsule2) -> PointPair
            The nearest points of two capsules. Points jump to another nearest feature.
        closest_points(a: Capsule3, b: Capsule3) -> PointPair3
            The nearest points of two capsules of space. Points jump to another nearest feature.
        closest_points(capsule: Capsule3, hull: Hull3_8) -> PointPair3
            The nearest points of a capsule of space and a convex hull. Hulls have up to N vertices. Points jump to another nearest feature.
        closest_points(capsule: Capsule3, shape: Obb3) -> PointPair3
            The nearest points of a capsule of space and a box of any orientation. Points jump to another nearest feature.
        closest_points(circle: Circle, shape: Obb2) -> PointPair
            The nearest points of a circle and a rotated box. Points jump to another nearest feature.
        closest_points(a: Ellipsoid, b: Ellipsoid) -> PointPair3
            The nearest points of two ellipsoids. Points jump to another nearest feature.
        closest_points(a: Hull3_8, b: Hull3_8) -> PointPair3
            The nearest points of two convex hulls. Hulls have up to N vertices. Points jump to another nearest feature.
        closest_points(a: Line3, b: Line3) -> PointPair3
            The nearest points of two lines of space. Points jump to another nearest feature.
        closest_points(shape: Obb2, circle: Circle) -> PointPair
            The nearest points of a rotated box and a circle. Points jump to another nearest feature.
        closest_points(a: Obb2, b: Obb2) -> PointPair
            The nearest points of two rotated boxes. Points jump to another nearest feature.
        closest_points(shape: Obb3, ellipsoid: Ellipsoid) -> PointPair3
            The nearest points of a box of any orientation and an ellipsoid. Points jump to another nearest feature.
        closest_points(shape: Obb3, hull: Hull3_8) -> PointPair3
            The nearest points of a box of any orientation and a convex hull. Hulls have up to N vertices. Points jump to another nearest feature.
        closest_points(a: Obb3, b: Obb3) -> PointPair3
            The nearest points of two boxes of any orientation. Points jump to another nearest feature.
        closest_points(a: Segment2, b: Segment2) -> ClosestOnSegments
            The nearest points of two segments, and where along both they lie.
        closest_points(a: Segment3, b: Segment3) -> PointPair3
            The nearest points of two segments of space. Points jump to another nearest feature.
        closest_points(ball: Sphere, hull: Hull3_8) -> PointPair3
            The nearest points of a ball and a convex hull. Hulls have up to N vertices. Points jump to another nearest feature.
        closest_points(ball: Sphere, shape: Obb3) -> PointPair3
            The nearest points of a ball and a box of any orientation. Points jump to another nearest feature.
        closest_points(a: Triangle2, b: Triangle2) -> PointPair
            The nearest points of two triangles. Points jump to another nearest feature.
        closest_points(a: Triangle3, b: Triangle3) -> PointPair3
            The nearest points of two triangles of space. Points jump to another nearest feature.
        closest_points(point: Vec2, curve: Arc2) -> PointPair
            The nearest points of a point and a circular arc. Points jump to another place that is as near.
        closest_points(point: Vec2, curve: Cubic2) -> PointPair
            The nearest points of a point and a cubic Bézier curve. Points jump to another place that is as near.
        closest_points(point: Vec2, shape: Obb2) -> PointPair
            The nearest points of a point and a rotated box. Points jump to another nearest feature.
        closest_points(point: Vec2, curve: Quadratic2) -> PointPair
            The nearest points of a point and a quadratic Bézier curve. Points jump to another place that is as near.
        closest_points(point: Vec2, segment: Segment2) -> PointPair
            The nearest points of a point and a segment. Points jump to another nearest feature.
        closest_points(point: Vec2, triangle: Triangle2) -> PointPair
            The nearest points of a point and a triangle. Points jump to another nearest feature.
        closest_points(point: Vec3, hull: Hull3_8) -> PointPair3
            The nearest points of a point and a convex hull. Hulls have up to N vertices. Points jump to another nearest feature.
        closest_points(point: Vec3, line: Line3) -> PointPair3
            The nearest points of a point and a line of space. Points jump to another nearest feature.
        closest_points(point: Vec3, segment: Segment3) -> PointPair3
            The nearest points of a point and a segment of space. Points jump to another nearest feature.
        closest_points(point: Vec3, triangle: Triangle3) -> PointPair3
            The nearest points of a point and a triangle of space. Points jump to another nearest feature.
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair: ...
    @overload
    def __call__(self, a: Aabb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, a: Capsule2, b: Capsule2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair: ...
    @overload
    def __call__(self, a: Capsule3, b: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, capsule: Capsule3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, capsule: Capsule3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, circle: Circle, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair: ...
    @overload
    def __call__(self, a: Ellipsoid, b: Ellipsoid, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, a: Hull3_8, b: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, a: Line3, b: Line3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, shape: Obb2, circle: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair: ...
    @overload
    def __call__(self, shape: Obb3, ellipsoid: Ellipsoid, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, shape: Obb3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, a: Segment2, b: Segment2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> ClosestOnSegments: ...
    @overload
    def __call__(self, a: Segment3, b: Segment3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, ball: Sphere, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, ball: Sphere, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, a: Triangle2, b: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair: ...
    @overload
    def __call__(self, a: Triangle3, b: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, point: Vec2, curve: Arc2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair: ...
    @overload
    def __call__(self, point: Vec2, curve: Cubic2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair: ...
    @overload
    def __call__(self, point: Vec2, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair: ...
    @overload
    def __call__(self, point: Vec2, curve: Quadratic2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair: ...
    @overload
    def __call__(self, point: Vec2, segment: Segment2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair: ...
    @overload
    def __call__(self, point: Vec2, triangle: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair: ...
    @overload
    def __call__(self, point: Vec3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, point: Vec3, line: Line3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, point: Vec3, segment: Segment3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, point: Vec3, triangle: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> PointPair3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

closest_points: _closest_points

class _contacts(Verb):
    """The contact of a capsule of space and a box of any orientation: up to eight points whose gap is at most within. Hulls have up to N vertices. Places from the count on are zero.

    Rows:
        contacts(capsule: Capsule3, shape: Obb3, within: number) -> Contacts3
        contacts(a: Hull3_8, b: Hull3_8, within: number) -> Contacts3
            The contact of two convex hulls: up to eight points whose gap is at most within. Hulls have up to N vertices. Places from the count on are zero.
        contacts(shape: Obb3, hull: Hull3_8, within: number) -> Contacts3
            The contact of a box of any orientation and a convex hull: up to eight points whose gap is at most within. Hulls have up to N vertices. Places from the count on are zero.
        contacts(a: Obb3, b: Obb3, within: number) -> Contacts3
            The contact of two boxes of any orientation: up to eight points whose gap is at most within. Hulls have up to N vertices. Places from the count on are zero.
        contacts(plane: Plane3, shape: Obb3, within: number) -> Contacts3
            The contact of a half-space and a box of any orientation: up to eight points whose gap is at most within. Hulls have up to N vertices. Places from the count on are zero.
        contacts(ball: Sphere, shape: Obb3, within: number) -> Contacts3
            The contact of a ball and a box of any orientation: up to eight points whose gap is at most within. Hulls have up to N vertices. Places from the count on are zero.
    """
    @overload
    def __call__(self, capsule: Capsule3, shape: Obb3, within: ArrayLike, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contacts3: ...
    @overload
    def __call__(self, a: Hull3_8, b: Hull3_8, within: ArrayLike, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contacts3: ...
    @overload
    def __call__(self, shape: Obb3, hull: Hull3_8, within: ArrayLike, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contacts3: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, within: ArrayLike, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contacts3: ...
    @overload
    def __call__(self, plane: Plane3, shape: Obb3, within: ArrayLike, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contacts3: ...
    @overload
    def __call__(self, ball: Sphere, shape: Obb3, within: ArrayLike, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contacts3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

contacts: _contacts

class _convert(Verb):
    """The same box in another convention, which `to` names where there are several.

    Rows:
        convert(shape: Aabb2) -> Cxcywh
            YOLO's box of an axis-aligned box.
        convert(shape: Aabb2) -> Xywh
            COCO's box of an axis-aligned box.
        convert(shape: Cxcywh) -> Aabb2
            The axis-aligned box of YOLO's box.
        convert(shape: Detectron2Box) -> ImageBox
            The image's box of detectron2's box.
        convert(shape: ImageBox) -> Detectron2Box
            detectron2's box of an image's box.
        convert(shape: ImageBox) -> Le135
            mmrotate's Le135 of an image's box.
        convert(shape: ImageBox) -> Le90
            mmrotate's Le90 of an image's box.
        convert(shape: ImageBox) -> OpenCvBox
            OpenCV's box of an image's box.
        convert(shape: KittiBox) -> YawBox3
            The upright box of KITTI's box.
        convert(shape: Le135) -> ImageBox
            The image's box of mmrotate's box (le135).
        convert(shape: Le90) -> ImageBox
            The image's box of mmrotate's box (le90).
        convert(shape: LidarBox) -> YawBox3
            The upright box of OpenPCDet's box.
        convert(shape: NuScenesBox) -> Obb3
            The box of any orientation of nuScenes' box.
        convert(shape: Obb2) -> Xyxyr
            The bounds before turning, and the angle, of a rotated box.
        convert(shape: Obb3) -> NuScenesBox
            nuScenes' box of a box of any orientation.
        convert(shape: OpenCvBox) -> ImageBox
            The image's box of OpenCV's box.
        convert(shape: Xywh) -> Aabb2
            The axis-aligned box of COCO's box.
        convert(shape: Xyxyr) -> Obb2
            The rotated box of bounds before turning, and the angle.
        convert(shape: YawBox3) -> KittiBox
            KITTI's box of an upright box.
        convert(shape: YawBox3) -> LidarBox
            OpenPCDet's box of an upright box.
        convert(shape: YawBox3) -> Obb3
            The box of any orientation of an upright box.
    """
    @overload
    def __call__(self, shape: Aabb2, /, *, kind: None = ..., to: Union[Type[Cxcywh], Literal["Cxcywh"]], out: Out = ..., backend: Backend = ...) -> Cxcywh: ...
    @overload
    def __call__(self, shape: Aabb2, /, *, kind: None = ..., to: Union[Type[Xywh], Literal["Xywh"]], out: Out = ..., backend: Backend = ...) -> Xywh: ...
    @overload
    def __call__(self, shape: Cxcywh, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb2: ...
    @overload
    def __call__(self, shape: Detectron2Box, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> ImageBox: ...
    @overload
    def __call__(self, shape: ImageBox, /, *, kind: None = ..., to: Union[Type[Detectron2Box], Literal["Detectron2Box"]], out: Out = ..., backend: Backend = ...) -> Detectron2Box: ...
    @overload
    def __call__(self, shape: ImageBox, /, *, kind: None = ..., to: Union[Type[Le135], Literal["Le135"]], out: Out = ..., backend: Backend = ...) -> Le135: ...
    @overload
    def __call__(self, shape: ImageBox, /, *, kind: None = ..., to: Union[Type[Le90], Literal["Le90"]], out: Out = ..., backend: Backend = ...) -> Le90: ...
    @overload
    def __call__(self, shape: ImageBox, /, *, kind: None = ..., to: Union[Type[OpenCvBox], Literal["OpenCvBox"]], out: Out = ..., backend: Backend = ...) -> OpenCvBox: ...
    @overload
    def __call__(self, shape: KittiBox, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> YawBox3: ...
    @overload
    def __call__(self, shape: Le135, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> ImageBox: ...
    @overload
    def __call__(self, shape: Le90, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> ImageBox: ...
    @overload
    def __call__(self, shape: LidarBox, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> YawBox3: ...
    @overload
    def __call__(self, shape: NuScenesBox, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Obb3: ...
    @overload
    def __call__(self, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Xyxyr: ...
    @overload
    def __call__(self, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> NuScenesBox: ...
    @overload
    def __call__(self, shape: OpenCvBox, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> ImageBox: ...
    @overload
    def __call__(self, shape: Xywh, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Aabb2: ...
    @overload
    def __call__(self, shape: Xyxyr, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Obb2: ...
    @overload
    def __call__(self, shape: YawBox3, /, *, kind: None = ..., to: Union[Type[KittiBox], Literal["KittiBox"]], out: Out = ..., backend: Backend = ...) -> KittiBox: ...
    @overload
    def __call__(self, shape: YawBox3, /, *, kind: None = ..., to: Union[Type[LidarBox], Literal["LidarBox"]], out: Out = ..., backend: Backend = ...) -> LidarBox: ...
    @overload
    def __call__(self, shape: YawBox3, /, *, kind: None = ..., to: Union[Type[Obb3], Literal["Obb3"]], out: Out = ..., backend: Backend = ...) -> Obb3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

convert: _convert

class _corners(Verb):
    """The corners of a rotated box.

    Rows:
        corners(shape: Obb2) -> Vec2x4
        corners(shape: Obb3) -> Vec3x8
            The corners of the box: the first side runs fastest, the third slowest.
        corners(shape: YawBox3) -> Vec3x8
            The corners of the box: the first side runs fastest, the third slowest.
    """
    @overload
    def __call__(self, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec2x4: ...
    @overload
    def __call__(self, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3x8: ...
    @overload
    def __call__(self, shape: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3x8: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

corners: _corners

class _crossing(Verb):
    """The crossing of lines or planes.

    Rows:
        crossing(a: Line2, b: Line2) -> CommonPoint
            The crossing of two lines.
        crossing(a: Plane3, b: Plane3) -> CommonLine3
            The line of two planes, the borders of two half-spaces.
        crossing(a: Plane3, b: Plane3, c: Plane3) -> CommonPoint3
            The point of three planes.
    """
    @overload
    def __call__(self, a: Line2, b: Line2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> CommonPoint: ...
    @overload
    def __call__(self, a: Plane3, b: Plane3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> CommonLine3: ...
    @overload
    def __call__(self, a: Plane3, b: Plane3, c: Plane3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> CommonPoint3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

crossing: _crossing

class _depth(Verb):
    """The depth of a point in a shape: positive inside, negative outside.

    Rows:
        depth(point: Vec2, shape: Aabb2) -> number
            The depth of a point and an axis-aligned box, positive inside.
        depth(point: Vec2, shape: Obb2) -> number
            The depth of a point and a rotated box, positive inside.
        depth(point: Vec2, paths: ring) -> number
            How far a point is inside a ring by the even-odd rule, negative outside. Without edges it is minus the largest finite number.
        depth(point: Vec2, polygons: Polygons) -> number
            The distance of points from the border of polygons: positive inside, negative outside.
    """
    @overload
    def __call__(self, point: Vec2, shape: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, paths: Rings, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Union[Vec2, Array], polygons: Polygons, /) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

depth: _depth

class _diameter(Verb):
    """The diameter of a convex polygon of up to N vertices: the largest distance of two of them, which are its record.

    Rows:
        diameter(polygon: ConvexPolygon6) -> number
        diameter(points: Paths or Polygons) -> number
            The largest distance of two points of each set; NaN for a set without points.
    """
    @overload
    def __call__(self, polygon: ConvexPolygon6, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, points: Union[Paths, Polygons], /) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

diameter: _diameter

class _diou(Verb):
    """The distance IoU of two boxes: IoU less the squared distance of the centres, by the enclosing shape.

    Rows:
        diou(a: Aabb2, b: Aabb2) -> number
            The distance IoU of two axis-aligned boxes. It takes the axis-aligned box around both.
        diou(a: Aabb3, b: Aabb3) -> number
            The distance IoU of two axis-aligned boxes. It takes the axis-aligned box around both.
        diou(a: ConvexPolygon5, b: ConvexPolygon5) -> number
            The distance IoU of two convex polygons of up to N vertices. It takes the diameter of both together.
        diou(a: Obb2, b: Obb2) -> number
            The distance IoU of two rotated boxes. It takes the convex hull of both.
        diou(a: Obb3, b: Obb3) -> number
            The distance IoU of two boxes of any orientation. It takes the smaller box around both along the axes of either.
        diou(a: YawBox3, b: YawBox3) -> number
            The distance IoU of two upright boxes. It takes the convex hull of the grounds times the height of both.
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: ConvexPolygon5, b: ConvexPolygon5, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

diou: _diou

class _diou_aabb(Verb):
    """The distance IoU of two rotated boxes by the diagonal of the box around both.

    Rows:
        diou_aabb(a: Obb2, b: Obb2) -> number
        diou_aabb(a: Obb3, b: Obb3) -> number
            The distance IoU of two boxes of any orientation by the box around both along the axes of the world.
        diou_aabb(a: YawBox3, b: YawBox3) -> number
            The distance IoU of two upright boxes by the box around both along the axes of the world.
    """
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

diou_aabb: _diou_aabb

class _diou_hull(Verb):
    """The distance IoU of two axis-aligned boxes by the diameter of the convex hull.

    Rows:
        diou_hull(a: Aabb2, b: Aabb2) -> number
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

diou_hull: _diou_hull

class _diou_rectangle(Verb):
    """The distance IoU of two upright boxes by the rectangle of least area around both grounds times the height of both.

    Rows:
        diou_rectangle(a: YawBox3, b: YawBox3) -> number
    """
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

diou_rectangle: _diou_rectangle

class _distance(Verb):
    """The distance of two shapes: 0 where they meet. That of a ring is from its edges, also inside.

    Rows:
        distance(a: Aabb2, b: Aabb2) -> number
            The distance of two axis-aligned boxes.
        distance(shape: Aabb2, point: Vec2) -> number
            The distance of an axis-aligned box and a point.
        distance(a: Aabb3, b: Aabb3) -> number
            The distance of two axis-aligned boxes.
        distance(shape: Aabb3, point: Vec3) -> number
            The distance of an axis-aligned box and a point.
        distance(a: Capsule2, b: Capsule2) -> number
            The distance of two capsules.
        distance(capsule: Capsule2, point: Vec2) -> number
            The distance of a capsule and a point.
        distance(a: Capsule3, b: Capsule3) -> number
            The distance of two capsules of space.
        distance(capsule: Capsule3, cone: Cone) -> number
            The distance of a capsule of space and a cone, 0 where they meet.
        distance(capsule: Capsule3, hull: Hull3_8) -> number
            The distance of a capsule of space and a convex hull, 0 where they meet. Hulls have up to N vertices.
        distance(capsule: Capsule3, line: Line3) -> number
            The distance of a capsule of space and a line of space.
        distance(capsule: Capsule3, shape: Obb3) -> number
            The distance of a capsule of space and a box of any orientation.
        distance(capsule: Capsule3, ball: Sphere) -> number
            The distance of a capsule of space and a ball.
        distance(a: Circle, b: Circle) -> number
            The distance of two circles.
        distance(circle: Circle, shape: Obb2) -> number
            The distance of a circle and a rotated box.
        distance(circle: Circle, segment: Segment2) -> number
            The distance of a circle and a segment.
        distance(circle: Circle, point: Vec2) -> number
            The distance of a circle and a point.
        distance(a: ConvexPolygon5, b: ConvexPolygon5) -> number
            The distance of two convex polygons of up to N vertices, 0 where they meet.
        distance(a: Ellipsoid, b: Ellipsoid) -> number
            The distance of two ellipsoids, 0 where they meet.
        distance(hull: Hull3_8, cylinder: Cylinder) -> number
            The distance of a convex hull and a cylinder, 0 where they meet. Hulls have up to N vertices.
        distance(a: Hull3_8, b: Hull3_8) -> number
            The distance of two convex hulls, 0 where they meet. Hulls have up to N vertices.
        distance(a: Interval, b: Interval) -> number
            The distance of two intervals.
        distance(a: Line3, b: Line3) -> number
            The distance of two lines of space. It jumps where they become parallel.
        distance(line: Line3, shape: Obb3) -> number
            The distance of a line of space and a box of any orientation.
        distance(line: Line3, ray: Ray3) -> number
            The distance of a line of space and a ray of space. It jumps where they become parallel.
        distance(line: Line3, shape: RoundBox3) -> number
            The distance of a line of space and a box with round edges.
        distance(line: Line3, solid: Tetrahedron) -> number
            The distance of a line of space and a tetrahedron.
        distance(line: Line3, triangle: Triangle3) -> number
            The distance of a line of space and a triangle of space.
        distance(shape: Obb2, circle: Circle) -> number
            The distance of a rotated box and a circle.
        distance(a: Obb2, b: Obb2) -> number
            The distance of two rotated boxes.
        distance(shape: Obb2, segment: Segment2) -> number
            The distance of a rotated box and a segment.
        distance(shape: Obb2, point: Vec2) -> number
            The distance of a rotated box and a point.
        distance(shape: Obb3, hull: Hull3_8) -> number
            The distance of a box of any orientation and a convex hull, 0 where they meet. Hulls have up to N vertices.
        distance(a: Obb3, b: Obb3) -> number
            The distance of two boxes of any orientation.
        distance(shape: Obb3, point: Vec3) -> number
            The distance of a box of any orientation and a point.
        distance(ray: Ray3, capsule: Capsule3) -> number
            The distance of a ray of space and a capsule of space.
        distance(ray: Ray3, shape: Obb3) -> number
            The distance of a ray of space and a box of any orientation.
        distance(a: Ray3, b: Ray3) -> number
            The distance of two rays of space. It jumps where they become parallel.
        distance(ray: Ray3, shape: RoundBox3) -> number
            The distance of a ray of space and a box with round edges.
        distance(ray: Ray3, solid: Tetrahedron) -> number
            The distance of a ray of space and a tetrahedron.
        distance(ray: Ray3, triangle: Triangle3) -> number
            The distance of a ray of space and a triangle of space.
        distance(shape: RoundBox3, hull: Hull3_8) -> number
            The distance of a box with round edges and a convex hull, 0 where they meet. Hulls have up to N vertices.
        distance(segment: Segment2, circle: Circle) -> number
            The distance of a segment and a circle.
        distance(segment: Segment2, shape: Obb2) -> number
            The distance of a segment and a rotated box.
        distance(a: Segment2, b: Segment2) -> number
            The distance of two segments.
        distance(segment: Segment2, point: Vec2) -> number
            The distance of a segment and a point.
        distance(segment: Segment3, hull: Hull3_8) -> number
            The distance of a segment of space and a convex hull, 0 where they meet. Hulls have up to N vertices.
        distance(segment: Segment3, line: Line3) -> number
            The distance of a segment of space and a line of space.
        distance(segment: Segment3, shape: Obb3) -> number
            The distance of a segment of space and a box of any orientation.
        distance(segment: Segment3, ray: Ray3) -> number
            The distance of a segment of space and a ray of space.
        distance(segment: Segment3, shape: RoundBox3) -> number
            The distance of a segment of space and a box with round edges.
        distance(a: Segment3, b: Segment3) -> number
            The distance of two segments of space.
        distance(segment: Segment3, solid: Tetrahedron) -> number
            The distance of a segment of space and a tetrahedron.
        distance(segment: Segment3, triangle: Triangle3) -> number
            The distance of a segment of space and a triangle of space.
        distance(ball: Sphere, hull: Hull3_8) -> number
            The distance of a ball and a convex hull, 0 where they meet. Hulls have up to N vertices.
        distance(ball: Sphere, shape: Obb3) -> number
            The distance of a ball and a box of any orientation.
        distance(a: Sphere, b: Sphere) -> number
            The distance of two balls.
        distance(solid: Tetrahedron, hull: Hull3_8) -> number
            The distance of a tetrahedron and a convex hull, 0 where they meet. Hulls have up to N vertices.
        distance(solid: Tetrahedron, shape: Obb3) -> number
            The distance of a tetrahedron and a box of any orientation.
        distance(solid: Tetrahedron, shape: RoundBox3) -> number
            The distance of a tetrahedron and a box with round edges.
        distance(a: Tetrahedron, b: Tetrahedron) -> number
            The distance of two tetrahedra.
        distance(a: Triangle2, b: Triangle2) -> number
            The distance of two triangles.
        distance(triangle: Triangle2, point: Vec2) -> number
            The distance of a triangle and a point.
        distance(triangle: Triangle3, hull: Hull3_8) -> number
            The distance of a triangle of space and a convex hull, 0 where they meet. Hulls have up to N vertices.
        distance(triangle: Triangle3, shape: Obb3) -> number
            The distance of a triangle of space and a box of any orientation.
        distance(triangle: Triangle3, shape: RoundBox3) -> number
            The distance of a triangle of space and a box with round edges.
        distance(triangle: Triangle3, solid: Tetrahedron) -> number
            The distance of a triangle of space and a tetrahedron.
        distance(a: Triangle3, b: Triangle3) -> number
            The distance of two triangles of space.
        distance(point: Vec2, shape: Aabb2) -> number
            The distance of a point and an axis-aligned box.
        distance(point: Vec2, curve: Arc2) -> number
            The distance of a point and a circular arc, 0 on the curve.
        distance(point: Vec2, capsule: Capsule2) -> number
            The distance of a point and a capsule.
        distance(point: Vec2, circle: Circle) -> number
            The distance of a point and a circle.
        distance(point: Vec2, polygon: ConvexPolygon6) -> number
            The distance of a point from a convex polygon of up to N vertices, 0 inside.
        distance(point: Vec2, curve: Cubic2) -> number
            The distance of a point and a cubic Bézier curve, 0 on the curve.
        distance(point: Vec2, shape: Obb2) -> number
            The distance of a point and a rotated box.
        distance(point: Vec2, curve: Quadratic2) -> number
            The distance of a point and a quadratic Bézier curve, 0 on the curve.
        distance(point: Vec2, segment: Segment2) -> number
            The distance of a point and a segment.
        distance(point: Vec2, triangle: Triangle2) -> number
            The distance of a point and a triangle.
        distance(a: Vec2, b: Vec2) -> number
            The distance of two points.
        distance(point: Vec2, paths: polyline) -> number
            The distance of a point and a polyline; the largest finite number where that has fewer than two vertices.
        distance(point: Vec2, paths: ring) -> number
            The distance of a point, also one inside, and the edges of a ring; that to the area is the signed distance where positive, else 0. Without edges the largest finite number.
        distance(point: Vec3, shape: Aabb3) -> number
            The distance of a point and an axis-aligned box.
        distance(point: Vec3, capsule: Capsule3) -> number
            The distance of a point and a capsule of space.
        distance(point: Vec3, cone: Cone) -> number
            The distance of a point and a cone.
        distance(point: Vec3, cylinder: Cylinder) -> number
            The distance of a point and a cylinder.
        distance(point: Vec3, disc: Disc) -> number
            The distance of a point and a disc, 0 where they meet.
        distance(point: Vec3, hull: Hull3_8) -> number
            The distance of a point and a convex hull, 0 where they meet. Hulls have up to N vertices.
        distance(point: Vec3, line: Line3) -> number
            The distance of a point and a line of space.
        distance(point: Vec3, shape: Obb3) -> number
            The distance of a point and a box of any orientation.
        distance(point: Vec3, ray: Ray3) -> number
            The distance of a point and a ray of space.
        distance(point: Vec3, segment: Segment3) -> number
            The distance of a point and a segment of space.
        distance(point: Vec3, ball: Sphere) -> number
            The distance of a point and a ball.
        distance(point: Vec3, solid: Tetrahedron) -> number
            The distance of a point and a tetrahedron.
        distance(point: Vec3, triangle: Triangle3) -> number
            The distance of a point and a triangle of space.
        distance(a: Vec3, b: Vec3) -> number
            The distance of two points.
        distance(point: Vec3, shape: YawBox3) -> number
            The distance of a point and an upright box.
        distance(point: Vec3, paths: polyline3) -> number
            The distance of a point and a polyline of space; the largest finite number where that has fewer than two vertices.
        distance(shape: YawBox3, point: Vec3) -> number
            The distance of an upright box and a point.
        distance(x: number, interval: Interval) -> number
            The distance of a number and an interval.
        distance(a: number, b: number) -> number
            The distance of two numbers.
        distance(point: Vec2, polygons: Polygons) -> number
            The distance of points from the area of polygons: 0 inside, with derivative zero.
        distance(a: Polygons, b: Polygons) -> number
            The distance of two polygons: 0 where they meet, with derivative zero.
        distance(shape: Aabb2, Capsule2, Circle, Obb2, Segment2, Triangle2 or Vec2x4, polygons: Polygons) -> number
            The same of a shape.
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Aabb2, point: Vec2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Aabb3, point: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Capsule2, b: Capsule2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, capsule: Capsule2, point: Vec2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Capsule3, b: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, capsule: Capsule3, cone: Cone, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, capsule: Capsule3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, capsule: Capsule3, line: Line3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, capsule: Capsule3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, capsule: Capsule3, ball: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Circle, b: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, circle: Circle, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, circle: Circle, segment: Segment2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, circle: Circle, point: Vec2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: ConvexPolygon5, b: ConvexPolygon5, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Ellipsoid, b: Ellipsoid, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, hull: Hull3_8, cylinder: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Hull3_8, b: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Interval, b: Interval, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Line3, b: Line3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, line: Line3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, line: Line3, ray: Ray3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, line: Line3, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, line: Line3, solid: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, line: Line3, triangle: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb2, circle: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb2, segment: Segment2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb2, point: Vec2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb3, point: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ray: Ray3, capsule: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ray: Ray3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Ray3, b: Ray3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ray: Ray3, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ray: Ray3, solid: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ray: Ray3, triangle: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: RoundBox3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment2, circle: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment2, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Segment2, b: Segment2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment2, point: Vec2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, line: Line3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, ray: Ray3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Segment3, b: Segment3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, solid: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, triangle: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ball: Sphere, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ball: Sphere, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Sphere, b: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, solid: Tetrahedron, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, solid: Tetrahedron, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, solid: Tetrahedron, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Tetrahedron, b: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Triangle2, b: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, triangle: Triangle2, point: Vec2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, triangle: Triangle3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, triangle: Triangle3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, triangle: Triangle3, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, triangle: Triangle3, solid: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Triangle3, b: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, shape: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, curve: Arc2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, capsule: Capsule2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, circle: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, polygon: ConvexPolygon6, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, curve: Cubic2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, curve: Quadratic2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, segment: Segment2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, triangle: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Vec2, b: Vec2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, paths: Polylines, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, paths: Rings, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, shape: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, capsule: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, cone: Cone, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, cylinder: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, disc: Disc, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, line: Line3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, ray: Ray3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, segment: Segment3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, ball: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, solid: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, triangle: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Vec3, b: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, shape: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, paths: Polylines, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: YawBox3, point: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, x: ArrayLike, interval: Interval, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: ArrayLike, b: ArrayLike, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Union[Vec2, Array], polygons: Polygons, /) -> Array: ...
    @overload
    def __call__(self, a: Polygons, b: Polygons, /) -> Array: ...
    @overload
    def __call__(self, shape: Union[Aabb2, Capsule2, Circle, Obb2, Segment2, Triangle2, Vec2x4], polygons: Polygons, /) -> Array: ...
    @overload
    def __call__(self, polygons: Polygons, shape: Union[Aabb2, Capsule2, Circle, Obb2, Segment2, Triangle2, Vec2x4], /) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

distance: _distance

class _eiou(Verb):
    """The efficient IoU of two boxes: the distance IoU less terms of both sizes.

    Rows:
        eiou(a: Aabb2, b: Aabb2) -> number
            The efficient IoU of two axis-aligned boxes. It takes the axis-aligned box around both.
        eiou(a: Aabb3, b: Aabb3) -> number
            The efficient IoU of two axis-aligned boxes. It takes the axis-aligned box around both.
        eiou(a: Obb2, b: Obb2) -> number
            The efficient IoU of two rotated boxes. It takes the convex hull of both.
        eiou(a: Obb3, b: Obb3) -> number
            The efficient IoU of two boxes of any orientation. It takes the smaller box around both along the axes of either.
        eiou(a: YawBox3, b: YawBox3) -> number
            The efficient IoU of two upright boxes. It takes the convex hull of the grounds times the height of both.
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

eiou: _eiou

class _eiou_aabb(Verb):
    """The efficient IoU of two rotated boxes by the box around both.

    Rows:
        eiou_aabb(a: Obb2, b: Obb2) -> number
        eiou_aabb(a: Obb3, b: Obb3) -> number
            The efficient IoU of two boxes of any orientation by the box around both along the axes of the world.
        eiou_aabb(a: YawBox3, b: YawBox3) -> number
            The efficient IoU of two upright boxes by the box around both along the axes of the world.
    """
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

eiou_aabb: _eiou_aabb

class _eiou_hull(Verb):
    """The efficient IoU of two axis-aligned boxes by the convex hull.

    Rows:
        eiou_hull(a: Aabb2, b: Aabb2) -> number
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

eiou_hull: _eiou_hull

class _eiou_rectangle(Verb):
    """The efficient IoU of two upright boxes by the rectangle of least area around both grounds times the height of both.

    Rows:
        eiou_rectangle(a: YawBox3, b: YawBox3) -> number
    """
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

eiou_rectangle: _eiou_rectangle

class _farthest_distance(Verb):
    """The longest distance of a point of one shape from a point of another one.

    Rows:
        farthest_distance(a: Aabb2, b: Aabb2) -> number
            The longest distance of two axis-aligned boxes.
        farthest_distance(a: Aabb3, b: Aabb3) -> number
            The longest distance of two axis-aligned boxes.
        farthest_distance(a: Capsule3, b: Capsule3) -> number
            The longest distance of two capsules of space.
        farthest_distance(circle: Circle, shape: Obb2) -> number
            The longest distance of a circle and a rotated box.
        farthest_distance(a: ConvexPolygon5, b: ConvexPolygon5) -> number
            The farthest distance of two convex polygons of up to N vertices.
        farthest_distance(a: Obb2, b: Obb2) -> number
            The longest distance of two rotated boxes.
        farthest_distance(a: Obb3, b: Obb3) -> number
            The longest distance of two boxes of any orientation.
        farthest_distance(a: Triangle2, b: Triangle2) -> number
            The longest distance of two triangles.
        farthest_distance(point: Vec2, shape: Obb2) -> number
            The longest distance of a point and a rotated box.
        farthest_distance(point: Vec3, shape: Obb3) -> number
            The longest distance of a point and a box of any orientation.
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Capsule3, b: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, circle: Circle, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: ConvexPolygon5, b: ConvexPolygon5, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Triangle2, b: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

farthest_distance: _farthest_distance

class _first_hit(Verb):
    """The first hit of a ray and a shape: how far along the ray, where, and the normal there.

    Rows:
        first_hit(ray: Ray2, shape: Aabb2) -> Hit
            The first hit of a ray and an axis-aligned box.
        first_hit(ray: Ray2, capsule: Capsule2) -> Hit
            The first hit of a ray and a capsule.
        first_hit(ray: Ray2, circle: Circle) -> Hit
            The first hit of a ray and a circle.
        first_hit(ray: Ray2, shape: Obb2) -> Hit
            The first hit of a ray and a rotated box.
        first_hit(ray: Ray2, triangle: Triangle2) -> Hit
            The first hit of a ray and a triangle.
        first_hit(ray: Ray3, shape: Aabb3) -> Hit3
            The first hit of a ray of space and an axis-aligned box.
        first_hit(ray: Ray3, capsule: Capsule3) -> Hit3
            The first hit of a ray of space and a capsule of space.
        first_hit(ray: Ray3, cone: Cone) -> Hit3
            The first hit of a ray of space and a cone.
        first_hit(ray: Ray3, cylinder: Cylinder) -> Hit3
            The first hit of a ray of space and a cylinder.
        first_hit(ray: Ray3, shape: Obb3) -> Hit3
            The first hit of a ray of space and a box of any orientation.
        first_hit(ray: Ray3, plane: Plane3) -> Hit3
            The first hit of a ray of space and a half-space.
        first_hit(ray: Ray3, shape: RoundBox3) -> Hit3
            The first hit of a ray of space and a box with round edges.
        first_hit(ray: Ray3, ball: Sphere) -> Hit3
            The first hit of a ray of space and a ball.
        first_hit(ray: Ray3, solid: Tetrahedron) -> Hit3
            The first hit of a ray of space and a tetrahedron.
        first_hit(ray: Ray3, triangle: Triangle3) -> Hit3
            The first hit of a ray of space and a triangle of space.
        first_hit(ray: Ray3, shape: YawBox3) -> Hit3
            The first hit of a ray of space and an upright box.
        first_hit(segment: Segment3, triangle: Triangle3) -> Hit3
            The first hit of a segment of space and a triangle of space.
    """
    @overload
    def __call__(self, ray: Ray2, shape: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit: ...
    @overload
    def __call__(self, ray: Ray2, capsule: Capsule2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit: ...
    @overload
    def __call__(self, ray: Ray2, circle: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit: ...
    @overload
    def __call__(self, ray: Ray2, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit: ...
    @overload
    def __call__(self, ray: Ray2, triangle: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit: ...
    @overload
    def __call__(self, ray: Ray3, shape: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit3: ...
    @overload
    def __call__(self, ray: Ray3, capsule: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit3: ...
    @overload
    def __call__(self, ray: Ray3, cone: Cone, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit3: ...
    @overload
    def __call__(self, ray: Ray3, cylinder: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit3: ...
    @overload
    def __call__(self, ray: Ray3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit3: ...
    @overload
    def __call__(self, ray: Ray3, plane: Plane3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit3: ...
    @overload
    def __call__(self, ray: Ray3, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit3: ...
    @overload
    def __call__(self, ray: Ray3, ball: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit3: ...
    @overload
    def __call__(self, ray: Ray3, solid: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit3: ...
    @overload
    def __call__(self, ray: Ray3, triangle: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit3: ...
    @overload
    def __call__(self, ray: Ray3, shape: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit3: ...
    @overload
    def __call__(self, segment: Segment3, triangle: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Hit3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

first_hit: _first_hit

class _flip_y(Verb):
    """An image's box where y points up, from the image's height.

    Rows:
        flip_y(shape: ImageBox, image_height: number) -> Obb2
        flip_y(shape: Obb2, image_height: number) -> ImageBox
            An image's box of a box whose y points up, from the image's height.
    """
    @overload
    def __call__(self, shape: ImageBox, image_height: ArrayLike, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Obb2: ...
    @overload
    def __call__(self, shape: Obb2, image_height: ArrayLike, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> ImageBox: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

flip_y: _flip_y

class _from_6d(Verb):
    """The rotation whose x axis is along the first vector and whose y axis is in the half plane of both.

    Rows:
        from_6d(columns: Vec3x2) -> Rotation3
    """
    @overload
    def __call__(self, columns: Vec3x2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Rotation3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

from_6d: _from_6d

class _from_rotation_vector(Verb):
    """The rotation of a rotation vector in radians: the exponential.

    Rows:
        from_rotation_vector(vector: Vec3) -> Rotation3
    """
    @overload
    def __call__(self, vector: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Rotation3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

from_rotation_vector: _from_rotation_vector

class _from_twist(Verb):
    """The pose after one unit of time at constant velocity, a screw, from turn and shift: the coupled exponential.

    Rows:
        from_twist(turn: Vec3, shift: Vec3) -> Pose3
    """
    @overload
    def __call__(self, turn: Vec3, shift: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Pose3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

from_twist: _from_twist

class _giou(Verb):
    """The generalised IoU of two shapes: IoU less the share of the enclosing shape that neither covers.

    Rows:
        giou(a: Aabb2, b: Aabb2) -> number
            The generalised IoU of two axis-aligned boxes. It takes the axis-aligned box around both.
        giou(a: Aabb3, b: Aabb3) -> number
            The generalised IoU of two axis-aligned boxes. It takes the axis-aligned box around both.
        giou(a: ConvexPolygon5, b: ConvexPolygon5) -> number
            The generalised IoU of two convex polygons of up to N vertices. It takes the convex hull of both.
        giou(a: Obb2, b: Obb2) -> number
            The generalised IoU of two rotated boxes. It takes the convex hull of both.
        giou(a: Obb3, b: Obb3) -> number
            The generalised IoU of two boxes of any orientation. It takes the smaller box around both along the axes of either.
        giou(a: YawBox3, b: YawBox3) -> number
            The generalised IoU of two upright boxes. It takes the convex hull of the grounds times the height of both.
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: ConvexPolygon5, b: ConvexPolygon5, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

giou: _giou

class _giou_aabb(Verb):
    """The generalised IoU of two rotated boxes by the box around both.

    Rows:
        giou_aabb(a: Obb2, b: Obb2) -> number
        giou_aabb(a: Obb3, b: Obb3) -> number
            The generalised IoU of two boxes of any orientation by the box around both along the axes of the world.
        giou_aabb(a: YawBox3, b: YawBox3) -> number
            The generalised IoU of two upright boxes by the box around both along the axes of the world.
    """
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

giou_aabb: _giou_aabb

class _giou_hull(Verb):
    """The generalised IoU of two axis-aligned boxes by the convex hull.

    Rows:
        giou_hull(a: Aabb2, b: Aabb2) -> number
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

giou_hull: _giou_hull

class _giou_rectangle(Verb):
    """The generalised IoU of two upright boxes by the rectangle of least area around both grounds times the height of both.

    Rows:
        giou_rectangle(a: YawBox3, b: YawBox3) -> number
    """
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

giou_rectangle: _giou_rectangle

class _height(Verb):
    """The distance of the apex from the base, in units of length.

    Rows:
        height(shape: Cone) -> number
        height(shape: Cylinder) -> number
            The distance of both ends, in units of length.
    """
    @overload
    def __call__(self, shape: Cone, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

height: _height

class _hull_area(Verb):
    """The area of the convex hull of two shapes.

    Rows:
        hull_area(a: Aabb2, b: Aabb2) -> number
            The area of the convex hull of two axis-aligned boxes.
        hull_area(a: ConvexPolygon5, b: ConvexPolygon5) -> number
            The area of the joint hull of two convex polygons of up to N vertices.
        hull_area(a: Obb2, b: Obb2) -> number
            The area of the convex hull of two rotated boxes.
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: ConvexPolygon5, b: ConvexPolygon5, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

hull_area: _hull_area

class _incircle(Verb):
    """The inscribed circle of a triangle.

    Rows:
        incircle(shape: Triangle2) -> Circle
    """
    @overload
    def __call__(self, shape: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Circle: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

incircle: _incircle

class _inertia(Verb):
    """The inertia of a body about its centroid, by unit density.

    Rows:
        inertia(shape: Capsule3) -> Symmetric3
            The inertia of a capsule of space about its centroid, by unit density.
        inertia(shape: Cone) -> Symmetric3
            The inertia of a cone about its centroid, by unit density.
        inertia(shape: Cylinder) -> Symmetric3
            The inertia of a cylinder about its centroid, by unit density.
        inertia(shape: Ellipsoid) -> Symmetric3
            The inertia of an ellipsoid about its centroid, by unit density.
        inertia(shape: Obb3) -> Symmetric3
            The inertia of a box of any orientation about its centroid, by unit density.
        inertia(shape: RoundBox3) -> Symmetric3
            The inertia of a box with round edges about its centroid, by unit density.
        inertia(shape: Sphere) -> Symmetric3
            The inertia of a ball about its centroid, by unit density.
        inertia(shape: Tetrahedron) -> Symmetric3
            The inertia of a tetrahedron about its centroid, by unit density.
    """
    @overload
    def __call__(self, shape: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Symmetric3: ...
    @overload
    def __call__(self, shape: Cone, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Symmetric3: ...
    @overload
    def __call__(self, shape: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Symmetric3: ...
    @overload
    def __call__(self, shape: Ellipsoid, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Symmetric3: ...
    @overload
    def __call__(self, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Symmetric3: ...
    @overload
    def __call__(self, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Symmetric3: ...
    @overload
    def __call__(self, shape: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Symmetric3: ...
    @overload
    def __call__(self, shape: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Symmetric3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

inertia: _inertia

class _interpolate(Verb):
    """The pose or rotation a share of the way to another one. It jumps at half turns.

    Rows:
        interpolate(a: Pose3, b: Pose3, share: number) -> Pose3
            The pose a share of the way to another one. It jumps at half turns.
        interpolate(a: Rotation3, b: Rotation3, share: number) -> Rotation3
            The rotation a share of the way to another one, along the shorter arc. It jumps at half turns.
    """
    @overload
    def __call__(self, a: Pose3, b: Pose3, share: ArrayLike, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Pose3: ...
    @overload
    def __call__(self, a: Rotation3, b: Rotation3, share: ArrayLike, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Rotation3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

interpolate: _interpolate

class _intersection_area(Verb):
    """The area that two shapes share.

    Rows:
        intersection_area(a: Aabb2, b: Aabb2) -> number
            Area that two axis-aligned boxes share.
        intersection_area(a: ConvexPolygon5, b: ConvexPolygon5) -> number
            The area that two convex polygons of up to N vertices share.
        intersection_area(hull: Hull3_8, plane: Plane3) -> number
            The area in which a convex hull and a half-space's border cuts the first. Hulls have up to N vertices.
        intersection_area(a: Obb2, b: Obb2) -> number
            Area that two rotated boxes share.
        intersection_area(shape: Obb3, plane: Plane3) -> number
            The area in which a box of any orientation and a half-space's border cuts the first. Hulls have up to N vertices.
        intersection_area(solid: Tetrahedron, plane: Plane3) -> number
            The area in which a tetrahedron and a half-space's border cuts the first. Hulls have up to N vertices.
        intersection_area(a: Vec2x4, b: Vec2x4) -> number
            Area that two quadrilaterals share. Of either order, and convex.
        intersection_area(a: Polygons, b: Polygons) -> number
            The area that two polygons share.
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: ConvexPolygon5, b: ConvexPolygon5, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, hull: Hull3_8, plane: Plane3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb3, plane: Plane3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, solid: Tetrahedron, plane: Plane3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Vec2x4, b: Vec2x4, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Polygons, b: Polygons, /) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

intersection_area: _intersection_area

class _intersection_length(Verb):
    """Length that two intervals share.

    Rows:
        intersection_length(a: Interval, b: Interval) -> number
    """
    @overload
    def __call__(self, a: Interval, b: Interval, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

intersection_length: _intersection_length

class _intersection_volume(Verb):
    """The volume that two boxes share.

    Rows:
        intersection_volume(a: Aabb3, b: Aabb3) -> number
            Volume that two axis-aligned boxes share.
        intersection_volume(shape: Aabb3, hull: Hull3_8) -> number
            The volume that an axis-aligned box and a convex hull share. Hulls have up to N vertices.
        intersection_volume(a: Aabb3, b: Obb3) -> number
            Volume that an axis-aligned box and a box of any orientation share.
        intersection_volume(a: Aabb3, b: YawBox3) -> number
            Volume that an axis-aligned box and an upright box share.
        intersection_volume(a: Hull3_8, b: Hull3_8) -> number
            The volume that two convex hulls share. Hulls have up to N vertices.
        intersection_volume(hull: Hull3_8, plane: Plane3) -> number
            The volume that a convex hull and a half-space share. Hulls have up to N vertices.
        intersection_volume(a: Obb3, b: Aabb3) -> number
            Volume that a box of any orientation and an axis-aligned box share.
        intersection_volume(shape: Obb3, hull: Hull3_8) -> number
            The volume that a box of any orientation and a convex hull share. Hulls have up to N vertices.
        intersection_volume(a: Obb3, b: Obb3) -> number
            Volume that two boxes of any orientation share.
        intersection_volume(shape: Obb3, plane: Plane3) -> number
            The volume that a box of any orientation and a half-space share. Hulls have up to N vertices.
        intersection_volume(a: Obb3, b: YawBox3) -> number
            Volume that a box of any orientation and an upright box share.
        intersection_volume(solid: Tetrahedron, hull: Hull3_8) -> number
            The volume that a tetrahedron and a convex hull share. Hulls have up to N vertices.
        intersection_volume(solid: Tetrahedron, shape: Obb3) -> number
            The volume that a tetrahedron and a box of any orientation share. Hulls have up to N vertices.
        intersection_volume(solid: Tetrahedron, plane: Plane3) -> number
            The volume that a tetrahedron and a half-space share. Hulls have up to N vertices.
        intersection_volume(a: Tetrahedron, b: Tetrahedron) -> number
            The volume that two tetrahedra share. Hulls have up to N vertices.
        intersection_volume(a: YawBox3, b: Aabb3) -> number
            Volume that an upright box and an axis-aligned box share.
        intersection_volume(shape: YawBox3, hull: Hull3_8) -> number
            The volume that an upright box and a convex hull share. Hulls have up to N vertices.
        intersection_volume(a: YawBox3, b: Obb3) -> number
            Volume that an upright box and a box of any orientation share.
        intersection_volume(a: YawBox3, b: YawBox3) -> number
            Volume that two upright boxes share.
    """
    @overload
    def __call__(self, a: Aabb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Aabb3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Hull3_8, b: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, hull: Hull3_8, plane: Plane3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb3, plane: Plane3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, solid: Tetrahedron, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, solid: Tetrahedron, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, solid: Tetrahedron, plane: Plane3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Tetrahedron, b: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: YawBox3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

intersection_volume: _intersection_volume

class _inverse(Verb):
    """The pose or rotation back.

    Rows:
        inverse(pose: Pose2) -> Pose2
            The pose of the plane back. Its cosine and sine count by their direction alone.
        inverse(pose: Pose3) -> Pose3
            The pose that moves back.
        inverse(rotation: Rotation3) -> Rotation3
            The rotation that turns back.
    """
    @overload
    def __call__(self, pose: Pose2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Pose2: ...
    @overload
    def __call__(self, pose: Pose3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Pose3: ...
    @overload
    def __call__(self, rotation: Rotation3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Rotation3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

inverse: _inverse

class _iof(Verb):
    """The part of the first shape that lies in the second, 0 to 1.

    Rows:
        iof(a: Aabb2, b: Aabb2) -> number
            The part of the first of two axis-aligned boxes that lies in the second, 0 to 1.
        iof(a: Aabb3, b: Aabb3) -> number
            The part of the first of two axis-aligned boxes that lies in the second, 0 to 1.
        iof(a: Aabb3, b: Obb3) -> number
            The part of the first of an axis-aligned box and a box of any orientation that lies in the second, 0 to 1.
        iof(a: Aabb3, b: YawBox3) -> number
            The part of the first of an axis-aligned box and an upright box that lies in the second, 0 to 1.
        iof(a: ConvexPolygon5, b: ConvexPolygon5) -> number
            The share of the first of two convex polygons of up to N vertices that lies in the second.
        iof(a: Hull3_8, b: Hull3_8) -> number
            The part of the first of two convex hulls that lies in the second, 0 to 1. Hulls have up to N vertices.
        iof(hull: Hull3_8, shape: Obb3) -> number
            The part of the first of a convex hull and a box of any orientation that lies in the second, 0 to 1. Hulls have up to N vertices.
        iof(hull: Hull3_8, plane: Plane3) -> number
            The part of the first of a convex hull and a half-space that lies in the second, 0 to 1. Hulls have up to N vertices.
        iof(a: Obb2, b: Obb2) -> number
            The part of the first of two rotated boxes that lies in the second, 0 to 1.
        iof(a: Obb3, b: Aabb3) -> number
            The part of the first of a box of any orientation and an axis-aligned box that lies in the second, 0 to 1.
        iof(shape: Obb3, hull: Hull3_8) -> number
            The part of the first of a box of any orientation and a convex hull that lies in the second, 0 to 1. Hulls have up to N vertices.
        iof(a: Obb3, b: Obb3) -> number
            The part of the first of two boxes of any orientation that lies in the second, 0 to 1.
        iof(shape: Obb3, plane: Plane3) -> number
            The part of the first of a box of any orientation and a half-space that lies in the second, 0 to 1. Hulls have up to N vertices.
        iof(a: Obb3, b: YawBox3) -> number
            The part of the first of a box of any orientation and an upright box that lies in the second, 0 to 1.
        iof(a: Tetrahedron, b: Tetrahedron) -> number
            The part of the first of two tetrahedra that lies in the second, 0 to 1. Hulls have up to N vertices.
        iof(a: YawBox3, b: Aabb3) -> number
            The part of the first of an upright box and an axis-aligned box that lies in the second, 0 to 1.
        iof(a: YawBox3, b: Obb3) -> number
            The part of the first of an upright box and a box of any orientation that lies in the second, 0 to 1.
        iof(a: YawBox3, b: YawBox3) -> number
            The part of the first of two upright boxes that lies in the second, 0 to 1.
        iof(a: Polygons, b: Polygons) -> number
            The part of the first polygon that lies in the second, 0 to 1.
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: ConvexPolygon5, b: ConvexPolygon5, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Hull3_8, b: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, hull: Hull3_8, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, hull: Hull3_8, plane: Plane3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb3, plane: Plane3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Tetrahedron, b: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Polygons, b: Polygons, /) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

iof: _iof

class _iou(Verb):
    """Intersection over union of two shapes, 0 to 1.

    Rows:
        iou(a: Aabb2, b: Aabb2) -> number
            Intersection over union of two axis-aligned boxes, 0 to 1.
        iou(a: Aabb3, b: Aabb3) -> number
            Intersection over union of two axis-aligned boxes, 0 to 1.
        iou(a: Aabb3, b: Obb3) -> number
            Intersection over union of an axis-aligned box and a box of any orientation, 0 to 1.
        iou(a: Aabb3, b: YawBox3) -> number
            Intersection over union of an axis-aligned box and an upright box, 0 to 1.
        iou(a: ConvexPolygon5, b: ConvexPolygon5) -> number
            The IoU of two convex polygons of up to N vertices.
        iou(a: Hull3_8, b: Hull3_8) -> number
            The intersection over union of two convex hulls, 0 to 1. Hulls have up to N vertices.
        iou(a: Interval, b: Interval) -> number
            Intersection over union of two intervals, 0 to 1.
        iou(a: Obb2, b: Obb2) -> number
            Intersection over union of two rotated boxes, 0 to 1.
        iou(a: Obb3, b: Aabb3) -> number
            Intersection over union of a box of any orientation and an axis-aligned box, 0 to 1.
        iou(shape: Obb3, hull: Hull3_8) -> number
            The intersection over union of a box of any orientation and a convex hull, 0 to 1. Hulls have up to N vertices.
        iou(a: Obb3, b: Obb3) -> number
            Intersection over union of two boxes of any orientation, 0 to 1.
        iou(a: Obb3, b: YawBox3) -> number
            Intersection over union of a box of any orientation and an upright box, 0 to 1.
        iou(solid: Tetrahedron, shape: Obb3) -> number
            The intersection over union of a tetrahedron and a box of any orientation, 0 to 1. Hulls have up to N vertices.
        iou(a: Tetrahedron, b: Tetrahedron) -> number
            The intersection over union of two tetrahedra, 0 to 1. Hulls have up to N vertices.
        iou(a: YawBox3, b: Aabb3) -> number
            Intersection over union of an upright box and an axis-aligned box, 0 to 1.
        iou(a: YawBox3, b: Obb3) -> number
            Intersection over union of an upright box and a box of any orientation, 0 to 1.
        iou(a: YawBox3, b: YawBox3) -> number
            Intersection over union of two upright boxes, 0 to 1.
        iou(a: Polygons, b: Polygons) -> number
            Intersection over union of two polygons, 0 to 1.
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: ConvexPolygon5, b: ConvexPolygon5, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Hull3_8, b: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Interval, b: Interval, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, solid: Tetrahedron, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Tetrahedron, b: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Polygons, b: Polygons, /) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

iou: _iou

class _iou_bev(Verb):
    """Intersection over union of two upright boxes, seen from above, 0 to 1.

    Rows:
        iou_bev(a: YawBox3, b: YawBox3) -> number
    """
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

iou_bev: _iou_bev

class _jeffreys(Verb):
    """The Jeffreys divergence of two rotated boxes as Gaussians whose standard deviations are half the sizes: the sum of the Kullback-Leibler divergences both ways.

    Rows:
        jeffreys(a: Obb2, b: Obb2) -> number
        jeffreys(a: Obb3, b: Obb3) -> number
            The Jeffreys divergence of two boxes of any orientation as Gaussians whose standard deviations are half the sizes: the sum of the Kullback-Leibler divergences both ways.
    """
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

jeffreys: _jeffreys

class _kfiou(Verb):
    """The IoU by a Kalman filter of two rotated boxes as Gaussians whose standard deviations are half the sizes. It is blind to centres and at most 1/3, in space 1/(2^2.5 - 1).

    Rows:
        kfiou(a: Obb2, b: Obb2) -> number
        kfiou(a: Obb3, b: Obb3) -> number
            The IoU by a Kalman filter of two boxes of any orientation as Gaussians whose standard deviations are half the sizes. It is blind to centres and at most 1/3, in space 1/(2^2.5 - 1).
    """
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

kfiou: _kfiou

class _kullback_leibler(Verb):
    """The Kullback-Leibler divergence of two rotated boxes as Gaussians whose standard deviations are half the sizes, from the first one to the second one, whose covariance is inverted.

    Rows:
        kullback_leibler(a: Obb2, b: Obb2) -> number
        kullback_leibler(a: Obb3, b: Obb3) -> number
            The Kullback-Leibler divergence of two boxes of any orientation as Gaussians whose standard deviations are half the sizes, from the first one to the second one, whose covariance is inverted.
    """
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

kullback_leibler: _kullback_leibler

class _left_jacobian(Verb):
    """The left Jacobian of the exponential at a rotation vector, column by column.

    Rows:
        left_jacobian(vector: Vec3) -> Vec3x3
    """
    @overload
    def __call__(self, vector: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3x3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

left_jacobian: _left_jacobian

class _left_jacobian_inverse(Verb):
    """The inverse of the left Jacobian at a rotation vector shorter than 2π, column by column.

    Rows:
        left_jacobian_inverse(vector: Vec3) -> Vec3x3
    """
    @overload
    def __call__(self, vector: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3x3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

left_jacobian_inverse: _left_jacobian_inverse

class _length(Verb):
    """The length of paths.

    Rows:
        length(paths: polyline) -> number
            The length of a polyline: the sum of the distances of neighbouring vertices.
        length(paths: polyline3) -> number
            The length of a polyline of space: the sum of the distances of neighbouring vertices. Edges of length zero have derivative zero.
        length(polygons: Polygons) -> number
            The perimeter of polygons, by its name in shapely.
    """
    @overload
    def __call__(self, paths: Polylines, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, polygons: Polygons, /) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

length: _length

class _length_inside(Verb):
    """The length of a segment that is inside of a shape.

    Rows:
        length_inside(segment: Segment2, shape: Aabb2) -> number
            The length inside of a segment and an axis-aligned box.
        length_inside(segment: Segment2, capsule: Capsule2) -> number
            The length inside of a segment and a capsule.
        length_inside(segment: Segment2, circle: Circle) -> number
            The length inside of a segment and a circle.
        length_inside(segment: Segment2, shape: Obb2) -> number
            The length inside of a segment and a rotated box.
        length_inside(segment: Segment2, triangle: Triangle2) -> number
            The length inside of a segment and a triangle.
        length_inside(segment: Segment2, paths: ring) -> number
            The length of the part of a segment that lies in a ring of either orientation; parts around which the ring winds twice count twice. It jumps where the segment is along an edge.
        length_inside(segment: Segment3, shape: Aabb3) -> number
            The length inside of a segment of space and an axis-aligned box.
        length_inside(segment: Segment3, capsule: Capsule3) -> number
            The length inside of a segment of space and a capsule of space.
        length_inside(segment: Segment3, cone: Cone) -> number
            The length inside of a segment of space and a cone.
        length_inside(segment: Segment3, cylinder: Cylinder) -> number
            The length inside of a segment of space and a cylinder.
        length_inside(segment: Segment3, shape: Obb3) -> number
            The length inside of a segment of space and a box of any orientation.
        length_inside(segment: Segment3, plane: Plane3) -> number
            The length inside of a segment of space and a half-space.
        length_inside(segment: Segment3, shape: RoundBox3) -> number
            The length inside of a segment of space and a box with round edges.
        length_inside(segment: Segment3, ball: Sphere) -> number
            The length inside of a segment of space and a ball.
        length_inside(segment: Segment3, solid: Tetrahedron) -> number
            The length inside of a segment of space and a tetrahedron.
        length_inside(segment: Segment3, shape: YawBox3) -> number
            The length inside of a segment of space and an upright box.
    """
    @overload
    def __call__(self, segment: Segment2, shape: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment2, capsule: Capsule2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment2, circle: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment2, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment2, triangle: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment2, paths: Rings, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, shape: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, capsule: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, cone: Cone, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, cylinder: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, plane: Plane3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, ball: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, solid: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, shape: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

length_inside: _length_inside

class _meeting(Verb):
    """The meeting of two segments.

    Rows:
        meeting(a: Segment2, b: Segment2) -> CommonPart
    """
    @overload
    def __call__(self, a: Segment2, b: Segment2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> CommonPart: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

meeting: _meeting

class _minimum_circle(Verb):
    """The smallest circle around points.

    Rows:
        minimum_circle(polygon: ConvexPolygon6) -> Circle
            The smallest circle around a convex polygon of up to N vertices.
        minimum_circle(points: Paths or Polygons) -> Circle
            The smallest circle around each set of points; NaN for a set without points.
    """
    @overload
    def __call__(self, polygon: ConvexPolygon6, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Circle: ...
    @overload
    def __call__(self, points: Union[Paths, Polygons], /) -> Circle: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

minimum_circle: _minimum_circle

class _minimum_rectangle(Verb):
    """The rectangle of least area around points.

    Rows:
        minimum_rectangle(polygon: ConvexPolygon6) -> Obb2
            The rectangle of least area around a convex polygon of up to N vertices. It jumps where another edge carries a smaller one.
        minimum_rectangle(points: Paths or Polygons) -> Obb2
            The rectangle of least area around each set of points; NaN for points on a line.
    """
    @overload
    def __call__(self, polygon: ConvexPolygon6, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Obb2: ...
    @overload
    def __call__(self, points: Union[Paths, Polygons], /) -> Obb2: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

minimum_rectangle: _minimum_rectangle

class _move(Verb):
    """Shapes, moved by poses.

    Rows:
        move(pose: Pose2, shape: Capsule2) -> Capsule2
            A capsule, moved by a pose.
        move(pose: Pose2, shape: Circle) -> Circle
            A circle, moved by a pose.
        move(pose: Pose2, shape: Line2) -> Line2
            A line, moved by a pose.
        move(pose: Pose2, shape: Obb2) -> Obb2
            A rotated box, moved by a pose. The angle of the pose, of (−π, π, is added to its heading and jumps there.
        move(pose: Pose2, shape: Pose2) -> Pose2
            The pose that applies the second one first, then the first one.
        move(pose: Pose2, shape: Ray2) -> Ray2
            A ray, moved by a pose.
        move(pose: Pose2, segment: Segment2) -> Segment2
            A segment, moved by a pose. The pose's cosine and sine count by their direction alone: the segment keeps its length.
        move(pose: Pose2, shape: Triangle2) -> Triangle2
            A triangle, moved by a pose.
        move(pose: Pose2, shape: Vec2) -> Vec2
            A point, moved by a pose.
        move(pose: Pose3, shape: Capsule3) -> Capsule3
            A capsule of space, moved by a pose.
        move(pose: Pose3, shape: Cone) -> Cone
            A cone, moved by a pose.
        move(pose: Pose3, shape: Cylinder) -> Cylinder
            A cylinder, moved by a pose.
        move(pose: Pose3, shape: Disc) -> Disc
            A disc, moved by a pose.
        move(pose: Pose3, shape: Ellipsoid) -> Ellipsoid
            An ellipsoid, moved by a pose.
        move(pose: Pose3, shape: Line3) -> Line3
            A line of space, moved by a pose.
        move(pose: Pose3, shape: Obb3) -> Obb3
            A box of any orientation, moved by a pose.
        move(pose: Pose3, shape: Plane3) -> Plane3
            A half-space, moved by a pose.
        move(pose: Pose3, shape: Pose3) -> Pose3
            The pose of space that applies the second one first, then the first one.
        move(pose: Pose3, shape: Ray3) -> Ray3
            A ray of space, moved by a pose.
        move(pose: Pose3, shape: RoundBox3) -> RoundBox3
            A box with round edges, moved by a pose.
        move(pose: Pose3, shape: Segment3) -> Segment3
            A segment of space, moved by a pose.
        move(pose: Pose3, shape: Sphere) -> Sphere
            A ball, moved by a pose.
        move(pose: Pose3, shape: Tetrahedron) -> Tetrahedron
            A tetrahedron, moved by a pose.
        move(pose: Pose3, shape: Triangle3) -> Triangle3
            A triangle of space, moved by a pose.
        move(pose: Pose3, shape: Vec3) -> Vec3
            A point, moved by a pose.
        move(a: Rotation3, b: Rotation3) -> Rotation3
            The rotation that turns by the second one first, then by the first one.
        move(rotation: Rotation3, vector: Vec3) -> Vec3
            A vector, turned.
    """
    @overload
    def __call__(self, pose: Pose2, shape: Capsule2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Capsule2: ...
    @overload
    def __call__(self, pose: Pose2, shape: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Circle: ...
    @overload
    def __call__(self, pose: Pose2, shape: Line2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Line2: ...
    @overload
    def __call__(self, pose: Pose2, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Obb2: ...
    @overload
    def __call__(self, pose: Pose2, shape: Pose2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Pose2: ...
    @overload
    def __call__(self, pose: Pose2, shape: Ray2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Ray2: ...
    @overload
    def __call__(self, pose: Pose2, segment: Segment2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Segment2: ...
    @overload
    def __call__(self, pose: Pose2, shape: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Triangle2: ...
    @overload
    def __call__(self, pose: Pose2, shape: Vec2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec2: ...
    @overload
    def __call__(self, pose: Pose3, shape: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Capsule3: ...
    @overload
    def __call__(self, pose: Pose3, shape: Cone, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Cone: ...
    @overload
    def __call__(self, pose: Pose3, shape: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Cylinder: ...
    @overload
    def __call__(self, pose: Pose3, shape: Disc, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Disc: ...
    @overload
    def __call__(self, pose: Pose3, shape: Ellipsoid, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Ellipsoid: ...
    @overload
    def __call__(self, pose: Pose3, shape: Line3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Line3: ...
    @overload
    def __call__(self, pose: Pose3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Obb3: ...
    @overload
    def __call__(self, pose: Pose3, shape: Plane3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Plane3: ...
    @overload
    def __call__(self, pose: Pose3, shape: Pose3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Pose3: ...
    @overload
    def __call__(self, pose: Pose3, shape: Ray3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Ray3: ...
    @overload
    def __call__(self, pose: Pose3, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> RoundBox3: ...
    @overload
    def __call__(self, pose: Pose3, shape: Segment3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Segment3: ...
    @overload
    def __call__(self, pose: Pose3, shape: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Sphere: ...
    @overload
    def __call__(self, pose: Pose3, shape: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Tetrahedron: ...
    @overload
    def __call__(self, pose: Pose3, shape: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Triangle3: ...
    @overload
    def __call__(self, pose: Pose3, shape: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3: ...
    @overload
    def __call__(self, a: Rotation3, b: Rotation3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Rotation3: ...
    @overload
    def __call__(self, rotation: Rotation3, vector: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

move: _move

class _nearest_rotation(Verb):
    """The rotation with the smallest difference from a matrix, given by its columns: its nearest rotation. It jumps where several are nearest.

    Rows:
        nearest_rotation(columns: Vec3x3) -> Rotation3
    """
    @overload
    def __call__(self, columns: Vec3x3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Rotation3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

nearest_rotation: _nearest_rotation

class _penetration(Verb):
    """The depth of overlap of two shapes, and its direction, which jumps to another deepest face.

    Rows:
        penetration(a: Aabb2, b: Aabb2) -> Contact
            The depth of overlap and its direction of two axis-aligned boxes. The direction jumps to another deepest face.
        penetration(a: Aabb3, b: Aabb3) -> Contact3
            The depth of overlap and its direction of two axis-aligned boxes. The direction jumps to another deepest face.
        penetration(a: Capsule2, b: Capsule2) -> Contact
            The depth of overlap and its direction of two capsules. The direction jumps to another deepest face.
        penetration(a: Capsule3, b: Capsule3) -> Contact3
            The depth of overlap and its direction of two capsules of space. The direction jumps to another deepest face.
        penetration(capsule: Capsule3, hull: Hull3_8) -> Contact3
            The depth of overlap and its direction of a capsule of space and a convex hull. Hulls have up to N vertices. The direction jumps to another deepest face.
        penetration(capsule: Capsule3, shape: Obb3) -> Contact3
            The depth of overlap and its direction of a capsule of space and a box of any orientation. The direction jumps to another deepest face.
        penetration(a: Circle, b: Circle) -> Contact
            The depth of overlap and its direction of two circles. The direction jumps to another deepest face.
        penetration(circle: Circle, shape: Obb2) -> Contact
            The depth of overlap and its direction of a circle and a rotated box. The direction jumps to another deepest face.
        penetration(a: Ellipsoid, b: Ellipsoid) -> Contact3
            The depth of overlap and its direction of two ellipsoids. The direction jumps to another deepest face.
        penetration(a: Hull3_8, b: Hull3_8) -> Contact3
            The depth of overlap and its direction of two convex hulls. Hulls have up to N vertices. The direction jumps to another deepest face.
        penetration(a: Obb2, b: Obb2) -> Contact
            The depth of overlap and its direction of two rotated boxes. The direction jumps to another deepest face.
        penetration(shape: Obb3, cylinder: Cylinder) -> Contact3
            The depth of overlap and its direction of a box of any orientation and a cylinder. The direction jumps to another deepest face.
        penetration(shape: Obb3, hull: Hull3_8) -> Contact3
            The depth of overlap and its direction of a box of any orientation and a convex hull. Hulls have up to N vertices. The direction jumps to another deepest face.
        penetration(a: Obb3, b: Obb3) -> Contact3
            The depth of overlap and its direction of two boxes of any orientation. The direction jumps to another deepest face.
        penetration(plane: Plane3, capsule: Capsule3) -> Contact3
            The depth of overlap and its direction of a half-space and a capsule of space. The direction jumps to another deepest face.
        penetration(plane: Plane3, hull: Hull3_8) -> Contact3
            The depth of overlap and its direction of a half-space and a convex hull. Hulls have up to N vertices. The direction jumps to another deepest face.
        penetration(plane: Plane3, shape: Obb3) -> Contact3
            The depth of overlap and its direction of a half-space and a box of any orientation. The direction jumps to another deepest face.
        penetration(shape: RoundBox3, hull: Hull3_8) -> Contact3
            The depth of overlap and its direction of a box with round edges and a convex hull. Hulls have up to N vertices. The direction jumps to another deepest face.
        penetration(ball: Sphere, hull: Hull3_8) -> Contact3
            The depth of overlap and its direction of a ball and a convex hull. Hulls have up to N vertices. The direction jumps to another deepest face.
        penetration(ball: Sphere, shape: Obb3) -> Contact3
            The depth of overlap and its direction of a ball and a box of any orientation. The direction jumps to another deepest face.
        penetration(a: Sphere, b: Sphere) -> Contact3
            The depth of overlap and its direction of two balls. The direction jumps to another deepest face.
        penetration(a: Triangle2, b: Triangle2) -> Contact
            The depth of overlap and its direction of two triangles. The direction jumps to another deepest face.
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact: ...
    @overload
    def __call__(self, a: Aabb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact3: ...
    @overload
    def __call__(self, a: Capsule2, b: Capsule2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact: ...
    @overload
    def __call__(self, a: Capsule3, b: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact3: ...
    @overload
    def __call__(self, capsule: Capsule3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact3: ...
    @overload
    def __call__(self, capsule: Capsule3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact3: ...
    @overload
    def __call__(self, a: Circle, b: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact: ...
    @overload
    def __call__(self, circle: Circle, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact: ...
    @overload
    def __call__(self, a: Ellipsoid, b: Ellipsoid, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact3: ...
    @overload
    def __call__(self, a: Hull3_8, b: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact3: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact: ...
    @overload
    def __call__(self, shape: Obb3, cylinder: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact3: ...
    @overload
    def __call__(self, shape: Obb3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact3: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact3: ...
    @overload
    def __call__(self, plane: Plane3, capsule: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact3: ...
    @overload
    def __call__(self, plane: Plane3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact3: ...
    @overload
    def __call__(self, plane: Plane3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact3: ...
    @overload
    def __call__(self, shape: RoundBox3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact3: ...
    @overload
    def __call__(self, ball: Sphere, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact3: ...
    @overload
    def __call__(self, ball: Sphere, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact3: ...
    @overload
    def __call__(self, a: Sphere, b: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact3: ...
    @overload
    def __call__(self, a: Triangle2, b: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Contact: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

penetration: _penetration

class _perimeter(Verb):
    """The length of the border of shapes of the plane.

    Rows:
        perimeter(shape: Capsule2) -> number
            The perimeter of a capsule.
        perimeter(shape: Circle) -> number
            The perimeter of a circle.
        perimeter(polygon: ConvexPolygon6) -> number
            The perimeter of a convex polygon of up to N vertices. Nothing is searched for.
        perimeter(shape: Triangle2) -> number
            The perimeter of a triangle.
        perimeter(ring: Vec2x4) -> number
            The perimeter of four vertices.
        perimeter(paths: ring) -> number
            The perimeter of a ring.
        perimeter(polygons: Polygons) -> number
            The perimeter of polygons, that of their holes included.
    """
    @overload
    def __call__(self, shape: Capsule2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, polygon: ConvexPolygon6, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ring: Vec2x4, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, paths: Rings, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, polygons: Polygons, /) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

perimeter: _perimeter

class _planes(Verb):
    """The planes of the box's faces with normals outwards, two for each side.

    Rows:
        planes(shape: Obb3) -> Plane3x6
    """
    @overload
    def __call__(self, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Plane3x6: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

planes: _planes

class _pose_at(Verb):
    """The pose that takes a body from its place at time 0 to that at a time.

    Rows:
        pose_at(motion: Motion3, time: number) -> Pose3
    """
    @overload
    def __call__(self, motion: Motion3, time: ArrayLike, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Pose3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

pose_at: _pose_at

class _probiou(Verb):
    """The probabilistic IoU of two rotated boxes as Gaussians of the variance of uniform boxes, size²/12: 0 to 1.

    Rows:
        probiou(a: Obb2, b: Obb2) -> number
        probiou(a: Obb3, b: Obb3) -> number
            The probabilistic IoU of two boxes of any orientation as Gaussians of the variance of uniform boxes, size²/12: 0 to 1.
    """
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

probiou: _probiou

class _project(Verb):
    """The image of a point of a camera's frame, in pixels; `sees` tells which are valid.

    Rows:
        project(point: Vec3, camera: BrownConrady) -> Vec2
            The image of a point of a camera's frame, in pixels. Points that it does not see have one, too; sees tells. The camera has radial and tangential distortion: BrownConrady.
        project(point: Vec3, camera: Fisheye) -> Vec2
            The image of a point of a camera's frame, in pixels. Points that it does not see have one, too; sees tells. The camera sees by the angle to its axis: Fisheye.
        project(point: Vec3, camera: Pinhole) -> Vec2
            The image of a point of a camera's frame, in pixels. Points that it does not see have one, too; sees tells. The camera has no distortion: Pinhole.
    """
    @overload
    def __call__(self, point: Vec3, camera: BrownConrady, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec2: ...
    @overload
    def __call__(self, point: Vec3, camera: Fisheye, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec2: ...
    @overload
    def __call__(self, point: Vec3, camera: Pinhole, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec2: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

project: _project

class _retract(Verb):
    """The rotation after a small turn in the body's frame, a rotation vector in radians.

    Rows:
        retract(rotation: Rotation3, turn: Vec3) -> Rotation3
        retract(pose: Pose3, turn: Vec3, shift: Vec3) -> Pose3
            The pose after a small turn and shift in the body's own frame.
    """
    @overload
    def __call__(self, rotation: Rotation3, turn: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Rotation3: ...
    @overload
    def __call__(self, pose: Pose3, turn: Vec3, shift: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Pose3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

retract: _retract

class _right_jacobian(Verb):
    """The right Jacobian of the exponential at a rotation vector, column by column.

    Rows:
        right_jacobian(vector: Vec3) -> Vec3x3
    """
    @overload
    def __call__(self, vector: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3x3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

right_jacobian: _right_jacobian

class _right_jacobian_inverse(Verb):
    """The inverse of the right Jacobian at a rotation vector shorter than 2π, column by column.

    Rows:
        right_jacobian_inverse(vector: Vec3) -> Vec3x3
    """
    @overload
    def __call__(self, vector: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3x3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

right_jacobian_inverse: _right_jacobian_inverse

class _rotation_vector(Verb):
    """The rotation vector of a rotation, of length 0 to π radians: the logarithm. It jumps at half turns.

    Rows:
        rotation_vector(rotation: Rotation3) -> Vec3
    """
    @overload
    def __call__(self, rotation: Rotation3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

rotation_vector: _rotation_vector

class _screw(Verb):
    """The motion from one pose to another along a screw: a turn about one axis and a shift along it. It jumps at half turns.

    Rows:
        screw(start: Pose3, end: Pose3) -> Motion3
    """
    @overload
    def __call__(self, start: Pose3, end: Pose3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Motion3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

screw: _screw

class _second_moments(Verb):
    """The second moments of areas or of points.

    Rows:
        second_moments(paths: cloud3) -> Symmetric3
            The covariance of points of space, divided by their number; zero without points.
        second_moments(paths: ring) -> AreaMoments
            The second moments of a ring's area about its centroid.
    """
    @overload
    def __call__(self, paths: Clouds, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Symmetric3: ...
    @overload
    def __call__(self, paths: Rings, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> AreaMoments: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

second_moments: _second_moments

class _separation_aware(Verb):
    """The IoU of two boxes with a term for their separation.

    Rows:
        separation_aware(a: Aabb3, b: Aabb3) -> number
            The IoU with a term for separation of two axis-aligned boxes.
        separation_aware(a: Obb2, b: Obb2) -> number
            The IoU with a term for separation of two rotated boxes.
        separation_aware(a: Obb3, b: Obb3) -> number
            The IoU with a term for separation of two boxes of any orientation.
        separation_aware(a: YawBox3, b: YawBox3) -> number
            The IoU with a term for separation of two upright boxes.
    """
    @overload
    def __call__(self, a: Aabb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: YawBox3, b: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

separation_aware: _separation_aware

class _signed_area(Verb):
    """The signed area of shapes of the plane: positive for counter-clockwise corners.

    Rows:
        signed_area(curve: Arc2) -> number
            The signed area between a circular arc and its chord: positive where it runs counter-clockwise.
        signed_area(curve: Cubic2) -> number
            The signed area between a cubic Bézier curve and its chord: positive where it runs counter-clockwise.
        signed_area(curve: Quadratic2) -> number
            The signed area between a quadratic Bézier curve and its chord: positive where it runs counter-clockwise.
        signed_area(shape: Triangle2) -> number
            The signed area of a triangle.
        signed_area(ring: Vec2x4) -> number
            The signed area of four vertices.
        signed_area(paths: ring) -> number
            The signed area of a ring: positive where it turns counter-clockwise.
    """
    @overload
    def __call__(self, curve: Arc2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, curve: Cubic2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, curve: Quadratic2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ring: Vec2x4, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, paths: Rings, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

signed_area: _signed_area

class _signed_distance(Verb):
    """The signed distance of two shapes: negative where they overlap, by how deep.

    Rows:
        signed_distance(a: Aabb2, b: Aabb2) -> number
            The signed distance of two axis-aligned boxes.
        signed_distance(shape: Aabb2, point: Vec2) -> number
            The signed distance of an axis-aligned box and a point.
        signed_distance(a: Aabb3, b: Aabb3) -> number
            The signed distance of two axis-aligned boxes.
        signed_distance(shape: Aabb3, point: Vec3) -> number
            The signed distance of an axis-aligned box and a point.
        signed_distance(a: Capsule2, b: Capsule2) -> number
            The signed distance of two capsules.
        signed_distance(capsule: Capsule2, point: Vec2) -> number
            The signed distance of a capsule and a point.
        signed_distance(a: Capsule3, b: Capsule3) -> number
            The signed distance of two capsules of space.
        signed_distance(capsule: Capsule3, hull: Hull3_8) -> number
            The signed distance of a capsule of space and a convex hull: less than 0 where they overlap, by the least move that parts them. Hulls have up to N vertices.
        signed_distance(capsule: Capsule3, shape: Obb3) -> number
            The signed distance of a capsule of space and a box of any orientation.
        signed_distance(capsule: Capsule3, shape: RoundBox3) -> number
            The signed distance of a capsule of space and a box with round edges.
        signed_distance(capsule: Capsule3, ball: Sphere) -> number
            The signed distance of a capsule of space and a ball.
        signed_distance(capsule: Capsule3, solid: Tetrahedron) -> number
            The signed distance of a capsule of space and a tetrahedron.
        signed_distance(capsule: Capsule3, triangle: Triangle3) -> number
            The signed distance of a capsule of space and a triangle of space.
        signed_distance(a: Circle, b: Circle) -> number
            The signed distance of two circles.
        signed_distance(circle: Circle, shape: Obb2) -> number
            The signed distance of a circle and a rotated box.
        signed_distance(circle: Circle, segment: Segment2) -> number
            The signed distance of a circle and a segment.
        signed_distance(circle: Circle, point: Vec2) -> number
            The signed distance of a circle and a point.
        signed_distance(a: ConvexPolygon5, b: ConvexPolygon5) -> number
            The signed distance of two convex polygons of up to N vertices: less than 0 where they overlap, by the least move that parts them.
        signed_distance(a: Cylinder, b: Cylinder) -> number
            The signed distance of two cylinders: less than 0 where they overlap, by the least move that parts them.
        signed_distance(a: Ellipsoid, b: Ellipsoid) -> number
            The signed distance of two ellipsoids: less than 0 where they overlap, by the least move that parts them.
        signed_distance(hull: Hull3_8, ellipsoid: Ellipsoid) -> number
            The signed distance of a convex hull and an ellipsoid: less than 0 where they overlap, by the least move that parts them. Hulls have up to N vertices.
        signed_distance(a: Hull3_8, b: Hull3_8) -> number
            The signed distance of two convex hulls: less than 0 where they overlap, by the least move that parts them. Hulls have up to N vertices.
        signed_distance(a: Interval, b: Interval) -> number
            The signed distance of two intervals.
        signed_distance(line: Line3, ball: Sphere) -> number
            The signed distance of a line of space and a ball.
        signed_distance(shape: Obb2, circle: Circle) -> number
            The signed distance of a rotated box and a circle.
        signed_distance(a: Obb2, b: Obb2) -> number
            The signed distance of two rotated boxes.
        signed_distance(shape: Obb2, segment: Segment2) -> number
            The signed distance of a rotated box and a segment.
        signed_distance(shape: Obb2, point: Vec2) -> number
            The signed distance of a rotated box and a point.
        signed_distance(shape: Obb3, cylinder: Cylinder) -> number
            The signed distance of a box of any orientation and a cylinder: less than 0 where they overlap, by the least move that parts them.
        signed_distance(shape: Obb3, hull: Hull3_8) -> number
            The signed distance of a box of any orientation and a convex hull: less than 0 where they overlap, by the least move that parts them. Hulls have up to N vertices.
        signed_distance(a: Obb3, b: Obb3) -> number
            The signed distance of two boxes of any orientation.
        signed_distance(a: Obb3, b: RoundBox3) -> number
            The signed distance of a box of any orientation and a box with round edges.
        signed_distance(shape: Obb3, point: Vec3) -> number
            The signed distance of a box of any orientation and a point.
        signed_distance(plane: Plane3, capsule: Capsule3) -> number
            The signed distance of a half-space and a capsule of space.
        signed_distance(plane: Plane3, cone: Cone) -> number
            The signed distance of a half-space and a cone.
        signed_distance(plane: Plane3, cylinder: Cylinder) -> number
            The signed distance of a half-space and a cylinder.
        signed_distance(plane: Plane3, disc: Disc) -> number
            The signed distance of a half-space and a disc.
        signed_distance(plane: Plane3, ellipsoid: Ellipsoid) -> number
            The signed distance of a half-space and an ellipsoid.
        signed_distance(plane: Plane3, hull: Hull3_8) -> number
            The signed distance of a half-space and a convex hull: less than 0 where they overlap, by the least move that parts them. Hulls have up to N vertices.
        signed_distance(plane: Plane3, shape: Obb3) -> number
            The signed distance of a half-space and a box of any orientation.
        signed_distance(plane: Plane3, shape: RoundBox3) -> number
            The signed distance of a half-space and a box with round edges.
        signed_distance(plane: Plane3, segment: Segment3) -> number
            The signed distance of a half-space and a segment of space.
        signed_distance(plane: Plane3, ball: Sphere) -> number
            The signed distance of a half-space and a ball.
        signed_distance(plane: Plane3, solid: Tetrahedron) -> number
            The signed distance of a half-space and a tetrahedron.
        signed_distance(plane: Plane3, triangle: Triangle3) -> number
            The signed distance of a half-space and a triangle of space.
        signed_distance(plane: Plane3, point: Vec3) -> number
            The signed distance of a half-space and a point.
        signed_distance(ray: Ray3, ball: Sphere) -> number
            The signed distance of a ray of space and a ball.
        signed_distance(shape: RoundBox3, hull: Hull3_8) -> number
            The signed distance of a box with round edges and a convex hull: less than 0 where they overlap, by the least move that parts them. Hulls have up to N vertices.
        signed_distance(a: RoundBox3, b: RoundBox3) -> number
            The signed distance of two boxes with round edges.
        signed_distance(segment: Segment2, circle: Circle) -> number
            The signed distance of a segment and a circle.
        signed_distance(segment: Segment2, shape: Obb2) -> number
            The signed distance of a segment and a rotated box.
        signed_distance(segment: Segment2, point: Vec2) -> number
            The signed distance of a segment and a point.
        signed_distance(segment: Segment3, capsule: Capsule3) -> number
            The signed distance of a segment of space and a capsule of space.
        signed_distance(ball: Sphere, cone: Cone) -> number
            The signed distance of a ball and a cone.
        signed_distance(ball: Sphere, cylinder: Cylinder) -> number
            The signed distance of a ball and a cylinder.
        signed_distance(ball: Sphere, hull: Hull3_8) -> number
            The signed distance of a ball and a convex hull: less than 0 where they overlap, by the least move that parts them. Hulls have up to N vertices.
        signed_distance(ball: Sphere, shape: Obb3) -> number
            The signed distance of a ball and a box of any orientation.
        signed_distance(ball: Sphere, shape: RoundBox3) -> number
            The signed distance of a ball and a box with round edges.
        signed_distance(ball: Sphere, segment: Segment3) -> number
            The signed distance of a ball and a segment of space.
        signed_distance(a: Sphere, b: Sphere) -> number
            The signed distance of two balls.
        signed_distance(ball: Sphere, solid: Tetrahedron) -> number
            The signed distance of a ball and a tetrahedron.
        signed_distance(ball: Sphere, triangle: Triangle3) -> number
            The signed distance of a ball and a triangle of space.
        signed_distance(solid: Tetrahedron, disc: Disc) -> number
            The signed distance of a tetrahedron and a disc: less than 0 where they overlap, by the least move that parts them.
        signed_distance(solid: Tetrahedron, hull: Hull3_8) -> number
            The signed distance of a tetrahedron and a convex hull: less than 0 where they overlap, by the least move that parts them. Hulls have up to N vertices.
        signed_distance(solid: Tetrahedron, shape: Obb3) -> number
            The signed distance of a tetrahedron and a box of any orientation.
        signed_distance(solid: Tetrahedron, shape: RoundBox3) -> number
            The signed distance of a tetrahedron and a box with round edges.
        signed_distance(a: Tetrahedron, b: Tetrahedron) -> number
            The signed distance of two tetrahedra.
        signed_distance(a: Triangle2, b: Triangle2) -> number
            The signed distance of two triangles.
        signed_distance(triangle: Triangle2, point: Vec2) -> number
            The signed distance of a triangle and a point.
        signed_distance(triangle: Triangle3, hull: Hull3_8) -> number
            The signed distance of a triangle of space and a convex hull: less than 0 where they overlap, by the least move that parts them. Hulls have up to N vertices.
        signed_distance(a: Triangle3, b: Triangle3) -> number
            The signed distance of two triangles of space.
        signed_distance(point: Vec2, shape: Aabb2) -> number
            The signed distance of a point and an axis-aligned box.
        signed_distance(point: Vec2, capsule: Capsule2) -> number
            The signed distance of a point and a capsule.
        signed_distance(point: Vec2, circle: Circle) -> number
            The signed distance of a point and a circle.
        signed_distance(point: Vec2, polygon: ConvexPolygon6) -> number
            The signed distance of a point from the border of a convex polygon of up to N vertices, less than 0 inside.
        signed_distance(point: Vec2, shape: Obb2) -> number
            The signed distance of a point and a rotated box.
        signed_distance(point: Vec2, segment: Segment2) -> number
            The signed distance of a point and a segment.
        signed_distance(point: Vec2, triangle: Triangle2) -> number
            The signed distance of a point and a triangle.
        signed_distance(point: Vec2, paths: ring) -> number
            The signed distance of a point and a ring: negative inside. Without edges it is the largest finite number.
        signed_distance(point: Vec3, shape: Aabb3) -> number
            The signed distance of a point and an axis-aligned box.
        signed_distance(point: Vec3, capsule: Capsule3) -> number
            The signed distance of a point and a capsule of space.
        signed_distance(point: Vec3, cone: Cone) -> number
            The signed distance of a point and a cone.
        signed_distance(point: Vec3, cylinder: Cylinder) -> number
            The signed distance of a point and a cylinder.
        signed_distance(point: Vec3, hull: Hull3_8) -> number
            The signed distance of a point and a convex hull: less than 0 where they overlap, by the least move that parts them. Hulls have up to N vertices.
        signed_distance(point: Vec3, shape: Obb3) -> number
            The signed distance of a point and a box of any orientation.
        signed_distance(point: Vec3, shape: RoundBox3) -> number
            The signed distance of a point and a box with round edges.
        signed_distance(point: Vec3, ball: Sphere) -> number
            The signed distance of a point and a ball.
        signed_distance(point: Vec3, solid: Tetrahedron) -> number
            The signed distance of a point and a tetrahedron.
        signed_distance(point: Vec3, shape: YawBox3) -> number
            The signed distance of a point and an upright box.
        signed_distance(shape: YawBox3, point: Vec3) -> number
            The signed distance of an upright box and a point.
        signed_distance(point: Vec2, polygons: Polygons) -> number
            The distance of points from the border of polygons: negative inside, positive outside.
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Aabb2, point: Vec2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Aabb3, point: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Capsule2, b: Capsule2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, capsule: Capsule2, point: Vec2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Capsule3, b: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, capsule: Capsule3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, capsule: Capsule3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, capsule: Capsule3, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, capsule: Capsule3, ball: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, capsule: Capsule3, solid: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, capsule: Capsule3, triangle: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Circle, b: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, circle: Circle, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, circle: Circle, segment: Segment2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, circle: Circle, point: Vec2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: ConvexPolygon5, b: ConvexPolygon5, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Cylinder, b: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Ellipsoid, b: Ellipsoid, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, hull: Hull3_8, ellipsoid: Ellipsoid, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Hull3_8, b: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Interval, b: Interval, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, line: Line3, ball: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb2, circle: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb2, segment: Segment2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb2, point: Vec2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb3, cylinder: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb3, point: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, plane: Plane3, capsule: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, plane: Plane3, cone: Cone, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, plane: Plane3, cylinder: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, plane: Plane3, disc: Disc, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, plane: Plane3, ellipsoid: Ellipsoid, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, plane: Plane3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, plane: Plane3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, plane: Plane3, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, plane: Plane3, segment: Segment3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, plane: Plane3, ball: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, plane: Plane3, solid: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, plane: Plane3, triangle: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, plane: Plane3, point: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ray: Ray3, ball: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: RoundBox3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: RoundBox3, b: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment2, circle: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment2, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment2, point: Vec2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, segment: Segment3, capsule: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ball: Sphere, cone: Cone, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ball: Sphere, cylinder: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ball: Sphere, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ball: Sphere, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ball: Sphere, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ball: Sphere, segment: Segment3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Sphere, b: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ball: Sphere, solid: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, ball: Sphere, triangle: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, solid: Tetrahedron, disc: Disc, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, solid: Tetrahedron, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, solid: Tetrahedron, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, solid: Tetrahedron, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Tetrahedron, b: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Triangle2, b: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, triangle: Triangle2, point: Vec2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, triangle: Triangle3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Triangle3, b: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, shape: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, capsule: Capsule2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, circle: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, polygon: ConvexPolygon6, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, segment: Segment2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, triangle: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, paths: Rings, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, shape: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, capsule: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, cone: Cone, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, cylinder: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, hull: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, ball: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, solid: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, shape: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: YawBox3, point: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Union[Vec2, Array], polygons: Polygons, /) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

signed_distance: _signed_distance

class _slant(Verb):
    """The distance of the apex from the rim, in units of length.

    Rows:
        slant(shape: Cone) -> number
    """
    @overload
    def __call__(self, shape: Cone, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

slant: _slant

class _span(Verb):
    """The parameters of entry and exit of a line and a shape.

    Rows:
        span(line: Line2, shape: Aabb2) -> Chord
            The parameters of entry and exit of a line and an axis-aligned box.
        span(line: Line2, capsule: Capsule2) -> Chord
            The parameters of entry and exit of a line and a capsule.
        span(line: Line2, circle: Circle) -> Chord
            The parameters of entry and exit of a line and a circle.
        span(line: Line2, shape: Obb2) -> Chord
            The parameters of entry and exit of a line and a rotated box.
        span(line: Line2, triangle: Triangle2) -> Chord
            The parameters of entry and exit of a line and a triangle.
        span(line: Line3, capsule: Capsule3) -> Chord
            The parameters of entry and exit of a line of space and a capsule of space.
        span(line: Line3, cone: Cone) -> Chord
            The parameters of entry and exit of a line of space and a cone.
        span(line: Line3, cylinder: Cylinder) -> Chord
            The parameters of entry and exit of a line of space and a cylinder.
        span(line: Line3, shape: Obb3) -> Chord
            The parameters of entry and exit of a line of space and a box of any orientation.
        span(line: Line3, plane: Plane3) -> Chord
            The parameters of entry and exit of a line of space and a half-space.
        span(line: Line3, ball: Sphere) -> Chord
            The parameters of entry and exit of a line of space and a ball.
        span(line: Line3, solid: Tetrahedron) -> Chord
            The parameters of entry and exit of a line of space and a tetrahedron.
    """
    @overload
    def __call__(self, line: Line2, shape: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Chord: ...
    @overload
    def __call__(self, line: Line2, capsule: Capsule2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Chord: ...
    @overload
    def __call__(self, line: Line2, circle: Circle, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Chord: ...
    @overload
    def __call__(self, line: Line2, shape: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Chord: ...
    @overload
    def __call__(self, line: Line2, triangle: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Chord: ...
    @overload
    def __call__(self, line: Line3, capsule: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Chord: ...
    @overload
    def __call__(self, line: Line3, cone: Cone, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Chord: ...
    @overload
    def __call__(self, line: Line3, cylinder: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Chord: ...
    @overload
    def __call__(self, line: Line3, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Chord: ...
    @overload
    def __call__(self, line: Line3, plane: Plane3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Chord: ...
    @overload
    def __call__(self, line: Line3, ball: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Chord: ...
    @overload
    def __call__(self, line: Line3, solid: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Chord: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

span: _span

class _squared_angle(Verb):
    """The square of the angle between two rotations, in 0, π².

    Rows:
        squared_angle(a: Rotation3, b: Rotation3) -> number
    """
    @overload
    def __call__(self, a: Rotation3, b: Rotation3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

squared_angle: _squared_angle

class _squared_distance(Verb):
    """The squared distance of two shapes.

    Rows:
        squared_distance(a: Aabb2, b: Aabb2) -> number
            The squared distance of two axis-aligned boxes.
        squared_distance(a: Aabb3, b: Aabb3) -> number
            The squared distance of two axis-aligned boxes.
        squared_distance(a: Obb2, b: Obb2) -> number
            The squared distance of two rotated boxes.
        squared_distance(a: Obb3, b: Obb3) -> number
            The squared distance of two boxes of any orientation.
        squared_distance(a: Segment2, b: Segment2) -> number
            The squared distance of two segments.
        squared_distance(a: Segment3, b: Segment3) -> number
            The squared distance of two segments of space.
        squared_distance(a: Triangle2, b: Triangle2) -> number
            The squared distance of two triangles.
        squared_distance(a: Triangle3, b: Triangle3) -> number
            The squared distance of two triangles of space.
        squared_distance(point: Vec2, segment: Segment2) -> number
            The squared distance of a point and a segment.
        squared_distance(point: Vec2, triangle: Triangle2) -> number
            The squared distance of a point and a triangle.
        squared_distance(point: Vec3, segment: Segment3) -> number
            The squared distance of a point and a segment of space.
        squared_distance(point: Vec3, triangle: Triangle3) -> number
            The squared distance of a point and a triangle of space.
    """
    @overload
    def __call__(self, a: Aabb2, b: Aabb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Aabb3, b: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Segment2, b: Segment2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Segment3, b: Segment3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Triangle2, b: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Triangle3, b: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, segment: Segment2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec2, triangle: Triangle2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, segment: Segment3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, point: Vec3, triangle: Triangle3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

squared_distance: _squared_distance

class _squared_wasserstein(Verb):
    """The squared Wasserstein distance of two rotated boxes as Gaussians whose standard deviations are half the sizes: the square of a length.

    Rows:
        squared_wasserstein(a: Obb2, b: Obb2) -> number
        squared_wasserstein(a: Obb3, b: Obb3) -> number
            The squared Wasserstein distance of two boxes of any orientation as Gaussians whose standard deviations are half the sizes: the square of a length.
    """
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

squared_wasserstein: _squared_wasserstein

class _support(Verb):
    """The farthest point of the ellipsoid in a direction of any length.

    Rows:
        support(shape: Ellipsoid, direction: Vec3) -> Vec3
    """
    @overload
    def __call__(self, shape: Ellipsoid, direction: Vec3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

support: _support

class _surface(Verb):
    """The area of the surface of bodies.

    Rows:
        surface(shape: Aabb3) -> number
            The area of the surface of an axis-aligned box.
        surface(shape: Capsule3) -> number
            The area of the surface of a capsule of space.
        surface(shape: Cone) -> number
            The area of the surface of a cone.
        surface(shape: Cylinder) -> number
            The area of the surface of a cylinder.
        surface(shape: Hull3_8) -> number
            The area of the surface of a convex hull of up to N vertices; of both sides of a flat one.
        surface(shape: Obb3) -> number
            The area of the surface of a box of any orientation.
        surface(shape: RoundBox3) -> number
            The area of the surface of a box with round edges.
        surface(shape: Sphere) -> number
            The area of the surface of a ball.
        surface(shape: Tetrahedron) -> number
            The area of the surface of a tetrahedron.
        surface(shape: YawBox3) -> number
            The area of the surface of an upright box.
    """
    @overload
    def __call__(self, shape: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Cone, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

surface: _surface

class _tangent_to(Verb):
    """The turn and the shift that lead to another pose: the inverse of retract. It jumps at half turns.

    Rows:
        tangent_to(a: Pose3, b: Pose3) -> Vec3, Vec3
        tangent_to(a: Rotation3, b: Rotation3) -> Vec3
            The turn in the body's frame that leads to another rotation, a rotation vector in radians: the inverse of retract. It jumps at half turns.
    """
    @overload
    def __call__(self, a: Pose3, b: Pose3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    @overload
    def __call__(self, a: Rotation3, b: Rotation3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

tangent_to: _tangent_to

class _time_of_impact(Verb):
    """The first touch of two capsules of space in motion. Hulls have up to N vertices. The time of a miss is the largest finite number.

    Rows:
        time_of_impact(a: Capsule3, motion_of_a: Motion3, b: Capsule3, motion_of_b: Motion3) -> Impact3
        time_of_impact(a: Capsule3, motion_of_a: Motion3, b: Obb3, motion_of_b: Motion3) -> Impact3
            The first touch of a capsule of space and a box of any orientation in motion. Hulls have up to N vertices. The time of a miss is the largest finite number.
        time_of_impact(a: Hull3_8, motion_of_a: Motion3, b: Hull3_8, motion_of_b: Motion3) -> Impact3
            The first touch of two convex hulls in motion. Hulls have up to N vertices. The time of a miss is the largest finite number.
        time_of_impact(a: Obb3, motion_of_a: Motion3, b: Obb3, motion_of_b: Motion3) -> Impact3
            The first touch of two boxes of any orientation in motion. Hulls have up to N vertices. The time of a miss is the largest finite number.
        time_of_impact(a: Sphere, motion_of_a: Motion3, b: Obb3, motion_of_b: Motion3) -> Impact3
            The first touch of a ball and a box of any orientation in motion. Hulls have up to N vertices. The time of a miss is the largest finite number.
        time_of_impact(a: Vec3, motion_of_a: Motion3, b: Obb3, motion_of_b: Motion3) -> Impact3
            The first touch of a point and a box of any orientation in motion. Hulls have up to N vertices. The time of a miss is the largest finite number.
    """
    @overload
    def __call__(self, a: Capsule3, motion_of_a: Motion3, b: Capsule3, motion_of_b: Motion3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Impact3: ...
    @overload
    def __call__(self, a: Capsule3, motion_of_a: Motion3, b: Obb3, motion_of_b: Motion3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Impact3: ...
    @overload
    def __call__(self, a: Hull3_8, motion_of_a: Motion3, b: Hull3_8, motion_of_b: Motion3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Impact3: ...
    @overload
    def __call__(self, a: Obb3, motion_of_a: Motion3, b: Obb3, motion_of_b: Motion3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Impact3: ...
    @overload
    def __call__(self, a: Sphere, motion_of_a: Motion3, b: Obb3, motion_of_b: Motion3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Impact3: ...
    @overload
    def __call__(self, a: Vec3, motion_of_a: Motion3, b: Obb3, motion_of_b: Motion3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Impact3: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

time_of_impact: _time_of_impact

class _to_6d(Verb):
    """The first two columns of a rotation's matrix: six coordinates without jumps.

    Rows:
        to_6d(rotation: Rotation3) -> Vec3x2
    """
    @overload
    def __call__(self, rotation: Rotation3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Vec3x2: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

to_6d: _to_6d

class _twist(Verb):
    """The turn, of length 0 to π radians, and the shift of the screw to a pose: the coupled logarithm. It jumps at half turns.

    Rows:
        twist(pose: Pose3) -> Vec3, Vec3
    """
    @overload
    def __call__(self, pose: Pose3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

twist: _twist

class _volume(Verb):
    """The volume of bodies.

    Rows:
        volume(shape: Aabb3) -> number
            The volume of an axis-aligned box.
        volume(shape: Capsule3) -> number
            The volume of a capsule of space.
        volume(shape: Cone) -> number
            The volume of a cone.
        volume(shape: Cylinder) -> number
            The volume of a cylinder.
        volume(shape: Ellipsoid) -> number
            The volume of an ellipsoid.
        volume(shape: Hull3_8) -> number
            The volume of a convex hull of up to N vertices; 0 of a flat one.
        volume(shape: Obb3) -> number
            The volume of a box of any orientation.
        volume(shape: RoundBox3) -> number
            The volume of a box with round edges.
        volume(shape: Sphere) -> number
            The volume of a ball.
        volume(shape: Tetrahedron) -> number
            The volume of a tetrahedron.
        volume(shape: YawBox3) -> number
            The volume of an upright box.
    """
    @overload
    def __call__(self, shape: Aabb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Capsule3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Cone, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Cylinder, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Ellipsoid, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Hull3_8, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: RoundBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Sphere, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: Tetrahedron, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, shape: YawBox3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

volume: _volume

class _wasserstein(Verb):
    """The Wasserstein distance of two rotated boxes as Gaussians whose standard deviations are half the sizes: a length.

    Rows:
        wasserstein(a: Obb2, b: Obb2) -> number
        wasserstein(a: Obb3, b: Obb3) -> number
            The Wasserstein distance of two boxes of any orientation as Gaussians whose standard deviations are half the sizes: a length.
    """
    @overload
    def __call__(self, a: Obb2, b: Obb2, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, a: Obb3, b: Obb3, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

wasserstein: _wasserstein

class _width(Verb):
    """The width of a convex polygon of up to N vertices: the least distance of two parallel lines around it.

    Rows:
        width(polygon: ConvexPolygon6) -> number
        width(points: Paths or Polygons) -> number
            The least distance of two parallel lines around each set of points; NaN for a set without points.
    """
    @overload
    def __call__(self, polygon: ConvexPolygon6, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, points: Union[Paths, Polygons], /) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, Array]: ...

width: _width

class _winding(Verb):
    """The winding number of a ring around a point: a whole number, which jumps at the border and has no derivatives.

    Rows:
        winding(point: Vec2, paths: ring) -> number
    """
    @overload
    def __call__(self, point: Vec2, paths: Rings, /, *, kind: None = ..., to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Array: ...
    @overload
    def __call__(self, *arguments: Any, kind: Kind, to: Kind = ..., out: Out = ..., backend: Backend = ...) -> Any: ...
    def value_grad(self, *arguments: Any, kind: Kind = ..., to: Kind = ..., out: Out = ..., backend: Backend = ..., **named: Any) -> tuple[Array, tuple[Array, ...]]: ...

winding: _winding

hull_centroid: HullMeasure
"""The centre of the volume of convex hulls of points of space, of shape (N, 3); of a flat one of its area.

    The hull is searched exactly. Gradients are those by all points, of the shape of the vertices; points that are no corners
    have derivative zero.

"""

hull_surface: HullMeasure
"""The area of all faces of convex hulls of points of space; of both sides of a flat one.

    The hull is searched exactly. Gradients are those by all points, of the shape of the vertices; points that are no corners
    have derivative zero.

"""

hull_volume: HullMeasure
"""The volume of convex hulls of points of space, in cubed units of length; 0 of flat ones.

    The hull is searched exactly. Gradients are those by all points, of the shape of the vertices; points that are no corners
    have derivative zero.

"""

difference: _Overlay
"""The points in the first of two polygons and not in the second.

    One polygon may stand for all of the other column. ``fill`` says which points of an input are inside: ``"even_odd"``,
    those that an odd number of rings enclose, or ``"nonzero"``. Inputs may cross themselves. Parts of the result run
    counter-clockwise, holes clockwise.

    The vertices of the result are exact to roundings, and have derivatives (``vjp``); edges of it may cross by a rounding
    and parts may meet in points. With ``valid=True`` the result is valid by the OGC's rules, which GEOS and shapely require
    of what they get: vertices are rounded to a grid of the format, within a step of the last digit of the largest
    coordinate. That takes longer for polygons of many vertices.

"""

intersection: _Overlay
"""The points in both of two polygons.

    One polygon may stand for all of the other column. ``fill`` says which points of an input are inside: ``"even_odd"``,
    those that an odd number of rings enclose, or ``"nonzero"``. Inputs may cross themselves. Parts of the result run
    counter-clockwise, holes clockwise.

    The vertices of the result are exact to roundings, and have derivatives (``vjp``); edges of it may cross by a rounding
    and parts may meet in points. With ``valid=True`` the result is valid by the OGC's rules, which GEOS and shapely require
    of what they get: vertices are rounded to a grid of the format, within a step of the last digit of the largest
    coordinate. That takes longer for polygons of many vertices.

"""

minkowski_sum: _Overlay
"""All sums of a point of one polygon and a point of another one: their Minkowski sum.

    One polygon may stand for all of the other column. ``fill`` says which points of an input are inside: ``"even_odd"``,
    those that an odd number of rings enclose, or ``"nonzero"``. Inputs may cross themselves. Parts of the result run
    counter-clockwise, holes clockwise.

    The vertices of the result are exact to roundings, and have derivatives (``vjp``); edges of it may cross by a rounding
    and parts may meet in points. With ``valid=True`` the result is valid by the OGC's rules, which GEOS and shapely require
    of what they get: vertices are rounded to a grid of the format, within a step of the last digit of the largest
    coordinate. That takes longer for polygons of many vertices.

"""

no_fit_polygon: _Overlay
"""All moves of the second polygon by which it touches or overlaps the first one.

    One polygon may stand for all of the other column. ``fill`` says which points of an input are inside: ``"even_odd"``,
    those that an odd number of rings enclose, or ``"nonzero"``. Inputs may cross themselves. Parts of the result run
    counter-clockwise, holes clockwise.

    The vertices of the result are exact to roundings, and have derivatives (``vjp``); edges of it may cross by a rounding
    and parts may meet in points. With ``valid=True`` the result is valid by the OGC's rules, which GEOS and shapely require
    of what they get: vertices are rounded to a grid of the format, within a step of the last digit of the largest
    coordinate. That takes longer for polygons of many vertices.

"""

symmetric_difference: _Overlay
"""The points in exactly one of two polygons.

    One polygon may stand for all of the other column. ``fill`` says which points of an input are inside: ``"even_odd"``,
    those that an odd number of rings enclose, or ``"nonzero"``. Inputs may cross themselves. Parts of the result run
    counter-clockwise, holes clockwise.

    The vertices of the result are exact to roundings, and have derivatives (``vjp``); edges of it may cross by a rounding
    and parts may meet in points. With ``valid=True`` the result is valid by the OGC's rules, which GEOS and shapely require
    of what they get: vertices are rounded to a grid of the format, within a step of the last digit of the largest
    coordinate. That takes longer for polygons of many vertices.

"""

union: _Overlay
"""The points in either of two polygons.

    One polygon may stand for all of the other column. ``fill`` says which points of an input are inside: ``"even_odd"``,
    those that an odd number of rings enclose, or ``"nonzero"``. Inputs may cross themselves. Parts of the result run
    counter-clockwise, holes clockwise.

    The vertices of the result are exact to roundings, and have derivatives (``vjp``); edges of it may cross by a rounding
    and parts may meet in points. With ``valid=True`` the result is valid by the OGC's rules, which GEOS and shapely require
    of what they get: vertices are rounded to a grid of the format, within a step of the last digit of the largest
    coordinate. That takes longer for polygons of many vertices.

"""
