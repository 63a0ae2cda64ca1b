"""Kernels of Pallas: run by its interpreter on the CPU, lowered and compiled for CUDA without a card."""

import re
import sys

import numpy as np
import pytest

jax = pytest.importorskip("jax")
pytest.importorskip("jax.experimental.pallas.triton")
jax.config.update("jax_enable_x64", True)

import jax.numpy as jnp

import geograd
import geograd.jax
from geograd import _jax_pallas, _nodes
from pairs import A, B
from pallas_kernels import compiled, texts_of
from samples import ROWS, ordinary

#: The compiler of JAX for the CPU contracts products and sums, that of a card does not.
NEAR = {np.float32: dict(rtol=2e-4, atol=2e-5), np.float64: dict(rtol=1e-9, atol=1e-11)}


@pytest.fixture
def interpreted(monkeypatch):
    """Kernels are run on the CPU, and the host is not asked."""
    monkeypatch.setenv("GEOGRAD_JAX_PALLAS", "interpret")
    jax.clear_caches()
    calls = []
    computed = geograd.jax._jax._computed
    monkeypatch.setattr(geograd.jax._jax, "_computed", lambda node, xs: calls.append(node.name) or computed(node, xs))
    yield calls
    jax.clear_caches()


def close(found, known, dtype):
    assert np.asarray(found).dtype == dtype
    np.testing.assert_allclose(found, known, **NEAR[dtype])


@pytest.mark.slow
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_values_and_derivatives_are_those_of_the_library(interpreted, dtype):
    # More items than a block, and a part of one.
    rng = np.random.default_rng(1)
    a = np.concatenate([rng.uniform(-2, 2, (300, 2)), rng.uniform(0.5, 3, (300, 2)), rng.uniform(-3, 3, (300, 1))], 1).astype(dtype)
    b = np.roll(a, 1, 0) + dtype(0.125)
    score = lambda a, b: geograd.jax.giou(a, b, kind="Obb2")
    value, (of_a, of_b) = geograd.giou.value_grad(a, b, kind="Obb2")
    close(score(a, b), value, dtype)
    close(jax.jit(score)(a, b), value, dtype)
    by_a, by_b = jax.jit(jax.grad(lambda a, b: score(a, b).sum(), (0, 1)))(a, b)
    close(by_a, of_a, dtype)
    close(by_b, of_b, dtype)
    close(jax.vmap(jax.grad(score), (0, None))(a[:5], b[0]), geograd.giou.value_grad(a[:5], b[:1].repeat(5, 0), kind="Obb2")[1][0], dtype)
    along = np.ones_like(a)
    _, moved = jax.jvp(lambda a: score(a, b), (jnp.asarray(a),), (jnp.asarray(along),))
    close(moved, geograd.giou.jvp(a, b, along, np.zeros_like(b), kind="Obb2")[1], dtype)
    assert interpreted == []


def test_second_derivatives(interpreted):
    a, b = jnp.asarray(A[0]), jnp.asarray(B[0])
    found = jax.jit(jax.hessian(lambda a: geograd.jax.iou(a, b, kind="Obb2")))(a)
    np.testing.assert_allclose(found, geograd.iou.hessian(A[:1], B[:1], kind="Obb2")[0, :5, :5], atol=1e-9)
    assert interpreted == []


#: The rows of the usual calls, and of several arguments and results.
SOME = [
    "distance(Vec2,Segment2)", "signed_distance(Obb2,Obb2)", "closest_points(Segment2,Segment2)", "centroid(Triangle2)",
    "kfiou(Obb2,Obb2)", "volume(Obb3)", "giou(YawBox3,YawBox3)",
]


