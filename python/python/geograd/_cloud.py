"""Clouds of points of space: nearest points, points within a radius, distances of two clouds."""

from . import _core
from ._mesh import _rows


class Cloud:
    """Points of space, of shape (P, 3), with a tree that is built once and serves all calls.

    Numbers are computed in float64. Of points at equal distances the one of lowest index comes first.

    >>> cloud = geograd.Cloud([[0, 0, 0], [3, 0, 0], [0, 4, 0]])
    >>> cloud.distance([1, 0, 0])
    array(1.)
    >>> cloud.nearest_some([1, 0, 0], 2)
    (array([0, 1]), array([1., 2.]))
    """

    __module__ = "geograd"

    def __init__(self, points):
        self._core = _core.CloudCore(_rows("points", points)[0])

    @property
    def points(self):
        """The points, of shape (P, 3)."""
        return self._core.points

    def __len__(self):
        return len(self.points)

    def __repr__(self):
        return f"<geograd.Cloud of {len(self)} points>"

    def __reduce__(self):
        return Cloud, (self.points,)

    def nearest(self, queries):
        """The index of the point that is nearest to each query."""
        rows, shape = _rows("queries", queries)
        return self._core.search(rows).reshape(shape)

    def distance(self, queries):
        """The distance of each query from its nearest point."""
        rows, shape = _rows("queries", queries)
        return self._core.distances(False, rows, self._core.search(rows)).reshape(shape)

    def squared_distance(self, queries):
        """The squared distance of each query from its nearest point."""
        rows, shape = _rows("queries", queries)
        return self._core.distances(True, rows, self._core.search(rows)).reshape(shape)

    def nearest_some(self, queries, count):
        """The indices of so many points that are nearest to each query, and their distances, in the order of these.

        There are at most as many as the cloud has points.
        """
        rows, shape = _rows("queries", queries)
        found = self._core.some(rows, count)[0].reshape(*shape, min(count, len(self)))
        repeated = rows.repeat(found.shape[-1], 0)
        return found, self._core.distances(False, repeated, found.ravel()).reshape(found.shape)

    def within(self, queries, radius):
        """The indices of the points within a radius of each query, one query after another, and where each query starts."""
        return self._core.within(_rows("queries", queries)[0], radius)

    def chamfer(self, other, *, squared=True):
        """The mean squared distance of these points from the other cloud, plus that of the other cloud's points from this one.

        Without ``squared`` it is the means of distances.
        """
        return self._core.chamfer(other._core, squared)

    def hausdorff(self, other):
        """The largest distance of a point of either cloud from the other one, and the pair that decides it: a point of each."""
        return self._core.hausdorff(other._core)

    def f_score(self, other, threshold):
        """The harmonic mean of the shares of both clouds that are as near to the other one."""
        return self._core.f_score(other._core, threshold)
