"""Losses of boxes as modules of PyTorch."""

from __future__ import annotations

from typing import Literal, Optional, Union

import torch

import geograd
from geograd import _nodes, _torch

Reduction = Literal["mean", "sum", "none"]
Invalid = Optional[Literal["raise", "nan", "ignore"]]
Factor = Union[float, torch.Tensor, None]

#: The least divisor of a sum of losses.
_LEAST = 1e-7


class Loss(torch.nn.Module):
    """One minus a score of two boxes, reduced: ``Loss("giou", kind="Obb2")``.

    ``reduction`` is ``"mean"``, ``"sum"`` or ``"none"``; the mean of no boxes is 0, with gradient 0. A call takes
    ``prediction`` and ``target``, tensors of boxes; ``weight``, a factor of each box's loss, or one for each of its numbers,
    of which the mean counts; and ``avg_factor``, by which the sum is divided in place of the number of boxes.

    ``invalid`` says what a pair with a number that is infinite or NaN, or with a negative size, gives. ``"raise"`` raises an
    error that names the item. ``"nan"`` gives NaN with gradient NaN, for which ``torch.amp.GradScaler`` skips a step.
    ``"ignore"`` gives 0 with gradient 0, as do pairs of weight 0 then. By default pairs raise, under ``torch.autocast`` they
    are NaN. On CUDA nothing raises: pairs are not checked unless ``invalid`` is ``"nan"`` or ``"ignore"``.

    Half precision is computed in float32. The module has no parameters and no state.
    """

    def __init__(self, verb: str, kind: str = "Obb2", reduction: Reduction = "mean", invalid: Invalid = None) -> None:
        super().__init__()
        if reduction not in ("mean", "sum", "none"):
            raise ValueError(f"reduction is 'mean', 'sum' or 'none', not {reduction!r}")
        if invalid not in (None, "raise", "nan", "ignore"):
            raise ValueError(f"invalid is 'raise', 'nan', 'ignore' or None, not {invalid!r}")
        self.verb, self.kind, self.reduction, self.invalid = verb, kind, reduction, invalid
        node = _nodes.of_verb(verb, kind, 2)
        self._shapes = tuple(node.base.kinds)

    def forward(
        self,
        prediction: torch.Tensor,
        target: torch.Tensor,
        weight: Optional[torch.Tensor] = None,
        avg_factor: Factor = None,
    ) -> torch.Tensor:
        invalid = getattr(self, "invalid", None)
        if invalid is None:
            invalid = "nan" if torch.is_autocast_enabled(prediction.device.type) else "raise"
        prediction, target = _torch.tensors(self.verb, (prediction, target), casts=True)
        if invalid == "raise":
            is_plain = not torch.compiler.is_compiling() and type(self)._of is Loss._of
            if is_plain and self.reduction != "none" and weight is None and avg_factor is None:
                found = _torch.reduced_less(self.verb, self.kind, self.reduction == "mean", (prediction, target))
                if found is not None:
                    return found
            return self._reduced(self._of(prediction, target), weight, avg_factor)
        shapes = getattr(self, "_shapes", (self.kind, self.kind))
        valid = _torch.valid(shapes[0], prediction) & _torch.valid(shapes[1], target)
        if invalid == "ignore" and weight is not None:
            valid = valid & (_of_boxes(weight, valid) != 0)
        # Pairs that are not valid become those of a box with itself, which every loss takes.
        box = prediction.new_tensor(_SOME[prediction.shape[-1]])
        loss = self._of(torch.where(valid[..., None], prediction, box), torch.where(valid[..., None], target, box))
        if invalid == "nan":
            # A factor of NaN by all numbers: their gradients are NaN, too.
            factor = torch.where(valid, 0.0, torch.nan).to(loss.dtype)[..., None]
            loss = loss + ((prediction + target) * factor).sum(-1)
        else:
            loss = torch.where(valid, loss, loss.new_zeros(()))
        return self._reduced(loss, weight, avg_factor)

    def _of(self, prediction: torch.Tensor, target: torch.Tensor) -> torch.Tensor:
        """The loss of every pair."""
        return 1 - self._score(prediction, target)

    def _score(self, prediction: torch.Tensor, target: torch.Tensor) -> torch.Tensor:
        found: torch.Tensor = _torch.of_verb(self.verb, (prediction, target), self.kind)
        return found

    def _reduced(self, loss: torch.Tensor, weight: Optional[torch.Tensor], avg_factor: Factor) -> torch.Tensor:
        if weight is not None:
            loss = loss * _of_boxes(weight, loss)
        if avg_factor is not None:
            if self.reduction == "sum":
                raise ValueError("avg_factor is for the reductions 'mean' and 'none': it divides the sum of a mean")
            if self.reduction == "none":
                return loss
            # The factor of no boxes is 0, and so is the loss.
            tensor = isinstance(avg_factor, torch.Tensor)
            return loss.sum() / (avg_factor.clamp(min=_LEAST) if tensor else max(avg_factor, _LEAST))
        if self.reduction == "none":
            return loss
        # An image without objects has no boxes, and its loss is no number less.
        return loss.sum() / max(loss.numel(), 1) if self.reduction == "mean" else loss.sum()

    def extra_repr(self) -> str:
        invalid = "" if self.invalid is None else f", invalid={self.invalid!r}"
        return f"{self.verb!r}, kind={self.kind!r}, reduction={self.reduction!r}{invalid}"


