"""Stands in for the losses of MMRotate 0.3, as modules of torch with its names and options, and for its angle versions.

Boxes are ``(x, y, width, height, angle)`` in radians, from x towards y, in every angle version.

>>> import torch
>>> from geograd.mmrotate import GDLoss, RotatedIoULoss
>>> pred = torch.tensor([[0.0, 0.0, 4.0, 2.0, 0.3], [9.0, 9.0, 4.0, 2.0, 0.0]], requires_grad=True)
>>> target = torch.tensor([[0.5, 0.0, 4.0, 2.0, 0.0], [9.0, 9.0, 4.0, 2.0, 1.5]])
>>> loss = RotatedIoULoss(mode="linear")(pred, target, weight=torch.tensor([1.0, 0.0]), avg_factor=1)
>>> loss = loss + GDLoss("kld", tau=1.0, reduction="sum")(pred, target)
>>> loss.backward()
>>> pred.grad.shape
torch.Size([2, 5])

A configuration names a loss that is registered: ``ROTATED_LOSSES.register_module(module=RotatedIoULoss, force=True)``.

What the losses measure
    * :class:`GDLoss` and :class:`KFLoss` take a box as a Gaussian whose standard deviations are half its sides: the
      variance along the width is ``width ** 2 / 4``. Ultralytics' probabilistic IoU has ``width ** 2 / 12``.
    * ``GDLoss("kld")`` is the divergence of the target from the prediction, KL(target || prediction): it inverts the
      prediction's covariance. ``GDLoss_v1("kld")`` is twice KL(prediction || target).
    * ``alpha`` weighs the shapes against the centres: offsets count as if they were ``alpha`` times shorter.

Differences from MMRotate
    * The mean of no boxes is 0 with gradient 0, not NaN.
    * Distances of Gaussians keep 1e-7 as the least number under the root of the distance. Floors inside, which change
      the loss of boxes smaller than 0.3, are left out.
    * :class:`GDLoss_v1` takes calls without ``weight``, and reduces.
    * NaN and infinite numbers raise a ValueError that names the row.
"""

from __future__ import annotations

from typing import Any, Callable, Dict, Optional, Tuple

import torch
from torch import Tensor, nn

import geograd

from ._angle_versions import norm_angle, obb2poly, obb2xyxy, one_of, poly2obb, regular
from ._tensors import Score, kept, numbers

__all__ = [
    "GDLoss", "GDLoss_v1", "KFLoss", "RotatedIoULoss", "norm_angle", "obb2poly", "obb2xyxy", "poly2obb", "regular",
]

#: The least number under a root of a distance.
_LEAST = 1e-7


class _Boxes:
    """Distances of boxes ``(x, y, width, height, angle)`` as Gaussians."""

    def __init__(self, alpha: float) -> None:
        self.alpha = alpha

    def _pair(self, p: Any, t: Any) -> Tuple[Any, Any]:
        """Both with the first centre as the origin, and the offset divided by alpha."""
        offset = (t[0] - p[0]) / self.alpha, (t[1] - p[1]) / self.alpha
        return geograd.Obb2(0.0, 0.0, *p[2:5]), geograd.Obb2(*offset, *t[2:5])

    def squared_wasserstein(self, p: Any, t: Any) -> Any:
        return self.alpha**2 * geograd.squared_wasserstein(*self._pair(p, t))

    def divergence(self, p: Any, t: Any) -> Any:
        """KL(t || p)."""
        first, second = self._pair(p, t)
        return geograd.kullback_leibler(second, first)

    def jeffreys(self, p: Any, t: Any) -> Any:
        return geograd.jeffreys(*self._pair(p, t)) / 2

    def bhattacharyya(self, p: Any, t: Any) -> Any:
        return geograd.bhattacharyya(*self._pair(p, t))

    def determinant(self, p: Any) -> Any:
        return (p[2] * p[3] / 4) ** 2


