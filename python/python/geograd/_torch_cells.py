"""Measures of cells on tensors, with gradients for sites and weights."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional

import numpy as np
import torch

import geograd
from geograd._torch_host import array


class CellMeasures(NamedTuple):
    """Measures of the cells of N sites."""

    #: The areas, of shape (N,).
    areas: torch.Tensor
    #: The centroids, of shape (N, 2).
    centroids: torch.Tensor
    #: The energy of transport: one number.
    energy: torch.Tensor


class _Measured(torch.autograd.Function):
    @staticmethod
    def forward(ctx: Any, sites: torch.Tensor, weights: torch.Tensor, made: Any) -> Any:
        ctx.made = made
        ctx.save_for_backward(sites, weights)
        all = made.areas, made.centroids, np.float64(made.energy)
        return tuple(torch.as_tensor(own).to(sites.dtype) for own in all)

    @staticmethod
    @torch.autograd.function.once_differentiable
    def backward(ctx: Any, areas: torch.Tensor, centroids: torch.Tensor, energy: torch.Tensor) -> Any:
        sites, weights = ctx.saved_tensors
        by_sites, by_weights, _ = ctx.made.areas_vjp(areas.numpy())
        more = ctx.made.centroids_vjp(centroids.numpy())
        scale = float(energy)
        by_sites = by_sites + more[0] - 2.0 * scale * ctx.made.first_moments
        by_weights = by_weights + more[1] - scale * ctx.made.areas
        return torch.from_numpy(by_sites).to(sites.dtype), torch.from_numpy(by_weights).to(weights.dtype), None


def cells(sites: torch.Tensor, weights: Optional[torch.Tensor] = None, *, domain: Any) -> CellMeasures:
    """Areas, centroids and energy of the cells of sites, of shape (N, 2), in a domain: :class:`geograd.Cells` in torch.

    Results have first derivatives by sites and weights.
    """
    rows = array("sites", sites, "cells")
    if weights is None:
        weights = torch.zeros(len(sites), dtype=sites.dtype)
    made = geograd.Cells(rows, array("weights", weights, "cells"), domain=domain)
    return CellMeasures(*_Measured.apply(sites, weights, made))  # type: ignore[no-untyped-call]
