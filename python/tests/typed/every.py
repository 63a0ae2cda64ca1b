"""A user's script that uses every other submodule, and columns of polygons in torch and JAX; type checkers accept it."""

from __future__ import annotations

import importlib.util
from typing import Any

import jax
import numpy as np
import numpy.typing as npt
import torch

import geograd
import geograd.cuda
import geograd.jax
import geograd.mmrotate
import geograd.torch
import geograd.torchvision
from geograd import assignment, suppression

Numbers = npt.NDArray[np.float64]
SQUARE = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])


def polygons(a: geograd.Polygons, b: geograd.Polygons) -> Numbers:
    shared: geograd.Polygons = geograd.intersection(a, b)
    gap: Numbers = geograd.distance(a, b) + geograd.distance(a, geograd.Obb2([9.0, 9.0, 2.0, 1.0, 0.3]))
    value, (by_a, _) = geograd.union_area.value_grad(a, b)
    inside: Numbers = geograd.contains(a, np.zeros((1, 2)))
    hull: geograd.Polygons = geograd.convex_hull(a)
    total: Numbers = geograd.area(shared) + gap + value + by_a.sum() + inside + geograd.perimeter(hull) + len(a.union_all())
    return total


def on_tensors(x: torch.Tensor) -> torch.Tensor:
    a = geograd.torch.Polygons.rings(x[None])
    b = geograd.torch.Polygons.of([SQUARE + 1], requires_grad=True)
    rings = geograd.torch.Rings(x, [0, 4])
    joined: geograd.torch.Polygons = geograd.torch.union(a, b, valid=True)
    points = torch.ones(1, 2, dtype=torch.float64)
    total: torch.Tensor = geograd.torch.iou(a, b) + geograd.torch.area(joined) + geograd.torch.union_area(a, b)
    total = total + geograd.torch.signed_distance(points, rings) + geograd.torch.contains(a, points)
    return total + geograd.torch.distance(a, torch.tensor([9.0, 9, 2, 1, 0.3]), kind="Obb2") + geograd.torch.length(
        geograd.torch.Polylines.of([SQUARE])
    )


def on_arrays(x: Numbers) -> jax.Array:
    a = geograd.jax.Polygons(x, [[0, 4]])
    rings = geograd.jax.Rings.of([SQUARE])
    found: jax.Array = geograd.jax.iou(a, geograd.Polygons.of([SQUARE + 1])) + geograd.jax.signed_distance(np.ones((1, 2)), rings)
    return found + geograd.jax.union_area(a, a) + geograd.jax.contains(a, np.ones((1, 2))) + geograd.jax.area(rings)


def boxes(a: torch.Tensor, scores: torch.Tensor) -> torch.Tensor:
    upright = geograd.torchvision.box_convert(a[:, :4], "cxcywh", "xyxy")
    kept = geograd.torchvision.nms(upright, scores, 0.5)
    loss: torch.Tensor = geograd.mmrotate.GDLoss("kld")(a, a + 0.1) + geograd.mmrotate.RotatedIoULoss()(a, a + 0.1)
    return loss + geograd.torchvision.generalized_box_iou_loss(upright, upright + 1, reduction="sum") + kept.sum()


def lists(a: geograd.Obb2, scores: Numbers) -> float:
    pairs = geograd.iou.above(a, a, 0.1)
    places, weights = suppression.soft(scores, pairs, sigma=0.5)
    rows, columns = assignment.optimal(geograd.iou.all_pairs(a, a))[:2]
    return float(weights.sum() + places.sum() + len(rows) + len(columns))


def geometries(a: geograd.Polygons) -> int:
    import geograd.geoarrow
    import geograd.shapely

    rings: geograd.Rings = geograd.shapely.rings(a.to_shapely())
    table = geograd.geoarrow.table(rings)
    again: geograd.Rings = geograd.geoarrow.rings(table["geometry"])
    return len(again) + len(geograd.Polygons.from_arrow(a.to_arrow())) + len(geograd.shapely.geometries(rings))


def engines(table: Any) -> str:
    import datafusion

    import geograd.datafusion

    context = datafusion.SessionContext()
    return geograd.datafusion.register(context, "iou", "Obb2", precision="f64")


def trackers(corners: Numbers) -> Numbers:
    import geograd.supervision

    with geograd.supervision.exact():
        overlaps: Numbers = geograd.supervision.oriented_box_iou_batch(corners, corners)
    return overlaps


def validators(a: torch.Tensor, scores: torch.Tensor) -> torch.Tensor:
    import geograd.ultralytics

    kept = geograd.ultralytics.nms(a, scores, 0.5)
    return geograd.ultralytics.batch_probiou(a, a).sum() + kept.sum()


def on_a_card(a: geograd.cuda.OnCard, b: geograd.cuda.Array, own: geograd.Function) -> int:
    """Type checkers read it; it needs a card."""
    overlaps: geograd.cuda.Verb[geograd.cuda.Array] = geograd.cuda.iou
    value, (by_a, _) = overlaps.value_grad(a, b, kind="Obb2")
    again: geograd.cuda.Array = overlaps(by_a, b, kind="Obb2", out=value)
    best, at = overlaps.row_max(a, again, groups=([0, 2], np.array([0, 2])), kind=geograd.Obb2)
    misses = geograd.cuda.function(own)
    total: geograd.cuda.Array = misses.sum(best, at)
    _, along = misses.jvp(a, b, a, b)
    host: Numbers = overlaps.all_pairs(a, total, kind="Obb2").numpy()
    return len(along) + overlaps.count_above(a, b, 0.5, kind="Obb2") + len(host)


def is_there(*names: str) -> bool:
    return all(importlib.util.find_spec(name) is not None for name in names)


column = geograd.Polygons.of([SQUARE])
some = geograd.Obb2(np.array([[0.0, 0.0, 4.0, 2.0, 0.1], [3.0, 1.0, 4.0, 2.0, 0.5]]))
tensor = torch.tensor(some.array, dtype=torch.float32)
print(polygons(column, geograd.Polygons.of([SQUARE + 1])).shape, on_tensors(torch.tensor(SQUARE)).shape, on_arrays(SQUARE).shape)
print(boxes(tensor, torch.ones(2)).shape, lists(some, np.array([0.9, 0.8])) > 0)
if is_there("shapely", "pyarrow"):
    assert geometries(column) == 3
if is_there("datafusion", "pyarrow"):
    assert engines(None)
if is_there("supervision"):
    assert trackers(geograd.corners(some).array.reshape(2, 4, 2)).shape == (2, 2)
if is_there("ultralytics"):
    assert validators(tensor, torch.ones(2)).shape == ()
