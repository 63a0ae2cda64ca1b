"""Shapes and paths of GeoArrow's columns, and back: geometries of GeoPandas and Parquet without objects of Python.

>>> import numpy as np, geograd
>>> from geograd.geoarrow import all_rings, rings, table
>>> squares = geograd.Aabb2(np.array([[0.0, 0.0, 2.0, 1.0], [5.0, 0.0, 6.0, 3.0]]))
>>> column = table(squares, crs="EPSG:3857").column("geometry")
>>> geograd.signed_area(rings(column)).tolist()
[2.0, 3.0]

A column is an array of Arrow, a chunked array, or anything with Arrow's interface for C, of interleaved coordinates or
of ``x`` and ``y`` apart. A row that is null raises a ValueError that names it. Points are read without a copy where
they are interleaved. Columns of WKB have to be decoded first: ``GeoSeries.to_arrow(geometry_encoding="geoarrow")``
writes GeoArrow.
"""

from __future__ import annotations

import importlib
import json
from typing import Any, List, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

import geograd

from . import _outlines

__all__ = ["all_rings", "points", "polylines", "rings", "table"]

# Without types: its stubs are a package of their own.
pa: Any = importlib.import_module("pyarrow")
_arrow: Any = importlib.import_module("geograd.arrow")

Array = NDArray[Any]


def _is_list(kind: Any) -> bool:
    return bool(pa.types.is_list(kind) or pa.types.is_large_list(kind))


def _levels(column: Any, wanted: Tuple[int, ...], what: str) -> Tuple[List[Array], Array]:
    """The offsets of nested lists from the outside in, each from 0, and the coordinates of all vertices."""
    column = _arrow._plain(column)
    if column.null_count:
        row = int(np.flatnonzero(column.is_null().to_numpy(zero_copy_only=False))[0])
        raise ValueError(f"geometry {row} is null ({column.null_count} of {len(column)} are)")
    found, kind = [], column.type
    while _is_list(kind):
        kind = kind.value_type
        found.append(kind)
    is_coordinates = pa.types.is_fixed_size_list(kind) or pa.types.is_struct(kind)
    if len(found) not in wanted or not is_coordinates:
        raise TypeError(f"a column of {what} of GeoArrow is needed, not of {column.type}")
    offsets = []
    for _ in found:
        own = np.asarray(column.offsets, np.int64)
        column = column.values.slice(own[0], own[-1] - own[0])
        offsets.append(own - own[0])
    if pa.types.is_struct(kind):
        parts = [column.field(i).to_numpy(zero_copy_only=False) for i in range(kind.num_fields)]
        return offsets, np.stack(parts[:3], -1).astype(np.float64, copy=False)
    numbers = column.flatten().to_numpy(zero_copy_only=False)
    return offsets, numbers.reshape(-1, kind.list_size)


def points(column: Any) -> Any:
    """Returns ``Vec2`` of a column of points, ``Vec3`` of points with three coordinates."""
    _, numbers = _levels(column, (0,), "points")
    return geograd.Vec3(numbers) if numbers.shape[1] == 3 else geograd.Vec2(numbers)


def polylines(column: Any) -> geograd.Polylines:
    """Returns the polylines of a column of lines."""
    (offsets,), vertices = _levels(column, (1,), "lines")
    return geograd.Polylines(vertices, offsets)


def rings(column: Any) -> geograd.Rings:
    """Returns the rings of a column of polygons of one part without holes. :func:`all_rings` takes any polygons."""
    (*outer, inner), vertices = _levels(column, (2, 3), "polygons")
    for offsets, what in zip(outer, ("holes",) if len(outer) == 1 else ("several parts", "holes")):
        counts = np.diff(offsets)
        if (counts != 1).any():
            row = int(np.flatnonzero(counts != 1)[0])
            what = what if counts[row] > 1 else "no ring"
            raise ValueError(f"geometry {row} has {what}: all_rings gives the rings of any polygons, with their rows")
    return geograd.Rings(*_outlines.opened(vertices[:, :2], inner))


