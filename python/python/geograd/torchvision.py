"""Stands in for the boxes of ``torchvision.ops``: IoU matrices, losses, suppression, conversions, with the same names.

Rotated boxes have exact overlaps and gradients in every function; torchvision has them in ``box_iou``, without a
gradient.

>>> import torch
>>> from geograd.torchvision import box_iou, generalized_box_iou_loss
>>> a = torch.tensor([[4.0, 4.0, 4.0, 2.0, 30.0]], requires_grad=True)    # centre, width, height, degrees
>>> b = torch.tensor([[5.0, 4.0, 4.0, 2.0, 0.0], [9.0, 9.0, 2.0, 2.0, 45.0]])
>>> [f"{iou:.3f}" for iou in box_iou(a, b, fmt="cxcywhr")[0]]
['0.452', '0.000']
>>> generalized_box_iou_loss(a, b[:1], reduction="sum", fmt="cxcywhr").backward()
>>> a.grad.shape
torch.Size([1, 5])

Formats
    ``xyxy`` (corners), ``xywh`` (smallest corner, size), ``cxcywh`` (centre, size), ``cxcywhr``, ``xywhr``,
    ``xyxyxyxy``. The angle ``r`` is in degrees, counter-clockwise in an image whose y points down: it turns x towards
    -y. ``xywhr`` has the corner that is the top left one before turning, ``xyxyxyxy`` the corners from there clockwise
    in the image. Four corners stand for the rectangle of the first three.

Differences from torchvision
    * Rotated IoU is exact to rounding, in float32 and in float64. torchvision 0.29 gives float32 for float64 boxes.
    * torchvision 0.29 loses corners of rotated boxes. It has 0.236 for an IoU of 4/21 of two boxes of whole numbers,
      0.33 for 0.997 of two nearly equal ones, and 1 for two apart whose sides are below 0.01.
    * Every function takes ``fmt``, leading axes and rotated boxes, with gradients. Rotated GIoU, DIoU and CIoU measure
      by the convex hull of both boxes and ignore ``eps``.
    * NaN and infinite numbers raise a ValueError that names the row, and so do negative sizes of rotated boxes and in
      ``nms``. Upright boxes of negative sizes compute as in torchvision elsewhere, and two empty ones give NaN.
    * At a tie, such as touching edges, both sides share the derivative.
    * ``batched_nms`` compares boxes of one class where they are. torchvision shifts the classes apart, which rounds,
      and joins classes again where all coordinates are negative.
    * Integer boxes compute in float64, without overflow.
"""

from __future__ import annotations

import math
from typing import Any, Tuple

import torch
from torch import Tensor

import geograd

from ._tensors import Score, kept, numbers

__all__ = [
    "batched_nms", "box_area", "box_convert", "box_iou", "complete_box_iou", "complete_box_iou_loss",
    "distance_box_iou", "distance_box_iou_loss", "generalized_box_iou", "generalized_box_iou_loss", "nms",
]

_UPRIGHT = {"xyxy": 4, "xywh": 4, "cxcywh": 4}
_ROTATED = {"cxcywhr": 5, "xywhr": 5, "xyxyxyxy": 8}
_WIDTHS = {**_UPRIGHT, **_ROTATED}


# Formulas of torchvision for upright boxes, of plain numbers: a Shape would refuse what torchvision computes.
def _overlap(a: Any, b: Any) -> Tuple[Any, Any]:
    """The areas of the intersection and of the union."""
    width = geograd.maximum(geograd.minimum(a[2], b[2]) - geograd.maximum(a[0], b[0]), 0.0)
    height = geograd.maximum(geograd.minimum(a[3], b[3]) - geograd.maximum(a[1], b[1]), 0.0)
    shared = width * height
    return shared, (a[2] - a[0]) * (a[3] - a[1]) + (b[2] - b[0]) * (b[3] - b[1]) - shared


def _around(a: Any, b: Any) -> Tuple[Any, Any]:
    """The size of the box around both."""
    width = geograd.maximum(a[2], b[2]) - geograd.minimum(a[0], b[0])
    return width, geograd.maximum(a[3], b[3]) - geograd.minimum(a[1], b[1])


def _apart(a: Any, b: Any, eps: float) -> Any:
    """The squared distance of the centres over that of the corners of the box around both."""
    width, height = _around(a, b)
    x, y = (a[0] + a[2]) / 2 - (b[0] + b[2]) / 2, (a[1] + a[3]) / 2 - (b[1] + b[3]) / 2
    return (x * x + y * y) / (width * width + height * height + eps)


