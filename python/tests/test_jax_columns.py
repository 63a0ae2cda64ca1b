"""Polygons and paths of JAX's arrays: values of the library, gradients of differences, under jit, grad, vmap and jvp."""

import numpy as np
import pytest

jax = pytest.importorskip("jax")
import jax.numpy as jnp  # noqa: E402

import geograd  # noqa: E402
import geograd.jax as ours  # noqa: E402

SQUARE = [(0.0, 0.0), (4.0, 0.1), (4.2, 4.0), (0.3, 4.0)]
HOLE = [(1.0, 1.0), (2.1, 1.2), (2.0, 2.3), (1.2, 2.0)]
KITE = [(1.5, 0.7), (5.1, 1.3), (3.9, 5.2), (0.6, 3.1)]
FAR = [(9.0, 9.0), (10.0, 9.3), (9.2, 10.0)]
POINTS = np.array([[1.5, 1.6], [8.1, 8.7]])
A = geograd.Polygons.of([[SQUARE, HOLE], [[SQUARE[::-1], HOLE[::-1]], [FAR]]])
B = geograd.Polygons.of([KITE, [KITE[::-1]]])
C = geograd.Polygons.of([[(6.0, 1), (7, 2), (6.3, 3)], [[(5.1, 5.3), (6.2, 7.4), (4.9, 6)], [(40.0, 1), (41, 1), (41, 2)]]])
RINGS = geograd.Rings.of([SQUARE, KITE[::-1]])
LINES = geograd.Polylines.of([SQUARE, KITE[:2]])
BOXES = np.array([[6.0, 1, 2, 1, 0.4], [6, 5.5, 1, 2, 0.3]])
SPACE = geograd.Polylines(np.random.default_rng(1).normal(size=(7, 3)), [0, 3, 7])

#: A verb, its arguments, the shape of rows.
CASES = [
    *[(verb, (A,), None) for verb in ("area", "perimeter", "length", "centroid")],
    *[(verb, (A, B), None) for verb in ("intersection_area", "union_area", "iou", "iof")],
    ("iou", (A, B[0]), None),
    ("distance", (A, C), None),
    ("distance", (A[0], C), None),
    *[(verb, (POINTS, A), None) for verb in ("distance", "signed_distance", "depth")],
    ("distance", (A, BOXES), "Obb2"),
    *[(verb, (RINGS,), None) for verb in ("area", "signed_area", "perimeter", "centroid", "second_moments")],
    *[(verb, (POINTS, RINGS), None) for verb in ("distance", "signed_distance", "depth", "winding")],
    ("signed_distance", (POINTS, RINGS[:1]), None),
    ("length", (LINES,), None),
    ("distance", (POINTS, LINES), None),
    ("length", (SPACE,), None),
    ("distance", (np.full((2, 3), 2.0), SPACE), None),
    *[(verb, (geograd.Clouds(SPACE.vertices, SPACE.offsets),), None) for verb in ("centroid", "second_moments")],
]
#: Those whose second derivatives are looked at: one of each formula.
TWICE = [CASES[k] for k in (2, 3, 6, 8, 9, 12, 14)]


@pytest.fixture(autouse=True)
def double():
    with jax.enable_x64(True) if hasattr(jax, "enable_x64") else jax.experimental.enable_x64():
        yield


def of(column, vertices):
    return getattr(ours, type(column).__name__)(vertices, column)


def function(verb, arguments, kind):
    """A verb as a function of the arrays of its arguments, and these."""
    xs = [x if isinstance(x, np.ndarray) else np.array(x.vertices) for x in arguments]

    def f(*xs):
        own = [x if isinstance(given, np.ndarray) else of(given, x) for given, x in zip(arguments, xs)]
        return getattr(ours, verb)(*own, **({} if kind is None else {"kind": kind}))

    return f, xs


