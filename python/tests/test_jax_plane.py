"""Cells, measures of round offsets and curves on JAX's arrays."""

import numpy as np
import pytest

import geograd

jax = pytest.importorskip("jax")
jnp = pytest.importorskip("jax.numpy")
geograd_jax = pytest.importorskip("geograd.jax")

DRAW = np.random.default_rng(3)


@pytest.fixture(autouse=True)
def doubles():
    with jax.enable_x64(True) if hasattr(jax, "enable_x64") else jax.experimental.enable_x64():
        yield


def slopes(f, *xs, tries=3):
    """Compares the derivatives of f by all arrays with differences along directions."""
    xs = [jnp.asarray(x) for x in xs]
    by = jax.grad(f, tuple(range(len(xs))))(*xs)
    assert any((own != 0).any() for own in by)
    for _ in range(tries):
        ways = [DRAW.normal(0, 1, x.shape) for x in xs]
        h = 1e-6
        sides = [f(*(x + s * h * d for x, d in zip(xs, ways))) for s in (1, -1)]
        difference = (sides[0] - sides[1]) / (2 * h)
        derivative = sum((own * d).sum() for own, d in zip(by, ways))
        assert abs(difference - derivative) < 2e-6 * (1 + abs(derivative)), (difference, derivative)


DOMAIN = [(0, 0), (4, 0), (4.5, 3), (-0.3, 2.5)]


def test_cells_are_those_of_numpy_with_the_slopes_of_differences():
    sites, weights = DRAW.uniform(0.2, 2.3, (12, 2)), DRAW.uniform(0, 0.1, 12)
    own = geograd.Cells(sites, weights, domain=DOMAIN)
    made = geograd_jax.cells(sites, weights, domain=DOMAIN)
    assert (np.asarray(made.areas) == own.areas).all() and (np.asarray(made.centroids) == own.centroids).all()
    assert made.energy == own.energy
    w = DRAW.normal(0, 1, 12)
    slopes(lambda s, t: (geograd_jax.cells(s, t, domain=DOMAIN).areas * w).sum(), sites, weights)
    slopes(lambda s, t: (geograd_jax.cells(s, t, domain=DOMAIN).centroids * w[:, None]).sum(), sites, weights)
    slopes(lambda s, t: geograd_jax.cells(s, t, domain=DOMAIN).energy, sites, weights)
    compiled = jax.jit(lambda s: geograd_jax.cells(s, domain=DOMAIN).areas)
    assert (np.asarray(compiled(sites)) == geograd.Cells(sites, domain=DOMAIN).areas).all()
    with pytest.raises(ValueError, match="sites"):
        geograd_jax.cells(np.zeros((3, 3)), domain=DOMAIN)


def test_weights_of_places_are_those_of_numpy_with_the_slopes_of_differences():
    points, places = DRAW.uniform(0, 4, (12, 2)), DRAW.uniform(-1, 5, (25, 2))
    made = geograd.Delaunay(points)
    triangles, expected = made.barycentric(places)
    inside = triangles >= 0
    corners, weights = jax.jit(geograd_jax.barycentric)(points, places)
    assert (np.asarray(weights) == expected).all() and inside.any() and not inside.all()
    assert (np.asarray(corners)[inside] == made.triangles[triangles[inside]]).all() and not np.asarray(corners)[~inside].any()
    w = DRAW.normal(0, 1, (25, 3))
    slopes(lambda p, q: (geograd_jax.barycentric(p, q).weights * w).sum(), points, places)
    along = lambda p, q: (jax.grad(lambda p: (geograd_jax.barycentric(p, q).weights ** 2 * w).sum())(p) * points[::-1]).sum()
    slopes(along, points, places)
    assert not np.asarray(geograd_jax.barycentric(np.array([[0.0, 0], [1, 1], [2, 2]]), places).weights).any()
    with pytest.raises(ValueError, match="places"):
        geograd_jax.barycentric(points, np.zeros((3, 3)))


@pytest.mark.parametrize("name", ["buffer_area", "buffer_perimeter"])
@pytest.mark.parametrize("sign", [1, -1])
def test_measures_of_offsets_are_those_of_numpy_with_the_slopes_of_differences(name, sign):
    column = geograd.Polygons.of([[(0, 0), (4, 0.2), (4.1, 3), (2, 1.5), (0.1, 3.3)], [[(9, 0), (13, 0.3), (12, 4)], [(10, 0.6), (11.4, 2), (11.6, 0.8)]]])
    distances = sign * np.array([0.3, 0.05])
    measure = getattr(geograd_jax, name)
    own = geograd_jax.Polygons.of(column)
    assert (np.asarray(measure(own, distances)) == getattr(geograd, name)(column, distances)).all()
    w = DRAW.normal(0, 1, 2)
    slopes(lambda v, d: (measure(geograd_jax.Polygons(v, column), d) * w).sum(), column.vertices, distances)
    slopes(lambda d: measure(own, d).sum(), np.array(sign * 0.05))
    assert (jax.jit(measure)(own, distances) == measure(own, distances)).all()


def test_paths_have_measures_of_their_surroundings():
    lines = geograd_jax.Polylines.of(geograd.Polylines([[0, 0], [3, 0.5], [4, 3.0]], [0, 3]))
    expected = geograd.buffer_area(geograd.Polylines([[0, 0], [3, 0.5], [4, 3.0]], [0, 3]), 0.4)
    assert (np.asarray(geograd_jax.buffer_area(lines, 0.4)) == expected).all()


STEPS, NUMBERS = "MLAQCZ", np.array([0, 0, 2, 0.1, 4, 1, 0.3, 3.5, 2.5, 2.2, 3.3, 1.5, 4, 0.5, 3.2, -0.4, 1.8])


def test_curves_are_those_of_numpy_with_the_slopes_of_differences():
    own = geograd.CurvePath(STEPS, NUMBERS)
    path = geograd_jax.CurvePath(STEPS, NUMBERS)
    points = DRAW.uniform(-1, 5, (30, 2))
    assert path.length() == own.length and path.area() == own.area
    assert (np.asarray(path.distance(points)) == own.distance(points)).all()
    slopes(lambda x: geograd_jax.CurvePath(STEPS, x).length(), NUMBERS)
    slopes(lambda x: geograd_jax.CurvePath(STEPS, x).area(), NUMBERS)
    assert (path.lengths() == own.lengths).all() and path.lengths().shape == (sum(x != "M" for x in STEPS),)
    slopes(lambda x: (geograd_jax.CurvePath(STEPS, x).lengths() ** 2).sum(), NUMBERS)
    w = DRAW.normal(0, 1, 30)
    slopes(lambda p, x: (geograd_jax.CurvePath(STEPS, x).distance(p) * w).sum(), points, NUMBERS)
    by = jax.jit(jax.grad(lambda path: path.distance(points).sum()))(path)
    assert isinstance(by, geograd_jax.CurvePath) and by.steps == STEPS
    assert (jax.vmap(path.distance)(points.reshape(6, 5, 2)).reshape(-1) == path.distance(points)).all()
    with pytest.raises(ValueError, match="points"):
        path.distance(np.zeros((2, 3)))
