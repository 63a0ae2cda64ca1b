"""Measures of cells on tensors, with gradients for sites and weights."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional

import numpy as np
import torch

import geograd
from geograd._torch_host import array, last


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
    def backward(ctx: Any, areas: torch.Tensor, centroids: torch.Tensor, energy: torch.Tensor) -> Any:
        sites, weights = ctx.saved_tensors
        by_sites, by_weights, _ = ctx.made.areas_vjp(np.ascontiguousarray(areas.detach().numpy(), np.float64))
        more = ctx.made.centroids_vjp(np.ascontiguousarray(centroids.detach().numpy(), np.float64))
        parts = torch.from_numpy(by_sites + more[0]).to(sites.dtype), torch.from_numpy(by_weights + more[1]).to(weights.dtype)
        if torch.is_grad_enabled():
            parts = tuple(_measures(part, areas, centroids, sites, weights) for part in parts)
            # Areas and centroids have derivatives: so has the slope of the energy.
            own, middles, _ = _Measured.apply(sites, weights, ctx.made)  # type: ignore[no-untyped-call]
            first = own[:, None] * (middles - sites)
        else:
            own, first = (torch.from_numpy(np.asarray(x)).to(sites.dtype) for x in (ctx.made.areas, ctx.made.first_moments))
        return parts[0] - 2.0 * energy * first, parts[1] - energy * own, None


def _measures(part: torch.Tensor, areas: torch.Tensor, centroids: torch.Tensor, sites: torch.Tensor, weights: torch.Tensor) -> torch.Tensor:
    """A slope of areas and centroids: without these nothing depends on anything."""
    if (areas == 0).all() and (centroids == 0).all() and not (areas.requires_grad or centroids.requires_grad):
        return part
    return last("areas and centroids of cells", part, areas, centroids, sites, weights)


def cells(sites: torch.Tensor, weights: Optional[torch.Tensor] = None, *, domain: Any) -> CellMeasures:
    """Areas, centroids and energy of the cells of sites, of shape (N, 2), in a domain: :class:`geograd.Cells` in torch.

    Results have first derivatives by sites and weights, the energy second ones.
    """
    rows = array("sites", sites, "cells")
    if weights is None:
        weights = torch.zeros(len(sites), dtype=sites.dtype)
    made = geograd.Cells(rows, array("weights", weights, "cells"), domain=domain)
    return CellMeasures(*_Measured.apply(sites, weights, made))  # type: ignore[no-untyped-call]
