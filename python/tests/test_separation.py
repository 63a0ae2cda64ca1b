"""Distances of polygons from polygons and shapes: values of shapely, gradients of differences."""

import numpy as np
import pytest

import geograd
from geograd import Polygons

shapely = pytest.importorskip("shapely")
from test_polygons import blobs, difference, hostile, moved, star

SHAPES = {
    "Aabb2": (4, lambda x: shapely.box(*x)),
    "Capsule2": (5, lambda x: shapely.LineString(x[:4].reshape(2, 2))),
    "Circle": (3, lambda x: shapely.Point(x[:2])),
    "Obb2": (5, lambda x: shapely.Polygon(geograd.corners(geograd.Obb2(x)).array.reshape(4, 2))),
    "Segment2": (4, lambda x: shapely.LineString(x.reshape(2, 2))),
    "Triangle2": (6, lambda x: shapely.Polygon(x.reshape(3, 2))),
    "Vec2x4": (8, lambda x: shapely.Polygon(x.reshape(4, 2))),
}


def apart(seed, count):
    """Pairs of geometries with holes and parts of which most are apart, some meet, and some lie in holes."""
    a, b = blobs(seed, count)
    dice = np.random.default_rng(seed)
    return a, np.array([shapely.affinity.translate(own, *dice.normal(size=2) * 2.5) for own in b], object)


def some(kind, count):
    dice = np.random.default_rng(4)
    x = dice.normal(size=(count, SHAPES[kind][0])) * 2
    if kind == "Aabb2":
        x[:, 2:] = x[:, :2] + abs(x[:, 2:])
    if kind == "Vec2x4":
        x = geograd.corners(geograd.Obb2(np.c_[x[:, :2], abs(x[:, 2:4]), x[:, 4]])).array
    return np.concatenate([x[:, :2], abs(x[:, 2:4]), x[:, 4:]], 1) if kind == "Obb2" else np.abs(x) if kind == "Circle" else x


