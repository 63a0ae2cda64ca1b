"""Rotated boxes in the angle versions of MMRotate: oc, le90 and le135."""

from __future__ import annotations

import math
from typing import Any, Tuple

import torch
from torch import Tensor

_VERSIONS = {"oc": (0.0, math.pi / 2), "le90": (-math.pi / 2, math.pi), "le135": (-math.pi / 4, math.pi)}


def one_of(name: str, value: Any, known: Tuple[Any, ...]) -> None:
    if value not in known:
        raise ValueError(f"{name} is one of {', '.join(map(repr, known))}, not {value!r}")


def norm_angle(angle: Tensor, angle_range: str) -> Tensor:
    """Returns angles in the range of a version: [-pi/2, pi/2) for le90, [-pi/4, 3pi/4) for le135, any for oc."""
    one_of("angle_range", angle_range, tuple(_VERSIONS))
    low, period = _VERSIONS[angle_range]
    return angle if angle_range == "oc" else (angle - low) % period + low


def regular(boxes: Tensor, version: str = "oc") -> Tensor:
    """Returns the same rectangles in the form of a version.

    In le90 and le135 the width is the longer side; in oc the angle is in [0, pi/2).
    """
    one_of("version", version, tuple(_VERSIONS))
    low, period = _VERSIONS[version]
    x, y, width, height, angle = boxes.unbind(-1)
    if version == "oc":
        quarters = torch.floor(angle / period)
        turned = quarters % 2 == 1
        angle = (angle - quarters * period).clamp(min=0)
    else:
        turned = width < height
        angle = norm_angle(torch.where(turned, angle + math.pi / 2, angle), version)
    return torch.stack([x, y, torch.where(turned, height, width), torch.where(turned, width, height), angle], -1)


def poly2obb(polys: Tensor, version: str = "oc") -> Tensor:
    """Returns the boxes of four corners of rectangles, (N, 8) to (N, 5), in the form of a version."""
    corners = polys.reshape(-1, 4, 2)
    across, down = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 1]
    sizes = [torch.linalg.vector_norm(side, dim=-1) for side in (across, down)]
    angle = torch.atan2(across[:, 1], across[:, 0])
    return regular(torch.stack([*corners.mean(1).unbind(-1), *sizes, angle], -1), version)


def obb2poly(rboxes: Tensor, version: str = "oc") -> Tensor:
    """Returns the four corners of boxes, (N, 5) to (N, 8), which are the same in every version."""
    one_of("version", version, tuple(_VERSIONS))
    x, y, width, height, angle = rboxes.unbind(-1)
    cos, sin = angle.cos() / 2, angle.sin() / 2
    across, down = (width * cos, width * sin), (-height * sin, height * cos)
    signs = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    return torch.stack([at + i * across[k] + j * down[k] for i, j in signs for k, at in ((0, x), (1, y))], -1)


def obb2xyxy(rboxes: Tensor, version: str = "oc") -> Tensor:
    """Returns the upright boxes around boxes, (N, 5) to (N, 4), which are the same in every version."""
    one_of("version", version, tuple(_VERSIONS))
    center, width, height, angle = rboxes[..., :2], rboxes[..., 2], rboxes[..., 3], rboxes[..., 4]
    cos, sin = angle.cos().abs() / 2, angle.sin().abs() / 2
    half = torch.stack([width * cos + height * sin, width * sin + height * cos], -1)
    return torch.cat([center - half, center + half], -1)