class _Gaussians(_Boxes):
    """Distances of Gaussians ``(x, y, deviation of x, deviation of y, correlation)``."""

    def _covariance(self, p: Any) -> Tuple[Any, Any, Any, Any]:
        determinant = (p[2] * p[3]) ** 2 * (1 - p[4] ** 2)
        return p[2] ** 2, p[3] ** 2, p[4] * p[2] * p[3], determinant

    def squared_wasserstein(self, p: Any, t: Any) -> Any:
        (a, b, c, d), (e, f, g, h) = self._covariance(p), self._covariance(t)
        coupled = a * e + b * f + 2 * c * g + 2 * geograd.sqrt(d * h)
        apart = (p[0] - t[0]) ** 2 + (p[1] - t[1]) ** 2
        return apart + self.alpha**2 * (a + b + e + f - 2 * geograd.sqrt(geograd.maximum(coupled, 0.0)))

    def divergence(self, p: Any, t: Any) -> Any:
        (a, b, c, d), (e, f, g, h) = self._covariance(p), self._covariance(t)
        x, y = p[0] - t[0], p[1] - t[1]
        apart = (b * x * x + a * y * y - 2 * c * x * y) / d
        return (apart / self.alpha**2 + (b * e + a * f - 2 * c * g) / d + geograd.log(d / h)) / 2 - 1

    def jeffreys(self, p: Any, t: Any) -> Any:
        return (self.divergence(p, t) + self.divergence(t, p)) / 2

    def determinant(self, p: Any) -> Any:
        return self._covariance(p)[3]


_KINDS: Dict[str, Callable[[float], _Boxes]] = {"xy_wh_r": _Boxes, "xy_stddev_pearson": _Gaussians}


def _sized(p: Any) -> Any:
    """A box with sides between 1e-7 and 1e7."""
    return [p[0], p[1], geograd.clip(p[2], 1e-7, 1e7), geograd.clip(p[3], 1e-7, 1e7), p[4]]


def _correlated(p: Any) -> Any:
    """A Gaussian whose correlation is below 1."""
    return [*p[:4], geograd.clip(p[4], 1e-7 - 1, 1 - 1e-7)]


def _root(x: Any) -> Any:
    return geograd.sqrt(geograd.maximum(x, _LEAST))


def _eighth(x: Any) -> Any:
    """The eighth root: a length, of a product of two determinants."""
    return geograd.sqrt(geograd.sqrt(geograd.sqrt(x)))


def _log1p(x: Any) -> Any:
    # Distances are 1e-7 and more where their rounding shows.
    return geograd.log(1 + x)


def _shaped(distance: Any, fun: str, tau: float) -> Any:
    """A loss of a distance, as GDLoss has it."""
    if fun == "log1p":
        distance = _log1p(distance)
    elif fun == "sqrt":
        distance = _root(distance)
    return 1 - 1 / (tau + distance) if tau >= 1.0 else distance


@kept("xy_wh_r", "gwd", "log1p", 0.0, 1.0, True)
def _distance_loss(kind: str, loss: str, fun: str, tau: float, alpha: float, own: bool) -> Score:
    """``own`` is the option of the loss: ``normalize`` of gwd, ``sqrt`` of the others."""
    of = _KINDS[kind](alpha)

    def rooted(x: Any) -> Any:
        return _root(x) if own else x

    def distance(p: Any, t: Any) -> Any:
        if loss == "gwd":
            apart = _root(of.squared_wasserstein(p, t))
            if not own:
                return apart
            return apart / (2 * geograd.maximum(_eighth(of.determinant(p) * of.determinant(t)), _LEAST))
        if loss == "kld":
            return rooted(of.divergence(p, t))
        if loss == "jd":
            return rooted(of.jeffreys(p, t))
        both = rooted(of.divergence(p, t)), rooted(of.divergence(t, p))
        return geograd.maximum(*both) if loss == "kld_symmax" else geograd.minimum(*both)

    @numbers(pred=5, target=5)
    def gaussian_loss(p: Any, t: Any) -> Any:
        p, t = (_sized(p), _sized(t)) if kind == "xy_wh_r" else (_correlated(p), _correlated(t))
        return _shaped(distance(p, t), fun, tau)

    return Score(gaussian_loss)


