"""Sets of points: hulls, smallest shapes around them, extents, alignments."""

import numpy as np

from . import _core

#: The verbs that take sets of points, given as paths or as the vertices of polygons: what each gives.
VERBS = {"diameter": None, "minimum_circle": "Circle", "minimum_rectangle": "Obb2", "width": None}
SUMMARIES = {
    "diameter": "The largest distance of two points of each set; NaN for a set without points.",
    "minimum_circle": "The smallest circle around each set of points; NaN for a set without points.",
    "minimum_rectangle": "The rectangle of least area around each set of points; NaN for points on a line.",
    "width": "The least distance of two parallel lines around each set of points; NaN for a set without points.",
}


def _sets(points):
    """The points of some sets, one set after the other, and where each starts."""
    if isinstance(points, _core.Polygons):
        rings, parts, polygons = points.offsets
        return points.vertices, rings[parts[polygons]]
    if isinstance(points, _core.Paths):
        vertices, offsets = points.vertices, np.asarray(points.offsets)
    else:
        arrays = [np.asarray(own) for own in (points if isinstance(points, (list, tuple)) else list(points))]
        if any(own.ndim != 2 or own.shape[1] != 2 for own in arrays):
            raise ValueError("points: a list of arrays of shape (P, 2) is needed, one for each set, or paths")
        vertices = np.concatenate(arrays) if arrays else np.zeros((0, 2))
        offsets = np.concatenate([[0], np.cumsum([len(own) for own in arrays])])
    if vertices.shape[1] != 2:
        raise ValueError(f"points: points of the plane are needed, not of {vertices.shape[1]} coordinates")
    if not np.isfinite(vertices).all():
        raise ValueError("points: a coordinate is not finite")
    dtype = np.float32 if vertices.dtype == np.float32 else np.float64
    return np.ascontiguousarray(vertices, dtype), offsets


def run(verb, form, arguments):
    """Runs a form of a verb of sets of points."""
    import geograd

    forms = ("value", "vjp") if VERBS[verb] else ("value", "value_grad", "vjp")
    if form not in forms:
        raise TypeError(f"geograd.{verb}.{form} is not there for sets of points: they have {', '.join(forms)}")
    if len(arguments) != 1 + (form == "vjp"):
        raise TypeError(f"geograd.{verb} takes points{', upstream' if form == 'vjp' else ''}, not {len(arguments)} arguments")
    points, offsets = _sets(arguments[0])
    count, offsets = len(offsets) - 1, offsets.tolist()
    if form == "vjp":
        width = {"Circle": (3,), "Obb2": (5,), None: ()}[VERBS[verb]]
        upstream = np.ascontiguousarray(np.broadcast_to(np.asarray(arguments[1], points.dtype), (count, *width)))
        return _core.around_points(verb, points, offsets, upstream)
    value = _core.around_points(verb, points, offsets)
    if form == "value_grad":
        return value, _core.around_points(verb, points, offsets, np.ones(count, points.dtype))
    return getattr(geograd, VERBS[verb])(value) if VERBS[verb] else value


class ConvexHull:
    """The convex hull of each set of points, as polygons.

    Sets are a list of arrays of shape (P, 2), paths, or the vertices of polygons. Points on a line have a hull without parts.
    """

    __module__ = "geograd"

    def __init__(self):
        self.__name__ = self.__qualname__ = "convex_hull"
        self.__doc__ = type(self).__doc__

    def __repr__(self):
        return "<geograd.convex_hull>"

    def __reduce__(self):
        return self.__name__

    def __call__(self, points):
        return self._of(points)[0]

    def vjp(self, points, upstream):
        """Cotangents of all points, from those of the vertices of the hulls."""
        made, places, count = self._of(points)
        upstream = np.broadcast_to(np.asarray(upstream, made.vertices.dtype), (len(places), 2))
        bars = np.zeros((count, 2), made.vertices.dtype)
        bars[places] = upstream
        return bars

    def _of(self, points):
        import geograd

        points, offsets = _sets(points)
        made, places = _core.hulls_of_points(points, offsets.tolist())
        return geograd.Polygons(made), places, len(points)


convex_hull = ConvexHull()


class Procrustes:
    """The motion that brings points of space closest to targets, by the sum of weighted squared distances.

    Takes points and targets of shape (P, 3) and weights of shape (P,), by default ones. Gives a ``Pose3``, applied second,
    and a scale, applied first: ``pose * (scale * point)``. With ``rigid=True`` the scale is 1.
    """

    __module__ = "geograd"

    def __init__(self):
        self.__name__ = self.__qualname__ = "procrustes"
        self.__doc__ = type(self).__doc__

    def __repr__(self):
        return "<geograd.procrustes>"

    def __reduce__(self):
        return self.__name__

    def __call__(self, points, targets, weights=None, *, rigid=False):
        import geograd

        numbers = np.array(_core.align_points(*_lists(points, targets, weights), rigid)[0])
        return geograd.Pose3(numbers[:7]), numbers[7]

    def vjp(self, points, targets, weights, pose_bar, scale_bar=0.0, *, rigid=False):
        """Cotangents of points, targets and weights, from those of the seven numbers of the pose and of the scale."""
        upstream = [*np.asarray(pose_bar, float).reshape(7).tolist(), float(scale_bar)]
        _, by_points, by_targets, by_weights = _core.align_points(*_lists(points, targets, weights), rigid, upstream)
        return np.array(by_points).reshape(-1, 3), np.array(by_targets).reshape(-1, 3), np.array(by_weights)


def _lists(points, targets, weights):
    points, targets = (np.asarray(x.array if isinstance(x, _core.Shape) else x, float) for x in (points, targets))
    for name, own in (("points", points), ("targets", targets)):
        if own.ndim != 2 or own.shape[1] != 3:
            raise ValueError(f"{name}: an array of shape (P, 3) is needed, not {own.shape}")
    weights = np.ones(len(points)) if weights is None else np.asarray(weights, float)
    return points.ravel().tolist(), targets.ravel().tolist(), weights.ravel().tolist()


procrustes = Procrustes()
