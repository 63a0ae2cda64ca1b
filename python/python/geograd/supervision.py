"""Stands in for the overlaps of boxes in supervision: matrices, suppression, mean average precision of detections.

Upright boxes are ``(x_min, y_min, x_max, y_max)``, oriented ones four corners in either order, of shape (N, 4, 2) or
(N, 8).

>>> import numpy as np
>>> from geograd.supervision import oriented_box_iou_batch, oriented_box_non_max_suppression
>>> boxes = np.array([[0, 0, 4, 0, 4, 2, 0, 2], [1, 0, 5, 0, 5, 2, 1, 2], [9, 9, 11, 11, 10, 12, 8, 10]])
>>> oriented_box_iou_batch(boxes[:1], boxes).tolist()
[[1.0, 0.6, 0.0]]
>>> scores = np.array([[0, 0, 0, 0, 0.8], [0, 0, 0, 0, 0.9], [0, 0, 0, 0, 0.7]])
>>> oriented_box_non_max_suppression(scores, boxes, iou_threshold=0.5).tolist()
[False, True, True]

:class:`MeanAveragePrecision` is supervision's metric with these overlaps. ``with geograd.supervision.exact():`` puts
them in the place of supervision's own for all that it computes: ``Detections.with_nms`` and ``with_nmm``, confusion
matrices, recall.

Differences from supervision
    * Overlaps of oriented boxes are those of float64, where supervision's are float32.
    * A box that is not finite or a quadrilateral that is not convex raises a ValueError that names the row. One that is
      thinner than the rounding of its corners has no area: it overlaps nothing.
"""

from __future__ import annotations

import contextlib
import functools
import importlib
import sys
from typing import Any, Callable, Iterator

import numpy as np
from numpy.typing import NDArray

import geograd

from ._recorded import numbers

__all__ = [
    "MeanAveragePrecision", "box_iou_batch", "box_non_max_suppression", "exact", "oriented_box_iou_batch",
    "oriented_box_non_max_suppression", "with_nms",
]

Array = NDArray[Any]


#: So many shapes of all classes are compared at once.
_FEW = 256


def _by_union(metric: Any) -> bool:
    """Whether overlaps are over the union, or over the smaller box: supervision's names, or its enumeration."""
    name = str(getattr(metric, "value", metric)).upper()
    if name not in ("IOU", "IOS"):
        raise ValueError(f"overlap_metric is 'IOU' or 'IOS', not {metric!r}")
    return name == "IOU"


@functools.lru_cache(maxsize=None)
def _upright(by_union: bool) -> geograd.Function:
    @numbers(boxes_true=4, boxes_detection=4)
    def box_iou_batch(a: Any, b: Any) -> Any:
        width = geograd.maximum(geograd.minimum(a[2], b[2]) - geograd.maximum(a[0], b[0]), 0.0)
        height = geograd.maximum(geograd.minimum(a[3], b[3]) - geograd.maximum(a[1], b[1]), 0.0)
        area_a, area_b = (a[2] - a[0]) * (a[3] - a[1]), (b[2] - b[0]) * (b[3] - b[1])
        shared = width * height
        whole = area_a + area_b - shared if by_union else geograd.minimum(area_a, area_b)
        # Boxes without an area have no overlap.
        some = whole > 0.0
        return geograd.where(some, shared, 0.0) / geograd.where(some, whole, 1.0)

    return box_iou_batch


def box_iou_batch(boxes_true: Array, boxes_detection: Array, overlap_metric: Any = "IOU") -> Array:
    """Returns the overlap of every box of (N, 4) with every one of (M, 4), 0 to 1: float32 of shape (N, M).

    ``overlap_metric`` is ``"IOU"``, over the union, or ``"IOS"``, over the smaller box, or supervision's
    ``OverlapMetric``.
    """
    by_union = _by_union(overlap_metric)
    a, b = [np.asarray(boxes, np.float64) for boxes in (boxes_true, boxes_detection)]
    for name, boxes in (("boxes_true", a), ("boxes_detection", b)):
        if boxes.ndim != 2 or boxes.shape[1] != 4:
            raise ValueError(f"`{name}` has shape {boxes.shape}; expected (N, 4)")
    if not len(a) or not len(b):
        return np.zeros((len(a), len(b)), np.float32)
    found: Array = _upright(by_union).all_pairs(a, b).astype(np.float32)
    return found


