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


def test_forward_mode():
    by_a, by_b = geograd.iou.value_grad(A, B, kind="Obb2")[1]
    rng = np.random.default_rng(4)
    da, db = rng.normal(size=(2, *A.shape))
    value, along = jax.jvp(iou, (A, B), (da, db))
    np.testing.assert_array_equal(value, geograd.iou(A, B, kind="Obb2"))
    np.testing.assert_allclose(along, (by_a * da + by_b * db).sum(-1), atol=1e-13)
    # Along one argument alone, which leaves the other one out.
    np.testing.assert_allclose(jax.jit(lambda d: jax.jvp(lambda a: iou(a, B), (A,), (d,))[1])(da), (by_a * da).sum(-1), atol=1e-13)
    of_first = lambda a: iou(a, B[0])
    hessian = geograd.iou.hessian(A[:1], B[:1], kind="Obb2")[0, :5, :5]
    for way in (jax.hessian, lambda f: jax.jacfwd(jax.jacfwd(f)), lambda f: jax.jacrev(jax.jacfwd(f)), lambda f: jax.jit(jax.hessian(f))):
        np.testing.assert_allclose(way(of_first)(A[0]), hessian, atol=1e-12)
    both = jax.hessian(lambda a, b: iou(a, b), argnums=(0, 1))(A[0], B[0])
    whole = geograd.iou.hessian(A[:1], B[:1], kind="Obb2")[0]
    np.testing.assert_allclose(np.block([[np.asarray(x) for x in row] for row in both]), whole, atol=1e-12)
    pushed = jax.vmap(lambda a, d: jax.jvp(of_first, (a,), (d,))[1])(A, da)
    np.testing.assert_allclose(pushed[0], along[0] - (by_b[0] * db[0]).sum(), atol=1e-13)


@pytest.mark.parametrize("row", [row for row in ROWS if str(row) in SOME], ids=str)
def test_both_modes_by_differences(row):
    arrays = smooth(row, 2, order=2)
    verb = getattr(geograd.jax, row.verb)
    check_grads(lambda *xs: verb(*xs, kind=row.kinds), arrays, order=2, modes=["fwd", "rev"], atol=1e-3, rtol=1e-3)


def test_loops_and_checkpoints():
    def descent(a):
        step = lambda a, _: (a - 0.1 * jax.grad(lambda a: (1 - iou(a, B)).sum())(a), None)
        return jax.lax.scan(step, a, None, length=3)[0].sum()

    slope = jax.grad(jax.jit(descent))(A)
    tangent = jax.jvp(descent, (A,), (jnp.ones_like(A),))[1]
    np.testing.assert_allclose(tangent, slope.sum(), rtol=1e-10)
    np.testing.assert_allclose(jax.grad(lambda a: jax.checkpoint(iou)(a, B).sum())(A), jax.grad(lambda a: iou(a, B).sum())(A))


def test_all_pairs():
    matrix = geograd.jax.iou.all_pairs(A, B, kind="Obb2")
    np.testing.assert_array_equal(matrix, geograd.iou.all_pairs(A, B, kind="Obb2"))
    bars = np.random.default_rng(1).normal(size=matrix.shape)
    grads = jax.grad(lambda a, b: (geograd.jax.iou.all_pairs(a, b, kind="Obb2") * bars).sum(), argnums=(0, 1))(A, B)
    for grad, expected in zip(grads, geograd.iou.all_pairs_vjp(A, B, bars, kind="Obb2")):
        np.testing.assert_allclose(grad, expected, atol=1e-13)
    batches = geograd.jax.iou.all_pairs(np.stack([A, B]), B, kind="Obb2")
    assert batches.shape == (2, 3, 3)
    np.testing.assert_array_equal(batches[1], geograd.iou.all_pairs(B, B, kind="Obb2"))
    near = geograd.jax.distance.all_pairs(A[:, 0], B[:, 0], kind="number")
    np.testing.assert_array_equal(near, np.abs(A[:, :1] - B[:, 0]))


def test_conversions():
    box = np.array([[1.0, 2.0, 4.0, 2.0, 1.9]])
    for to in ("Le90", "Detectron2Box"):
        found = geograd.jax.convert(box, kind="ImageBox", to=to)
        np.testing.assert_array_equal(found, geograd.convert(geograd.ImageBox(box), to=to).array)
    with pytest.raises(TypeError, match="say which by to="):
        geograd.jax.convert(box, kind="ImageBox")


NAMED = {"iou_loss": "iou", "giou_loss": "giou", "diou_loss": "diou", "ciou_loss": "ciou", "eiou_loss": "eiou", "probiou_loss": "probiou"}


@pytest.mark.parametrize("name", [*NAMED, "kfiou_loss", "gwd_loss", "kld_loss"])
def test_losses_are_those_of_torch(name):
    loss = getattr(geograd.jax, name)
    weight = np.array([0.5, 2.0, 0.0])
    if name in NAMED:
        each = 1 - geograd.jax._score(NAMED[name], A, B, "Obb2")
        np.testing.assert_array_equal(loss(A, B, reduction="none"), each)
        np.testing.assert_array_equal(geograd.jax.loss(NAMED[name], A, B), loss(A, B))
    each = np.asarray(loss(A, B, reduction="none"))
    np.testing.assert_allclose(loss(A, B), each.mean())
    np.testing.assert_allclose(loss(A, B, reduction="sum", weight=weight), (each * weight).sum())
    np.testing.assert_allclose(loss(A, B, weight=np.tile(weight[:, None], 5), avg_factor=2.0), (each * weight).sum() / 2)
    assert loss(A[:0], B[:0]) == 0 and loss(A, B, weight=0 * weight, avg_factor=0.0) == 0
    grad = jax.jit(jax.grad(loss))(A, B)
    assert np.isfinite(grad).all() and np.isfinite(jax.grad(loss)(B, B)).all()
    with pytest.raises(ValueError, match="avg_factor"):
        loss(A, B, reduction="sum", avg_factor=1.0)
    torch, own = pytest.importorskip("torch"), pytest.importorskip("geograd.torch")
    other = next(getattr(own, one) for one in dir(own) if one.lower() == name.replace("_", ""))
    other = other(**({"centers": 0} if name == "kfiou_loss" else {}))
    a = torch.tensor(A, requires_grad=True)
    value = other(a, torch.tensor(B))
    value.backward()
    np.testing.assert_allclose(loss(A, B), value.item(), rtol=1e-13)
    np.testing.assert_allclose(grad, a.grad.numpy(), rtol=1e-9, atol=1e-13)
