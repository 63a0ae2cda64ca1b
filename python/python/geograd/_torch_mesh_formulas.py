"""What queries of a mesh compute along the records of their searches, in operations of torch: derivatives of any order."""

from __future__ import annotations

from typing import Any, Callable, Sequence

import numpy as np
import torch

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


def _dot(a: torch.Tensor, b: torch.Tensor) -> torch.Tensor:
    return (a * b).sum(-1, keepdim=True)


def _over(a: torch.Tensor, b: torch.Tensor) -> torch.Tensor:
    """A quotient, zero where the divisor is."""
    none = b == 0.0
    return torch.where(none, torch.zeros_like(a), a / torch.where(none, torch.ones_like(b), b))


def _length(v: torch.Tensor) -> torch.Tensor:
    """Lengths; of zero with derivative zero."""
    square = _dot(v, v)
    none = square == 0.0
    return torch.where(none, torch.zeros_like(square), torch.where(none, torch.ones_like(square), square).sqrt())


def nearest(kind: str, faces: Any, found: Any, signs: Any, points: torch.Tensor, vertices: torch.Tensor) -> torch.Tensor:
    """Distances of points with signs, or their closest points, along records: a face and a feature each."""
    points = points.reshape(-1, 3)
    corners = vertices[torch.from_numpy(faces[found[:, 0]])]
    a, b, c = corners.unbind(1)
    code = torch.from_numpy(found[:, 1])
    each = torch.arange(len(code))
    edge = (code - 4).clamp(min=0)
    start, end = corners[each, edge // 3], corners[each, edge % 3]
    along = end - start
    on_edge = start + along * _over(_dot(points - start, along), _dot(along, along))
    at_corner = corners[each, (code - 1).clamp(0, 2)]
    normal = torch.linalg.cross(b - a, c - a)
    inside, is_corner = (code == 0)[:, None], (code <= 3)[:, None]
    border = torch.where(is_corner, at_corner, on_edge)
    if kind == "closest":
        flat = points - normal * _over(_dot(points - a, normal), _dot(normal, normal))
        return torch.where(inside, flat, border)
    height = _over(_dot(points - a, normal), _length(normal))
    if kind == "squared_distance":
        return torch.where(inside, height * height, _dot(points - border, points - border)).squeeze(-1)
    length = _length(points - border)
    if kind == "distance":
        return torch.where(inside, height * height.detach().sign(), length).squeeze(-1)
    # On a face of a closed mesh the normal points outward.
    side = (height.detach() * signs[:, None]).sign()
    if kind == "signed_distance":
        side = torch.where(side == 0.0, torch.ones_like(side), side)
    return torch.where(inside, height * side, length * signs[:, None]).squeeze(-1)


def parameters(faces: Any, hits: Any, starts: torch.Tensor, directions: torch.Tensor, vertices: torch.Tensor) -> torch.Tensor:
    """The parameters at which rays meet faces; zero, without derivatives, for a miss."""
    missed = torch.from_numpy(hits < 0)[:, None]
    starts, directions = starts.reshape(-1, 3), directions.reshape(-1, 3)
    a, b, c = vertices[torch.from_numpy(faces[np.maximum(hits, 0)])].unbind(1)
    normal = torch.linalg.cross(b - a, c - a)
    step = _over(_dot(a - starts, normal), _dot(directions, normal))
    return torch.where(missed, torch.zeros_like(step), step).squeeze(-1)


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
    x, y, cosine = _length(a), _length(b), _dot(a, b)
    # Both are equal; one of them has no difference.
    crossed = torch.linalg.cross(a, b)
    divisor = torch.where(cosine < 0.0, _over(_dot(crossed, crossed), x * y - cosine), x * y + cosine)
    by_start, by_end = _over(normal, x * divisor), _over(normal, y * divisor)
    by_points = -(by_start + by_end).sum(1).reshape(points.shape)
    zero = torch.zeros_like(seen)
    by_vertices = zero.index_add(0, torch.from_numpy(start), by_start.sum(0)).index_add(0, torch.from_numpy(end), by_end.sum(0))
    return by_points, by_vertices
