"""Cells of sites: areas beside shapely's, derivatives beside differences and torch's checks."""

import numpy as np
import pytest

import geograd

SQUARE = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]
HOLE = [(1.0, 1.0), (2.0, 1.25), (1.5, 2.0)]


def scattered(count, seed=0):
    return np.random.default_rng(seed).uniform(0.1, 3.9, (count, 2))


def test_areas_are_those_of_shapely():
    shapely = pytest.importorskip("shapely")
    sites = scattered(50)
    for rings in ([SQUARE], [SQUARE, HOLE]):
        domain = shapely.Polygon(rings[0], rings[1:])
        cells = geograd.Cells(sites, domain=rings)
        regions = shapely.get_parts(shapely.voronoi_polygons(shapely.MultiPoint(sites), extend_to=domain))
        of_region = [np.flatnonzero(shapely.contains_xy(region, *sites.T))[0] for region in regions]
        clipped = shapely.intersection(regions, domain)
        expected = np.zeros(len(sites))
        expected[of_region] = shapely.area(clipped)
        np.testing.assert_allclose(cells.areas, expected, rtol=0, atol=1e-12)
        np.testing.assert_allclose(cells.areas.sum(), domain.area, rtol=1e-14)
        whole = [geograd.area(geograd.Polygons.of([cells.rings(k)]))[0] for k in range(3)]
        np.testing.assert_allclose(whole, cells.areas[:3], rtol=1e-12)
        # The domain may be of any kind.
        for other in (domain, geograd.Polygons.of([rings]), [rings]):
            np.testing.assert_array_equal(geograd.Cells(sites, domain=other).areas, cells.areas)


def test_derivatives_are_those_of_differences():
    sites, domain = scattered(12, 1), [SQUARE, HOLE]
    weights = np.random.default_rng(2).uniform(0, 0.3, 12)
    bars, ways = np.random.default_rng(3).uniform(-1, 1, 12), np.random.default_rng(4).uniform(-1, 1, (12, 2))
    cells = geograd.Cells(sites, weights, domain=domain)
    step = 1e-6

    def along(f, by):
        more = geograd.Cells(sites + by * ways, weights + by * bars, domain=domain)
        return f(more)

    def checked(f, by_sites, by_weights):
        expected = (along(f, step) - along(f, -step)) / (2 * step)
        assert np.sum(by_sites * ways) + by_weights @ bars == pytest.approx(expected, abs=1e-7)

    checked(lambda own: own.areas @ bars, *cells.areas_vjp(bars)[:2])
    checked(lambda own: np.sum(own.centroids * ways), *cells.centroids_vjp(ways)[:2])
    checked(lambda own: own.energy, -2 * cells.first_moments, -cells.areas)
    rows, columns, values = cells.area_slopes()
    product = np.zeros(12)
    np.add.at(product, rows, values * bars[columns])
    moved = [geograd.Cells(sites, weights + by * bars, domain=domain).areas for by in (step, -step)]
    np.testing.assert_allclose(product, (moved[0] - moved[1]) / (2 * step), atol=1e-7)
    rows, columns, blocks = cells.energy_hessian()
    product, way = np.zeros((12, 3)), np.column_stack([ways, bars])
    np.add.at(product, rows, np.einsum("kij,kj->ki", blocks, way[columns]))

    def slopes(own):
        return np.column_stack([-2 * own.first_moments, -own.areas])

    np.testing.assert_allclose(product, (along(slopes, step) - along(slopes, -step)) / (2 * step), atol=1e-6)


def test_newton_gives_wanted_areas():
    sites = scattered(40, 5)
    wanted = np.full(40, 16.0 / 40)
    weights = np.zeros(40)
    for _ in range(30):
        cells = geograd.Cells(sites, weights, domain=SQUARE)
        if abs(cells.areas - wanted).max() < 1e-12:
            break
        rows, columns, values = cells.area_slopes()
        matrix = np.zeros((40, 40))
        matrix[rows, columns] = values
        # Weights count up to a common number: the first one stays.
        step = np.zeros(40)
        step[1:] = np.linalg.solve(matrix[1:, 1:], (wanted - cells.areas)[1:])
        scale = 1.0
        while geograd.Cells(sites, weights + scale * step, domain=SQUARE).areas.min() < cells.areas.min() / 2:
            scale /= 2
        weights = weights + scale * step
    assert abs(cells.areas - wanted).max() < 1e-12


def test_hidden_sites_and_neighbours():
    cells = geograd.Cells([(1, 2), (3, 2), (1.5, 2)], [0, 0, -9], domain=SQUARE)
    np.testing.assert_array_equal(cells.hidden, [False, False, True])
    np.testing.assert_array_equal(cells.neighbours(0), [1])
    assert cells.rings(2) == [] and len(cells) == 3 and repr(cells) == "<geograd.Cells of 3 sites>"


def test_bad_input():
    with pytest.raises(ValueError, match=r"sites: an array of shape \(N, 2\)"):
        geograd.Cells([1, 2], domain=SQUARE)
    with pytest.raises(ValueError, match="weights"):
        geograd.Cells([(1, 2)], [1, 2], domain=SQUARE)
    with pytest.raises(ValueError, match="sites"):
        geograd.Cells([(1, np.nan)], domain=SQUARE)
    with pytest.raises(ValueError, match="domain: one polygon"):
        geograd.Cells([(1, 2)], domain=geograd.Polygons.of([SQUARE, SQUARE]))
    cells = geograd.Cells([(1, 2)], domain=SQUARE)
    with pytest.raises(ValueError, match="areas_bar"):
        cells.areas_vjp([1, 2])
    with pytest.raises(IndexError, match="site 1 of 1"):
        cells.rings(1)


def test_torch():
    torch = pytest.importorskip("torch")
    import geograd.torch as gt

    sites = torch.from_numpy(scattered(9, 6)).requires_grad_()
    weights = torch.rand(9, dtype=torch.float64, generator=torch.Generator().manual_seed(1)).mul(0.2).requires_grad_()
    domain = [SQUARE, HOLE]
    assert torch.autograd.gradcheck(lambda s, w: tuple(gt.cells(s, w, domain=domain)), (sites, weights), atol=1e-5)
    assert torch.autograd.gradgradcheck(lambda s, w: gt.cells(s, w, domain=domain).energy, (sites, weights), atol=1e-5)
    slope = torch.autograd.grad(gt.cells(sites, weights, domain=domain).areas.square().sum(), sites, create_graph=True)[0]
    with pytest.raises(RuntimeError, match="areas and centroids of cells: derivatives"):
        slope.sum().backward()
    # Lloyd's step is the fixed point of the energy.
    optimizer = torch.optim.SGD([sites], lr=0.05)
    before = gt.cells(sites, domain=domain).energy.item()
    for _ in range(20):
        optimizer.zero_grad()
        gt.cells(sites, domain=domain).energy.backward()
        optimizer.step()
    assert gt.cells(sites, domain=domain).energy.item() < before
    single = gt.cells(sites.detach().float().requires_grad_(), domain=SQUARE)
    assert [own.dtype for own in single] == [torch.float32] * 3
    single.areas.sum().backward()
    with pytest.raises(TypeError, match="sites: a tensor"):
        gt.cells(np.zeros((2, 2)), domain=SQUARE)
