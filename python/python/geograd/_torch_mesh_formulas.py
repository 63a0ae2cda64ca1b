"""Derivatives of derivatives along the records of searches, in operations of torch."""

from __future__ import annotations

from typing import Any, Callable, Sequence

import numpy as np
import torch

from geograd._record_formulas import dot, length, over

Tensors = Sequence[torch.Tensor]


def differentiated(value: Callable[..., torch.Tensor], leaves: Tensors, upstream: torch.Tensor) -> list[Any]:
    """The cotangents of tensors, with derivatives of their own; None for a tensor without one."""
    wanted = [k for k, leaf in enumerate(leaves) if leaf.requires_grad]
    out: list[Any] = [None] * len(leaves)
    if wanted:
        computed = value(*(leaf.double() for leaf in leaves)).reshape(upstream.shape)
        of = [leaves[k] for k in wanted]
        for k, bar in zip(wanted, torch.autograd.grad(computed, of, upstream.double(), create_graph=True, allow_unused=True)):
            out[k] = bar
    return out


def border(faces: Any) -> tuple[Any, Any, Any]:
    """The edges that faces pass more often in one direction: starts, ends, and how often more."""
    ends = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    pairs, inverse = np.unique(np.sort(ends, axis=1), axis=0, return_inverse=True)
    times = np.bincount(inverse.reshape(-1), np.where(ends[:, 0] < ends[:, 1], 1, -1), len(pairs)).astype(np.int64)
    kept = (times != 0) & (pairs[:, 0] != pairs[:, 1])
    pairs, times = pairs[kept], times[kept]
    flipped = times < 0
    return np.where(flipped, pairs[:, 1], pairs[:, 0]), np.where(flipped, pairs[:, 0], pairs[:, 1]), np.abs(times)


def swept(faces: Any, upstream: torch.Tensor, points: torch.Tensor, vertices: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
    """The cotangents of points and vertices from those of winding numbers: what the border sweeps.

    With an edge from a to b, seen from a point, and D = |a||b| + a·b, a moved start has b×a / (|a| D), a moved end b×a / (|b| D),
    over 4π.
    """
    start, end, times = border(faces)
    at, seen = points.reshape(-1, 1, 3), vertices.double()
    a, b = (seen[torch.from_numpy(own)] - at for own in (start, end))
    scale = upstream.reshape(-1, 1, 1) * torch.from_numpy(times)[None, :, None] / (4.0 * np.pi)
    normal = torch.linalg.cross(b, a) * scale
    x, y, cosine = length(torch, a), length(torch, b), dot(a, b)
    # Both are equal; one of them has no difference.
    crossed = torch.linalg.cross(a, b)
    divisor = torch.where(cosine < 0.0, over(torch, dot(crossed, crossed), x * y - cosine), x * y + cosine)
    by_start, by_end = over(torch, normal, x * divisor), over(torch, normal, y * divisor)
    by_points = -(by_start + by_end).sum(1).reshape(points.shape)
    zero = torch.zeros_like(seen)
    by_vertices = zero.index_add(0, torch.from_numpy(start), by_start.sum(0)).index_add(0, torch.from_numpy(end), by_end.sum(0))
    return by_points, by_vertices
