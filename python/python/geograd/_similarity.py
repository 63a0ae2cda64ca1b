"""Hausdorff's and Fréchet's distance of figures of the plane, item by item, with gradients by all vertices."""

import numpy as np

from . import _convert_polygons, _core, _formulas
from ._polygons import _cotangents, _counted

_KIND = ("Vec2", "Segment2")


class _Figures:
    """Vertices of a column, the vertex after each, and how many there are up to each item."""

    def __init__(self, x, name, is_leash):
        import geograd

        if _convert_polygons.is_geometry(x) or not isinstance(x, (_core.Paths, _core.Polygons)):
            x = _figures_of(x, name, is_leash)
        if isinstance(x, _core.Polygons):
            if is_leash:
                raise TypeError(f"`{name}`: geograd.frechet takes Polylines and Rings, whose vertices have one order")
            rings, parts, polygons = x.offsets
            self.following, self.ends = np.arange(1, len(x.vertices) + 1), rings[parts[polygons]]
            self.following[rings[1:] - 1] = rings[:-1]
        else:
            if x.vertices.shape[1] != 2 or isinstance(x, geograd.Clouds):
                raise TypeError(f"`{name}`: figures of the plane are needed, not {type(x).__name__} of space")
            self.ends = np.asarray(x.offsets, np.int64)
            self.following = _formulas.following(_Open(self.ends, type(x)))
        self.vertices = x.vertices

    def __len__(self):
        return len(self.ends) - 1


class _Open:
    """What :func:`_formulas.following` asks of a layout."""

    def __init__(self, offsets, cls):
        self.offsets, self.cls = (offsets,), cls


def _figures_of(x, name, is_leash):
    """A column of an array of geometries or of lists: polygons, else paths."""
    import geograd

    if not _convert_polygons.is_geometry(x):
        x = list(x)
        if not x or not _convert_polygons.is_geometry(x[0]):
            return geograd.Polylines.of(x)
        x = np.array(x, object)
    import shapely

    items = np.atleast_1d(np.asarray(getattr(x, "values", x), object))
    types = np.unique(shapely.get_type_id(items))
    if np.isin(types, [1]).all():
        return geograd.Polylines.of(items)
    if np.isin(types, [2]).all():
        return geograd.Rings.of(items)
    if np.isin(types, [3, 6]).all() and not is_leash:
        return geograd.Polygons.from_shapely(items)
    wanted = "lines or rings" if is_leash else "lines, rings or polygons"
    raise TypeError(f"`{name}`: geometries of one kind are needed, {wanted}")


class Similarity:
    """A distance of two columns of figures of the plane, item by item: ``Polylines``, ``Rings``, ``Polygons``, lists of paths, or
    shapely's geometries. One item stands for all. An item without vertices has the distance NaN and derivatives of zero.

    Gradients are by all vertices, of their shape. The pair that decides has them all: a vertex, and the ends of an edge or
    another vertex.
    """

    __module__ = "geograd"

    def __init__(self, name, summary):
        self.__name__ = self.__qualname__ = name
        self.__doc__ = f"{summary}\n\n{Similarity.__doc__}"

    def __repr__(self):
        return f"<geograd.{self.__name__}>"

    def __reduce__(self):
        return self.__name__

    def _found(self, a, b):
        is_leash = self.__name__ == "frechet"
        both = [_Figures(x, name, is_leash) for x, name in ((a, "a"), (b, "b"))]
        dtype = np.result_type(*[own.vertices for own in both])
        counts = [len(own) for own in both]
        if counts[0] != counts[1] and 1 not in counts:
            raise ValueError(f"`b` has {counts[1]} rows where {counts[0]} are needed, or one, as many as `a`")
        lists = [(np.ascontiguousarray(own.vertices, dtype), own.following, own.ends) for own in both]
        return lists, _core.far_pairs(*lists, _counted(*counts), is_leash)

    def __call__(self, a, b):
        """The distance of every item."""
        return self._found(a, b)[1][0]

    def _pulled(self, lists, found, upstream):
        import geograd

        distances, of_second, vertex, start, end = found
        vertices = [own[0] for own in lists]
        bars = tuple(np.zeros_like(own) for own in vertices)
        for side in (0, 1):
            here = np.flatnonzero((of_second == bool(side)) & (distances > 0))
            if not len(here):
                continue
            own, other = vertices[side], vertices[1 - side]
            places, ends = vertex[here], (start[here], end[here])
            segments = np.concatenate([other[ends[0]], other[ends[1]]], 1)
            by_vertex, by_edge = geograd.distance.vjp(own[places], segments, upstream[here], kind=_KIND)
            np.add.at(bars[side], places, by_vertex)
            np.add.at(bars[1 - side], ends[0], by_edge[:, :2])
            np.add.at(bars[1 - side], ends[1], by_edge[:, 2:])
        return bars

    def vjp(self, a, b, upstream):
        """Cotangents of the vertices of both columns, from those of the distances."""
        lists, found = self._found(a, b)
        return self._pulled(lists, found, _cotangents(upstream, len(found[0]), found[0].dtype))

    def value_grad(self, a, b):
        """The distance of every item, and its gradients by the vertices of both columns."""
        lists, found = self._found(a, b)
        return found[0], self._pulled(lists, found, np.ones_like(found[0]))


hausdorff = Similarity("hausdorff", "Hausdorff's distance, as shapely's: the largest one of a vertex of either figure from the other's edges.")
frechet = Similarity("frechet", "The discrete Fréchet distance, as shapely's: the shortest leash for walks along the vertices of both paths.")
