"""The same calls on a GPU, a driver in software included; without the feature, the error that says so."""

import os

import numpy as np
import pytest

import geograd

A = np.random.default_rng(4).uniform(1, 3, (300, 5)).astype(np.float32)
B = (A + 0.1).astype(np.float32)


def has_gpu():
    try:
        geograd.iou(A[:1], B[:1], kind="Obb2", backend="gpu")
    except RuntimeError as error:
        if os.environ.get("GEOGRAD_REQUIRE_GPU"):
            raise
        assert "gpu" in str(error).lower()
        return False
    return True


def test_calls_on_a_gpu():
    if not has_gpu():
        pytest.skip("built without the feature gpu, or there is no driver")
    a, b = geograd.Obb2(A), geograd.Obb2(B)
    near = dict(rtol=1e-3, atol=1e-4)
    np.testing.assert_allclose(geograd.iou(a, b, backend="gpu"), geograd.iou(a, b), **near)
    value, (by_a, by_b) = geograd.iou.value_grad(a, b, backend="gpu")
    np.testing.assert_allclose(by_a, geograd.iou.value_grad(a, b)[1][0], **near)
    matrix = geograd.iou.all_pairs(a, b)
    np.testing.assert_allclose(geograd.iou.all_pairs(a, b, backend="gpu"), matrix, **near)
    np.testing.assert_allclose(geograd.iou.row_max(a, b, backend="gpu")[0], matrix.max(1), **near)
    np.testing.assert_allclose(geograd.iou.sum(a, b, backend="gpu"), matrix.sum(), rtol=1e-4)
    # Groups: pairs of the matrix that are in one, an empty one among them.
    groups = [0, 100, 100, 120, 300], [0, 70, 90, 90, 300]
    i, j, _ = geograd.iou.above(a, b, 0.5, groups=groups, backend="gpu")
    wanted = geograd.iou.above(a, b, 0.5, groups=groups)
    assert len(i) > 100 and (i == wanted[0]).all() and (j == wanted[1]).all()
    for form in (geograd.iou.row_max, geograd.iou.column_max):
        (best, at), wanted = form(a, b, groups=groups, backend="gpu"), form(a, b, groups=groups)
        np.testing.assert_allclose(best, wanted[0], **near)
        assert ((at == -1) == (wanted[1] == -1)).all() and (at == -1).any()
    with pytest.raises(ValueError, match="groups of `a`: offset 1"):
        geograd.iou.above(a, b, 0.5, groups=([0, 3], [0, 300]), backend="gpu")
    total, derivatives = geograd.iou.sum_grad(a, b, backend="gpu")
    np.testing.assert_allclose(derivatives[0], geograd.iou.sum_grad(a, b)[1][0], rtol=1e-2, atol=1e-2)
    rings = geograd.Rings(A[:, :2], np.arange(0, 301, 4))
    np.testing.assert_allclose(geograd.signed_area(rings, backend="gpu"), geograd.signed_area(rings), **near)

    @geograd.function
    def loss(a: geograd.Obb2, b: geograd.Obb2):
        return 1 - geograd.iou(a, b) + 0.1 * abs(a.heading - b.heading)

    np.testing.assert_allclose(loss(A, B, backend="gpu"), loss(A, B), **near)
    with pytest.raises(TypeError, match="float32"):
        geograd.iou(A.astype(np.float64), B, kind="Obb2", backend="gpu")


def test_without_the_feature_the_error_says_so():
    if has_gpu():
        pytest.skip("it is there")
    with pytest.raises(RuntimeError, match="gpu|GPU"):
        geograd.iou(A, B, kind="Obb2", backend="gpu")
