"""Shapes and paths of arrays of shapely geometries or of a ``GeoSeries``, and back.

>>> import shapely, geograd
>>> from geograd.shapely import boxes, geometries, minimum_boxes, rings
>>> squares = [shapely.box(0, 0, 2, 1), shapely.box(1, 0, 3, 1)]
>>> geograd.iou.all_pairs(boxes(squares), boxes(squares)).round(3).tolist()
[[1.0, 0.333], [0.333, 1.0]]
>>> outlines = rings([shapely.Point(0, 0).buffer(1), shapely.Polygon([(0, 0), (4, 0), (4, 2)])])
>>> geograd.distance(geograd.Vec2(5.0, 0.0), outlines).round(6).tolist()
[4.0, 1.0]
>>> f"{geometries(minimum_boxes(shapely.MultiPoint([(0, 0), (2, 0), (1, 1), (3, 1)])))[0].area:.2f}"
'3.00'

Every function takes one geometry, a sequence, an array of objects, a ``GeoSeries`` or a ``GeometryArray``. A missing or
empty geometry raises a ValueError that names its row, and so does one of another type. Coordinates are float64.
"""

from __future__ import annotations

import importlib
import math
from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

import geograd

from . import _outlines

__all__ = [
    "all_rings", "boxes", "geometries", "minimum_boxes", "points", "polylines", "rings", "segments", "series",
    "upright_boxes",
]

# Without types: its stubs are a package of their own.
shapely: Any = importlib.import_module("shapely")
Array = NDArray[Any]

# Numbers that shapely has for the types.
_POINT, _LINE, _RING, _POLYGON, _POLYGONS = 0, 1, 2, 3, 6


def _checked(x: Any, types: Tuple[int, ...], wanted: str) -> Array:
    """Geometries of some types as a flat array, none missing or empty."""
    if isinstance(x, shapely.Geometry):
        x = [x]
    found: Array = np.empty(len(x), object)
    found[:] = np.asarray(x, object) if len(x) else []
    if not len(found):
        return found
    kinds = shapely.get_type_id(found)
    for bad, what in ((kinds == -1, "is missing"), (shapely.is_empty(found), "is empty"), (~np.isin(kinds, types), "")):
        if bad.any():
            row = int(np.flatnonzero(bad)[0])
            raise ValueError(f"geometry {row} {what or 'is a ' + found[row].geom_type}: {wanted} are needed")
    return found


def _has_z(found: Array) -> bool:
    return bool(len(found) and shapely.has_z(found).all())


def points(x: Any) -> Any:
    """Returns ``Vec2`` of points, ``Vec3`` where all have three coordinates."""
    found = _checked(x, (_POINT,), "points")
    has_z = _has_z(found)
    numbers = shapely.get_coordinates(found, include_z=has_z).reshape(len(found), 3 if has_z else 2)
    return geograd.Vec3(numbers) if has_z else geograd.Vec2(numbers)


def segments(x: Any) -> Any:
    """Returns ``Segment2`` of lines of two points, ``Segment3`` where all have three coordinates."""
    found = _checked(x, (_LINE,), "lines of two points")
    counts = shapely.get_num_coordinates(found) if len(found) else np.zeros(0, int)
    if (counts != 2).any():
        row = int(np.flatnonzero(counts != 2)[0])
        raise ValueError(f"geometry {row} has {counts[row]} points: lines of two points are needed")
    has_z = _has_z(found)
    numbers = shapely.get_coordinates(found, include_z=has_z).reshape(len(found), 6 if has_z else 4)
    return geograd.Segment3(numbers) if has_z else geograd.Segment2(numbers)


def _joined(lines: Array, closed: bool, has_z: bool = False) -> Tuple[Array, Array]:
    """The vertices of lines one after another, and their offsets; of closed ones without the last vertex."""
    counts = shapely.get_num_coordinates(lines) if len(lines) else np.zeros(0, np.int64)
    vertices = shapely.get_coordinates(lines, include_z=has_z).reshape(-1, 3 if has_z else 2)
    offsets = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
    return _outlines.opened(vertices, offsets) if closed else (vertices, offsets)


