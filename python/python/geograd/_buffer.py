"""Offsets of columns of polygons and polylines."""

import numpy as np

from . import _core
from ._polygons import Polygons, _cotangents
from ._shapes import Paths, Polylines


class Buffer:
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
    array([36.])
    """

    __module__ = "geograd"

    def __init__(self):
        self.__name__ = self.__qualname__ = "buffer"
        self.__doc__ = type(self).__doc__

    def __repr__(self):
        return "<geograd.buffer>"

    def __reduce__(self):
        return self.__name__

    def __call__(self, column, distance, **style):
        return self._of(column, distance, **style)[0]

    def vjp(self, column, distance, upstream, **style):
        """Cotangents of the vertices of the column and of the distance, from those of the vertices of the result."""
        made, record = self._of(column, distance, **style)
        return pulled(record, _cotangents(upstream, len(made.vertices), made.vertices.dtype, (2,)), np.shape(distance))

    def _of(
        self, column, distance, *, join="round", limit=5.0, end="round", chords=16, tolerance=None, fill="even_odd", valid=False
    ):
        starts = None
        if isinstance(column, Paths):
            if not isinstance(column, Polylines) or column.vertices.shape[1] != 2:
                raise TypeError("column: Polygons, or Polylines of the plane, are needed")
            vertices, starts = np.ascontiguousarray(column.vertices), np.asarray(column.offsets).tolist()
            count = len(starts) - 1
        else:
            vertices = Polygons.of(column)
            count = len(vertices)
        if np.ndim(distance) > 1 or np.shape(distance) not in ((), (1,), (count,)):
            raise ValueError(f"distance: one number or {count} are needed, not an array of shape {np.shape(distance)}")
        distances = np.broadcast_to(np.asarray(distance, float), (count,)).tolist()
        look = (join, limit, end, chords, tolerance)
        made, record = _core.polygon_buffer(vertices, starts, distances, look, fill, valid)
        return Polygons(made), record


def pulled(record, upstream, shape):
    """Cotangents of the vertices of the column, and of distances of this shape."""
    by_vertices, by_distance = record.vjp(upstream)
    if shape != by_distance.shape:
        by_distance = by_distance.sum(dtype=by_distance.dtype).reshape(shape)
    return by_vertices, by_distance


buffer = Buffer()
