"""Distances of polygons from polygons and from shapes of the plane, item by item: 0 where they meet."""

import numpy as np

from . import _convert_polygons, _core

#: Shapes that have a distance from polygons beside points: each with the columns of its vertices, one after the other.
CORNERS = {
    "Aabb2": [0, 1, 2, 1, 2, 3, 0, 3],
    "Triangle2": list(range(6)),
    "Vec2x4": list(range(8)),
    "Obb2": list(range(8)),
    "Segment2": list(range(4)),
    "Capsule2": list(range(4)),
    "Circle": [0, 1],
}
#: Those that are a path of a width: the place of its half.
RADII = {"Capsule2": 4, "Circle": 2}
_KIND = ("Segment2", "Segment2")


class Outline:
    """Edges of a column of polygons or shapes, as places among vertices, and what lies inside of them."""

    def __init__(self, vertices, following, ends, starts, rings, area, radius):
        self.vertices, self.following, self.area, self.radius = vertices, following, area, radius
        #: How many edges there are up to each item, one vertex of each ring, and how many rings there are up to each item.
        self.ends, self.starts, self.rings = ends, starts, rings

    def __len__(self):
        return len(self.ends) - 1

    @classmethod
    def of_polygons(cls, column):
        rings, parts, polygons = column.offsets
        following = np.arange(1, len(column.vertices) + 1)
        following[rings[1:] - 1] = rings[:-1]
        of_item = parts[polygons]
        return cls(column.vertices, following, rings[of_item], rings[:-1], of_item, column, None)

    @classmethod
    def of_shape(cls, shape):
        kind, array = type(shape).__name__, np.asarray(shape.array)
        rows = array.reshape(-1, array.shape[-1])
        if not np.all(_core.valid(kind, np.ascontiguousarray(rows, np.float64))):
            # The library says which item and which number of it is wrong.
            _refused(shape, kind, rows)
        radius = rows[:, RADII[kind]] if kind in RADII else None
        if kind in ("Obb2", "Aabb2", "Triangle2", "Vec2x4"):
            return cls.of_polygons(_convert_polygons.corners_of(_polygons(), shape))
        vertices = np.ascontiguousarray(rows[:, CORNERS[kind]]).reshape(-1, 2)
        size = len(CORNERS[kind]) // 2
        # A segment is one edge, a centre one of no length: the edge from a second end is the same once more.
        following = np.arange(len(vertices)).reshape(-1, size)[:, ::-1].reshape(-1)
        counts = np.arange(len(rows) + 1)
        return cls(vertices, following, counts * size, counts[:-1] * size, counts, None, radius)

    def segments(self, edges):
        """The ends of edges, of shape (E, 4)."""
        return np.concatenate([self.vertices[edges], self.vertices[self.following[edges]]], 1)


def _refused(shape, kind, rows):
    """Raises the error of a shape that is none."""
    import geograd

    geograd.distance(geograd.Vec2(np.zeros(2, rows.dtype)), shape)
    place = int(np.flatnonzero(~np.asarray(_core.valid(kind, np.ascontiguousarray(rows, np.float64))))[0])
    raise ValueError(f"item {place} is no {kind}: {rows[place].tolist()}")


def _polygons():
    import geograd

    return geograd.Polygons


def outline(x):
    """The outline of an argument; None of what has no distance from polygons by its edges."""
    if isinstance(x, _core.Polygons):
        return Outline.of_polygons(x)
    if isinstance(x, _core.Shape):
        return Outline.of_shape(x) if type(x).__name__ in CORNERS else None
    if isinstance(x, _core.Paths) or _convert_polygons.is_geometry(x):
        return Outline.of_polygons(_polygons().of(x))
    return None


def nearest(a, b, count):
    """The nearest edges of two outlines, item by item: distances, infinite without edges, a place of each, whether bounds meet."""
    dtype = np.result_type(a.vertices, b.vertices)
    lists = [(np.ascontiguousarray(own.vertices, dtype), own.following, own.ends) for own in (a, b)]
    return _core.nearest_edges(*lists, count)