def _aspect(a: Any, b: Any) -> Any:
    """How far the aspect ratios of two boxes differ, 0 to 1."""
    turn = [geograd.arctan2((x[2] - x[0]) / (x[3] - x[1]), 1.0) for x in (a, b)]
    return 4 / math.pi**2 * (turn[0] - turn[1]) ** 2


@kept()
def _iou() -> Score:
    @numbers(boxes1=4, boxes2=4)
    def box_iou(a: Any, b: Any) -> Any:
        shared, union = _overlap(a, b)
        return shared / union

    return Score(box_iou)


@kept()
def _giou() -> Score:
    @numbers(boxes1=4, boxes2=4)
    def generalized_box_iou(a: Any, b: Any) -> Any:
        shared, union = _overlap(a, b)
        width, height = _around(a, b)
        hull = geograd.maximum(width, 0.0) * geograd.maximum(height, 0.0)
        return shared / union - (hull - union) / hull

    return Score(generalized_box_iou)


@kept(1e-7)
def _diou(eps: float) -> Score:
    @numbers(boxes1=4, boxes2=4)
    def distance_box_iou(a: Any, b: Any) -> Any:
        shared, union = _overlap(a, b)
        return shared / union - _apart(a, b, eps)

    return Score(distance_box_iou)


@kept(1e-7)
def _ciou(eps: float) -> Score:
    @numbers(boxes1=5, boxes2=5)
    def complete_box_iou(a: Any, b: Any) -> Any:
        shared, union = _overlap(a, b)
        iou = shared / union
        # The last number is the angle of the aspect ratio, of each box once.
        aspect = 4 / math.pi**2 * (a[4] - b[4]) ** 2
        return iou - _apart(a, b, eps) - aspect * aspect / (1 - iou + aspect + eps)

    return Score(complete_box_iou)


@kept(1e-7)
def _giou_loss(eps: float) -> Score:
    @numbers(boxes1=4, boxes2=4)
    def generalized_box_iou_loss(a: Any, b: Any) -> Any:
        shared, union = _overlap(a, b)
        width, height = _around(a, b)
        return 1 - shared / (union + eps) + (width * height - union) / (width * height + eps)

    return Score(generalized_box_iou_loss)


@kept(1e-7)
def _diou_loss(eps: float) -> Score:
    @numbers(boxes1=4, boxes2=4)
    def distance_box_iou_loss(a: Any, b: Any) -> Any:
        shared, union = _overlap(a, b)
        return 1 - shared / (union + eps) + _apart(a, b, eps)

    return Score(distance_box_iou_loss)


@kept(1e-7)
def _weight(eps: float) -> Score:
    @numbers(boxes1=4, boxes2=4)
    def weight(a: Any, b: Any) -> Any:
        shared, union = _overlap(a, b)
        aspect = _aspect(a, b)
        return aspect / (1 - shared / (union + 1e-7) + aspect + eps)

    return Score(weight)


@kept()
def _ciou_loss() -> Score:
    @numbers(boxes1=4, boxes2=4, weight=0)
    def complete_box_iou_loss(a: Any, b: Any, weight: Any) -> Any:
        shared, union = _overlap(a, b)
        # torchvision's `eps` is that of the weight alone.
        return 1 - shared / (union + 1e-7) + _apart(a, b, 1e-7) + weight * _aspect(a, b)

    return Score(complete_box_iou_loss)


@kept("iou")
def _rotated(verb: str) -> Score:
    return Score(getattr(geograd, verb), "Obb2")


for _verb in ("giou", "diou", "ciou_fixed_weight"):
    _rotated(_verb)


def _checked(boxes: Tensor, fmt: str, name: str = "boxes") -> None:
    if fmt not in _WIDTHS:
        raise ValueError(f"fmt is one of {', '.join(_WIDTHS)}, not {fmt!r}")
    if boxes.dim() == 0 or boxes.shape[-1] != _WIDTHS[fmt]:
        wanted = f"fmt={fmt!r} needs a tensor of shape (..., {_WIDTHS[fmt]})"
        raise ValueError(f"`{name}`: {wanted}, not {tuple(boxes.shape)}")


def _ready(boxes1: Tensor, boxes2: Tensor, fmt: str) -> Tuple[Tensor, Tensor, torch.dtype]:
    """Boxes as corners or as Obb2, in one format to compute in, and that of the result."""
    _checked(boxes1, fmt, "boxes1")
    _checked(boxes2, fmt, "boxes2")
    dtypes = (boxes1.dtype, boxes2.dtype)
    result = torch.float64 if torch.float64 in dtypes else torch.float32
    inner = result if all(dtype.is_floating_point for dtype in dtypes) else torch.float64
    return _shaped(boxes1, fmt, inner), _shaped(boxes2, fmt, inner), result