@pytest.mark.parametrize("row", [row for row in ROWS if str(row) in SOME], ids=str)
def test_rows(interpreted, row):
    arrays = ordinary(row, 5)
    verb = getattr(geograd.jax, row.verb)
    results, pull = jax.vjp(lambda *xs: verb(*xs, kind=row.kinds), *map(jnp.asarray, arrays))
    parts = results if isinstance(results, tuple) else (results,)
    found = np.concatenate([np.asarray(x).reshape(5, -1) for x in parts], -1)
    np.testing.assert_allclose(found, row.value(arrays), rtol=1e-9, atol=1e-11)
    bars = [np.random.default_rng(1).uniform(-1, 1, x.shape) for x in parts]
    grads = pull(tuple(map(jnp.asarray, bars)) if isinstance(results, tuple) else jnp.asarray(bars[0]))
    found = np.concatenate([np.asarray(x).reshape(5, -1) for x in grads], -1)
    np.testing.assert_allclose(found, row.gradient(arrays, bars), rtol=1e-8, atol=1e-9)
    assert interpreted == []


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_every_operation_of_programs(interpreted, dtype):
    seen = set()
    for verb in ("iou", "penetration", "distance"):
        for kind in ("Obb2", "Obb3"):
            program = _nodes.of_verb(verb, kind, 2).base.program("vjp", dtype == np.float64)
            seen |= {name for name, _, _ in program.nodes()[0]}

    @geograd.function
    def all_of_them(p: geograd.Vec2, q: float):
        a, b = p.x, p.y
        truth = ((a < b) & ~(a <= q)) | np.equal(a, b)
        chosen = geograd.where(truth, geograd.exp(-a), geograd.log(b))
        near = geograd.minimum(geograd.maximum(a, q), b) + abs(a - 2) + geograd.arctan2(a, b) / geograd.sqrt(b)
        return chosen + near + geograd.sin(a * 3) * geograd.cos(b * 40) + geograd.tanh(q)

    rng = np.random.default_rng(2)
    p, q = rng.uniform(0.25, 4, (200, 2)).astype(dtype), rng.uniform(0.5, 3, 200).astype(dtype)
    own = geograd.jax.function(all_of_them)
    value, (by_p, by_q) = all_of_them.value_grad(p, q)
    close(own(p, q), value, dtype)
    found = jax.jit(jax.grad(lambda p, q: own(p, q).sum(), (0, 1)))(p, q)
    close(found[0], by_p, dtype)
    close(found[1], by_q, dtype)
    seen |= {name for name, _, _ in all_of_them.program_of("value_grad", np.dtype(dtype)).nodes()[0]}
    known = set(_jax_pallas._Evaluation(dtype, _jax_pallas._Unrounded).operations())
    assert seen - {"constant", "input", "bool"} <= known and interpreted == []
    assert known - seen <= {"canonical", "split", "rest", "sin_high", "sin_low", "cos_high", "cos_low", "high", "binade"}, known - seen


def test_bits_of_halves_and_binades():
    """The operations that are no functions of lax, in both formats."""
    for dtype, low in ((np.float32, 12), (np.float64, 27)):
        of = _jax_pallas._Evaluation(dtype, _jax_pallas._Unrounded)
        rng = np.random.default_rng(3)
        x = np.concatenate([np.exp(rng.uniform(-60, 60, 126)), [0.0, 1e-310]]).astype(dtype)
        whole = x.view(np.uint32 if dtype == np.float32 else np.uint64)
        expected = (whole >> whole.dtype.type(low) << whole.dtype.type(low)).view(dtype)
        np.testing.assert_array_equal(of.high(jnp.asarray(x)), expected)
        scaled = (np.asarray(of.binade(jnp.asarray(x))) * x)[:126]
        assert ((2 <= scaled) & (scaled < 4)).all()
        angle = rng.uniform(-9, 9, 128).astype(dtype)
        operations = of.operations()
        for name, wide in (("sin", np.sin(angle.astype(np.float64))), ("cos", np.cos(angle.astype(np.float64)))):
            high, rest = (np.asarray(operations[f"{name}_{part}"](jnp.asarray(angle)), np.float64) for part in ("high", "low"))
            # Of float32 both halves have more digits than the number.
            np.testing.assert_allclose(high + rest, wide, rtol=0, atol=2.0**-36 if dtype == np.float32 else 2.0**-52)
            assert (np.abs(rest) <= np.abs(high) * 2.0 ** (-11 if dtype == np.float32 else -25)).all()
        zeros = [jnp.asarray(np.full(128, zero, dtype)) for zero in (0.0, -0.0)]
        assert all((np.asarray(operations["atan2"](y, x)) == 0).all() for y in zeros for x in zeros)
        assert np.asarray(operations["root"](jnp.asarray(-x))).max() == 0


