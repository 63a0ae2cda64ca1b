"""Hausdorff's and Fréchet's distance beside shapely's, and their gradients beside differences."""

import numpy as np
import pytest

import geograd


def walks(seed, count=40, dtype=np.float64):
    """Paths of 1 to 30 vertices."""
    rng = np.random.default_rng(seed)
    counts = rng.integers(1, 31, count)
    vertices = np.concatenate([rng.normal(size=(n, 2)).cumsum(0) for n in counts]).astype(dtype)
    return geograd.Polylines(vertices, np.concatenate([[0], np.cumsum(counts)]))


def leash(a, b):
    """The discrete Fréchet distance, by its definition."""
    gaps, cost = np.linalg.norm(a[:, None] - b[None], axis=-1), np.full((len(a) + 1, len(b) + 1), np.inf)
    cost[0, 0] = 0
    for i in range(len(a)):
        for j in range(len(b)):
            cost[i + 1, j + 1] = max(gaps[i, j], min(cost[i, j], cost[i, j + 1], cost[i + 1, j]))
    return cost[-1, -1]


def test_leashes_are_those_of_the_definition():
    a, b = walks(6), walks(7)
    pairs = [[own.vertices[start:end] for start, end in zip(own.offsets, own.offsets[1:])] for own in (a, b)]
    expected = [leash(p, q) for p, q in zip(*pairs)]
    np.testing.assert_allclose(geograd.frechet(a, b), expected, rtol=1e-13)
    np.testing.assert_allclose(geograd.frechet(geograd.Polylines.of(pairs[0][:1]), b), [leash(pairs[0][0], q) for q in pairs[1]], rtol=1e-13)
    # No leash is shorter than the way between both ends, and this one is no longer. GEOS 3.14.1 has sqrt(29).
    a, b = [(2, 1), (4, 0), (3, 2), (3, 0), (0, 0), (4, 1)], [(4, 1), (4, 4), (2, 5)]
    assert geograd.frechet([a], [b]).tolist() == [np.sqrt(20)]


def test_values_are_those_of_shapely():
    shapely = pytest.importorskip("shapely")
    rng = np.random.default_rng(0)
    lines = [[shapely.LineString(rng.normal(size=(n, 2)).cumsum(0)) for n in rng.integers(2, 40, 60)] for _ in range(2)]
    a, b = (np.array(own, object) for own in lines)
    np.testing.assert_allclose(geograd.hausdorff(a, b), shapely.hausdorff_distance(a, b), rtol=1e-13)
    # GEOS prunes walks, and some of its leashes are too long.
    ratio = shapely.frechet_distance(a, b) / geograd.frechet(a, b)
    assert ratio.min() > 1 - 1e-13 and np.mean(ratio < 1 + 1e-13) > 0.8
    # One stands for all.
    np.testing.assert_allclose(geograd.hausdorff(a[:1], b), shapely.hausdorff_distance(a[0], b), rtol=1e-13)
    disc = shapely.Point(0, 0).buffer(3)
    holed = [disc.difference(shapely.Point(x, 0.3).buffer(r)) for x, r in ((0.2, 1.0), (5.0, 4.0), (-1.0, 0.25))]
    other = [shapely.Point(1, 1).buffer(r) for r in (1.0, 2.5, 7.0)]
    np.testing.assert_allclose(geograd.hausdorff(holed, other), shapely.hausdorff_distance(holed, other), rtol=1e-13)
    rings = np.array([own.exterior for own in other], object)
    np.testing.assert_allclose(geograd.hausdorff(holed, geograd.Rings.of(rings)), shapely.hausdorff_distance(holed, rings), rtol=1e-13)


@pytest.mark.parametrize("verb", [geograd.hausdorff, geograd.frechet])
def test_gradients_are_those_of_differences(verb):
    a, b = walks(1), walks(2)
    value, (by_a, by_b) = verb.value_grad(a, b)
    np.testing.assert_array_equal(value, verb(a, b))
    assert (by_a.shape, by_b.shape) == (a.vertices.shape, b.vertices.shape)
    rng, step = np.random.default_rng(3), 1e-7
    ways = [rng.normal(size=own.vertices.shape) for own in (a, b)]
    moved = [
        verb(*[geograd.Polylines(own.vertices + sign * step * way, own.offsets) for own, way in zip((a, b), ways)]) for sign in (1, -1)
    ]
    sums = [np.add.reduceat((by * way).sum(1), own.offsets[:-1]) for by, way, own in zip((by_a, by_b), ways, (a, b))]
    np.testing.assert_allclose(sum(sums), (moved[0] - moved[1]) / (2 * step), atol=1e-6)
    # A translation of both changes no distance.
    np.testing.assert_allclose(by_a.sum(0) + by_b.sum(0), 0, atol=1e-12)
    bars = rng.normal(size=len(value))
    for found, by, own in zip(verb.vjp(a, b, bars), (by_a, by_b), (a, b)):
        np.testing.assert_allclose(found, by * np.repeat(bars, np.diff(own.offsets))[:, None], atol=1e-12)


def test_formats_kinds_and_what_is_refused():
    a, b = walks(4, dtype=np.float32), walks(5, dtype=np.float32)
    assert geograd.hausdorff(a, b).dtype == np.float32
    wide = [geograd.Polylines(own.vertices.astype(float), own.offsets) for own in (a, b)]
    np.testing.assert_allclose(geograd.hausdorff(a, b), geograd.hausdorff(*wide), rtol=1e-5)
    np.testing.assert_allclose(geograd.frechet(a, b), geograd.frechet(*wide), rtol=1e-5)
    square = [(0, 0), (4, 0), (4, 4), (0, 4)]
    assert geograd.hausdorff([square], geograd.Rings([(1, 1), (3, 1), (3, 3)], [0, 3])).tolist() == [np.sqrt(8)]
    # No vertices: no distance, and no slope.
    none = geograd.Polylines(np.zeros((1, 2)), [0, 0, 1])
    value, (by, _) = geograd.hausdorff.value_grad(none, geograd.Polylines.of([square]))
    assert np.isnan(value[0]) and value[1] == np.sqrt(32) and np.isfinite(by).all()
    with pytest.raises(TypeError, match="frechet takes Polylines and Rings"):
        geograd.frechet(geograd.Polygons.of([square]), [square])
    with pytest.raises(TypeError, match="of the plane"):
        geograd.hausdorff(geograd.Clouds([(0.0, 0, 0)], [0, 1]), [square])
    with pytest.raises(ValueError, match="3 rows where 2"):
        geograd.hausdorff([square] * 2, [square] * 3)
