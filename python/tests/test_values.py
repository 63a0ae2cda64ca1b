"""Values and gradients against formulas written here."""

import numpy as np
import pytest

import geograd

RNG = np.random.default_rng(5)


def test_iou_of_upright_boxes():
    low = RNG.uniform(0, 2, (100, 2))
    a = np.concatenate([low, low + RNG.uniform(0.1, 2, (100, 2))], 1)
    low = RNG.uniform(0, 2, (100, 2))
    b = np.concatenate([low, low + RNG.uniform(0.1, 2, (100, 2))], 1)
    sides = np.clip(np.minimum(a[:, 2:], b[:, 2:]) - np.maximum(a[:, :2], b[:, :2]), 0, None)
    both = sides.prod(1)
    area = lambda box: (box[:, 2:] - box[:, :2]).prod(1)
    np.testing.assert_allclose(geograd.iou(a, b, kind="Aabb2"), both / (area(a) + area(b) - both), rtol=1e-12, atol=1e-15)


def test_distances():
    p, q = RNG.normal(size=(2, 50, 2))
    r = RNG.uniform(0.1, 1, (2, 50))
    circles = [geograd.Circle(np.column_stack([x, s])) for x, s in zip((p, q), r)]
    expected = np.maximum(np.hypot(*(p - q).T) - r.sum(0), 0)
    np.testing.assert_allclose(geograd.distance(*circles), expected, atol=1e-14)
    segments = np.concatenate([p, q], 1)
    x = RNG.normal(size=(50, 2))
    t = np.clip(((x - p) * (q - p)).sum(1) / ((q - p) ** 2).sum(1), 0, 1)
    near = p + t[:, None] * (q - p)
    value, (by_point, by_segment) = geograd.distance.value_grad(geograd.Vec2(x), geograd.Segment2(segments))
    expected = np.hypot(*(x - near).T)
    np.testing.assert_allclose(value, expected, rtol=1e-12)
    unit = (x - near) / expected[:, None]
    np.testing.assert_allclose(by_point, unit, atol=1e-9)
    np.testing.assert_allclose(by_segment, -np.concatenate([(1 - t)[:, None] * unit, t[:, None] * unit], 1), atol=1e-9)


def test_paths_of_space():
    rng = np.random.default_rng(8)
    parts = [rng.normal(size=(n, 3)) for n in (2, 7, 0, 1, 40)]
    lines, clouds = geograd.Polylines.of(parts), geograd.Clouds.of(parts)
    assert len(lines) == 5 and lines.vertices.shape == (50, 3)
    lengths = [np.linalg.norm(np.diff(part, axis=0), axis=1).sum() for part in parts]
    np.testing.assert_allclose(geograd.length(lines), lengths, rtol=1e-14)
    means = np.asarray(geograd.centroid(clouds))
    spreads = np.asarray(geograd.second_moments(clouds))
    for part, mean, spread in zip(parts, means, spreads):
        if len(part) > 1:
            full = np.cov(part.T, bias=True)
            np.testing.assert_allclose(mean, part.mean(0), atol=1e-15)
            np.testing.assert_allclose(spread, [*np.diag(full), full[0, 1], full[0, 2], full[1, 2]], atol=1e-14)
    points = geograd.Vec3(rng.normal(size=(5, 3)))
    value, (by_point, by_vertex) = geograd.distance.value_grad(points, lines)
    assert by_point.shape == (5, 3) and by_vertex.shape == (50, 3)
    a, b = parts[1][:-1], parts[1][1:]
    t = np.clip(((np.asarray(points)[1] - a) * (b - a)).sum(1) / ((b - a) ** 2).sum(1), 0, 1)
    near = a + t[:, None] * (b - a)
    np.testing.assert_allclose(value[1], np.linalg.norm(np.asarray(points)[1] - near, axis=1).min(), rtol=1e-14)
    np.testing.assert_allclose(np.linalg.norm(by_point[1]), 1)
    np.testing.assert_allclose(by_vertex[2:9].sum(0), -by_point[1], atol=1e-15)
    with pytest.raises(TypeError):
        geograd.signed_area(lines)
    with pytest.raises(ValueError, match=r"\(V, 2\)"):
        geograd.Rings.of(parts)


def test_paths():
    squares = [[[0, 0], [2, 0], [2, 2], [0, 2]], [[0.0, 0.0], [3, 0], [0, 4]], []]
    rings = geograd.Rings.of([np.reshape(x, (-1, 2)) for x in squares])
    assert len(rings) == 3
    np.testing.assert_array_equal(geograd.signed_area(rings), [4, 6, 0])
    np.testing.assert_allclose(geograd.perimeter(rings)[:2], [8, 12])
    np.testing.assert_allclose(np.asarray(geograd.centroid(rings))[:2], [[1, 1], [1, 4 / 3]])
    lines = geograd.Polylines(rings.vertices, rings.offsets)
    np.testing.assert_allclose(geograd.length(lines)[:2], [6, 8])
    points = geograd.Vec2(np.array([[1.0, 0.5]] * 3))
    np.testing.assert_allclose(geograd.distance(points, rings)[:1], [0.5])
    np.testing.assert_allclose(geograd.distance(points, lines)[:1], [0.5])
    np.testing.assert_allclose(geograd.signed_distance(geograd.Vec2([1.0, 0.5]), rings)[:1], [-0.5])
    value, by_vertex = geograd.signed_area.value_grad(rings)
    step = 1e-6
    moved = rings.vertices.copy()
    moved[0, 0] += step
    derivative = (geograd.signed_area(geograd.Rings(moved, rings.offsets)) - value)[0] / step
    np.testing.assert_allclose(by_vertex[0, 0], derivative, atol=1e-6)
    value, (by_point, by_vertex) = geograd.signed_distance.value_grad(points, rings)
    assert by_point.shape == (3, 2) and by_vertex.shape == rings.vertices.shape
    np.testing.assert_allclose(by_point[0], [0, -1])
    bars = geograd.signed_distance.vjp(points, rings, np.array([2.0, 1, 1]))
    np.testing.assert_allclose(bars[0][0], [0, -2])
    # One ring and many points; none, too.
    ring = geograd.Rings(rings.vertices[:4], [0, 4])
    many = np.array([[1.0, 0.5], [3.0, 1.0], [5.0, 2.0]])
    np.testing.assert_allclose(geograd.signed_distance(geograd.Vec2(many), ring), [-0.5, 1, 3])
    assert geograd.signed_distance(geograd.Vec2(many[:0]), ring).shape == (0,)
    value, (by_point, by_vertex) = geograd.signed_distance.value_grad(geograd.Vec2(many), ring)
    alone = [geograd.signed_distance.value_grad(geograd.Vec2(x[None]), ring) for x in many]
    np.testing.assert_array_equal(by_point, np.concatenate([one[1][0] for one in alone]))
    np.testing.assert_allclose(by_vertex, sum(one[1][1] for one in alone), atol=1e-12)
    bars = geograd.signed_distance.vjp(geograd.Vec2(many), ring, np.array([0.0, 2, 0]))
    np.testing.assert_allclose(bars[1], 2 * alone[1][1][1], atol=1e-12)
    with pytest.raises(ValueError, match="3 rows where 2 are needed"):
        geograd.signed_distance(geograd.Vec2(many), geograd.Rings(rings.vertices[:7], [0, 4, 7]))
    single = geograd.Rings(rings.vertices.astype(np.float32), rings.offsets)
    assert geograd.signed_area(single).dtype == np.float32