def test_nan_is_kept_and_empty_arrays_are_empty(interpreted):
    a = A.copy()
    a[1, 2] = np.nan
    iou = lambda a, b: geograd.jax.iou(a, b, kind="Obb2")
    assert len(A) == 3 and np.isnan(iou(a, B)).tolist() == [False, True, False]
    (by,) = jax.grad(lambda a: iou(a, B).sum(), (0,))(jnp.asarray(a))
    assert np.isnan(by).all(1).tolist() == [False, True, False]

    @geograd.function
    def chosen(x: float, y: float):
        return geograd.where(x < 1, y, 2.0)

    # Whatever the operations make of it.
    x, y = np.array([0.0, np.nan, 3.0]), np.array([1.0, 1.0, np.nan])
    assert np.isnan(geograd.jax.function(chosen)(x, y)).tolist() == [False, True, True]
    assert iou(A[:0], B[:0]).shape == (0,) and iou(A[0], B[0]).shape == () and interpreted == []


def test_the_host_computes_what_has_no_kernel(interpreted, monkeypatch):
    rings = np.concatenate([np.array([[0.0, 0, 2, 0, 2, 1, 0, 1, 0, 0, 0, 0]]), np.full((1, 1), 4.0)], 1)
    known = geograd.minimum_circle(rings, kind="ConvexPolygon6")
    found = geograd.jax.minimum_circle(rings, kind="ConvexPolygon6")
    np.testing.assert_array_equal(np.concatenate([np.ravel(x) for x in jax.tree.leaves(found)]), np.ravel(known.array))
    assert len(interpreted) == 1
    monkeypatch.setattr(_jax_pallas, "LONGEST", 10)
    node = _nodes.of_verb("diou", "Obb2", 2)
    monkeypatch.setattr(node, "kept", {})
    np.testing.assert_array_equal(geograd.jax.diou(A, B, kind="Obb2"), geograd.diou(A, B, kind="Obb2"))
    assert len(interpreted) == 2


def test_a_wrong_setting_says_what_is_known(monkeypatch):
    monkeypatch.setenv("GEOGRAD_JAX_PALLAS", "yes")
    with pytest.raises(ValueError, match="'interpret' or 'off', not 'yes'"):
        geograd.jax.iou(A, B, kind="Obb2")


def lowered(f, *xs):
    return jax.jit(f).trace(*xs).lower(lowering_platforms=("cuda",))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("wide", [True, False])
def test_a_card_runs_kernels_without_the_host(monkeypatch, dtype, wide):
    """Lowering for CUDA needs no card."""
    if not wide and dtype == np.float64:
        pytest.skip("float64 needs the setting")
    a, b = jnp.asarray(A, dtype), jnp.asarray(B, dtype)
    iou = lambda a, b: geograd.jax.iou(a, b, kind="Obb2")
    with _jax_pallas._in_64_bits(wide):
        for f in (iou, jax.grad(lambda a, b: iou(a, b).sum()), jax.vmap(jax.hessian(iou))):
            text = lowered(f, a, b).as_text()
            assert "xla.gpu.triton" in text and "callback" not in text
            # Products by themselves, so that no compiler contracts them.
            assert f"mul.rn.f{32 if dtype == np.float32 else 64}" in text
        # A search stays with the host, and so does all where the environment says so: a callback needs the card.
        rings = jnp.zeros((2, 13), dtype)
        with pytest.raises(ValueError, match="different from the lowering platform"):
            lowered(lambda x: geograd.jax.minimum_circle(x, kind="ConvexPolygon6"), rings)
        monkeypatch.setenv("GEOGRAD_JAX_PALLAS", "off")
        with pytest.raises(ValueError, match="different from the lowering platform"):
            lowered(lambda a, b: geograd.jax.iou(a, b, kind="Obb2"), a, b)


@pytest.mark.skipif(sys.platform != "linux", reason="triton is for Linux")
def test_triton_compiles_kernels_without_contraction(tmp_path):
    """Machine code for a card is made without one; the text of a box without a heading has no elementary function."""
    pytest.importorskip("triton")
    a = jnp.ones((300, 4), np.float32)
    f = jax.grad(lambda a, b: geograd.jax.giou(a, b, kind="Aabb2").sum(), (0, 1))
    try:
        texts = texts_of(lowered(f, a, a))
    except (ImportError, AttributeError, TypeError) as error:
        pytest.skip(f"this version of JAX has its modules elsewhere: {error}")
    assert len(texts) == 1
    try:
        made = compiled(texts[0], tmp_path)
    except RuntimeError as error:
        if "parse" not in str(error).lower():
            raise
        pytest.skip(f"this version of triton has another dialect: {error}")
    text = made.asm["ptx"]
    assert len(made.asm["cubin"]) > 1000 and len(re.findall(r"mul\.rn\.f32", text)) > 20
    assert re.findall(r"fma|mad\.rn|mul\.f32|div\.full|div\.approx", text) == []