def _corners(boxes: Array, name: str) -> Array:
    """Corners as (N, 4, 2) in float64; those of quadrilaterals without an area are one point."""
    boxes = np.asarray(boxes)
    if boxes.ndim not in (2, 3) or boxes.shape[1:] not in ((8,), (4, 2)):
        raise ValueError(f"`{name}` has shape {boxes.shape}; expected (N, 4, 2), four corners of x and y, or (N, 8)")
    rounding = np.finfo(np.float32 if boxes.dtype in (np.float16, np.float32) else np.float64).eps
    corners = np.array(boxes, np.float64).reshape(-1, 4, 2)
    sides = np.roll(corners, -1, axis=1) - corners
    reach = np.abs(corners).max(axis=(1, 2), initial=0) * np.abs(sides).sum(axis=(1, 2))
    thin = _areas(corners) <= 4 * rounding * reach
    corners[thin] = corners[thin][:, :1]
    return corners


def _areas(corners: Array) -> Array:
    """Half the cross products of the diagonals."""
    first, second = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
    found: Array = np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / 2
    return found


def oriented_box_iou_batch(boxes_true: Array, boxes_detection: Array, overlap_metric: Any = "IOU") -> Array:
    """Returns the overlap of every convex quadrilateral of a list with every one of another, 0 to 1: float64 of (N, M).

    Lists have the shape (N, 4, 2) or (N, 8). ``overlap_metric`` is that of :func:`box_iou_batch`.
    """
    by_union = _by_union(overlap_metric)
    a, b = _corners(boxes_true, "boxes_true"), _corners(boxes_detection, "boxes_detection")
    if not len(a) or not len(b):
        return np.zeros((len(a), len(b)))
    shared = geograd.intersection_area.all_pairs(a.reshape(-1, 8), b.reshape(-1, 8), kind="Vec2x4")
    area_a, area_b = _areas(a)[:, None], _areas(b)[None]
    whole = area_a + area_b - shared if by_union else np.minimum(area_a, area_b)
    found = np.divide(shared, whole, out=np.zeros_like(shared), where=whole > 0)
    np.clip(found, 0.0, 1.0, out=found)
    made: Array = found
    return made


def _best_first(predictions: Array, threshold: float) -> tuple[Array, Array]:
    """The order of the scores, as supervision has it, and the classes."""
    if not 0 <= threshold <= 1:
        raise ValueError(f"iou_threshold is between 0 and 1, not {threshold}")
    predictions = np.asarray(predictions)
    if predictions.ndim != 2 or predictions.shape[1] not in (5, 6):
        raise ValueError(f"`predictions` has shape {predictions.shape}; expected (N, 5) or (N, 6)")
    # Classes may be any numbers.
    own = predictions[:, 5] if predictions.shape[1] == 6 else np.zeros(len(predictions))
    classes = np.unique(own, return_inverse=True)[1]
    return np.flip(predictions[:, 4].argsort()), classes.reshape(-1).astype(np.int64)


def _kept(order: Array, classes: Array, threshold: float, matrix: Callable[[Array], Array]) -> NDArray[np.bool_]:
    """Which shapes stay: of a class, the best first, one goes that overlaps a kept one by more than the threshold."""
    keep = np.zeros(len(order), bool)
    # One call for a few shapes, less memory for many.
    groups = [order] if len(order) <= _FEW else [order[classes[order] == own] for own in np.unique(classes)]
    for places in groups:
        over = (matrix(places) > threshold) & (classes[places][:, None] == classes[places])
        alive = np.ones(len(places), bool)
        for i in range(len(places)):
            if alive[i]:
                alive[i + 1 :] &= ~over[i, i + 1 :]
        keep[places[alive]] = True
    return keep


