"""Columns of polygons with holes and parts, and what is computed of them, item by item."""

import numpy as np

from . import _convert_polygons, _core, _outlines, _points, _separation

#: The verbs that take polygons: what each takes, and what it gives.
VERBS = {
    "area": ("polygons: Polygons", "number"),
    "centroid": ("polygons: Polygons", "Vec2"),
    "depth": ("point: Vec2, polygons: Polygons", "number"),
    "distance": ("point: Vec2, polygons: Polygons", "number"),
    "intersection_area": ("a: Polygons, b: Polygons", "number"),
    "iof": ("a: Polygons, b: Polygons", "number"),
    "iou": ("a: Polygons, b: Polygons", "number"),
    "length": ("polygons: Polygons", "number"),
    "perimeter": ("polygons: Polygons", "number"),
    "signed_distance": ("point: Vec2, polygons: Polygons", "number"),
}
#: Further rows of them: what each takes, and a summary.
FURTHER = {
    "distance": [
        ("a: Polygons, b: Polygons", "The distance of two polygons: 0 where they meet, with derivative zero."),
        ("shape: Aabb2, Capsule2, Circle, Obb2, Segment2, Triangle2 or Vec2x4, polygons: Polygons", "The same of a shape."),
    ]
}
SUMMARIES = {
    "area": "The area of polygons: holes do not count.",
    "centroid": "The centroid of the area of polygons; the mean of the vertices where the area is zero.",
    "depth": "The distance of points from the border of polygons: positive inside, negative outside.",
    "distance": "The distance of points from the area of polygons: 0 inside, with derivative zero.",
    "intersection_area": "The area that two polygons share.",
    "iof": "The part of the first polygon that lies in the second, 0 to 1.",
    "iou": "Intersection over union of two polygons, 0 to 1.",
    "length": "The perimeter of polygons, by its name in shapely.",
    "perimeter": "The perimeter of polygons, that of their holes included.",
    "signed_distance": "The distance of points from the border of polygons: negative inside, positive outside.",
}
MEASURES = ("area", "centroid", "length", "perimeter")
OVERLAPS = ("intersection_area", "iof", "iou", "union_area")
DISTANCES = ("depth", "distance", "signed_distance")


