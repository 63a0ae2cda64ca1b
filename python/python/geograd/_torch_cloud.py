"""Clouds of points on tensors: distances with gradients for queries and points."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import torch

import geograd
from geograd import _record_formulas as formulas
from geograd._torch_host import differentiated
from geograd._torch_mesh import _array, _like


class _Nearest(torch.autograd.Function):
    """The distance of queries from their nearest points."""

    @staticmethod
    def forward(ctx: Any, core: Any, squared: bool, queries: torch.Tensor, points: torch.Tensor) -> torch.Tensor:
        rows = _array("queries", queries)
        found = core.search(rows)
        ctx.core, ctx.squared, ctx.rows, ctx.found = core, squared, rows, found
        ctx.save_for_backward(queries, points)
        return torch.from_numpy(core.distances(squared, rows, found)).to(queries.dtype).reshape(queries.shape[:-1])

    @staticmethod
    def backward(ctx: Any, upstream: torch.Tensor) -> Any:
        if torch.is_grad_enabled():
            again = partial(formulas.gaps, torch, ctx.squared, torch.from_numpy(ctx.found))
            return None, None, *differentiated(again, ctx.saved_tensors, upstream)
        bars = np.ascontiguousarray(upstream.detach().numpy().reshape(-1), np.float64)
        parts = ctx.core.distances(ctx.squared, ctx.rows, ctx.found, bars)
        return None, None, *(_like(part, own) for part, own in zip(parts, ctx.saved_tensors))


class _Chamfer(torch.autograd.Function):
    """The Chamfer distance of two clouds."""

    @staticmethod
    def forward(ctx: Any, cores: Any, squared: bool, first: torch.Tensor, second: torch.Tensor) -> torch.Tensor:
        ctx.cores, ctx.squared = cores, squared
        ctx.save_for_backward(first, second)
        return torch.tensor(cores[0].chamfer(cores[1], squared), dtype=first.dtype)

    @staticmethod
    def backward(ctx: Any, upstream: torch.Tensor) -> Any:
        if torch.is_grad_enabled():
            own, other = ctx.cores
            first, second = ctx.saved_tensors
            found = [torch.from_numpy(core.search(_array("points", points))) for core, points in ((other, first), (own, second))]

            def again(first: torch.Tensor, second: torch.Tensor) -> Any:
                there = formulas.gaps(torch, ctx.squared, found[0], first, second).mean()
                return there + formulas.gaps(torch, ctx.squared, found[1], second, first).mean()

            return None, None, *differentiated(again, ctx.saved_tensors, upstream)
        parts = ctx.cores[0].chamfer(ctx.cores[1], ctx.squared, upstream.item())
        return None, None, *(_like(part, own) for part, own in zip(parts, ctx.saved_tensors))


class Cloud:
    """A cloud whose points are a tensor, of shape (P, 3): :class:`geograd.Cloud` in torch.

    Results have first and second derivatives by the queries and by the points. Sums have the same bits every time. Of two points that are
    equally near, the lower one has the derivative. It runs on the CPU.

    >>> points = torch.rand(100, 3, requires_grad=True)
    >>> geograd.torch.Cloud(points).chamfer(geograd.torch.Cloud(torch.rand(80, 3))).backward()
    """

    __module__ = "geograd.torch"

    def __init__(self, points: torch.Tensor) -> None:
        self.column = geograd.Cloud(_array("points", points))
        self.points = points

    def __repr__(self) -> str:
        return f"<geograd.torch.{repr(self.column)[len('<geograd.'):]}"

    def distance(self, queries: torch.Tensor) -> torch.Tensor:
        """The distance of each query from its nearest point; derivative zero at a point."""
        found: torch.Tensor = _Nearest.apply(self.column._core, False, queries, self.points)
        return found

    def squared_distance(self, queries: torch.Tensor) -> torch.Tensor:
        """The squared distance of each query from its nearest point."""
        found: torch.Tensor = _Nearest.apply(self.column._core, True, queries, self.points)
        return found

    def chamfer(self, other: Cloud, *, squared: bool = True) -> torch.Tensor:
        """The mean squared distance of these points from the other cloud, plus that of the other cloud's points from this one."""
        cores = self.column._core, other.column._core
        found: torch.Tensor = _Chamfer.apply(cores, squared, self.points, other.points)
        return found

    def hausdorff(self, other: Cloud) -> torch.Tensor:
        """The largest distance of a point of either cloud from the other one; the pair that decides it has the derivative."""
        _, own, second = self.column.hausdorff(other.column)
        return torch.linalg.vector_norm(self.points[own] - other.points[second])