def box_non_max_suppression(
    predictions: Array, iou_threshold: float = 0.5, overlap_metric: Any = "IOU"
) -> NDArray[np.bool_]:
    """Returns which boxes stay, (N,) truths: rows are (x_min, y_min, x_max, y_max, score), or have a class, too."""
    by_union = _by_union(overlap_metric)
    order, classes = _best_first(predictions, iou_threshold)
    boxes = np.ascontiguousarray(np.asarray(predictions)[:, :4], np.float64)
    if not len(boxes):
        return np.zeros(0, bool)
    # Ranks in place of scores: equal scores keep the order of supervision.
    ranks = np.arange(len(order), 0, -1, dtype=np.float64)
    places = _upright(by_union).suppress(boxes[order], ranks, float(iou_threshold), classes=classes[order])
    keep = np.zeros(len(boxes), bool)
    keep[order[places]] = True
    return keep


def oriented_box_non_max_suppression(
    predictions: Array, oriented_boxes: Array, iou_threshold: float = 0.5, overlap_metric: Any = "IOU"
) -> NDArray[np.bool_]:
    """Returns which oriented boxes stay, (N,) truths: of ``predictions`` the scores count, and classes if there are."""
    by_union = _by_union(overlap_metric)
    order, classes = _best_first(predictions, iou_threshold)
    corners = _corners(oriented_boxes, "oriented_boxes")
    if len(order) != len(corners):
        raise ValueError(f"{len(order)} `predictions` and {len(corners)} `oriented_boxes`: one box for each is needed")
    metric = "IOU" if by_union else "IOS"

    def overlaps(places: Array) -> Array:
        return oriented_box_iou_batch(corners[places], corners[places], metric)

    return _kept(order, classes, iou_threshold, overlaps)


def with_nms(detections: Any, threshold: float = 0.5, class_agnostic: bool = False, overlap_metric: Any = "IOU") -> Any:
    """Returns the ``sv.Detections`` that stay, by oriented boxes where there are some, else by upright ones."""
    with exact():
        by = importlib.import_module("supervision").OverlapMetric("IOU" if _by_union(overlap_metric) else "IOS")
        return detections.with_nms(threshold, class_agnostic, by)


#: What this module has in the place of functions of supervision.
_STANDS_IN = {
    "box_iou_batch": box_iou_batch,
    "oriented_box_iou_batch": oriented_box_iou_batch,
    "box_non_max_suppression": box_non_max_suppression,
    "oriented_box_non_max_suppression": oriented_box_non_max_suppression,
}


@contextlib.contextmanager
def exact() -> Iterator[None]:
    """Puts the functions of this module in the place of supervision's, until the context ends.

    The place is one for all threads.
    """
    importlib.import_module("supervision.metrics")
    originals = importlib.import_module("supervision.detection.utils.iou_and_nms")
    kept: list[tuple[Any, str, Any]] = []
    for name, own in _STANDS_IN.items():
        original = getattr(originals, name, None)
        for title, module in list(sys.modules.items()):
            is_part = title.partition(".")[0] == "supervision"
            if is_part and original is not None and module.__dict__.get(name) is original:
                kept.append((module, name, original))
    try:
        for module, name, _ in kept:
            setattr(module, name, _STANDS_IN[name])
        yield
    finally:
        for module, name, original in kept:
            setattr(module, name, original)


def _metric() -> Any:
    original: Any = importlib.import_module("supervision.metrics").MeanAveragePrecision

    class MeanAveragePrecision(original):  # type: ignore[misc]
        """supervision's mean average precision, of upright or oriented boxes, with the overlaps of this module."""

        def compute(self) -> Any:
            """The result of all detections and targets so far."""
            with exact():
                return super().compute()

    MeanAveragePrecision.__module__, MeanAveragePrecision.__qualname__ = __name__, "MeanAveragePrecision"
    return MeanAveragePrecision


def __getattr__(name: str) -> Any:
    if name == "MeanAveragePrecision":
        made = globals()[name] = _metric()
        return made
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