def _shaped(boxes: Tensor, fmt: str, dtype: torch.dtype) -> Tensor:
    """Boxes as corners or as Obb2."""
    boxes = boxes if boxes.dtype == dtype else boxes.to(dtype)
    return _obb2(boxes, fmt) if fmt in _ROTATED else _to_corners(boxes, fmt)


#: The units of cxcywhr in those of Obb2.
_UNITS = {
    dtype: torch.tensor([1.0, 1.0, 1.0, 1.0, -math.pi / 180], dtype=dtype) for dtype in (torch.float32, torch.float64)
}


def _obb2(boxes: Tensor, fmt: str) -> Tensor:
    """Rotated boxes as geograd has them: the heading in radians, from x towards y."""
    if fmt != "cxcywhr":
        boxes = box_convert(boxes, fmt, "cxcywhr")
    return boxes * _UNITS[boxes.dtype].to(boxes.device)


def _matrix(score: Score, boxes1: Tensor, boxes2: Tensor, dtype: torch.dtype) -> Tensor:
    found = score.pairs(boxes1, boxes2)
    return found if found.dtype == dtype else found.to(dtype)


def _in_pairs(boxes1: Tensor, boxes2: Tensor, fmt: str) -> Tuple[Tensor, Tensor, torch.dtype]:
    for name, boxes in (("boxes1", boxes1), ("boxes2", boxes2)):
        if boxes.dim() < 2:
            raise IndexError(f"`{name}`: a list of boxes is needed, not a tensor of shape {tuple(boxes.shape)}")
    return _ready(boxes1, boxes2, fmt)


def box_iou(boxes1: Tensor, boxes2: Tensor, fmt: str = "xyxy") -> Tensor:
    """Returns the IoU of every box of (..., N, K) with every one of (..., M, K), 0 to 1: a tensor (..., N, M)."""
    a, b, dtype = _in_pairs(boxes1, boxes2, fmt)
    return _matrix(_rotated("iou") if fmt in _ROTATED else _iou(), a, b, dtype)


def generalized_box_iou(boxes1: Tensor, boxes2: Tensor, fmt: str = "xyxy") -> Tensor:
    """Returns the generalised IoU of all pairs, -1 to 1: IoU less the share of the hull that neither box covers."""
    a, b, dtype = _in_pairs(boxes1, boxes2, fmt)
    return _matrix(_rotated("giou") if fmt in _ROTATED else _giou(), a, b, dtype)


def distance_box_iou(boxes1: Tensor, boxes2: Tensor, eps: float = 1e-7, fmt: str = "xyxy") -> Tensor:
    """Returns the distance IoU of all pairs, -1 to 1: IoU less the squared distance of the centres over the hull's."""
    a, b, dtype = _in_pairs(boxes1, boxes2, fmt)
    return _matrix(_rotated("diou") if fmt in _ROTATED else _diou(eps), a, b, dtype)


def complete_box_iou(boxes1: Tensor, boxes2: Tensor, eps: float = 1e-7, fmt: str = "xyxy") -> Tensor:
    """Returns the complete IoU of all pairs, at most 1: distance IoU less a term of aspect ratios.

    The weight of that term is a constant in the gradient.
    """
    a, b, dtype = _in_pairs(boxes1, boxes2, fmt)
    if fmt in _ROTATED:
        return _matrix(_rotated("ciou_fixed_weight"), a, b, dtype)
    turn_a, turn_b = [torch.atan((x[..., 2] - x[..., 0]) / (x[..., 3] - x[..., 1])) for x in (a, b)]
    if not (torch.is_grad_enabled() and (a.requires_grad or b.requires_grad)):
        a, b = [torch.cat([x, turn.unsqueeze(-1)], -1) for x, turn in ((a, turn_a), (b, turn_b))]
        return _matrix(_ciou(eps), a, b, dtype)
    aspect = 4 / math.pi**2 * (turn_a.unsqueeze(-1) - turn_b.unsqueeze(-2)) ** 2
    with torch.no_grad():
        weight = aspect / (1 - _iou().pairs(a, b) + aspect + eps)
    return (_diou(eps).pairs(a, b) - weight * aspect).to(dtype)


def _reduced(loss: Tensor, reduction: str) -> Tensor:
    if reduction == "none":
        return loss
    if reduction == "mean":
        return loss.mean() if loss.numel() else 0.0 * loss.sum()
    if reduction == "sum":
        return loss.sum()
    raise ValueError(f"reduction is 'none', 'mean' or 'sum', not {reduction!r}")


