"""Stands in for the overlaps of oriented boxes in Ultralytics: exact IoU, and probabilistic IoU as the original has it.

Boxes are ``xywhr``: centre, width, height, and the angle in radians from x towards y, as in ``geograd.Obb2``.

>>> import torch
>>> from geograd.ultralytics import batch_iou, batch_probiou, nms
>>> truth = torch.tensor([[50.0, 50.0, 40.0, 4.0, 0.0]])
>>> found = torch.tensor([[50.0, 50.0, 40.0, 4.0, 0.1], [52.0, 50.0, 36.0, 4.0, 0.0]])
>>> [f"{iou:.2f}" for iou in batch_iou(truth, found)[0]], [f"{iou:.2f}" for iou in batch_probiou(truth, found)[0]]
(['0.60', '0.90'], ['0.68', '0.92'])
>>> nms(found, torch.tensor([0.9, 0.8]), 0.5)
tensor([0])

``model.val(validator=geograd.ultralytics.OBBValidator)`` scores a model by exact IoU. :func:`exact` does so for code
that calls Ultralytics' own validator or tracker, and ``TorchNMS.fast_nms(boxes, scores, threshold,
iou_func=batch_iou)`` suppresses by it.

Differences from Ultralytics
    * NaN and infinite numbers raise a ValueError that names the row; in ``iou``, ``batch_iou`` and ``nms`` negative
      sizes do, too.
    * ``probiou`` and ``batch_probiou`` have Ultralytics' ``eps`` and ``floor``, and other roundings: determinants are
      products of sizes, where Ultralytics subtracts numbers that are nearly equal for thin boxes.
    * ``nms`` is greedy. Ultralytics' ``fast_nms`` lets suppressed boxes suppress others.
"""

from __future__ import annotations

import contextlib
import importlib
import importlib.util
import math
from typing import Any, Iterator, Optional, Tuple, Union

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

import geograd

from ._tensors import Score, array, kept, numbers

__all__ = ["OBBValidator", "batch_iou", "batch_probiou", "exact", "iou", "nms", "probiou"]

Boxes = Union[Tensor, NDArray[Any]]


def _tensor(boxes: Boxes, name: str) -> Tensor:
    made = torch.from_numpy(np.ascontiguousarray(boxes)) if isinstance(boxes, np.ndarray) else boxes
    if made.dim() == 0 or made.shape[-1] != 5:
        raise ValueError(f"`{name}`: a tensor of shape (..., 5) is needed, not {tuple(made.shape)}")
    return made


def _ready(obb1: Boxes, obb2: Boxes) -> Tuple[Tensor, Tensor, torch.dtype]:
    """Both in one format to compute in, and that of the result."""
    a, b = _tensor(obb1, "obb1"), _tensor(obb2, "obb2")
    result = torch.promote_types(a.dtype, b.dtype)
    result = result if result.is_floating_point else torch.float32
    inner = torch.float64 if result == torch.float64 else torch.float32
    return a.to(inner), b.to(inner), result


@kept()
def _iou() -> Score:
    return Score(geograd.iou, "Obb2")


def _gaussian(box: Any, floor: float) -> Tuple[Any, Any]:
    """The variances of a box along its own axes."""
    return box[2] * box[2] / 12 + floor, box[3] * box[3] / 12 + floor


def _probiou(a: Any, b: Any, turned_a: Tuple[Any, Any], turned_b: Tuple[Any, Any], eps: float, floor: float) -> Any:
    """Ultralytics' score of two boxes whose cosines and sines are known."""
    (p, q), (r, s) = _gaussian(a, floor), _gaussian(b, floor)
    (cos_a, sin_a), (cos_b, sin_b) = turned_a, turned_b
    x, y = a[0] - b[0], a[1] - b[1]
    sin2 = (sin_a * cos_b - cos_a * sin_b) ** 2
    cos2 = (cos_a * cos_b + sin_a * sin_b) ** 2
    # The determinant of the sum of both covariances, a sum of products.
    whole = p * q + r * s + (p * r + q * s) * sin2 + (p * s + q * r) * cos2
    # The squares of the offset across the axes of either box.
    across = p * (cos_a * y - sin_a * x) ** 2 + q * (sin_a * y + cos_a * x) ** 2
    across = across + r * (cos_b * y - sin_b * x) ** 2 + s * (sin_b * y + cos_b * x) ** 2
    apart = 0.25 * across / (whole + eps)
    unlike = 0.5 * geograd.log(whole / (4 * geograd.sqrt(p * q * (r * s)) + eps) + eps)
    distance = geograd.minimum(geograd.maximum(apart + unlike, eps), 100.0)
    return 1 - geograd.sqrt(1 - geograd.exp(-distance) + eps)


@kept(1e-7, 0.0)
def _aligned(eps: float, floor: float) -> Score:
    @numbers(obb1=5, obb2=5)
    def probiou(a: Any, b: Any) -> Any:
        turned = [(geograd.cos(x[4]), geograd.sin(x[4])) for x in (a, b)]
        return _probiou(a, b, turned[0], turned[1], eps, floor)

    return Score(probiou)


@kept(1e-7)
def _of_pairs(eps: float) -> Score:
    @numbers(obb1=6, obb2=6)
    def batch_probiou(a: Any, b: Any) -> Any:
        return _probiou(a, b, (a[4], a[5]), (b[4], b[5]), eps, 0.0)

    return Score(batch_probiou)


@kept()
def _aspect() -> Score:
    @numbers(obb1=5, obb2=5)
    def aspect(a: Any, b: Any) -> Any:
        turn = [geograd.arctan2(x[2] / x[3], 1.0) for x in (a, b)]
        return 4 / math.pi**2 * (turn[0] - turn[1]) ** 2

    return Score(aspect)