def all_rings(column: Any) -> Tuple[geograd.Rings, Array]:
    """Returns all rings of a column of polygons, holes and parts included, and the row of the geometry of each.

    Outer rings turn counter-clockwise, holes clockwise: the signed areas of the rings of a geometry sum to its area.
    """
    (*outer, inner), vertices = _levels(column, (2, 3), "polygons")
    of_polygon = np.repeat(np.arange(len(outer[-1]) - 1), np.diff(outer[-1]))
    rows = of_polygon
    if len(outer) == 2:
        rows = np.repeat(np.arange(len(outer[0]) - 1), np.diff(outer[0]))[of_polygon]
    is_outer = np.diff(of_polygon, prepend=-1) > 0
    made = geograd.Rings(*_outlines.opened(vertices[:, :2], inner))
    return _outlines.turned(made, is_outer), rows.astype(np.int64)


def _nested(vertices: Array, levels: List[Array]) -> Any:
    """A column of lists of lists of coordinates."""
    numbers = pa.array(np.ascontiguousarray(vertices).reshape(-1))
    names = "xy" if vertices.shape[1] == 2 else "xyz"
    kind = pa.list_(pa.field(names, pa.float64(), nullable=False), vertices.shape[1])
    made = pa.FixedSizeListArray.from_arrays(numbers, type=kind)
    names_of_levels = ["vertices", "rings"] if len(levels) == 2 else ["vertices"]
    for offsets, name in zip(reversed(levels), names_of_levels):
        kind = pa.list_(pa.field(name, made.type, nullable=False))
        made = pa.ListArray.from_arrays(pa.array(offsets.astype(np.int32)), made, type=kind)
    return made


def table(shapes: Any, name: str = "geometry", crs: Optional[Any] = None) -> Any:
    """Returns shapes or paths as a table of one column of GeoArrow, which ``GeoDataFrame.from_arrow`` reads.

    Points, lines and polygons are made as :func:`geograd.shapely.geometries` makes them. ``crs`` is a code such as
    ``"EPSG:3857"``, or a dict of PROJJSON.
    """
    kind = type(shapes).__name__
    if isinstance(shapes, geograd.Rings):
        vertices, offsets = _outlines.closed(shapes)
        levels, extension = [np.arange(len(offsets)), offsets], "polygon"
    elif isinstance(shapes, geograd.Polylines):
        vertices, offsets = np.asarray(shapes.vertices, np.float64), np.asarray(shapes.offsets)
        levels, extension = [offsets], "linestring"
    elif kind in ("Vec2", "Vec3"):
        vertices, levels, extension = np.asarray(shapes.array, np.float64).reshape(-1, int(kind[-1])), [], "point"
    elif kind in ("Segment2", "Segment3"):
        vertices = np.asarray(shapes.array, np.float64).reshape(-1, int(kind[-1]))
        levels, extension = [np.arange(0, len(vertices) + 1, 2)], "linestring"
    elif isinstance(shapes, geograd.Shape) and (corners := _outlines.corners(shapes)) is not None:
        count, own = corners.shape[:2]
        outlines = geograd.Rings(corners.reshape(-1, 2), np.arange(count + 1) * own)
        vertices, offsets = _outlines.closed(outlines)
        levels, extension = [np.arange(len(offsets)), offsets], "polygon"
    else:
        raise TypeError(f"{kind} has no geometry: points, segments, boxes, triangles, rings and polylines have")
    metadata = {"ARROW:extension:name": f"geoarrow.{extension}"}
    if crs is not None:
        of = {"crs": crs, "crs_type": "authority_code" if isinstance(crs, str) else "projjson"}
        metadata["ARROW:extension:metadata"] = json.dumps(of)
    column = _nested(vertices, levels)
    return pa.table([column], schema=pa.schema([pa.field(name, column.type, metadata=metadata)]))