def polylines(x: Any) -> geograd.Polylines:
    """Returns the polylines of lines and rings, of the plane, or of space where all have three coordinates."""
    found = _checked(x, (_LINE, _RING), "lines")
    return geograd.Polylines(*_joined(found, closed=False, has_z=_has_z(found)))


def rings(x: Any) -> geograd.Rings:
    """Returns the rings of polygons of one part without holes, and of rings. :func:`all_rings` takes any polygons."""
    found = _checked(x, (_RING, _POLYGON, _POLYGONS), "polygons and rings")
    if not len(found):
        return geograd.Rings(np.zeros((0, 2)), np.zeros(1, np.int64))
    many = shapely.get_num_geometries(found) > 1
    # A collection of one polygon is that polygon.
    alone = shapely.get_type_id(found) == _POLYGONS
    if alone.any():
        found[alone] = shapely.get_geometry(found[alone], 0)
    holes = shapely.get_num_interior_rings(found) > 0
    for bad, what in ((many, "several parts"), (holes, "holes")):
        if bad.any():
            row = int(np.flatnonzero(bad)[0])
            raise ValueError(f"geometry {row} has {what}: all_rings gives the rings of such polygons, with their rows")
    # The coordinates of a polygon without holes are those of its ring.
    return geograd.Rings(*_joined(found, closed=True))


def all_rings(x: Any) -> Tuple[geograd.Rings, Array]:
    """Returns all rings of polygons with holes and of several parts, and the row of the geometry of each.

    Outer rings turn counter-clockwise, holes clockwise: the signed areas of the rings of a geometry sum to its area.
    """
    found = _checked(x, (_POLYGON, _POLYGONS), "polygons")
    if not len(found):
        return geograd.Rings(np.zeros((0, 2)), np.zeros(1, np.int64)), np.zeros(0, np.int64)
    parts, of = shapely.get_parts(found, return_index=True)
    lines, part = shapely.get_rings(parts, return_index=True)
    # The first ring of a part is the outer one.
    is_outer = np.diff(part, prepend=-1) > 0
    return _outlines.turned(geograd.Rings(*_joined(lines, closed=True)), is_outer), of[part].astype(np.int64)


def upright_boxes(x: Any) -> Any:
    """Returns ``Aabb2`` of the bounds of geometries of any type."""
    found = _checked(x, tuple(range(8)), "geometries")
    return geograd.Aabb2(np.ascontiguousarray(shapely.bounds(found)).reshape(-1, 4))


def boxes(x: Any, tolerance: float = 1e-6) -> Any:
    """Returns ``Obb2`` of polygons that are rectangles: the width lies along the first edge.

    ``tolerance`` is the largest difference from a rectangle, as a share of its longer side.
    """
    found = _checked(x, (_POLYGON,), "rectangles")
    counts = shapely.get_num_coordinates(found) if len(found) else np.zeros(0, int)
    if (counts != 5).any():
        row = int(np.flatnonzero(counts != 5)[0])
        raise ValueError(f"geometry {row} has {counts[row] - 1} corners, not 4; minimum_boxes takes any polygons")
    made, error = _fitted(shapely.get_coordinates(found).reshape(-1, 5, 2)[:, :4])
    bad = error > tolerance * made[:, 2:4].max(1, initial=0)
    if bad.any():
        row = int(np.flatnonzero(bad)[0])
        apart = f"it differs by {error[row]:.2g}"
        raise ValueError(f"geometry {row} is no rectangle: {apart}; minimum_boxes takes any polygons")
    return geograd.Obb2(made)


def _fitted(corners: Array) -> Tuple[Array, Array]:
    """The boxes of four corners in order, and how far the corners are from those of the box."""
    edges = np.roll(corners, -1, axis=1) - corners
    across, down = (edges[:, 0] - edges[:, 2]) / 2, (edges[:, 1] - edges[:, 3]) / 2
    sizes = [np.hypot(*side.T) for side in (across, down)]
    heading = np.where(sizes[0] > 0, np.arctan2(across[:, 1], across[:, 0]), np.arctan2(-down[:, 0], down[:, 1]))
    made = np.column_stack([corners.mean(1), *sizes, heading])
    bent = np.abs(edges[:, 0] + edges[:, 2]).max(1, initial=0)
    along = np.abs((across * down).sum(1)) / np.maximum(np.maximum(*sizes), np.finfo(float).tiny)
    return made, np.maximum(bent, along)