class Polygons(_core.Polygons):
    """A column of polygons, each of parts with holes.

    ``vertices`` has the vertices of all rings, of shape (V, 2). ``offsets`` are three lists: where each ring starts among
    the vertices, each part among the rings, each polygon among the parts; the last number of each is the count of these.
    The first ring of a part bounds it, the others are its holes. The last vertex of a ring is joined with its first one,
    which is not repeated. Both arrays are those of ``shapely.to_ragged_array`` but for the repeated vertices.

    Rings turn either way. Points that an odd number of rings enclose are inside. Coordinates are finite, and every
    ring has three distinct vertices. A column does not change.

    Areas, centroids and overlaps (``iou``, ``iof``, ``intersection_area``, ``union_area``) take rings that do not cross;
    ``make_valid`` gives such. The time of an overlap grows with the product of both numbers of vertices.

    >>> square = [(0, 0), (4, 0), (4, 4), (0, 4)]
    >>> hole = [(1, 1), (2, 1), (2, 2), (1, 2)]
    >>> geograd.area(geograd.Polygons.of([square, [square, hole]]))
    array([16., 15.])
    """

    __slots__ = ()
    __module__ = "geograd"

    def __new__(cls, vertices, offsets=None):
        if offsets is None and isinstance(vertices, _core.Polygons):
            return super().__new__(cls, vertices)
        lists = list(offsets if offsets is not None else ())
        if not 1 <= len(lists) <= 3:
            raise ValueError(f"offsets: one to three lists are needed (of rings, parts, polygons), not {len(lists)}")
        # A list that is left out has one of the former in each of its own.
        while len(lists) < 3:
            lists.append(np.arange(len(lists[-1])))
        return super().__new__(cls, vertices, lists)

    @classmethod
    def of(cls, polygons):
        """Polygons of a list, of geometries, of rings or of boxes.

        An item of a list is a ring, of shape (V, 2); or a list of rings, the border and its holes; or a list of such
        lists, the parts; or a geometry. The last vertex of a ring may repeat the first one. Rings and shapes with
        corners (boxes, triangles, quadrilaterals) are polygons without holes.
        """
        if isinstance(polygons, _core.Polygons):
            return polygons
        if isinstance(polygons, _core.Paths):
            return cls(polygons.vertices, (polygons.offsets,))
        if isinstance(polygons, _core.Shape):
            return _convert_polygons.corners_of(cls, polygons)
        if _convert_polygons.is_geometry(polygons):
            return cls.from_shapely(polygons)
        items = list(polygons)
        if items and _convert_polygons.is_geometry(items[0]):
            return cls.from_shapely(np.array(items, object))
        vertices, rings, parts, ends = [], [0], [0], [0]
        for place, item in enumerate(items):
            for part in _convert_polygons.parts_of(item, place):
                for ring in part:
                    vertices.append(ring)
                    rings.append(rings[-1] + len(ring))
                parts.append(parts[-1] + len(part))
            ends.append(len(parts) - 1)
        whole = np.concatenate(vertices) if vertices else np.zeros((0, 2))
        return cls(whole, (rings, parts, ends))

    @classmethod
    def from_shapely(cls, geometries):
        """Polygons of an array of shapely's polygons and multipolygons, or of a GeoSeries; without their third coordinate."""
        import shapely

        geometries = np.atleast_1d(np.asarray(getattr(geometries, "values", geometries), object))
        types = shapely.get_type_id(geometries)
        wrong = ~np.isin(types, [3, 6])
        if wrong.any():
            place = int(np.flatnonzero(wrong)[0])
            what = "missing" if types[place] < 0 else f"a {geometries[place].geom_type}"
            raise TypeError(f"geometry {place}: a Polygon or a MultiPolygon is needed, and it is {what}")
        if (types == 3).all() and not (shapely.get_num_interior_rings(geometries) > 0).any():
            # The coordinates of a polygon without holes are those of its one ring.
            counts = shapely.get_num_coordinates(geometries)
            full = counts > 0
            ends = np.concatenate([[0], np.cumsum(counts[full])])
            vertices, rings = _outlines.opened(shapely.get_coordinates(geometries), ends)
            return cls(vertices, (rings, np.arange(len(rings)), np.concatenate([[0], np.cumsum(full)])))
        parts, of = shapely.get_parts(geometries, return_index=True)
        full = ~shapely.is_empty(parts)
        parts, of = parts[full], of[full]
        polygons = np.concatenate([[0], np.cumsum(np.bincount(of, minlength=len(geometries)))])
        rings, of_part = shapely.get_rings(parts, return_index=True)
        ends = np.concatenate([[0], np.cumsum(np.bincount(of_part, minlength=len(parts)))])
        counts = shapely.get_num_coordinates(rings)
        vertices = shapely.get_coordinates(rings)
        # The last vertex of a ring of shapely is its first.
        vertices, offsets = _outlines.opened(vertices, np.concatenate([[0], np.cumsum(counts)]))
        return cls(vertices, (offsets, ends, polygons))

    def to_shapely(self):
        """An array of shapely's geometries: of a polygon of one part a Polygon, of any other a MultiPolygon."""
        import shapely

        _, parts, polygons = self.offsets
        counts = np.diff(polygons)
        one = counts == 1
        of_parts = np.zeros(0, object)
        if len(parts) > 1:
            # Shapely takes longer to close rings.
            vertices, rings = self._closed()
            of_parts = shapely.from_ragged_array(shapely.GeometryType.POLYGON, vertices, (rings, parts))
        if len(of_parts) and one.all():
            return of_parts
        made = np.full(len(self), shapely.MultiPolygon(), object)
        made[one] = of_parts[polygons[:-1][one]]
        of_many = np.repeat(~one, counts)
        if of_many.any():
            shapely.multipolygons(of_parts[of_many], indices=np.repeat(np.arange(len(self)), counts)[of_many], out=made)
        return made

    @classmethod
    def from_arrow(cls, column):
        """Polygons of a GeoArrow column (``geoarrow.polygon``, ``geoarrow.multipolygon``, ``geoarrow.wkb``), with x and y in
        structs or in lists."""
        return _convert_polygons.from_arrow(cls, column)

    def to_arrow(self):
        """A GeoArrow column of the type ``geoarrow.multipolygon``: lists of parts of rings of structs of x and y."""
        import pyarrow as pa

        (vertices, rings), (_, parts, polygons) = self._closed(), self.offsets
        made = pa.StructArray.from_arrays([pa.array(np.ascontiguousarray(lane)) for lane in vertices.T], ["x", "y"])
        for offsets, name in ((rings, "vertices"), (parts, "rings"), (polygons, "polygons")):
            is_large = offsets[-1] > 2**31 - 1
            of, list_of = (pa.LargeListArray, pa.large_list) if is_large else (pa.ListArray, pa.list_)
            offsets = pa.array(offsets, pa.int64() if is_large else pa.int32())
            made = of.from_arrays(offsets, made, type=list_of(pa.field(name, made.type, nullable=False)))
        return pa.ExtensionArray.from_storage(_convert_polygons.multipolygons(made.type), made)

    def __arrow_c_array__(self, requested_schema=None):
        return self.to_arrow().__arrow_c_array__(requested_schema)

    @classmethod
    def concatenate(cls, columns):
        """The polygons of several columns, one after the other."""
        return cls(_core.joined_polygons([cls.of(own) for own in columns]))

    def union_all(self, *, valid=False):
        """The union of all polygons of the column, a column of one; ``valid`` as in :func:`geograd.union`."""
        return type(self)(_core.polygon_union_all(self, valid))

    def make_valid(self, *, fill="even_odd"):
        """The same areas as polygons that are valid by the OGC's rules: rings do not cross, holes lie in their part."""
        nothing = Polygons(np.zeros((0, 2), self.vertices.dtype), ([0], [0], [0, 0]))
        return type(self)(_core.polygon_overlay("union", self, nothing, fill, True, False)[0])

    def buffer(self, distance, **style):
        """The polygons grown or shrunk by a distance: see :func:`geograd.buffer`."""
        import geograd

        return geograd.buffer(self, distance, **style)

    def tolist(self):
        """The polygons as lists of parts, each a list of rings of shape (V, 2)."""
        rings, parts, polygons = self.offsets
        of_ring = [self.vertices[low:high] for low, high in zip(rings, rings[1:])]
        of_part = [of_ring[low:high] for low, high in zip(parts, parts[1:])]
        return [of_part[low:high] for low, high in zip(polygons, polygons[1:])]

    @property
    def bounds(self):
        """The smallest axis-aligned box around each polygon, an ``Aabb2``; NaN for a polygon without parts."""
        import geograd

        rings, parts, polygons = self.offsets
        starts = rings[parts[polygons]]
        made = np.full((len(self), 4), np.nan, self.vertices.dtype)
        full = starts[:-1] < starts[1:]
        if full.any():
            made[full, :2] = np.minimum.reduceat(self.vertices, starts[:-1][full])
            made[full, 2:] = np.maximum.reduceat(self.vertices, starts[:-1][full])
        return geograd.Aabb2(made)

    def __getitem__(self, key):
        if isinstance(key, (int, np.integer)):
            place = int(key) + len(self) * (key < 0)
            if not 0 <= place < len(self):
                raise IndexError(f"polygon {key} of {len(self)}")
            items = [place]
        else:
            items = np.arange(len(self))[key]
            if items.ndim != 1:
                raise IndexError("a place, a slice, or a list of places or truths is needed")
            items = items.tolist()
        return type(self)(self._chosen(items))

    def __iter__(self):
        return (self[place] for place in range(len(self)))

    def __eq__(self, other):
        """Whether the polygons of each row have equal vertices in one order."""
        if not isinstance(other, _core.Polygons):
            return NotImplemented
        if len(self) != len(other):
            return np.zeros(max(len(self), len(other)), bool)
        return np.array(self._equal(other), bool)

    def __ne__(self, other):
        equal = self.__eq__(other)
        return equal if equal is NotImplemented else ~equal

    __hash__ = None

    def __reduce__(self):
        return type(self), (np.array(self.vertices), tuple(np.array(own) for own in self.offsets))

    def __copy__(self):
        return self

    def __deepcopy__(self, memo):
        return self