def test_distances_of_polygons_are_those_of_shapely():
    a, b = apart(1, 300)
    p, q = Polygons.of(a), Polygons.of(b)
    expected = shapely.distance(a, b)
    assert 0.05 < (expected == 0).mean() < 0.5
    found = geograd.distance(p, q)
    assert ((found == 0) == (expected == 0)).all()
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(geograd.distance(p[0], q), shapely.distance(a[0], b), rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(geograd.distance(q, p[0]), shapely.distance(b, a[0]), rtol=1e-12, atol=1e-13)
    single = [Polygons(own.vertices.astype(np.float32), own.offsets) for own in (p, q)]
    assert geograd.distance(*single).dtype == np.float32
    np.testing.assert_allclose(geograd.distance(*single), expected, rtol=1e-5, atol=1e-5)


def test_pairs_that_touch_lie_in_holes_or_have_no_part():
    a, b = (np.array(list(own), object) for own in zip(*hostile()))
    expected = shapely.distance(a, b)
    found = geograd.distance(Polygons.of(a), Polygons.of(b))
    np.testing.assert_allclose(found, np.where(np.isnan(expected), np.finfo(float).max, expected))
    frame = shapely.box(0, 0, 9, 9).difference(shapely.box(2, 2, 7, 7))
    # In the hole, within the area, around all of it.
    inner = [shapely.box(3, 4, 4, 5), shapely.box(0.5, 0.5, 1, 1), shapely.box(-1, -1, 10, 10)]
    value, (by_frame, by_inner) = geograd.distance.value_grad(Polygons.of([frame]), Polygons.of(inner))
    assert value.tolist() == [1, 0, 0] and by_inner[4:].any() == False and by_inner[:4, 0].sum() == 1
    assert by_frame.sum(0) == pytest.approx(-by_inner.sum(0))
    assert len(geograd.distance(Polygons.of([]), Polygons.of([]))) == 0


def test_values_alone_have_the_bits_of_those_with_gradients():
    for a, b in (apart(5, 200), zip(*hostile())):
        p, q = (Polygons.of(np.array(list(own), object)) for own in (a, b))
        for first, second in ((p, q), (p[0], q), (p, q[0])):
            np.testing.assert_array_equal(geograd.distance(first, second), geograd.distance.value_grad(first, second)[0])


def test_many_vertices():
    dice = np.random.default_rng(3)
    a, b = ([shapely.Polygon(star(dice, 200, x)) for x in places] for places in ([0, 0, 1], [2.3, 0.4, 9]))
    p, q = Polygons.of(a), Polygons.of(b)
    np.testing.assert_allclose(geograd.distance(p, q), shapely.distance(a, b), rtol=1e-13, atol=1e-14)
    one, many = geograd.distance.value_grad(p[:1], q[:1]), geograd.distance.value_grad(p, q)
    assert one[0][0] == many[0][0] and (one[1][0] == many[1][0][:200]).all()


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("count", [3, 7, 40, 300])
def test_the_nearest_edges_are_those_of_all_pairs(count, dtype):
    dice = np.random.default_rng(count)
    a, b = (Polygons.of([star(dice, count, x) for x in places]) for places in ([0, 0, 1, 0.3], [2.3, 0.4, 9, -1.9]))
    a, b = (Polygons(own.vertices.astype(dtype), own.offsets) for own in (a, b))
    rings = [own.vertices.reshape(4, count, 2) for own in (a, b)]
    sides = [np.concatenate([own, np.roll(own, -1, 1)], 2).reshape(-1, 4) for own in rings]
    found = geograd.distance(a, b)
    for k in range(4):
        pairs = geograd.distance.all_pairs(*[own[k * count : (k + 1) * count] for own in sides], kind="Segment2")
        inside = geograd.contains(a[k], b[k].vertices[:1])[0] or geograd.contains(b[k], a[k].vertices[:1])[0]
        assert found[k] == (0 if inside else pairs.min())


def test_all_pairs():
    a, b = (Polygons.of(own) for own in apart(4, 6))
    expected = [[geograd.distance(a[i], b[j])[0] for j in range(4)] for i in range(6)]
    assert np.array_equal(geograd.distance.all_pairs(a, b[:4]), expected)
    np.testing.assert_allclose(geograd.distance.all_pairs(b[:4], a), np.transpose(expected), rtol=1e-13)
    points = np.random.default_rng(2).normal(size=(5, 2))
    for verb in (geograd.distance, geograd.signed_distance, geograd.depth):
        expected = [[verb(point[None], a[j])[0] for j in range(6)] for point in points]
        assert np.array_equal(verb.all_pairs(geograd.Vec2(points), a), expected)
    assert geograd.distance.all_pairs(a[:0], b).shape == (0, 6)


def test_gradients_by_both_are_those_of_differences():
    p, q = (Polygons.of(own) for own in apart(2, 6))
    for a, b in ((p, q), (p[0], q), (p, q[:1])):
        value, (by_a, by_b) = geograd.distance.value_grad(a, b)
        assert (value > 0).any()
        of = lambda x, y: geograd.distance(moved(a, x), moved(b, y)).sum()
        assert by_a == pytest.approx(difference(lambda x: of(x, b.vertices), np.array(a.vertices)), abs=1e-6)
        assert by_b == pytest.approx(difference(lambda y: of(a.vertices, y), np.array(b.vertices)), abs=1e-6)
        upstream = np.arange(1.0, len(value) + 1)
        weighted = geograd.distance.vjp(a, b, upstream)[0]
        expected = difference(lambda x: geograd.distance(moved(a, x), b) @ upstream, np.array(a.vertices))
        assert weighted == pytest.approx(expected, abs=1e-5)


@pytest.mark.parametrize("kind", SHAPES)
def test_distances_from_shapes(kind):
    a, _ = apart(5, 60)
    p, x = Polygons.of(a), some(kind, 60)
    if kind == "Capsule2":
        x[:, 4] = 0.2 * abs(x[:, 4])
    of, build = SHAPES[kind][1], getattr(geograd, kind)
    expected = shapely.distance(a, np.array([of(own) for own in x], object))
    if kind in ("Circle", "Capsule2"):
        expected = np.maximum(expected - x[:, -1], 0)
    assert (expected > 0).any()
    np.testing.assert_allclose(geograd.distance(build(x), p), expected, rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(geograd.distance(p, build(x)), geograd.distance(build(x), p), rtol=1e-14)
    for count in (6, 1):
        own, few = x[:count] if count > 1 else x[0], p[:6]
        _, (by_shape, by_polygons) = geograd.distance.value_grad(build(own), few)
        assert by_shape.shape == own.shape
        expected = difference(lambda y: geograd.distance(build(y), few).sum(), own.copy())
        assert by_shape == pytest.approx(expected, abs=1e-5)
        expected = difference(lambda y: geograd.distance(build(own), moved(few, y)).sum(), np.array(few.vertices))
        assert by_polygons == pytest.approx(expected, abs=1e-5)


def test_refusals():
    p = Polygons.of([[(0, 0), (1, 0), (0, 1)]] * 3)
    with pytest.raises(TypeError, match="takes points, Polygons, Aabb2, .*, not Line2"):
        geograd.distance(geograd.Line2([0, 0, 1, 0.0]), p)
    with pytest.raises(TypeError, match="takes points beside them, not Polygons"):
        geograd.signed_distance(p, p)
    with pytest.raises(ValueError, match="`b` has 2 rows where 3 are needed"):
        geograd.distance(p, p[:2])
    for build, numbers, match in [
        (geograd.Segment2, [[0, 0, 1, 1], [3, np.nan, 1, 1.0]], "item 1"),
        (geograd.Circle, [[0, 0, 1], [0, 0, -1.0]], "item 1"),
        (geograd.Obb2, [[0, 0, 1, 1, 0], [0, 0, np.inf, 1, 0]], "item 1"),
        (geograd.Triangle2, [[0, 0, 1, 1, 0, 2], [0, 0, np.nan, 1, 0, 0]], "1"),
    ]:
        with pytest.raises(ValueError, match=match):
            geograd.distance(build(np.array(numbers)), p[:2])
    assert "distance(a: Polygons, b: Polygons) -> number" in geograd.distance.__doc__
