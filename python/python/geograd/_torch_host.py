"""Tensors that the library reads on the host, and derivatives of derivatives."""

from __future__ import annotations

from typing import Any, Callable, Sequence

import numpy as np
import torch


def checked(name: str, tensor: Any, what: str) -> torch.Tensor:
    """Refuses what is no tensor of floats on the CPU, where ``what`` are, such as meshes."""
    if not isinstance(tensor, torch.Tensor) or tensor.dtype not in (torch.float32, torch.float64):
        raise TypeError(f"{name}: a tensor of float32 or float64 is needed")
    if tensor.device.type != "cpu":
        raise TypeError(f"{name}: {what} are on the CPU, and a tensor is on {tensor.device}: move it with .cpu()")
    return tensor


def array(name: str, tensor: Any, what: str) -> Any:
    """The numbers of a tensor in float64."""
    return np.ascontiguousarray(checked(name, tensor, what).detach().numpy(), np.float64)


class _Last(torch.autograd.Function):
    """A derivative that has none itself."""

    @staticmethod
    def forward(ctx: Any, what: str, part: torch.Tensor, *leaves: torch.Tensor) -> torch.Tensor:
        ctx.what = what
        return part

    @staticmethod
    def backward(ctx: Any, upstream: torch.Tensor) -> Any:
        raise RuntimeError(f"{ctx.what}: derivatives of this order are not there")


def last(what: str, part: torch.Tensor, *leaves: torch.Tensor) -> torch.Tensor:
    """A derivative by some leaves; an error where its own derivatives are asked for, instead of none."""
    found: torch.Tensor = _Last.apply(what, part, *leaves)
    return found


def differentiated(value: Callable[..., torch.Tensor], leaves: Sequence[torch.Tensor], upstream: torch.Tensor) -> list[Any]:
    """The cotangents of tensors, with derivatives of their own; None for a tensor without one."""
    wanted = [k for k, leaf in enumerate(leaves) if leaf.requires_grad]
    out: list[Any] = [None] * len(leaves)
    if wanted:
        computed = value(*(leaf.double() for leaf in leaves)).reshape(upstream.shape)
        of = [leaves[k] for k in wanted]
        for k, bar in zip(wanted, torch.autograd.grad(computed, of, upstream.double(), create_graph=True, allow_unused=True)):
            out[k] = bar
    return out
