"""A user's script, which type checkers accept in their strict modes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import torch

import geograd
import geograd.arrow
import geograd.jax
import geograd.ray
import geograd.torch
from geograd import assignment, metric

Numbers = npt.NDArray[np.float64]


class Gap(NamedTuple):
    car: geograd.Obb2
    margin: float


@geograd.function
def clearance(point: geograd.Vec2, gap: Gap, scale: float = 1.0) -> geograd.Symbol:
    near: geograd.Symbol = geograd.distance(point, gap.car, kind=("Vec2", "Obb2"))
    return geograd.tanh(geograd.maximum(near - gap.margin, 0.0) * scale)


def overlaps(a: geograd.Obb2, b: geograd.Obb2) -> Numbers:
    value, (by_a, by_b) = geograd.iou.value_grad(a, b)
    matrix: Numbers = geograd.iou.all_pairs(a, b)
    best, places = geograd.iou.row_max(a, b, groups=([0, 2], [0, 2]))
    kept = geograd.iou.suppress(a, np.ones(len(a)), 0.5, most=10)
    total: Numbers = value + by_a.sum() + by_b.sum() + matrix.max() + best[places >= 0].sum() + kept.sum()
    return total


def corners(boxes: geograd.Obb2) -> list[float]:
    turned: geograd.Le90 = geograd.convert(geograd.ImageBox(boxes.array), to="Le90")
    return [float(box.array[0]) for box in boxes] + [float(turned.center.x[0])]


def paths(lines: list[Numbers]) -> Numbers:
    rings = geograd.Rings.of(lines)
    border: Numbers = geograd.perimeter(rings[:1])
    inside: Numbers = geograd.signed_distance(geograd.Vec2(rings[0][:1]), rings)
    angle: float = geograd.arctan2(1.0, 2.0)
    return border + inside + angle


def train(boxes: torch.Tensor, target: torch.Tensor) -> torch.Tensor:
    loss = geograd.torch.GIoULoss(reduction="sum", invalid="nan")
    other = geograd.torch.GWDLoss(fun="sqrt", tau=2.0)
    total: torch.Tensor = loss(boxes, target, weight=torch.ones(2)) + other(boxes, target)
    own = geograd.torch.function(clearance)
    score = geograd.torch.iou(boxes, target, kind="Obb2").sum() + geograd.torch.iou.all_pairs(boxes, target, kind=geograd.Obb2).max()
    far: torch.Tensor = own(boxes[:, :2], torch.ones(6), torch.tensor(1.0)).sum()
    return total + score + far


def judge(scores: Numbers, a: geograd.Obb2, b: geograd.Obb2) -> float:
    pairs = geograd.iou.above(a, b, 0.5)
    first, _, _ = assignment.largest(pairs)
    found = metric.outcomes(scores, 3, pairs, 0.5)
    apply = geograd.ray.apply("iou", ["a", "b"], "Obb2")
    geograd.arrow.column(a, layout="struct")
    jax_loss = geograd.jax.giou_loss(a.array, b.array, reduction="mean")
    return metric.average_precision(metric.curve(scores, found, 3), "forty") + float(jax_loss) + len(first) + len(apply.columns)


geograd.set_num_threads(1)
some = geograd.Obb2(np.array([[0.0, 0.0, 4.0, 2.0, 0.1], [3.0, 1.0, 4.0, 2.0, 0.5], [9.0, 1.0, 4.0, 2.0, 0.5]]))
tensor = torch.tensor(some.array, dtype=torch.float32)[:2]
print(overlaps(some[:2], some[:2]).shape, len(corners(some)), paths([np.eye(3, 2)]).shape, train(tensor, tensor + 0.1).shape)
print(judge(np.array([0.9, 0.8, 0.7]), some, some) > 3, geograd.check(clearance, quiet=True).passed)