def _aligned(boxes1: Tensor, boxes2: Tensor, fmt: str) -> Tuple[Tensor, Tensor, torch.dtype]:
    a, b, dtype = _ready(boxes1, boxes2, fmt)
    if a.shape != b.shape:
        a, b = a + torch.zeros_like(b), b + torch.zeros_like(a)
    return a, b, dtype


def generalized_box_iou_loss(
    boxes1: Tensor, boxes2: Tensor, reduction: str = "none", eps: float = 1e-7, fmt: str = "xyxy"
) -> Tensor:
    """Returns 1 less the generalised IoU of box i of both, 0 to 2, reduced by ``"none"``, ``"mean"`` or ``"sum"``."""
    a, b, dtype = _aligned(boxes1, boxes2, fmt)
    loss = 1 - _rotated("giou").aligned(a, b) if fmt in _ROTATED else _giou_loss(eps).aligned(a, b)
    return _reduced(loss.to(dtype), reduction)


def distance_box_iou_loss(
    boxes1: Tensor, boxes2: Tensor, reduction: str = "none", eps: float = 1e-7, fmt: str = "xyxy"
) -> Tensor:
    """Returns 1 less the distance IoU of box i of both, 0 to 2, reduced by ``"none"``, ``"mean"`` or ``"sum"``."""
    a, b, dtype = _aligned(boxes1, boxes2, fmt)
    loss = 1 - _rotated("diou").aligned(a, b) if fmt in _ROTATED else _diou_loss(eps).aligned(a, b)
    return _reduced(loss.to(dtype), reduction)


def complete_box_iou_loss(
    boxes1: Tensor, boxes2: Tensor, reduction: str = "none", eps: float = 1e-7, fmt: str = "xyxy"
) -> Tensor:
    """Returns 1 less the complete IoU of box i of both, at least 0, reduced by ``"none"``, ``"mean"`` or ``"sum"``."""
    a, b, dtype = _aligned(boxes1, boxes2, fmt)
    if fmt in _ROTATED:
        return _reduced((1 - _rotated("ciou_fixed_weight").aligned(a, b)).to(dtype), reduction)
    with torch.no_grad():
        weight = _weight(eps).aligned(a, b)
    return _reduced(_ciou_loss().aligned(a, b, weight).to(dtype), reduction)


def nms(boxes: Tensor, scores: Tensor, iou_threshold: float, fmt: str = "xyxy") -> Tensor:
    """Returns the places of the boxes that no kept box of a higher score overlaps by more than a threshold.

    The best come first.
    """
    return _suppressed(boxes, scores, None, iou_threshold, fmt)


def batched_nms(boxes: Tensor, scores: Tensor, idxs: Tensor, iou_threshold: float, fmt: str = "xyxy") -> Tensor:
    """Returns what ``nms`` keeps where boxes suppress those of their own class alone: ``idxs`` has the classes."""
    if idxs.shape != scores.shape:
        raise RuntimeError(f"`idxs` has shape {tuple(idxs.shape)}, and `scores` has {tuple(scores.shape)}")
    return _suppressed(boxes, scores, idxs, iou_threshold, fmt)


def _suppressed(boxes: Tensor, scores: Tensor, classes: Any, threshold: float, fmt: str) -> Tensor:
    if fmt not in _WIDTHS:
        raise ValueError(f"fmt is one of {', '.join(_WIDTHS)}, not {fmt!r}")
    if boxes.dim() != 2 or boxes.shape[1] != _WIDTHS[fmt]:
        raise RuntimeError(f"`boxes`: a tensor of shape (N, {_WIDTHS[fmt]}) is needed, not {tuple(boxes.shape)}")
    if scores.dim() != 1 or len(scores) != len(boxes):
        raise RuntimeError(f"`scores`: a tensor of shape ({len(boxes)},) is needed, not {tuple(scores.shape)}")
    dtype = torch.float32 if boxes.dtype in (torch.float16, torch.bfloat16, torch.float32) else torch.float64
    score = _rotated("iou") if fmt in _ROTATED else _upright()
    return score.suppressed(_shaped(boxes.detach(), fmt, dtype), scores.to(torch.float64), threshold, classes)


@kept()
def _upright() -> Score:
    return Score(geograd.iou, "Aabb2")