def iou(obb1: Boxes, obb2: Boxes) -> Tensor:
    """Returns the exact IoU of box i of both, 0 to 1: a tensor of shape (..., 1), as ``probiou`` has it."""
    a, b, dtype = _ready(obb1, obb2)
    a, b = _alike(a, b)
    return _iou().aligned(a, b).unsqueeze(-1).to(dtype)


def batch_iou(obb1: Boxes, obb2: Boxes, eps: Optional[float] = None) -> Tensor:
    """Returns the exact IoU of every box of (N, 5) with every one of (M, 5), 0 to 1: a tensor of shape (N, M).

    ``eps`` is there for callers of ``batch_probiou``, and changes nothing.
    """
    a, b, dtype = _ready(obb1, obb2)
    return _iou().pairs(a, b).to(dtype)


def _alike(a: Tensor, b: Tensor) -> Tuple[Tensor, Tensor]:
    return (a, b) if a.shape == b.shape else (a + torch.zeros_like(b), b + torch.zeros_like(a))


def probiou(obb1: Boxes, obb2: Boxes, CIoU: bool = False, eps: float = 1e-7, floor: float = 0.0) -> Tensor:
    """Returns the probabilistic IoU of box i of both, 0 to 1: a tensor of shape (..., 1).

    ``CIoU`` subtracts the term of aspect ratios, its weight a constant in the gradient. ``floor`` is added to the
    variances.
    """
    a, b, dtype = _ready(obb1, obb2)
    a, b = _alike(a, b)
    score = _aligned(eps, floor).aligned(a, b)
    if CIoU:
        aspect = _aspect().aligned(a, b)
        with torch.no_grad():
            weight = aspect / (aspect - score + (1 + eps))
        score = score - weight * aspect
    return score.unsqueeze(-1).to(dtype)


def batch_probiou(obb1: Boxes, obb2: Boxes, eps: float = 1e-7) -> Tensor:
    """Returns the probabilistic IoU of every box of (N, 5) with every one of (M, 5), 0 to 1: a tensor (N, M)."""
    a, b, dtype = _ready(obb1, obb2)
    # Cosine and sine of each box once.
    a, b = [torch.cat([x[..., :4], x[..., 4:].cos(), x[..., 4:].sin()], -1) for x in (a, b)]
    return _of_pairs(eps).pairs(a, b).to(dtype)


def nms(boxes: Boxes, scores: Tensor, iou_threshold: float, classes: Optional[Tensor] = None) -> Tensor:
    """Returns the places of the boxes that no kept box of a higher score overlaps by more than a threshold.

    The best come first. With ``classes`` boxes suppress those of their own class alone.
    """
    a, _, _ = _ready(boxes, boxes)
    if a.dim() != 2:
        raise ValueError(f"`boxes`: a tensor of shape (N, 5) is needed, not {tuple(a.shape)}")
    for name, own in (("scores", scores), ("classes", classes)):
        if own is not None and tuple(own.shape) != (len(a),):
            raise ValueError(f"`{name}`: a tensor of shape ({len(a)},) is needed, not {tuple(own.shape)}")
    return _iou().suppressed(a, scores.to(torch.float64), iou_threshold, classes)


#: The modules whose ``batch_probiou`` scores detections; that of ``nms`` suppresses.
_SCORES = ["ultralytics.utils.metrics", "ultralytics.models.yolo.obb.val"]
#: That of tracks, which Ultralytics imports where the package ``lap`` is, and else tries to install it.
_TRACKS = "ultralytics.trackers.utils.matching"


@contextlib.contextmanager
def exact(nms: bool = False) -> Iterator[None]:
    """Puts ``batch_iou`` in the place of Ultralytics' ``batch_probiou``, until the context ends.

    It scores detections, confusion matrices and tracks; with ``nms`` it suppresses, too. The place is one for all
    threads.
    """
    wanted = [*_SCORES, "ultralytics.utils.nms"] if nms else list(_SCORES)
    if importlib.util.find_spec("lap"):
        wanted.append(_TRACKS)
    # All first: a module that is imported later would keep the stand-in.
    modules = [importlib.import_module(name) for name in wanted]
    kept = [module.batch_probiou for module in modules]
    try:
        for module in modules:
            setattr(module, "batch_probiou", batch_iou)
        yield
    finally:
        for module, own in zip(modules, kept):
            setattr(module, "batch_probiou", own)


def _validator() -> Any:
    original: Any = importlib.import_module("ultralytics.models.yolo.obb.val").OBBValidator

    class OBBValidator(original):  # type: ignore[misc]
        """Ultralytics' validator of oriented boxes, with exact IoU in its scores and its confusion matrix.

        Suppression stays that of the model; ``with geograd.ultralytics.exact(nms=True):`` around ``val`` changes it,
        too.
        """

        def _process_batch(self, preds: Any, batch: Any) -> Any:
            """Which predictions are right, at each threshold of IoU."""
            if batch["cls"].shape[0] == 0 or preds["cls"].shape[0] == 0:
                return {"tp": np.zeros((preds["cls"].shape[0], self.niou), dtype=bool)}
            overlaps = batch_iou(batch["bboxes"], preds["bboxes"])
            return {"tp": array(self.match_predictions(preds["cls"], batch["cls"], overlaps))}

        def update_metrics(self, preds: Any, batch: Any) -> None:
            """Adds the predictions and truths of a batch of images."""
            with exact():
                super().update_metrics(preds, batch)

    OBBValidator.__module__, OBBValidator.__qualname__ = __name__, "OBBValidator"
    return OBBValidator


def __getattr__(name: str) -> Any:
    if name == "OBBValidator":
        made = globals()[name] = _validator()
        return made
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