def _spots(points, polygons):
    """Points as rows in the format of a call."""
    array = np.asarray(points.array if isinstance(points, _core.Shape) else points)
    if array.shape[-1:] != (2,) or array.ndim > 2:
        raise ValueError(f"`point`: an array of shape (N, 2) is needed, not {array.shape}")
    is_single = array.dtype == np.float32 and polygons.vertices.dtype == np.float32
    return np.ascontiguousarray(array.reshape(-1, 2), np.float32 if is_single else np.float64)


def _cotangents(upstream, count, dtype, width=()):
    upstream = np.asarray(upstream, dtype)
    return np.ascontiguousarray(np.broadcast_to(upstream, (count, *width)))


def _counted(a, b):
    """The number of results of two columns, of which one item may stand for all."""
    return b if a == 1 else a


def run(verb, form, arguments):
    """Runs a form of a verb of polygons, or of sets of points."""
    if verb in _points.VERBS:
        return _points.run(verb, form, arguments)
    if verb not in VERBS:
        raise TypeError(f"geograd.{verb} takes no Polygons; they have {', '.join(VERBS)}")
    if form not in ("value", "value_grad", "vjp") and not (form == "all_pairs" and verb not in MEASURES):
        pairs = "" if verb in MEASURES else ", all_pairs"
        raise TypeError(f"geograd.{verb}.{form} is not there for Polygons: they have the value, value_grad, vjp{pairs}")
    wanted = (1 if verb in MEASURES else 2) + (form == "vjp")
    if len(arguments) != wanted:
        more = ", upstream" if form == "vjp" else ""
        takes = VERBS[verb][0].replace(": Polygons", "").replace(": Vec2", "")
        raise TypeError(f"geograd.{verb} takes {takes}{more}, not {len(arguments)} arguments")
    if verb in MEASURES:
        return _measure(verb, form, *arguments)
    if verb in OVERLAPS:
        return _overlap(verb, form, *arguments)
    return _distance(verb, form, *arguments)


