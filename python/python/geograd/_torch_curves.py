"""Paths of lines, circular arcs and Bézier curves on tensors."""

from __future__ import annotations

from typing import Any

import numpy as np
import torch

import geograd
from geograd._torch_host import array, last


class _Measured(torch.autograd.Function):
    """The length or the area of a path."""

    @staticmethod
    def forward(ctx: Any, path: Any, name: str, numbers: torch.Tensor) -> torch.Tensor:
        value, slopes = getattr(path, f"{name}_grad")()
        ctx.name, ctx.slopes = name, torch.from_numpy(np.asarray(slopes)).to(numbers.dtype)
        ctx.save_for_backward(numbers)
        return torch.tensor(value, dtype=numbers.dtype)

    @staticmethod
    def backward(ctx: Any, upstream: torch.Tensor) -> Any:
        return None, None, upstream * last(ctx.name, ctx.slopes, *ctx.saved_tensors)


class _Lengths(torch.autograd.Function):
    """The lengths of the pieces of a path."""

    @staticmethod
    def forward(ctx: Any, path: Any, numbers: torch.Tensor) -> torch.Tensor:
        ctx.path = path
        ctx.save_for_backward(numbers)
        return torch.from_numpy(path.lengths).to(numbers.dtype)

    @staticmethod
    def backward(ctx: Any, upstream: torch.Tensor) -> Any:
        (numbers,) = ctx.saved_tensors
        _, bars = ctx.path.lengths_vjp(upstream.detach().numpy())
        return None, last("lengths", torch.from_numpy(bars).to(numbers.dtype), upstream, numbers)


class _Distance(torch.autograd.Function):
    """The distances of points from a path."""

    @staticmethod
    def forward(ctx: Any, path: Any, points: torch.Tensor, numbers: torch.Tensor) -> torch.Tensor:
        ctx.path, ctx.rows = path, array("points", points, "curves").reshape(-1, 2)
        ctx.save_for_backward(points, numbers)
        return torch.from_numpy(path.distance(ctx.rows)).to(points.dtype).reshape(points.shape[:-1])

    @staticmethod
    def backward(ctx: Any, upstream: torch.Tensor) -> Any:
        points, numbers = ctx.saved_tensors
        bars = np.ascontiguousarray(upstream.detach().numpy().reshape(-1), np.float64)
        by_numbers, by_points = (torch.from_numpy(np.asarray(own)) for own in ctx.path.distance_vjp(ctx.rows, bars))
        parts = by_points.to(points.dtype).reshape(points.shape), by_numbers.to(numbers.dtype)
        return None, *(last("distance", part, upstream, points, numbers) for part in parts)


class CurvePath:
    """A path whose numbers are a tensor, of shape (K,): :class:`geograd.CurvePath` in torch.

    Results have first derivatives by the numbers and by points. It runs on the CPU.

    >>> path = geograd.torch.CurvePath("MAZ", torch.tensor([0.0, 0, 2, 0, 1], requires_grad=True))
    >>> path.area().backward()
    """

    __module__ = "geograd.torch"

    def __init__(self, steps: str, numbers: torch.Tensor) -> None:
        self.column = geograd.CurvePath(steps, array("numbers", numbers, "curves"))
        self.steps, self.numbers = steps, numbers

    def __repr__(self) -> str:
        return f"<geograd.torch.CurvePath {self.steps}>"

    def length(self) -> torch.Tensor:
        """The length of all pieces."""
        found: torch.Tensor = _Measured.apply(self.column, "length", self.numbers)
        return found

    def lengths(self) -> torch.Tensor:
        """The length of each piece, of shape (P,)."""
        found: torch.Tensor = _Lengths.apply(self.column, self.numbers)
        return found

    def area(self) -> torch.Tensor:
        """The signed area of all contours, positive counter-clockwise. A straight line closes those that are open."""
        found: torch.Tensor = _Measured.apply(self.column, "area", self.numbers)
        return found

    def distance(self, points: torch.Tensor) -> torch.Tensor:
        """The distance of each point, of shape (..., 2), from the path; derivative zero on it."""
        if not isinstance(points, torch.Tensor) or points.dim() == 0 or points.shape[-1] != 2:
            raise ValueError("points: a tensor of shape (..., 2) is needed")
        found: torch.Tensor = _Distance.apply(self.column, points, self.numbers)
        return found
