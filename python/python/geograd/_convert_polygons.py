"""Polygons of lists, geometries, corners of shapes and columns of Arrow. None of these libraries is imported before."""

import sys

import numpy as np


def is_geometry(x):
    """Whether something is a geometry of shapely, an array of such, or a GeoSeries."""
    shapely = sys.modules.get("shapely")
    if shapely is None:
        return False
    if hasattr(x, "geom_type"):
        return True
    return isinstance(x, np.ndarray) and x.dtype == object and x.size > 0 and isinstance(x.flat[0], shapely.Geometry)


def _ring(ring, place):
    own = np.asarray(ring)
    if own.ndim != 2 or own.shape[1] != 2 or own.dtype.kind not in "fiu":
        raise ValueError(f"polygon {place}: a ring has vertices of shape {own.shape}, not (V, 2)")
    is_closed = len(own) > 3 and (own[0] == own[-1]).all()
    return own[:-1] if is_closed else own


def parts_of(item, place):
    """The rings of every part of an item of a list."""
    depth, inner = 0, item
    while not np.isscalar(inner) and getattr(inner, "ndim", 1):
        if len(inner) == 0:
            if depth > 0:
                raise ValueError(f"polygon {place}: a ring or a part is empty")
            return []
        depth, inner = depth + 1, inner[0]
    nested = {2: [[item]], 3: [item], 4: item}.get(depth)
    if nested is None:
        raise ValueError(f"polygon {place}: a ring of shape (V, 2), a list of rings, or a list of lists of rings is needed")
    return [[_ring(ring, place) for ring in part] for part in nested]


def of_corners(cls, shape):
    """Polygons of the corners of shapes."""
    import geograd

    kind = type(shape).__name__
    if kind == "Obb2":
        corners = geograd.corners(shape).array
    elif kind == "Aabb2":
        corners = np.asarray(shape)[..., [0, 1, 2, 1, 2, 3, 0, 3]]
    elif kind in ("Vec2x4", "Triangle2"):
        corners = np.asarray(shape)
    else:
        raise TypeError(f"Polygons.of takes Obb2, Aabb2, Vec2x4 and Triangle2, not {kind}")
    size = corners.shape[-1] // 2
    vertices = corners.reshape(-1, 2)
    return cls(vertices, (np.arange(0, len(vertices) + 1, size),))


def multipolygons(storage):
    """The extension type of GeoArrow for multipolygons."""
    import pyarrow as pa

    class MultiPolygons(pa.ExtensionType):
        def __init__(self):
            super().__init__(storage, "geoarrow.multipolygon")

        def __arrow_ext_serialize__(self):
            return b"{}"

    return MultiPolygons()


def from_arrow(cls, column):
    import pyarrow as pa

    if hasattr(column, "to_arrow"):
        column = column.to_arrow()
    if isinstance(column, pa.ChunkedArray):
        column = column.combine_chunks()
    if column.null_count:
        raise ValueError(f"the column has {column.null_count} rows without a polygon")
    name = getattr(column.type, "extension_name", "")
    column = getattr(column, "storage", column)
    if pa.types.is_binary(column.type) or pa.types.is_large_binary(column.type):
        import shapely

        return cls.from_shapely(shapely.from_wkb(column.to_numpy(zero_copy_only=False)))
    lists = []
    while pa.types.is_list(column.type) or pa.types.is_large_list(column.type):
        offsets = column.offsets.to_numpy()
        lists.append(offsets - offsets[0])
        column = column.values.slice(offsets[0], offsets[-1] - offsets[0])
    if len(lists) not in (2, 3):
        raise TypeError(f"lists of rings or of parts are needed, not {name or column.type} under {len(lists)} lists")
    if pa.types.is_struct(column.type):
        lanes = [column.field(place).to_numpy(zero_copy_only=False) for place in map(column.type.get_field_index, ("x", "y"))]
        vertices = np.stack(lanes, -1)
    elif pa.types.is_fixed_size_list(column.type):
        vertices = column.flatten().to_numpy(zero_copy_only=False).reshape(len(column), -1)[:, :2]
    else:
        raise TypeError(f"vertices are structs of x and y or lists of numbers, not {column.type}")
    polygons = lists[0] if len(lists) == 3 else np.arange(len(lists[0]))
    parts, rings = lists[-2:]
    # GeoArrow repeats the first vertex of a ring at its end.
    ends = rings[1:][np.diff(rings) > 0] - 1
    keep = np.ones(len(vertices), bool)
    keep[ends] = False
    counts = np.maximum(np.diff(rings) - 1, 0)
    # An empty polygon is a part without rings there, and a polygon without parts here.
    full = np.diff(parts) > 0
    polygons = np.concatenate([[0], np.cumsum(full)])[polygons]
    parts = parts[np.concatenate([[True], full])]
    return cls(vertices[keep], (np.concatenate([[0], np.cumsum(counts)]), parts, polygons))