def _measure(verb, form, polygons, upstream=None):
    import geograd

    dtype, width = polygons.vertices.dtype, (2,) if verb == "centroid" else ()
    if form == "vjp":
        return _core.polygon_measure(verb, polygons, _cotangents(upstream, len(polygons), dtype, width))
    value = _core.polygon_measure(verb, polygons)
    if width:
        if form == "value_grad":
            raise TypeError("value_grad is of functions with one number as result, and a centroid has 2: use vjp")
        return geograd.Vec2(value)
    if form == "value":
        return value
    return value, _core.polygon_measure(verb, polygons, np.ones(len(polygons), dtype))


def _overlap(verb, form, a, b, upstream=None):
    a, b = Polygons.of(a), Polygons.of(b)
    if form == "value":
        return _core.polygon_overlap(verb, a, b)
    if form == "all_pairs":
        return _core.polygon_pairs(verb, a, b)
    dtype = np.result_type(a.vertices, b.vertices)
    upstream = _cotangents(1 if upstream is None else upstream, _counted(len(a), len(b)), dtype)
    value, gradient = _core.polygon_overlap(verb, a, b, upstream)
    return gradient if form == "vjp" else (value, gradient)


def _distance(verb, form, first, second, upstream=None, fill="even_odd"):
    if form == "all_pairs":
        return _distances(verb, first, second)
    is_turned = isinstance(first, _core.Polygons)
    other = second if is_turned else first
    if not _is_of_points(other):
        if verb != "distance":
            raise TypeError(f"geograd.{verb} of Polygons takes points beside them, not {type(other).__name__}: distance takes it")
        return _separation.distance(form, first, second, upstream)
    points, polygons = (second, first) if is_turned else (first, second)
    points = _spots(points, polygons)
    sign = -1 if verb == "depth" else 1
    if form == "value":
        return sign * _core.polygon_distance(points, polygons, fill, verb == "distance")
    upstream = sign * _cotangents(1 if upstream is None else upstream, _counted(len(points), len(polygons)), points.dtype)
    value, gradient = _core.polygon_distance(points, polygons, fill, verb == "distance", upstream)
    gradient = gradient[::-1] if is_turned else gradient
    return gradient if form == "vjp" else (sign * value, gradient)


def _distances(verb, first, second):
    """Every item of one column with every item of another: a matrix."""
    import geograd

    def listed(x):
        if isinstance(x, (_core.Polygons, _core.Paths)) or _convert_polygons.is_geometry(x):
            return Polygons.of(x)
        cls = type(x) if isinstance(x, _core.Shape) else geograd.Vec2
        return cls(np.atleast_2d(np.asarray(x)))

    both = [listed(x) for x in (first, second)]
    counts = [len(x) for x in both]
    # One item of the shorter column at a time stands for all.
    side = int(counts[1] <= counts[0])
    rows = [_distance(verb, "value", *[x[k : k + 1] if i == side else x for i, x in enumerate(both)]) for k in range(counts[side])]
    made = np.stack(rows) if rows else np.zeros((counts[side], counts[1 - side]))
    return np.ascontiguousarray(made.T) if side else made