@kept("gwd", "sqrt", 1.0)
def _first_loss(loss: str, fun: str, tau: float) -> Score:
    of = _Boxes(1.0)

    @numbers(pred=5, target=5)
    def gaussian_loss_v1(p: Any, t: Any) -> Any:
        p, t = _sized(p), _sized(t)
        if loss == "gwd":
            distance = of.squared_wasserstein(p, t)
        elif loss == "kld":
            distance = 2 * of.divergence(t, p)
        else:
            distance = of.bhattacharyya(p, t)
        distance = geograd.maximum(distance, 1e-6)
        if loss == "gwd" and not fun:
            return _log1p(geograd.sqrt(distance) / (2 * _eighth(of.determinant(p) * of.determinant(t))))
        if fun == "sqrt":
            distance = geograd.sqrt(distance)
        elif fun == "log1p" or loss == "kld":
            distance = _log1p(distance)
        return 1 - 1 / (tau + distance)

    return Score(gaussian_loss_v1)


@kept("none", 1e-6)
def _filtered(fun: str, eps: float) -> Score:
    @numbers(pred=5, target=5)
    def kfiou_loss(p: Any, t: Any) -> Any:
        p, t = _sized(p), _sized(t)
        area_p, area_t = p[2] * p[3], t[2] * t[3]
        sin2 = geograd.sin(p[4] - t[4]) ** 2
        # The determinant of the sum of both covariances, times 16: a sum of products.
        like, unlike = (p[2] * t[3]) ** 2 + (p[3] * t[2]) ** 2, (p[2] * t[2]) ** 2 + (p[3] * t[3]) ** 2
        whole = area_p**2 + area_t**2 + like * (1 - sin2) + unlike * sin2
        shared = area_p * area_t / geograd.sqrt(whole)
        score = shared / (area_p + area_t - shared + eps)
        if fun == "ln":
            return -geograd.log(score + eps)
        return geograd.exp(1 - score) - 1 if fun == "exp" else 1 - score

    return Score(kfiou_loss)


@kept("log", 1e-6)
def _iou_loss(mode: str, eps: float) -> Score:
    @numbers(pred=5, target=5)
    def rotated_iou_loss(p: Any, t: Any) -> Any:
        # A negative side has no area, and its IoU no gradient.
        made = [geograd.Obb2(x[0], x[1], geograd.maximum(x[2], 0.0), geograd.maximum(x[3], 0.0), x[4]) for x in (p, t)]
        iou = geograd.maximum(geograd.iou(*made), eps)
        if mode == "linear":
            return 1 - iou
        return 1 - iou * iou if mode == "square" else -geograd.log(iou)

    return Score(rotated_iou_loss)


def _floating(x: Tensor) -> Tensor:
    return x if x.dtype in (torch.float32, torch.float64) else x.float()


class _Weighted(nn.Module):
    """A loss of boxes with weights, a mean over a given number, and a reduction for one call."""

    def __init__(self, reduction: str, loss_weight: float) -> None:
        super().__init__()
        one_of("reduction", reduction, ("none", "mean", "sum"))
        self.reduction, self.loss_weight = reduction, loss_weight

    def _loss(self, pred: Tensor, target: Tensor, options: Dict[str, Any]) -> Tensor:
        raise NotImplementedError

    def _weighted(
        self, pred: Tensor, target: Tensor, weight: Optional[Tensor], avg_factor: Optional[float],
        reduction_override: Optional[str], options: Dict[str, Any],
    ) -> Tensor:
        if reduction_override is not None:
            one_of("reduction_override", reduction_override, ("none", "mean", "sum"))
        reduction = reduction_override or self.reduction
        for name, boxes in (("pred", pred), ("target", target)):
            if boxes.dim() != 2 or boxes.shape[1] != 5:
                raise ValueError(f"`{name}`: a tensor of shape (N, 5) is needed, not {tuple(boxes.shape)}")
        if len(pred) != len(target):
            raise ValueError(f"`pred` has {len(pred)} boxes, and `target` has {len(target)}")
        if weight is not None and weight.dim() > 1:
            weight = weight.mean(-1)
        if weight is not None and tuple(weight.shape) != (len(pred),):
            raise ValueError(f"`weight`: one for each of {len(pred)} boxes is needed, not {tuple(weight.shape)}")
        if reduction != "none" and (not len(pred) or (weight is not None and not bool((weight > 0).any()))):
            return (pred * 0).sum()
        loss = self._loss(_floating(pred), _floating(target), options)
        if weight is not None:
            loss = loss * weight
        return self._reduced(loss, reduction, avg_factor) * self.loss_weight

    @staticmethod
    def _reduced(loss: Tensor, reduction: str, avg_factor: Optional[float]) -> Tensor:
        if reduction == "none":
            return loss
        if avg_factor is None:
            return loss.sum() if reduction == "sum" else loss.mean()
        if reduction == "sum":
            raise ValueError("avg_factor goes with reduction='mean', not with 'sum'")
        # The term keeps a mean over no boxes finite.
        return loss.sum() / (avg_factor + torch.finfo(torch.float32).eps)

    def extra_repr(self) -> str:
        own = ", ".join(f"{name}={value!r}" for name, value in self._options().items())
        return f"{own}, reduction={self.reduction!r}, loss_weight={self.loss_weight}"

    def _options(self) -> Dict[str, Any]:
        return {}


