"""Offsets of columns of polygons and polylines."""

import numpy as np

from . import _core
from ._curves import CurvePath
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
        return self._of(column, distance, **style, keep=False)[0]

    def curves(self, column, distance, *, fill="even_odd"):
        """The border of each row's offset with round corners and ends, its arcs exact: a ``CurvePath``, ``None`` where nothing is left.

        The offset is on the left of its contours. Arcs that are not certain are chords, as ``geograd.buffer_area.is_exact`` tells.

        >>> square = geograd.Polygons.of([[(0, 0), (4, 0), (4, 4), (0, 4)]])
        >>> [border] = geograd.buffer.curves(square, 1.0)
        >>> border.steps, round(border.area, 6)
        ('MALALALAZ', 35.141593)
        """
        borders = _core.polygon_buffer_curves(*given(column, distance), fill)
        return [CurvePath(*border) if border is not None else None for border in borders]

    def vjp(self, column, distance, upstream, **style):
        """Cotangents of the vertices of the column and of the distance, from those of the vertices of the result."""
        made, record = self._of(column, distance, **style)
        return pulled(record, _cotangents(upstream, len(made.vertices), made.vertices.dtype, (2,)), np.shape(distance))

    def _of(
        self,
        column,
        distance,
        *,
        join="round",
        limit=5.0,
        end="round",
        chords=16,
        tolerance=None,
        fill="even_odd",
        valid=False,
        keep=True,
    ):
        vertices, starts, distances = given(column, distance)
        look = (join, limit, end, chords, tolerance)
        made, record = _core.polygon_buffer(vertices, starts, distances, look, fill, valid, keep)
        return Polygons(made), record


def given(column, distance):
    """The vertices of a column, where its paths start (``None`` for polygons), and a distance for each row."""
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
    return vertices, starts, np.broadcast_to(np.asarray(distance, float), (count,)).tolist()


def shaped(by_distance, shape):
    """Cotangents of distances of a shape, from those of each row."""
    if shape != by_distance.shape:
        by_distance = by_distance.sum(dtype=by_distance.dtype).reshape(shape)
    return by_distance


def pulled(record, upstream, shape):
    """Cotangents of the vertices of the column, and of distances of this shape."""
    by_vertices, by_distance = record.vjp(upstream)
    return by_vertices, shaped(by_distance, shape)


class BufferMeasure:
    """{summary} of polygons grown (a positive distance) or shrunk (a negative one), or of the surroundings of open paths,
    row by row, with round corners and ends whose arcs are exact: no chords.

    ``distance`` is one number, or one per row. A polygon may be of any kind: ``fill`` says what is inside. {sentence}

    The vertices of the column and the distance have exact derivatives (``value_grad``, ``vjp``): those of the motion of the
    border. Where it cannot be certain of the arcs, such as for a path that lies along itself, 128 chords or more per quarter
    of a turn stand for them; ``is_exact`` tells.

    >>> square = geograd.Polygons.of([[(0, 0), (4, 0), (4, 4), (0, 4)]])
    >>> {example}
    """

    __module__ = "geograd"

    def __init__(self, name, place, **texts):
        self.__name__ = self.__qualname__ = name
        self.__doc__ = type(self).__doc__.format(**texts)
        self._place = place

    def __repr__(self):
        return f"<geograd.{self.__name__}>"

    def __reduce__(self):
        return self.__name__

    def __call__(self, column, distance, *, fill="even_odd"):
        return self._of(column, distance, fill)[0][self._place]

    def is_exact(self, column, distance, *, fill="even_odd"):
        """Says of each row whether its arcs are exact."""
        return self._of(column, distance, fill)[0][2]

    def vjp(self, column, distance, upstream, *, fill="even_odd"):
        """Cotangents of the vertices of the column and of the distance, from those of the values."""
        return self._pulled(column, distance, upstream, fill)[1]

    def value_grad(self, column, distance, *, fill="even_odd"):
        """Values, and the derivatives of each by the vertices of its row and by its distance."""
        count = len(given(column, distance)[2])
        return self._pulled(column, np.broadcast_to(distance, (count,)), 1.0, fill)

    def _of(self, column, distance, fill, upstream=None):
        vertices, starts, distances = given(column, distance)
        if upstream is not None:
            upstream = self._cotangents(upstream, vertices, starts, distances)
        return _core.polygon_buffer_measures(vertices, starts, distances, fill, upstream)

    def _cotangents(self, upstream, vertices, starts, distances):
        """The cotangents of areas and of perimeters."""
        dtype = vertices.dtype if starts is not None else vertices.vertices.dtype
        own = np.ascontiguousarray(np.broadcast_to(np.asarray(upstream, dtype), (len(distances),)))
        both = [np.zeros_like(own), np.zeros_like(own)]
        both[self._place] = own
        return both

    def _along(self, column, distance, upstream, direction, fill):
        """Derivatives of values and of cotangents along a direction of the vertices and of the distance."""
        vertices, starts, distances = given(column, distance)
        upstream = self._cotangents(upstream, vertices, starts, distances)
        ways, further = direction
        further = np.ascontiguousarray(np.broadcast_to(np.asarray(further, upstream[0].dtype), (len(distances),)))
        direction = [np.ascontiguousarray(ways, upstream[0].dtype), further]
        values, (by_vertices, by_distance) = _core.polygon_buffer_measures_along(
            vertices, starts, distances, fill, upstream, direction
        )
        return values[self._place], (by_vertices, shaped(by_distance, np.shape(distance)))

    def _pulled(self, column, distance, upstream, fill):
        values, (by_vertices, by_distance) = self._of(column, distance, fill, upstream)
        return values[self._place], (by_vertices, shaped(by_distance, np.shape(distance)))


buffer_area = BufferMeasure(
    "buffer_area",
    0,
    summary="The area",
    sentence="A row that the distance empties has 0. The area grows by the perimeter.",
    example="geograd.buffer_area(square, 1.0)\n    array([35.14159265])",
)
buffer_perimeter = BufferMeasure(
    "buffer_perimeter",
    1,
    summary="The perimeter, holes included,",
    sentence="A row that the distance empties has 0.",
    example="geograd.buffer_perimeter(square, 1.0)\n    array([22.28318531])",
)



buffer = Buffer()