def _is_of_points(x):
    """Whether an argument is points: vectors, an array or lists of numbers."""
    import geograd

    return not isinstance(x, (_core.Polygons, _core.Paths, _core.Shape)) and not _convert_polygons.is_geometry(x) or (
        isinstance(x, geograd.Vec2)
    )


def contains(polygons, points, *, fill="even_odd"):
    """Says whether polygons contain points, item by item, decided exactly; the border belongs to a polygon.

    One polygon may stand for all points, and one point for all polygons. ``fill`` says which points are inside:
    ``"even_odd"``, those that an odd number of rings enclose, or ``"nonzero"``, those with a winding number other than
    zero. ``polygons`` may also be rings, geometries or boxes. A point that is not finite is in no polygon.
    """
    return _core.polygon_contains(points, Polygons.of(polygons), fill)


class Overlay:
    """An operation of polygons, item by item, exact: a function of two columns that gives one.

    One polygon may stand for all of the other column. ``fill`` says which points of an input are inside: ``"even_odd"``,
    those that an odd number of rings enclose, or ``"nonzero"``. Inputs may cross themselves. Parts of the result run
    counter-clockwise, holes clockwise.

    The vertices of the result are exact to roundings, and have derivatives (``vjp``); edges of it may cross by a rounding
    and parts may meet in points. With ``valid=True`` the result is valid by the OGC's rules, which GEOS and shapely require
    of what they get: vertices are rounded to a grid of the format, within a step of the last digit of the largest
    coordinate. That takes longer for polygons of many vertices.
    """

    __module__ = "geograd"

    def __init__(self, name, summary):
        self.__name__ = self.__qualname__ = name
        self.__doc__ = f"{summary}\n{Overlay.__doc__.partition(chr(10))[2]}"

    def __repr__(self):
        return f"<geograd.{self.__name__}>"

    def __reduce__(self):
        return self.__name__

    def __call__(self, a, b, *, fill="even_odd", valid=False):
        return self._of(a, b, fill, valid, keep=False)[0]

    def vjp(self, a, b, upstream, *, fill="even_odd", valid=False):
        """Cotangents of the vertices of both columns, from those of the vertices of the result, of shape (V, 2)."""
        made, record = self._of(a, b, fill, valid)
        return record.vjp(_cotangents(upstream, len(made.vertices), made.vertices.dtype, (2,)))

    def _of(self, a, b, fill="even_odd", valid=False, keep=True):
        made, record = _core.polygon_overlay(self.__name__, Polygons.of(a), Polygons.of(b), fill, valid, keep)
        return Polygons(made), record


class UnionArea:
    """The area that two polygons cover together, item by item, in squared units of length."""

    __module__ = "geograd"

    def __init__(self):
        self.__name__ = self.__qualname__ = "union_area"
        self.__doc__ = type(self).__doc__

    def __repr__(self):
        return "<geograd.union_area>"

    def __reduce__(self):
        return self.__name__

    def __call__(self, a, b):
        return _overlap("union_area", "value", a, b)

    def value_grad(self, a, b):
        """The value of every item, and its gradients by the vertices of both columns."""
        return _overlap("union_area", "value_grad", a, b)

    def vjp(self, a, b, upstream):
        """Cotangents of the vertices of both columns, from those of the values."""
        return _overlap("union_area", "vjp", a, b, upstream)

    def all_pairs(self, a, b):
        """Every polygon of `a` with every polygon of `b`: a matrix."""
        return _overlap("union_area", "all_pairs", a, b)


OVERLAYS = {
    name: Overlay(name, summary)
    for name, summary in (
        ("union", "The points in either of two polygons."),
        ("intersection", "The points in both of two polygons."),
        ("difference", "The points in the first of two polygons and not in the second."),
        ("symmetric_difference", "The points in exactly one of two polygons."),
        ("minkowski_sum", "All sums of a point of one polygon and a point of another one: their Minkowski sum."),
        ("no_fit_polygon", "All moves of the second polygon by which it touches or overlaps the first one."),
    )
}
union_area = UnionArea()
