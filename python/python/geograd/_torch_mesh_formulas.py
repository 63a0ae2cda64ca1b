"""Derivatives of derivatives along the records of searches, in operations of torch."""

from __future__ import annotations

from typing import Any, Callable, Sequence

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
