"""The forms of a verb on arrays."""

import numpy as np
import pytest

import geograd

RNG = np.random.default_rng(1)
A = RNG.uniform(1, 3, (50, 5))
B = A + RNG.normal(0, 0.3, A.shape)


def test_forms_agree():
    a, b = geograd.Obb2(A), geograd.Obb2(B)
    value, (by_a, by_b) = geograd.iou.value_grad(a, b)
    assert value.shape == (50,) and by_a.shape == (50, 5)
    np.testing.assert_array_equal(value, geograd.iou(A, B, kind="Obb2"))
    matrix = geograd.iou.all_pairs(a, b)
    np.testing.assert_array_equal(np.diag(matrix), value)
    scaled = geograd.iou.vjp(a, b, np.full(50, 2.0))
    np.testing.assert_allclose(scaled[0], 2 * by_a, rtol=1e-14)
    step = 1e-6
    moved = A.copy()
    moved[:, 0] += step
    derivative = (geograd.iou(geograd.Obb2(moved), b) - value) / step
    np.testing.assert_allclose(derivative, by_a[:, 0], atol=1e-4)


def test_a_plain_array_never_guesses():
    with pytest.raises(TypeError, match=r"plain array.*\(Obb2, Obb2\)"):
        geograd.iou(A, B)
