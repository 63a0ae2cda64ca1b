"""geograd.jax: values, derivatives of both orders, jit, vmap, own functions, errors."""

import numpy as np
import pytest

jax = pytest.importorskip("jax")
jax.config.update("jax_enable_x64", True)

import jax.numpy as jnp
from jax.test_util import check_grads

import geograd
import geograd.jax
from samples import ROWS, ordinary, smooth
from pairs import A, B


def iou(a, b):
    return geograd.jax.iou(a, b, kind="Obb2")


@pytest.mark.parametrize("row", ROWS, ids=str)
def test_every_row_has_the_values_and_gradients_of_numpy(row):
    arrays = ordinary(row, 3)
    verb = getattr(geograd.jax, row.verb)
    results, pull = jax.vjp(lambda *xs: verb(*xs, kind=row.kinds), *map(jnp.asarray, arrays))
    parts = results if isinstance(results, tuple) else (results,)
    np.testing.assert_array_equal(np.concatenate([np.asarray(x).reshape(len(arrays[0]), -1) for x in parts], -1), row.value(arrays))
    rng = np.random.default_rng(1)
    bars = [rng.uniform(-1, 1, x.shape) for x in parts]
    grads = pull(tuple(map(jnp.asarray, bars)) if isinstance(results, tuple) else jnp.asarray(bars[0]))
    found = np.concatenate([np.asarray(x).reshape(len(arrays[0]), -1) for x in grads], -1)
    np.testing.assert_array_equal(found, row.gradient(arrays, bars))


SOME = ["iou(Obb2,Obb2)", "giou(YawBox3,YawBox3)", "distance(Vec2,Segment2)", "closest_points(Segment2,Segment2)", "centroid(Triangle2)"]


@pytest.mark.parametrize("row", [row for row in ROWS if str(row) in SOME], ids=str)
def test_both_orders_by_differences(row):
    arrays = smooth(row, 2, order=2)
    verb = getattr(geograd.jax, row.verb)
    check_grads(lambda *xs: verb(*xs, kind=row.kinds), arrays, order=2, modes=["rev"], atol=1e-3, rtol=1e-3)


def test_transforms_agree():
    np.testing.assert_array_equal(jax.jit(iou)(A, B), geograd.iou(A, B, kind="Obb2"))
    by_a = geograd.iou.value_grad(A, B, kind="Obb2")[1][0]
    np.testing.assert_array_equal(jax.jit(jax.grad(lambda a: iou(a, B).sum()))(A), by_a)
    np.testing.assert_array_equal(jax.vmap(jax.grad(iou))(A, B), by_a)
    of_first = lambda a: iou(a, B[0])
    hessian = jax.jacrev(jax.jacrev(of_first))(jnp.asarray(A[0]))
    np.testing.assert_allclose(hessian, geograd.iou.hessian(A[:1], B[:1], kind="Obb2")[0, :5, :5], atol=1e-12)
    np.testing.assert_array_equal(iou(A[:, None], B[None]), geograd.iou.all_pairs(A, B, kind="Obb2"))
    inner = jax.vmap(jax.vmap(iou, in_axes=(None, 0)), in_axes=(0, None))(A, B)
    np.testing.assert_array_equal(inner, geograd.iou.all_pairs(A, B, kind="Obb2"))
    assert iou(A[0], B[0]).shape == () and iou(A[:0], B[:0]).shape == (0,)


def test_single_precision_stays():
    assert iou(A.astype("f4"), B.astype("f4")).dtype == np.float32


@geograd.function
def reach(point: geograd.Vec2, car: geograd.Obb2, weight: float):
    return weight * geograd.signed_distance(point, car)


def test_own_functions():
    own = geograd.jax.function(reach)
    point = np.array([[3.0, 1.0], [0.1, 0.2], [-2.0, 1.0]])
    np.testing.assert_array_equal(own(point, B, 2.0), reach(point, B, 2.0))
    by_point = jax.grad(lambda p: own(p, B, 2.0).sum())(point)
    np.testing.assert_allclose(by_point, reach.value_grad(point, B, 2.0)[1][0], rtol=1e-14)


def test_errors_say_what_to_do():
    with pytest.raises(TypeError, match=r"kind= must name.*\(Obb2, Obb2\)"):
        geograd.jax.iou(A, B)
    with pytest.raises(ValueError, match=r"`a` needs an array of shape \(..., 5\)"):
        iou(A[:, :4], B)
    with pytest.raises(TypeError, match="float16"):
        iou(A.astype("f2"), B)
    with pytest.raises(AttributeError, match="no attribute 'iuo'"):
        geograd.jax.iuo
    bad = A.copy()
    bad[2, 2] = -1.0
    with pytest.raises(Exception, match="`a` item 2: width is negative"):
        jax.block_until_ready(iou(bad, B))