class _OfBoxes(_Weighted):
    """A loss of a list of boxes and one of targets."""

    def forward(
        self, pred: Tensor, target: Tensor, weight: Optional[Tensor] = None, avg_factor: Optional[float] = None,
        reduction_override: Optional[str] = None, **options: Any,
    ) -> Tensor:
        """Returns the loss: ``weight`` is one for each box or for each number of it, of which the mean counts.

        ``avg_factor`` stands in for the number of boxes in the mean, ``reduction_override`` for the reduction.
        """
        return self._weighted(pred, target, weight, avg_factor, reduction_override, options)


class RotatedIoULoss(_OfBoxes):
    """The loss of exact IoU: ``1 - iou`` (``"linear"``), ``1 - iou ** 2`` (``"square"``) or ``-log(iou)`` (``"log"``).

    IoU below ``eps`` counts as ``eps``, without a gradient. ``linear=True`` is the mode ``"linear"``.
    """

    def __init__(
        self, linear: bool = False, eps: float = 1e-6, reduction: str = "mean", loss_weight: float = 1.0,
        mode: str = "log",
    ) -> None:
        super().__init__(reduction, loss_weight)
        one_of("mode", mode, ("linear", "square", "log"))
        self.linear, self.eps, self.mode = linear, eps, "linear" if linear else mode

    def _loss(self, pred: Tensor, target: Tensor, options: Dict[str, Any]) -> Tensor:
        mode, eps = options.get("mode", self.mode), options.get("eps", self.eps)
        one_of("mode", mode, ("linear", "square", "log"))
        return _iou_loss(mode, float(eps)).aligned(pred, target)

    def _options(self) -> Dict[str, Any]:
        return {"mode": self.mode, "eps": self.eps}


class GDLoss(_OfBoxes):
    """The loss of a distance of two Gaussians: ``"gwd"``, ``"kld"``, ``"jd"``, ``"kld_symmax"`` or ``"kld_symmin"``.

    ``fun`` is taken of the distance: ``"log1p"``, ``"sqrt"`` or ``"none"``. From ``tau`` 1 on the loss is ``1 - 1 /
    (tau + distance)``. The distance of ``gwd`` is over the size of the boxes unless ``normalize=False``, and that of
    the others is a root unless ``sqrt=False``. ``representation`` is ``"xy_wh_r"`` for boxes, or
    ``"xy_stddev_pearson"``.
    """

    def __init__(
        self, loss_type: str, representation: str = "xy_wh_r", fun: str = "log1p", tau: float = 0.0, alpha: float = 1.0,
        reduction: str = "mean", loss_weight: float = 1.0, **kwargs: Any,
    ) -> None:
        super().__init__(reduction, loss_weight)
        one_of("loss_type", loss_type, ("gwd", "kld", "jd", "kld_symmax", "kld_symmin"))
        one_of("representation", representation, tuple(_KINDS))
        one_of("fun", fun, ("log1p", "none", "sqrt"))
        self.loss_type, self.representation, self.fun = loss_type, representation, fun
        self.tau, self.alpha, self.kwargs = tau, alpha, dict(kwargs)

    def _loss(self, pred: Tensor, target: Tensor, options: Dict[str, Any]) -> Tensor:
        own = bool({**self.kwargs, **options}.get("normalize" if self.loss_type == "gwd" else "sqrt", True))
        score = _distance_loss(self.representation, self.loss_type, self.fun, float(self.tau), float(self.alpha), own)
        if self.representation == "xy_wh_r":
            return score.aligned(pred, target)
        # Its formulas subtract: float32 would show.
        return score.aligned(pred.double(), target.double()).to(pred.dtype)

    def _options(self) -> Dict[str, Any]:
        own = {"representation": self.representation, "fun": self.fun, "tau": self.tau, "alpha": self.alpha}
        return {"loss_type": self.loss_type, **own, **self.kwargs}