def minimum_boxes(x: Any) -> Any:
    """Returns ``Obb2`` of the smallest rectangles around geometries: the width is the longer side, the heading in
    [-pi/2, pi/2)."""
    found = _checked(x, tuple(range(8)), "geometries")
    if not len(found):
        return geograd.Obb2(np.zeros((0, 5)))
    around = shapely.minimum_rotated_rectangle(found)
    made = np.zeros((len(found), 5))
    kinds = shapely.get_type_id(around)
    # Points and lines have rectangles without an area.
    for kind, count in ((_POINT, 1), (_LINE, 2), (_POLYGON, 5)):
        rows = kinds == kind
        corners = shapely.get_coordinates(around[rows]).reshape(-1, count, 2)
        order = {1: [0, 0, 0, 0], 2: [0, 1, 1, 0], 5: [0, 1, 2, 3]}[count]
        made[rows], _ = _fitted(corners[:, order])
    turned = made[:, 2] < made[:, 3]
    made[turned, 2:4] = made[turned, 3:1:-1]
    made[turned, 4] += math.pi / 2
    made[:, 4] = (made[:, 4] + math.pi / 2) % math.pi - math.pi / 2
    return geograd.Obb2(made)


def geometries(shapes: Any) -> Array:
    """Returns the geometries of shapes or paths, as an array of objects of their leading shape.

    Points and segments become points and lines, rings, boxes, triangles and quadrilaterals polygons, other paths lines.
    """
    if isinstance(shapes, geograd.Paths):
        return _of_paths(shapes)
    if not isinstance(shapes, geograd.Shape):
        raise TypeError(f"geometries are made of shapes and paths of geograd, not of {type(shapes).__name__}")
    kind, array = type(shapes).__name__, np.asarray(shapes.array, np.float64)
    lead, rows = array.shape[:-1], array.reshape(-1, array.shape[-1])
    if kind in ("Vec2", "Vec3"):
        made = shapely.points(rows)
    elif kind in ("Segment2", "Segment3"):
        made = shapely.linestrings(rows.reshape(len(rows), 2, rows.shape[1] // 2))
    elif (corners := _outlines.corners(shapes)) is not None:
        offsets = np.arange(len(corners) + 1) * (corners.shape[1] + 1)
        # The first corner again: a choice of places takes several times as long.
        made = _of_closed(np.concatenate([corners, corners[:, :1]], 1).reshape(-1, 2), offsets)
    else:
        known = "Vec2, Vec3, Segment2, Segment3, Aabb2, Obb2, Triangle2, Vec2x4 and paths"
        raise TypeError(f"{kind} has no geometry: {known} have")
    found: Array = np.asarray(made, object).reshape(lead)
    return found


def _of_closed(vertices: Array, offsets: Array) -> Array:
    """Polygons of one closed ring each."""
    made: Array = shapely.from_ragged_array(shapely.GeometryType.POLYGON, vertices, (offsets, np.arange(len(offsets))))
    return made


def _of_paths(paths: geograd.Paths) -> Array:
    if isinstance(paths, geograd.Rings):
        return _of_closed(*_outlines.closed(paths))
    vertices, offsets = np.asarray(paths.vertices, np.float64), np.asarray(paths.offsets, np.int64)
    if isinstance(paths, geograd.Polylines):
        made = shapely.from_ragged_array(shapely.GeometryType.LINESTRING, vertices, (offsets,))
    else:
        made = shapely.from_ragged_array(shapely.GeometryType.MULTIPOINT, vertices, (offsets,))
    lines: Array = made
    return lines


def series(shapes: Any, index: Any = None, crs: Optional[Any] = None) -> Any:
    """Returns the geometries of shapes or paths as a ``GeoSeries``; GeoPandas is needed."""
    return importlib.import_module("geopandas").GeoSeries(geometries(shapes), index=index, crs=crs)
