"""Convex hulls of points of space: volume, surface, centroid and faces of each set."""

import numpy as np

from . import _core
from ._shapes import Clouds


def _sets(points):
    """Vertices of sets of points, where each starts, and the places that an array of hulls has among them."""
    if isinstance(points, _core.Paths):
        vertices, offsets = np.asarray(points.vertices), np.asarray(points.offsets, np.int64)
        if vertices.shape[1] != 3:
            raise TypeError("points of space are needed: geograd.convex_hull takes those of the plane")
        return vertices, offsets, None
    if isinstance(points, _core.Shape):
        if type(points).__name__ != "Hull3_8":
            raise TypeError(f"hulls of points are needed: Clouds, Hull3_8 or an array, not {type(points).__name__}")
        array = np.asarray(points)
        rows = array.reshape(-1, 25)
        if not np.all(_core.valid("Hull3_8", np.ascontiguousarray(rows, np.float64))):
            raise ValueError("a Hull3_8 has from 1 to 8 vertices, of finite numbers")
        is_there = np.arange(8) < rows[:, 24:]
        vertices = rows[:, :24].reshape(-1, 8, 3)[is_there]
        return vertices, np.concatenate([[0], np.cumsum(is_there.sum(1))]), (array.shape, is_there)
    array = np.asarray(points)
    if array.ndim == 3 and array.shape[2] == 3:
        return array.reshape(-1, 3), np.arange(len(array) + 1) * array.shape[1], None
    return _sets(Clouds.of(points))


def _format(vertices):
    return np.ascontiguousarray(vertices, np.float32 if vertices.dtype == np.float32 else np.float64)


class HullMeasure:
    """A measure of the convex hulls of sets of points of space: of ``Clouds``, of ``Hull3_8``, or of an array of shape (N, V, 3).

    The hull is searched exactly. Gradients are those by all points, of the shape of the vertices; points that are no corners
    have derivative zero.
    """

    __module__ = "geograd"

    def __init__(self, name, summary, width):
        self.__name__ = self.__qualname__ = name
        self.__doc__, self._width = f"{summary}\n{HullMeasure.__doc__.partition(chr(10))[2]}", width

    def __repr__(self):
        return f"<geograd.{self.__name__}>"

    def __reduce__(self):
        return self.__name__

    def __call__(self, points):
        """The measure of every set."""
        vertices, offsets, hulls = _sets(points)
        found = _core.hull_measure(self.__name__, _format(vertices), offsets)
        lead = (len(offsets) - 1,) if hulls is None else hulls[0][:-1]
        return found.reshape((*lead, *self._width))[()]

    def vjp(self, points, upstream):
        """Cotangents of the points, from those of the measures."""
        vertices, offsets, hulls = _sets(points)
        vertices = _format(vertices)
        lead = (len(offsets) - 1,) if hulls is None else hulls[0][:-1]
        upstream = np.broadcast_to(np.asarray(upstream, vertices.dtype), (*lead, *self._width))
        bars = _core.hull_measure(self.__name__, vertices, offsets, np.ascontiguousarray(upstream).reshape(-1)).reshape(-1, 3)
        if hulls is None:
            return bars if isinstance(points, _core.Paths) or np.ndim(points) != 3 else bars.reshape(np.shape(points))
        shape, is_there = hulls
        made = np.zeros((len(is_there), 8, 3), bars.dtype)
        made[is_there] = bars
        return np.concatenate([made.reshape(-1, 24), np.zeros((len(made), 1), bars.dtype)], 1).reshape(shape)

    def value_grad(self, points):
        """The measure of every set, one number, and its gradient by its points."""
        if self._width:
            raise TypeError(f"value_grad is of functions with one number as result, and {self.__name__} has 3: use vjp")
        return self(points), self.vjp(points, 1.0)


def hull_faces(points):
    """The faces of the convex hulls of sets of points of space, counter-clockwise seen from outside.

    ``corners`` are places among the vertices of all sets, one face after the other, ``faces`` where each face starts among
    these, ``hulls`` where each hull starts among the faces. Corners in one plane bound one face; points in a plane have a
    hull of two faces, those on a line have none. Places of ``Hull3_8`` are those in ``array[..., :24].reshape(-1, 3)``.

    >>> corners, faces, hulls = geograd.hull_faces(geograd.Clouds.of([cube]))
    """
    vertices, offsets, hulls = _sets(points)
    corners, faces, ends = _core.hull_faces(_format(vertices), offsets)
    return corners if hulls is None else np.flatnonzero(hulls[1])[corners], faces, ends


MEASURES = {
    name: HullMeasure(name, summary, width)
    for name, summary, width in (
        ("hull_volume", "The volume of convex hulls of points of space, in cubed units of length; 0 of flat ones.", ()),
        ("hull_surface", "The area of all faces of convex hulls of points of space; of both sides of a flat one.", ()),
        ("hull_centroid", "The centre of the volume of convex hulls of points of space, of shape (N, 3); of a flat one of its area.", (3,)),
    )
}