#: Boxes that every loss takes, by how many numbers they have: Interval, Aabb2, Obb2, Aabb3, YawBox3, Obb3.
_SOME = {
    2: [0.0, 1.0],
    4: [0.0, 0.0, 1.0, 1.0],
    5: [0.0, 0.0, 1.0, 1.0, 0.0],
    6: [0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
    7: [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0],
    10: [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0],
}


def _of_boxes(weight: torch.Tensor, loss: torch.Tensor) -> torch.Tensor:
    """A weight of each box: where each of its numbers has one, their mean."""
    return weight.mean(-1) if weight.dim() == loss.dim() + 1 else weight


class IoULoss(Loss):
    """One minus :func:`geograd.iou`, reduced: from 0 to 1, without gradient for boxes apart. See :class:`Loss`."""

    def __init__(self, kind: str = "Obb2", reduction: Reduction = "mean", invalid: Invalid = None) -> None:
        super().__init__("iou", kind, reduction, invalid)


class GIoULoss(Loss):
    """One minus :func:`geograd.giou`, reduced: from 0 to 2. See :class:`Loss`.

    Of rotated boxes (``Obb2``) it takes the convex hull of both, of upright ones (``Aabb2``) the box around both.
    """

    def __init__(self, kind: str = "Obb2", reduction: Reduction = "mean", invalid: Invalid = None) -> None:
        super().__init__("giou", kind, reduction, invalid)


class DIoULoss(Loss):
    """One minus :func:`geograd.diou`, reduced: the IoU less a share of the distance of centres. See :class:`Loss`."""

    def __init__(self, kind: str = "Obb2", reduction: Reduction = "mean", invalid: Invalid = None) -> None:
        super().__init__("diou", kind, reduction, invalid)


class CIoULoss(Loss):
    """One minus :func:`geograd.ciou`, reduced: :class:`DIoULoss` and one of aspects, whose weight has a derivative.

    ``Loss("ciou_fixed_weight")`` takes the weight as a constant, as torchvision does. See :class:`Loss`.
    """

    def __init__(self, kind: str = "Obb2", reduction: Reduction = "mean", invalid: Invalid = None) -> None:
        super().__init__("ciou", kind, reduction, invalid)


class EIoULoss(Loss):
    """One minus :func:`geograd.eiou`, reduced: :class:`DIoULoss` and those of width and height. See :class:`Loss`."""

    def __init__(self, kind: str = "Obb2", reduction: Reduction = "mean", invalid: Invalid = None) -> None:
        super().__init__("eiou", kind, reduction, invalid)


class ProbIoULoss(Loss):
    """One minus :func:`geograd.probiou`, reduced: Hellinger's distance of Gaussians of variances ``size ** 2 / 12``.

    See :class:`Loss`.
    """

    def __init__(self, kind: str = "Obb2", reduction: Reduction = "mean", invalid: Invalid = None) -> None:
        super().__init__("probiou", kind, reduction, invalid)


#: The size at which the smooth L1 loss of centres becomes linear, of mmrotate.
_BETA = 1 / 9


class KFIoULoss(Loss):
    """The loss of shapes by :func:`geograd.kfiou` and that of centres (Yang et al. 2023), reduced: 0 for equal boxes.

    ``kfiou`` is blind to centres and at most 1/3 (of boxes in space ``1 / (2 ** 2.5 - 1)``), so its part of the loss is
    that bound less ``kfiou``: the gradient is that of ``1 - kfiou``. Boxes are Gaussians whose standard deviations are half
    the sizes. The part of centres is ``centers`` times the smooth L1 loss, linear from 1/9, of their offset along the
    target's axes, over the target's size. The paper and mmrotate measure it from anchors, which a loss of boxes has not.
    ``centers=0`` leaves it out; another loss has to place boxes then. ``Loss("kfiou")`` is plainly ``1 - kfiou``.
    """

    def __init__(
        self, kind: str = "Obb2", reduction: Reduction = "mean", centers: float = 1.0, invalid: Invalid = None
    ) -> None:
        super().__init__("kfiou", kind, reduction, invalid)
        self.centers = centers
        node = _nodes.of_verb("kfiou", kind, 2)
        self._is_flat = len(getattr(geograd, node.base.kinds[0])._fields) == 5
        self._bound = 1 / 3 if self._is_flat else 1 / (2**2.5 - 1)

    def _of(self, prediction: torch.Tensor, target: torch.Tensor) -> torch.Tensor:
        # Rounding alone makes the first part negative.
        loss = (self._bound - self._score(prediction, target)).clamp(min=0)
        if self.centers:
            loss = loss + self.centers * self._apart(prediction, target)
        return loss

    def _apart(self, prediction: torch.Tensor, target: torch.Tensor) -> torch.Tensor:
        """The smooth L1 loss of the offset of centres, summed over the axes."""
        if self._is_flat:
            heading = target[..., 4]
            axes = _turned(prediction[..., :2] - target[..., :2], heading.cos(), heading.sin())
            size = target[..., 2:4]
        else:
            axes = _in_frame(prediction[..., :3] - target[..., :3], target[..., 6:10])
            size = target[..., 3:6]
        # A flat target has no share of an offset across it: its unit is that of length.
        share = (axes / torch.where(size > 0, size, torch.ones_like(size))).abs()
        return torch.where(share < _BETA, share * share * (0.5 / _BETA), share - 0.5 * _BETA).sum(-1)

    def extra_repr(self) -> str:
        return f"{super().extra_repr()}, centers={self.centers}"


def _turned(offset: torch.Tensor, cos: torch.Tensor, sin: torch.Tensor) -> torch.Tensor:
    """A vector of the plane in a frame whose first axis is (cos, sin)."""
    x, y = offset[..., 0], offset[..., 1]
    return torch.stack([cos * x + sin * y, cos * y - sin * x], -1)


def _in_frame(offset: torch.Tensor, quaternion: torch.Tensor) -> torch.Tensor:
    """A vector of space in the frame that a quaternion of any length (w, x, y, z) turns to."""
    unit = quaternion / quaternion.norm(dim=-1, keepdim=True)
    w, v = unit[..., :1], -unit[..., 1:]
    offset, v = torch.broadcast_tensors(offset, v)
    twice = 2 * torch.linalg.cross(v, offset)
    return offset + w * twice + torch.linalg.cross(v, twice)


class _Distance(Loss):
    """A loss of a distance ``d`` of boxes as Gaussians: ``1 - 1 / (tau + f(d))``, or ``f(d)`` for ``tau`` below 1."""

    def __init__(
        self, verb: str, kind: str, reduction: Reduction, fun: str, tau: float, invalid: Invalid
    ) -> None:
        super().__init__(verb, kind, reduction, invalid)
        if fun not in ("log1p", "sqrt", "none"):
            raise ValueError(f"fun is 'log1p', 'sqrt' or 'none', not {fun!r}")
        self.fun, self.tau = fun, tau

    def _of(self, prediction: torch.Tensor, target: torch.Tensor) -> torch.Tensor:
        distance = self._distance(prediction, target)
        if self.fun == "log1p":
            distance = distance.log1p()
        elif self.fun == "sqrt":
            distance = _root(distance)
        return 1 - 1 / (self.tau + distance) if self.tau >= 1 else distance

    def _distance(self, prediction: torch.Tensor, target: torch.Tensor) -> torch.Tensor:
        raise NotImplementedError

    def extra_repr(self) -> str:
        return f"{super().extra_repr()}, fun={self.fun!r}, tau={self.tau}"


def _root(x: torch.Tensor) -> torch.Tensor:
    """The square root, with derivative zero at zero, where boxes are equal."""
    positive = x > 0
    return torch.where(positive, torch.where(positive, x, 1.0).sqrt(), 0.0)


class GWDLoss(_Distance):
    """The loss by :func:`geograd.wasserstein`, the distance of boxes as Gaussians (Yang et al. 2021), as mmrotate's: 0 for
    equal boxes, below 1.

    Standard deviations are half the sizes. ``normalize`` divides the distance by the geometric mean of all sizes, which
    makes it independent of the scale. ``fun`` is ``"log1p"``, ``"sqrt"`` or ``"none"``, ``f`` of the loss
    ``1 - 1 / (tau + f(distance))``; below 1 ``tau`` means ``f(distance)``. See :class:`Loss`.
    """

    def __init__(
        self,
        kind: str = "Obb2",
        reduction: Reduction = "mean",
        fun: str = "log1p",
        tau: float = 1.0,
        normalize: bool = True,
        invalid: Invalid = None,
    ) -> None:
        super().__init__("wasserstein", kind, reduction, fun, tau, invalid)
        self.normalize = normalize

    def _distance(self, prediction: torch.Tensor, target: torch.Tensor) -> torch.Tensor:
        distance = self._score(prediction, target)
        if not self.normalize:
            return distance
        sizes = slice(2, 4) if prediction.shape[-1] == 5 else slice(3, 6)
        product = prediction[..., sizes].prod(-1) * target[..., sizes].prod(-1)
        # A box without area has no scale.
        product = torch.where(product > 0, product, 1.0)
        return distance / product ** (0.5 / (sizes.stop - sizes.start))

    def extra_repr(self) -> str:
        return f"{super().extra_repr()}, normalize={self.normalize}"


class KLDLoss(_Distance):
    """The loss by :func:`geograd.kullback_leibler`, the divergence of boxes as Gaussians (Yang et al. 2021), as mmrotate's:
    of the target from the prediction, whose covariance is inverted; 0 for equal boxes, below 1.

    Standard deviations are half the sizes. ``sqrt`` takes the divergence's root. ``fun`` is ``"log1p"``, ``"sqrt"`` or
    ``"none"``, ``f`` of the loss ``1 - 1 / (tau + f(divergence))``; below 1 ``tau`` means ``f(divergence)``. See
    :class:`Loss`.
    """

    def __init__(
        self,
        kind: str = "Obb2",
        reduction: Reduction = "mean",
        fun: str = "log1p",
        tau: float = 1.0,
        sqrt: bool = True,
        invalid: Invalid = None,
    ) -> None:
        super().__init__("kullback_leibler", kind, reduction, fun, tau, invalid)
        self.sqrt = sqrt

    def _distance(self, prediction: torch.Tensor, target: torch.Tensor) -> torch.Tensor:
        divergence = self._score(target, prediction)
        return _root(divergence) if self.sqrt else divergence

    def extra_repr(self) -> str:
        return f"{super().extra_repr()}, sqrt={self.sqrt}"


for _made in (
    Loss, IoULoss, GIoULoss, DIoULoss, CIoULoss, EIoULoss, ProbIoULoss, KFIoULoss, _Distance, GWDLoss, KLDLoss
):
    # The place at which users find them, and pickle does.
    if not _made.__name__.startswith("_"):
        _made.__module__ = "geograd.torch"
