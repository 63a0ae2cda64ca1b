"""Convex hulls of points of space: by known solids, by differences, by the faces' own sums."""

import numpy as np
import pytest

import geograd
from geograd import Clouds

CUBE = np.array([[k & 1, k >> 1 & 1, k >> 2] for k in range(8)], float)
VERBS = (geograd.hull_volume, geograd.hull_surface, geograd.hull_centroid)


def test_known_solids():
    wedge = np.array([[0, 0, 0], [2, 0, 0], [0, 3, 0], [0, 0, 4], [0.5, 0.75, 0.0]])
    square = CUBE[:4]
    clouds = Clouds.of([CUBE, wedge, square, CUBE[:2], CUBE[:1]])
    np.testing.assert_allclose(geograd.hull_volume(clouds), [1, 4, 0, 0, 0])
    np.testing.assert_allclose(geograd.hull_surface(clouds)[[0, 2, 3, 4]], [6, 2, 0, 0])
    expected = [[0.5] * 3, [0.5, 0.75, 1], [0.5, 0.5, 0], [0.5, 0, 0], [0, 0, 0]]
    np.testing.assert_allclose(geograd.hull_centroid(clouds), expected, atol=1e-15)
    corners, faces, hulls = geograd.hull_faces(clouds)
    assert np.diff(hulls).tolist() == [6, 4, 2, 0, 0] and (np.diff(faces)[:6] == 4).all()
    # Counter-clockwise from outside, and the point within a face is no corner.
    for hull, middle in ((range(6), CUBE.mean(0)), (range(6, 10), wedge[:4].mean(0))):
        for face in hull:
            p = clouds.vertices[corners[faces[face] : faces[face + 1]]]
            assert np.cross(p[1] - p[0], p[2] - p[0]) @ (p[0] - middle) > 0
    assert 12 not in corners


@pytest.mark.parametrize("verb", VERBS)
def test_gradients_are_those_of_differences(verb):
    points = np.random.default_rng(2).normal(size=(3, 12, 3))
    bar = np.random.default_rng(3).normal(size=np.shape(verb(points)))
    found, step = verb.vjp(points, bar), 1e-6
    assert found.shape == points.shape
    for place in np.ndindex(points.shape):
        moved = [points.copy(), points.copy()]
        moved[0][place] += step
        moved[1][place] -= step
        assert found[place] == pytest.approx(((verb(moved[0]) - verb(moved[1])) * bar).sum() / (2 * step), abs=1e-7)
    assert verb(points.astype(np.float32)).dtype == np.float32
    flat = verb.vjp(Clouds(points.reshape(-1, 3), [0, 12, 24, 36]), bar)
    assert np.array_equal(flat, found.reshape(-1, 3))


def test_hulls_of_the_table():
    points = np.random.default_rng(5).normal(size=(4, 8, 3))
    counts = [8, 5, 4, 1]
    hulls = geograd.Hull3_8(np.c_[points.reshape(4, 24), counts])
    clouds = Clouds.of([own[:count] for own, count in zip(points, counts)])
    for verb in VERBS:
        assert np.array_equal(verb(hulls), verb(clouds))
        by = verb.vjp(hulls, 1.0)
        assert by.shape == (4, 25) and not by[:, 24].any() and not by[3, 3:].any()
        assert np.array_equal(by[1, :15], verb.vjp(clouds, 1.0)[8:13].reshape(-1))
    value, gradient = geograd.hull_volume.value_grad(hulls)
    assert np.array_equal(gradient, geograd.hull_volume.vjp(hulls, 1.0)) and value[3] == 0
    assert geograd.hull_volume(geograd.Hull3_8(np.r_[CUBE.reshape(-1), 8])) == pytest.approx(1)
    corners, _, _ = geograd.hull_faces(hulls)
    assert corners.max() < 32 and set(corners) <= {*range(8), *range(8, 13), *range(16, 20)}


def test_refusals():
    with pytest.raises(ValueError, match="`vertices` item 1: y is not a finite number"):
        geograd.hull_volume(Clouds.of([[[0, 0, 0], [1, np.nan, 0]]]))
    with pytest.raises(TypeError, match="points of space"):
        geograd.hull_volume(geograd.Rings.of([[(0, 0), (1, 0), (0, 1)]]))
    with pytest.raises(TypeError, match="value_grad is of functions with one number"):
        geograd.hull_centroid.value_grad(CUBE[None])
    with pytest.raises(ValueError, match="from 1 to 8 vertices"):
        geograd.hull_surface(geograd.Hull3_8(np.zeros((1, 25))))
