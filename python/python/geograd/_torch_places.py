"""The weights of corners around places, on tensors."""

from __future__ import annotations

from functools import partial
from typing import Any, NamedTuple

import numpy as np
import torch

import geograd
from geograd._record_formulas import weights
from geograd._torch_host import array, differentiated


class PlaceWeights(NamedTuple):
    """For each of M places the points of the triangle that contains it, and their weights."""

    #: The numbers of the points, of shape (M, 3).
    corners: torch.Tensor
    #: The weights, of shape (M, 3): from 0 to 1 with the sum 1, zeros outside of all triangles.
    weights: torch.Tensor


class _Weighed(torch.autograd.Function):
    @staticmethod
    def forward(ctx: Any, made: Any, points: torch.Tensor, places: torch.Tensor) -> Any:
        ctx.made, ctx.rows = made, array("places", places, "triangulations")
        triangles, found = made.barycentric(ctx.rows)
        ctx.inside = torch.from_numpy(triangles >= 0)
        ctx.corners = torch.from_numpy(made._corners(triangles))
        ctx.save_for_backward(points, places)
        ctx.mark_non_differentiable(ctx.corners)
        return ctx.corners, torch.from_numpy(found).to(places.dtype)

    @staticmethod
    def backward(ctx: Any, _: Any, upstream: torch.Tensor) -> Any:
        points, places = ctx.saved_tensors
        if torch.is_grad_enabled():
            again = partial(weights, torch, ctx.corners, ctx.inside)
            return None, *differentiated(again, (points, places), upstream)
        bars = np.ascontiguousarray(upstream.numpy(), np.float64)
        by_points, by_places = ctx.made.barycentric_vjp(ctx.rows, bars)
        return None, torch.from_numpy(by_points).to(points.dtype), torch.from_numpy(by_places).to(places.dtype)


def barycentric(points: torch.Tensor, places: torch.Tensor) -> PlaceWeights:
    """Points around places in the Delaunay triangulation of points, and their weights: :meth:`geograd.Delaunay.barycentric` in torch.

    ``points`` has the shape (N, 2), ``places`` (M, 2). Weights have derivatives of any order by both; decisions are exact, and
    the triangulation is fixed between them. The mean of numbers at the points by these weights is their linear interpolation.

    >>> heights = torch.tensor([10.0, 20.0, 30.0])
    >>> points = torch.tensor([[0.0, 0], [4, 0], [0, 4]], requires_grad=True)
    >>> corners, weights = geograd.torch.barycentric(points, torch.tensor([[1.0, 2]]))
    >>> (heights[corners] * weights).sum().backward()
    """
    rows = array("points", points, "triangulations")
    if array("places", places, "triangulations").ndim != 2 or places.shape[1] != 2:
        raise ValueError(f"places: a tensor of shape (M, 2) is needed, not {tuple(places.shape)}")
    made = geograd.Delaunay(rows)
    return PlaceWeights(*_Weighed.apply(made, points, places))  # type: ignore[no-untyped-call]