def box_area(boxes: Tensor, fmt: str = "xyxy") -> Tensor:
    """Returns the areas of boxes, at least 0 for boxes that are some."""
    _checked(boxes, fmt)
    if boxes.is_floating_point():
        boxes = boxes if boxes.dtype in (torch.float32, torch.float64) else boxes.float()
    else:
        boxes = boxes if boxes.dtype in (torch.int32, torch.int64) else boxes.int()
    if fmt == "xyxy":
        return (boxes[..., 2] - boxes[..., 0]) * (boxes[..., 3] - boxes[..., 1])
    if fmt == "xyxyxyxy":
        across, down = boxes[..., 2:4] - boxes[..., :2], boxes[..., 4:6] - boxes[..., 2:4]
        area: Tensor = torch.linalg.vector_norm(across, dim=-1) * torch.linalg.vector_norm(down, dim=-1)
        return area
    return boxes[..., 2] * boxes[..., 3]


def box_convert(boxes: Tensor, in_fmt: str, out_fmt: str) -> Tensor:
    """Returns boxes in another format: upright ones of ``xyxy``, ``xywh``, ``cxcywh``, rotated ones of the other three.

    Rotated integer boxes are rounded. An upright format of rotated boxes, and the reverse, is a NotImplementedError.
    """
    for fmt in (in_fmt, out_fmt):
        if fmt not in _WIDTHS:
            raise ValueError(f"the format of boxes is one of {', '.join(_WIDTHS)}, not {fmt!r}")
    if in_fmt == out_fmt:
        return boxes.clone()
    if (in_fmt in _ROTATED) != (out_fmt in _ROTATED):
        raise NotImplementedError(f"boxes of {in_fmt} have no format {out_fmt}: only one of both is rotated")
    _checked(boxes, in_fmt)
    if in_fmt in _UPRIGHT:
        return _from_corners(_to_corners(boxes, in_fmt), out_fmt)
    if in_fmt != "xywhr":
        boxes = _as(boxes.dtype, _cornered(boxes) if in_fmt == "cxcywhr" else _measured(boxes))
    if out_fmt == "xywhr":
        return boxes
    return _as(boxes.dtype, _centred(boxes) if out_fmt == "cxcywhr" else _four(boxes))


def _as(dtype: torch.dtype, boxes: Tensor) -> Tensor:
    return boxes if dtype.is_floating_point else boxes.round().to(dtype)


def _to_corners(boxes: Tensor, fmt: str) -> Tensor:
    if fmt == "xyxy":
        return boxes
    at, size = boxes[..., :2], boxes[..., 2:]
    if fmt == "xywh":
        return torch.cat([at, at + size], -1)
    return torch.cat([at - 0.5 * size, at + 0.5 * size], -1)


def _from_corners(boxes: Tensor, fmt: str) -> Tensor:
    if fmt == "xyxy":
        return boxes
    low, high = boxes[..., :2], boxes[..., 2:]
    return torch.cat([low if fmt == "xywh" else (low + high) / 2, high - low], -1)


def _turn(degrees: Tensor) -> Tuple[Tensor, Tensor]:
    radians = degrees * (math.pi / 180)
    return radians.cos(), radians.sin()


def _halves(boxes: Tensor) -> Tuple[Tensor, Tensor]:
    """From the first corner to the centre."""
    _, _, width, height, angle = boxes.unbind(-1)
    cos, sin = _turn(angle)
    return width / 2 * cos + height / 2 * sin, height / 2 * cos - width / 2 * sin


def _cornered(boxes: Tensor) -> Tensor:
    x, y = _halves(boxes)
    return torch.cat([torch.stack([boxes[..., 0] - x, boxes[..., 1] - y], -1), boxes[..., 2:].to(x.dtype)], -1)


def _centred(boxes: Tensor) -> Tensor:
    x, y = _halves(boxes)
    return torch.cat([torch.stack([boxes[..., 0] + x, boxes[..., 1] + y], -1), boxes[..., 2:].to(x.dtype)], -1)


def _four(boxes: Tensor) -> Tensor:
    x, y, width, height, angle = boxes.unbind(-1)
    cos, sin = _turn(angle)
    right, down = (width * cos, -width * sin), (height * sin, height * cos)
    corners = [
        x + 0 * cos, y + 0 * cos, x + right[0], y + right[1], x + right[0] + down[0], y + right[1] + down[1],
        x + down[0], y + down[1],
    ]
    return torch.stack(corners, -1)


def _measured(boxes: Tensor) -> Tensor:
    across, down = boxes[..., 2:4] - boxes[..., :2], boxes[..., 4:6] - boxes[..., 2:4]
    angle = torch.atan2(-across[..., 1], across[..., 0]) * (180 / math.pi)
    sizes = [torch.linalg.vector_norm(side.to(angle.dtype), dim=-1) for side in (across, down)]
    return torch.stack([boxes[..., 0].to(angle.dtype), boxes[..., 1].to(angle.dtype), *sizes, angle], -1)