@pytest.mark.parametrize(("verb", "arguments", "kind"), CASES, ids=lambda x: x if isinstance(x, str) else None)
def test_values_and_derivatives(verb, arguments, kind):
    f, xs = function(verb, arguments, kind)
    given = [getattr(geograd, kind or f"Vec{x.shape[1]}")(x) if isinstance(x, np.ndarray) else x for x in arguments]
    expected = np.asarray(getattr(geograd, verb)(*given))
    np.testing.assert_allclose(jax.jit(f)(*xs), expected, rtol=1e-14)
    dice = np.random.default_rng(5)
    bar, directions = dice.normal(size=expected.shape), [dice.normal(size=x.shape) for x in xs]
    found, back = jax.vjp(f, *xs)
    np.testing.assert_allclose(found, expected, rtol=1e-14)
    bars = back(jnp.asarray(bar))
    of_library = getattr(geograd, verb).vjp(*given, bar)
    for one, other in zip(bars, of_library if isinstance(of_library, tuple) else (of_library,)):
        np.testing.assert_allclose(one, np.asarray(other).reshape(one.shape), rtol=1e-12)
    # Derivatives along directions are those of differences, and those of the cotangents.
    _, along = jax.jvp(f, tuple(xs), tuple(directions))
    total = sum(float((g * d).sum()) for g, d in zip(bars, directions))
    assert float((along * bar).sum()) == pytest.approx(total, rel=1e-9, abs=1e-12)
    low, high = (np.asarray(f(*[x + step * d for x, d in zip(xs, directions)])) for step in (-1e-6, 1e-6))
    np.testing.assert_allclose(along, (high - low) / 2e-6, rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize(("verb", "arguments", "kind"), TWICE, ids=lambda x: x if isinstance(x, str) else None)
def test_second_derivatives_are_those_of_differences(verb, arguments, kind):
    f, xs = function(verb, arguments, kind)
    dice = np.random.default_rng(6)
    weights, directions = dice.normal(size=np.shape(f(*xs))), [dice.normal(size=x.shape) for x in xs]
    slope = jax.grad(lambda xs: (f(*xs) * weights).sum())
    second = jax.jit(lambda xs, ds: jax.jvp(slope, (xs,), (ds,))[1])(xs, directions)
    low, high = (slope([x + step * d for x, d in zip(xs, directions)]) for step in (-1e-6, 1e-6))
    for one, before, after in zip(second, low, high):
        np.testing.assert_allclose(one, (after - before) / 2e-6, rtol=1e-5, atol=1e-5)
    assert max(float(abs(one).max()) for one in second) > 1e-3


def test_a_column_is_a_tree():
    a, b = ours.Polygons.of(A), ours.Polygons.of(B)

    @jax.jit
    def loss(a, b):
        return (1 - ours.iou(a, b)).sum()

    by = jax.jit(jax.grad(loss))(a, b)
    assert type(by) is ours.Polygons and by.vertices.shape == A.vertices.shape
    np.testing.assert_allclose(by.vertices, -geograd.iou.value_grad(A, B)[1][0], rtol=1e-12)
    stepped = jax.tree.map(lambda x, g: x - 0.1 * g, a, by)
    assert loss(stepped, b) < loss(a, b) and len(stepped) == 2 and stepped.offsets[0].tolist() == A.offsets[0].tolist()
    assert loss._cache_size() <= 3
    assert "jax.Polygons 2 of" in repr(a)


def test_maps_over_columns_of_one_layout():
    moves = jnp.linspace(0, 1, 3)[:, None, None]
    many = A.vertices + moves
    f = lambda x, y: ours.iou(of(A, x), of(B, y))
    expected = np.stack([geograd.iou(geograd.Polygons(x, A.offsets), B) for x in np.asarray(many)])
    np.testing.assert_allclose(jax.vmap(f, (0, None))(many, B.vertices), expected)
    np.testing.assert_allclose(jax.jit(jax.vmap(f, (0, None)))(many, B.vertices), expected)
    slopes = jax.vmap(jax.grad(lambda x: f(x, B.vertices).sum()))(many)
    np.testing.assert_allclose(slopes[1], jax.grad(lambda x: f(x, B.vertices).sum())(many[1]), rtol=1e-12)
    slope = jax.grad(lambda x: (ours.centroid(of(RINGS, x)) ** 2).sum())
    second = jax.jit(lambda x: jax.jvp(slope, (x,), (jnp.ones_like(x).at[0].set(0),))[1])
    some = RINGS.vertices + moves
    np.testing.assert_allclose(jax.vmap(second)(some)[2], second(some[2]), rtol=1e-9, atol=1e-12)
    spots = np.array([[0.5, 0.5], [9.3, 9.4]])
    inside = jax.vmap(lambda p: ours.contains(ours.Polygons.of(A), p))(jnp.asarray(np.stack([spots, spots + 9])))
    assert inside.tolist() == [geograd.contains(A, spots + k).tolist() for k in (0, 9)] and inside.any()


def test_forward_and_reverse_agree():
    f, xs = function("iou", (A[0], B), None)
    forward, reverse = jax.jacfwd(f, (0, 1))(*xs), jax.jacrev(f, (0, 1))(*xs)
    for one, other in zip(forward, reverse):
        np.testing.assert_allclose(one, other, rtol=1e-12, atol=1e-14)
    assert np.abs(forward[0]).max() > 1e-3


def test_single_precision_and_rings_of_one_size():
    x = jnp.asarray([SQUARE, KITE], jnp.float32)
    found = ours.area(ours.Polygons.rings(x))
    assert found.dtype == jnp.float32
    np.testing.assert_allclose(found, geograd.area(geograd.Polygons.of(np.asarray(x))), rtol=1e-6)
    # Hosts see arrays of a compiled function in its format.
    slope = jax.jit(jax.grad(lambda x: ours.area(ours.Polygons.rings(x)).sum()))(x)
    assert slope.shape == (2, 4, 2) and slope.dtype == jnp.float32
    # Columns of arrays are constants.
    assert jax.grad(lambda p: ours.signed_distance(p, RINGS).sum())(jnp.asarray(POINTS)).shape == (2, 2)


def test_descent_in_a_compiled_loop():
    target = geograd.Polygons.of([[SQUARE, HOLE]])
    turns = np.arange(8) * (2 * np.pi / 8)
    ring = jnp.asarray(2 + np.stack([np.cos(turns), np.sin(turns)], -1))[None]
    slope = jax.grad(lambda x: ours.iou(ours.Polygons.rings(x), target).sum())
    after = jax.lax.fori_loop(0, 60, lambda _, x: x + 0.5 * slope(x), ring)
    score = lambda x: float(ours.iou(ours.Polygons.rings(x), target)[0])
    assert score(ring) < 0.3 and score(after) > 0.7


def test_refusals():
    a = ours.Polygons.of(A)
    with pytest.raises(TypeError, match="geograd.giou takes no Polygons"):
        ours.giou(a, a)
    with pytest.raises(TypeError, match="takes 2 arguments, not 1"):
        ours.iou(a)
    with pytest.raises(TypeError, match="geograd.winding of Rings has no second derivatives"):
        slope = jax.grad(lambda x: ours.winding(POINTS, of(RINGS, x)).sum())
        jax.jvp(slope, (RINGS.vertices,), (RINGS.vertices,))
    with pytest.raises(ValueError, match="polygon 1: "):
        ours.Polygons(np.where(np.arange(len(A.vertices))[:, None] == 8, np.nan, A.vertices), A)
    with pytest.raises(ValueError, match=r"\(19, 2\) is the shape"):
        ours.Polygons(np.zeros((3, 2)), A)
    with pytest.raises(TypeError, match="int"):
        ours.Polygons(np.zeros((4, 2), int), ([0, 4],))
    with pytest.raises(Exception, match="polygon 0: "):
        jax.jit(lambda x: ours.area(of(A, x)))(np.full((19, 2), np.nan)).block_until_ready()