class GDLoss_v1(_OfBoxes):
    """The first form of the loss of Gaussians: ``"gwd"``, ``"kld"``, or ``"bcd"`` of the Bhattacharyya distance.

    The loss is ``1 - 1 / (tau + fun(distance))``, where the distances of ``gwd`` and ``kld`` are squares. ``fun`` is
    ``"sqrt"``, ``"log1p"`` or ``""``, which for ``gwd`` is the logarithm of the distance over the size of the boxes.
    """

    def __init__(
        self, loss_type: str, fun: str = "sqrt", tau: float = 1.0, reduction: str = "mean", loss_weight: float = 1.0,
        **kwargs: Any,
    ) -> None:
        super().__init__(reduction, loss_weight)
        one_of("loss_type", loss_type, ("gwd", "kld", "bcd"))
        one_of("fun", fun, ("log1p", "sqrt", ""))
        self.loss_type, self.fun, self.tau, self.kwargs = loss_type, fun, tau, dict(kwargs)

    def _loss(self, pred: Tensor, target: Tensor, options: Dict[str, Any]) -> Tensor:
        return _first_loss(self.loss_type, self.fun, float(self.tau)).aligned(pred, target)

    def _options(self) -> Dict[str, Any]:
        return {"loss_type": self.loss_type, "fun": self.fun, "tau": self.tau}


class KFLoss(_Weighted):
    """The loss of IoU by a Kalman filter, of decoded boxes, and the smooth L1 loss of the encoded centres.

    ``fun`` is ``"none"`` (``1 - kfiou``), ``"ln"`` or ``"exp"``. ``pred`` and ``target`` are encoded: their first two
    numbers count. Without ``pred_decode`` and ``targets_decode`` they are boxes themselves.
    """

    def __init__(self, fun: str = "none", reduction: str = "mean", loss_weight: float = 1.0, **kwargs: Any) -> None:
        super().__init__(reduction, loss_weight)
        one_of("fun", fun, ("none", "ln", "exp"))
        self.fun = fun

    def forward(
        self, pred: Tensor, target: Tensor, weight: Optional[Tensor] = None, avg_factor: Optional[float] = None,
        pred_decode: Optional[Tensor] = None, targets_decode: Optional[Tensor] = None,
        reduction_override: Optional[str] = None, **options: Any,
    ) -> Tensor:
        """Returns the loss: from ``beta`` in ``options`` the L1 loss is linear, ``eps`` is added to areas."""
        options = {"pred_decode": pred_decode, "targets_decode": targets_decode, **options}
        return self._weighted(pred, target, weight, avg_factor, reduction_override, options)

    def _loss(self, pred: Tensor, target: Tensor, options: Dict[str, Any]) -> Tensor:
        decoded = (options["pred_decode"], pred), (options["targets_decode"], target)
        boxes = [x if own is None else own for own, x in decoded]
        beta, eps = options.get("beta", 1 / 9), float(options.get("eps", 1e-6))
        offset = nn.functional.smooth_l1_loss(pred[:, :2], target[:, :2], reduction="none", beta=beta).sum(-1)
        score = _filtered(self.fun, eps).aligned(*[_floating(x) for x in boxes])
        return (offset + score).clamp(0)

    def _options(self) -> Dict[str, Any]:
        return {"fun": self.fun}
