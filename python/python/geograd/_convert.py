"""Arrays of numbers of anything: sequences, Arrow columns, geometries of shapely. None of these libraries is imported."""

import sys

import numpy as np

from . import _outlines


def numbers(x, name, kind):
    """An array of float32 or float64 exactly; a TypeError says what is wrong with anything else."""
    library = type(x).__module__.partition(".")[0]
    if library in ("pyarrow", "polars"):
        return numbers(_column(x, name), name, kind)
    if library == "torch" and getattr(x, "requires_grad", False):
        raise TypeError(
            f"`{name}`: the tensor requires a gradient, which NumPy's arrays lose: call geograd.torch's verb of the same name, "
            "or pass tensor.detach()"
        )
    if isinstance(x, np.ma.MaskedArray):
        raise TypeError(f"`{name}`: masked arrays have rows without values; pass those that have: x.compressed() or x[~mask]")
    geometries = _geometries(x)
    if geometries is not None:
        return _coordinates(geometries, name, kind)
    try:
        array = np.asarray(x)
    except ValueError as error:
        raise TypeError(f"`{name}`: {error}") from None
    code = array.dtype.kind
    if code == "f" and array.dtype.itemsize in (4, 8):
        return np.asarray(array, array.dtype.newbyteorder("="))
    if code in "iu":
        return array.astype(np.float64)
    if code == "O" and array.size == 0:
        return array.astype(np.float64)
    what = {
        "O": "an array of objects", "b": "an array of truths", "c": "complex", "U": "text", "S": "bytes",
        "M": "an array of times", "m": "an array of times",
    }.get(code, f"an array of {array.dtype}")
    raise TypeError(f"`{name}`: an array of float32 or float64 is needed, not {what}")


def _column(x, name):
    """The numbers of an Arrow column: lists of a fixed size, structs, or numbers."""
    if hasattr(x, "columns"):
        names = ", ".join(getattr(x, "column_names", x.columns))
        raise TypeError(f"`{name}`: a column is needed, not a table of {names}; geograd.arrow.Apply takes tables")
    if hasattr(x, "to_arrow"):
        x = x.to_arrow()
    if hasattr(x, "combine_chunks"):
        x = x.combine_chunks()
    if getattr(x, "null_count", 0):
        raise ValueError(f"`{name}`: {x.null_count} rows of the column are null")
    kind = str(x.type)
    if kind.startswith("fixed_size_list"):
        size = x.type.list_size
        return x.flatten().to_numpy(zero_copy_only=False).reshape(-1, size)
    if kind.startswith("struct"):
        return np.stack([part.to_numpy(zero_copy_only=False) for part in x.flatten()], axis=-1)
    if kind.startswith(("list", "large_list")):
        raise TypeError(f"`{name}`: a column of lists has rows of any length; cast it to a fixed_size_list")
    return x.to_numpy(zero_copy_only=False)


def _geometries(x):
    """Geometries of shapely as a flat array of objects; None for anything else."""
    shapely = sys.modules.get("shapely")
    if shapely is None:
        return None
    if isinstance(x, shapely.Geometry):
        return np.array([x], dtype=object)
    if isinstance(x, (np.ndarray, list, tuple)) or type(x).__module__.partition(".")[0] in ("geopandas", "pandas"):
        array = np.asarray(x, dtype=object) if not isinstance(x, np.ndarray) else x
        if array.dtype == object and array.ndim == 1 and array.size and isinstance(array[0], shapely.Geometry):
            return array
    return None


def _coordinates(geometries, name, kind):
    """Points, segments, triangles and upright boxes of geometries."""
    shapely = sys.modules["shapely"]
    wanted = {"Vec2": (0, 1), "Segment2": (1, 2)}.get(kind)
    if kind == "Aabb2":
        return np.ascontiguousarray(shapely.bounds(geometries))
    if wanted is None:
        raise TypeError(f"`{name}`: geometries stand for Vec2, Segment2, Aabb2 and paths (geograd.Rings, geograd.Polylines), not {kind}")
    of_type, count = wanted
    counts = shapely.get_num_coordinates(geometries)
    if not ((shapely.get_type_id(geometries) == of_type) & (counts == count)).all():
        raise ValueError(f"`{name}`: a geometry is no {'Point' if of_type == 0 else 'LineString of two points'}")
    return shapely.get_coordinates(geometries).reshape(len(geometries), -1)


def paths(x, name, closed=False, widths=(2,)):
    """Vertices and offsets of lists of vertices, or of geometries: polygons without holes, rings and lines."""
    geometries = _geometries(x) if 2 in widths else None
    if geometries is not None:
        shapely = sys.modules["shapely"]
        types = shapely.get_type_id(geometries)
        if not np.isin(types, [1, 2, 3]).all():
            raise TypeError(f"{name}: polygons, rings and lines are needed; explode multi-part geometries first")
        if (shapely.get_num_interior_rings(geometries) > 0).any():
            raise ValueError(f"{name}: a polygon has holes, and a path is one ring: pass rings one by one, holes apart")
        # The coordinates of a polygon without holes are those of its ring.
        counts = shapely.get_num_coordinates(geometries)
        vertices = shapely.get_coordinates(geometries)
        ends = np.cumsum(counts)
        if closed and (counts > 0).all() and (types != 1).all():
            return _outlines.opened(vertices, np.concatenate([[0], ends]))
        if closed:
            # The last vertex of a ring of shapely is its first.
            keep = np.ones(len(vertices), bool)
            keep[ends[(types != 1) & (counts > 0)] - 1] = False
            counts = counts - ((types != 1) & (counts > 0))
            vertices = vertices[keep]
        return vertices, np.concatenate([[0], np.cumsum(counts)])
    parts = [np.asarray(part) for part in x]
    for i, part in enumerate(parts):
        if part.ndim != 2 or part.shape[1] not in widths:
            wanted = " or ".join(f"(V, {n})" for n in widths)
            raise ValueError(f"{name}: path {i} has vertices of shape {part.shape}, not {wanted}")
        # All of one width, that of the first.
        widths = part.shape[1:]
    vertices = np.concatenate(parts) if parts else np.zeros((0, widths[0]))
    return vertices, np.concatenate([[0], np.cumsum([len(part) for part in parts])]).astype(np.int64)
