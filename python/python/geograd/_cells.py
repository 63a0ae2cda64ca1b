"""Cells of sites in a polygon: Voronoi cells, and power cells of sites with weights."""

import numpy as np

from . import _core
from ._polygons import Polygons


def _domain(domain):
    """The vertices of a domain, and how many there are up to the end of each ring."""
    column = domain if isinstance(domain, _core.Polygons) else Polygons.of([domain])
    if len(column) != 1:
        raise ValueError(f"domain: one polygon is needed, not {len(column)}")
    return np.ascontiguousarray(column.vertices, np.float64), [int(end) for end in column.offsets[0][1:]]


def _sites(sites):
    sites = np.asarray(sites)
    if sites.ndim != 2 or sites.shape[1] != 2:
        raise ValueError(f"sites: an array of shape (N, 2) is needed, not {sites.shape}")
    return np.ascontiguousarray(sites, np.float64)


def _weights(weights):
    weights = np.zeros(0) if weights is None else np.asarray(weights)
    if weights.ndim != 1:
        raise ValueError(f"weights: an array of shape (N,) is needed, not {weights.shape}")
    return np.ascontiguousarray(weights, np.float64)


class Cells:
    """The cells of sites in a domain: each point belongs to the nearest site, and with weights to the site of the least
    squared distance less its weight.

    ``sites`` has the shape (N, 2), ``weights`` the shape (N,). ``domain`` is one polygon: a ring of shape (V, 2), a list of rings
    (holes too), shapely's, or :class:`Polygons` of one item. Numbers are computed in float64. Sites may lie outside of the domain.
    Of sites at one place the heaviest has the cell, and equal ones share it.

    >>> cells = geograd.Cells([(1, 1), (3, 1)], domain=[(0, 0), (4, 0), (4, 2), (0, 2)])
    >>> cells.areas
    array([4., 4.])
    >>> cells.areas_vjp([1, 0])[0]  # the area of the first cell grows by 1 for each unit that either site goes to the right
    array([[1., 0.],
           [1., 0.]])
    """

    __module__ = "geograd"

    def __init__(self, sites, weights=None, *, domain):
        self._core = _core.CellsCore(_sites(sites), _weights(weights), *_domain(domain))
        self._moments = None

    def __len__(self):
        return len(self.areas)

    def __repr__(self):
        return f"<geograd.Cells of {len(self)} sites>"

    def _of_moments(self, place):
        if self._moments is None:
            self._moments = self._core.moments()
        return self._moments[place]

    @property
    def areas(self):
        """The area of each cell, of shape (N,): 0 where others cover it. Their sum is the area of the domain."""
        return self._of_moments(1)

    @property
    def centroids(self):
        """The centroid of each cell, of shape (N, 2): the site itself where the area is zero."""
        return self._core.centroids()

    @property
    def first_moments(self):
        """The integral over each cell of the way from its site, of shape (N, 2)."""
        return self._of_moments(0)

    @property
    def second_moments(self):
        """The integral over each cell of the squared distance from its site, of shape (N,)."""
        return self._of_moments(2)

    @property
    def energy(self):
        """The sum over cells of the integral of the squared distance from the site less its weight. Its derivatives are minus
        twice the first moments by sites, and minus the areas by weights."""
        return self._core.energy()

    @property
    def hidden(self):
        """Whether each site has no cell, since others cover it or it is outside of the domain's reach."""
        return self._core.hidden()

    def neighbours(self, site):
        """The sites whose cells share a side with a site's cell, sorted. Of sites that share a cell the first is named."""
        return self._core.neighbours(site)

    def rings(self, site):
        """The rings of a cell, a list of arrays of shape (V, 2), counter-clockwise; empty for a hidden site."""
        vertices, ends = self._core.rings(site)
        return np.split(vertices, ends[:-1]) if ends else []

    def area_slopes(self):
        """The derivatives of areas by weights as a sparse matrix: rows, columns, values. Sorted, symmetric up to roundings, with
        rows that sum to zero: minus the Hessian of the dual of semi-discrete transport, for Newton's method."""
        return self._core.area_slopes()

    def energy_hessian(self):
        """The second derivatives of the energy as a sparse matrix of blocks: rows, columns, and blocks of shape (K, 3, 3), in the
        order x, y, weight of a site. Sorted, symmetric up to roundings."""
        rows, columns, blocks = self._core.energy_hessian()
        return rows, columns, blocks.reshape(-1, 3, 3)

    def areas_vjp(self, areas_bar):
        """Cotangents of sites, of weights and of the domain's vertices from those of the areas."""
        bars = np.ascontiguousarray(areas_bar, np.float64)
        if bars.shape != (len(self),):
            raise ValueError(f"areas_bar: an array of shape ({len(self)},) is needed, not {bars.shape}")
        return self._core.moments_vjp(bars, np.zeros((len(self), 2)), np.zeros(len(self)))

    def centroids_vjp(self, centroids_bar):
        """Cotangents of sites, of weights and of the domain's vertices from those of the centroids."""
        bars = np.ascontiguousarray(centroids_bar, np.float64)
        if bars.shape != (len(self), 2):
            raise ValueError(f"centroids_bar: an array of shape ({len(self)}, 2) is needed, not {bars.shape}")
        return self._core.centroids_vjp(bars)