def separated(a, b):
    """Distances of two outlines, item by item, and the nearest edge of each where they are apart."""
    from ._polygons import _counted

    counts = len(a), len(b)
    if counts[0] != counts[1] and 1 not in counts:
        raise ValueError(f"`b` has {counts[1]} rows where {counts[0]} are needed, or one, as many as `a`")
    count = _counted(*counts)
    distance, edge_a, edge_b, are_near = nearest(a, b, count)
    is_apart = (distance > 0) & np.isfinite(distance)
    # One holds a part of the other only where their bounds meet.
    asked = np.flatnonzero(is_apart & are_near)
    for area, own in ((a.area, b), (b.area, a)):
        if area is not None and len(asked):
            held = _core.polygons_hold(area, own.vertices[own.starts], own.rings, asked)
            distance[asked[held]] = 0
            is_apart[asked[held]] = False
            asked = asked[~held]
    # As the distance of a point from a polygon without parts.
    distance[np.isinf(distance)] = np.finfo(distance.dtype).max
    edges = distance.copy()
    for own in (a, b):
        if own.radius is not None:
            distance = np.maximum(distance - own.radius, 0)
    is_apart &= distance > 0
    return distance, edges, np.flatnonzero(is_apart), edge_a, edge_b


def pulled(a, b, found, upstream):
    """Cotangents of the vertices and of the radii of both outlines, from those of their distances."""
    import geograd

    _, _, apart, edge_a, edge_b = found
    count = len(found[0])
    pairs = [a.segments(edge_a[apart]), b.segments(edge_b[apart])]
    bars = geograd.distance.vjp(*pairs, upstream[apart], kind=_KIND) if len(apart) else pairs
    made = []
    for own, edges, bar in zip((a, b), (edge_a[apart], edge_b[apart]), bars):
        by_vertices = np.zeros_like(own.vertices)
        np.add.at(by_vertices, edges, bar[:, :2])
        np.add.at(by_vertices, own.following[edges], bar[:, 2:])
        by_radius = None
        if own.radius is not None:
            by_radius = np.zeros_like(own.radius)
            np.add.at(by_radius, np.zeros_like(apart) if len(own) == 1 and count != 1 else apart, -upstream[apart])
        made.append((by_vertices, by_radius))
    return made


def by_numbers(x, by_vertices, by_radius):
    """Cotangents of the numbers of an argument, from those of its vertices and its radius."""
    import geograd

    if not isinstance(x, _core.Shape):
        return by_vertices
    kind, array = type(x).__name__, np.asarray(x.array)
    rows = by_vertices.reshape(-1, len(CORNERS[kind]))
    if kind == "Obb2":
        return geograd.corners.vjp(geograd.Obb2(array), geograd.Vec2x4(rows.reshape(*array.shape[:-1], 8)).array)
    made = np.zeros((len(rows), array.shape[-1]), rows.dtype)
    for place, column in enumerate(CORNERS[kind]):
        made[:, column] += rows[:, place]
    if by_radius is not None:
        made[:, RADII[kind]] = by_radius
    return made.reshape(array.shape)


def distance(form, first, second, upstream=None):
    """The distance of polygons from polygons or a shape in a form: value, value_grad or vjp."""
    from ._polygons import _cotangents

    if form == "value" and isinstance(first, _core.Polygons) and isinstance(second, _core.Polygons):
        return _core.polygons_apart(first, second)
    own = [outline(first), outline(second)]
    for x, found in zip((first, second), own):
        if found is None:
            raise TypeError(f"geograd.distance of Polygons takes points, Polygons, {', '.join(CORNERS)}, not {type(x).__name__}")
    dtype = np.result_type(*[x.vertices for x in own])
    for x in own:
        x.vertices = x.vertices.astype(dtype, copy=False)
    found = separated(*own)
    if form == "value":
        return found[0]
    upstream = _cotangents(1 if upstream is None else upstream, len(found[0]), dtype)
    bars = tuple(by_numbers(x, *bar) for x, bar in zip((first, second), pulled(*own, found, upstream)))
    return bars if form == "vjp" else (found[0], bars)
