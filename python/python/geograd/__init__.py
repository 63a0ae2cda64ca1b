"""Exact IoU, distances and overlaps of boxes and polygons on NumPy arrays, with exact gradients.

Every verb (``geograd.iou``, ``geograd.distance``, ...) takes shapes: arrays whose last axis has the numbers of one::

    a, b = geograd.Obb2(A), geograd.Obb2(B)            # A and B of shape (N, 5)
    value = geograd.iou(a, b)                          # (N,)
    value, (by_a, by_b) = geograd.iou.value_grad(a, b)
    matrix = geograd.iou.all_pairs(a, b)               # (N, N)
    value = geograd.iou(A, B, kind="Obb2")             # the same on plain arrays

``@geograd.function`` records a function of your own once and gives it the same forms; ``geograd.check`` checks a gradient.
"""

import os as _os

from . import _core, assignment, metric, suppression
from ._core import WGSL, Program, Shape, Symbol, Truth, __version__, get_num_threads, set_num_threads
from ._buffer import buffer, buffer_area, buffer_perimeter
from ._camera import sees
from ._cells import Cells
from ._check import Reports, check
from ._cloud import Cloud
from ._curves import CurvePath, Delaunay
from . import _elementary
from ._elementary import ELEMENTARY as _ELEMENTARY, clip, where
from ._euler import euler, from_euler
from ._function import Function, function
from ._hulls import MEASURES as _OF_HULLS, HullMeasure, hull_faces
from ._mesh import Mesh
from ._points import convex_hull, procrustes
from ._polygons import OVERLAYS as _OVERLAYS, Polygons, contains, union_area
from ._similarity import frechet, hausdorff
from ._shapes import CLASSES as _CLASSES, Clouds, Paths, Polylines, Rings
from ._verbs import VERBS as _VERBS, Verb

globals().update(_CLASSES)
globals().update(_VERBS)
globals().update({name: getattr(_elementary, name) for name in _ELEMENTARY})
globals().update(_OF_HULLS)
globals().update(_OVERLAYS)

# A child has none of its parent's threads, and must not find a lock held.
if hasattr(_os, "register_at_fork"):
    _os.register_at_fork(
        before=_core.before_fork, after_in_parent=_core.after_fork, after_in_child=_core.after_fork
    )

__all__ = sorted(
    [
        "Cells", "Cloud", "Clouds", "CurvePath", "Delaunay", "Function", "HullMeasure", "Mesh", "Paths", "Polygons", "Polylines", "Program", "Reports", "Rings", "Shape", "Symbol",
        "Truth", "Verb",
        "WGSL", "__version__", "assignment", "metric", "suppression",
        "buffer", "buffer_area", "buffer_perimeter", "check", "clip", "contains", "convex_hull", "euler", "frechet", "from_euler", "function", "get_num_threads", "hausdorff", "hull_faces",
        "procrustes", "sees",
        "set_num_threads", "union_area", "where", *_ELEMENTARY, *_CLASSES, *_OF_HULLS, *_OVERLAYS, *_VERBS,
    ]
)
