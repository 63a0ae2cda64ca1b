"""All pairs of columns of polygons and paths: each number is that of two items, with derivatives in torch and JAX."""

import importlib

import numpy as np
import pytest

import geograd
from geograd import Polygons, Polylines, Rings

#: Bounds of the differences of a matrix from calls for two items, whose sums may be in another order.
CLOSE = {"rtol": 1e-12, "atol": 1e-13}


def ring(vertices, at, seed):
    dice = np.random.default_rng(seed)
    angle = np.arange(vertices) * (2 * np.pi / vertices)
    return np.asarray(at) + dice.uniform(0.6, 1.0, vertices)[:, None] * np.c_[np.cos(angle), np.sin(angle)]


def near():
    """Columns of different lengths whose items overlap in part: one has a hole, one two parts."""
    hole = ring(4, (0, 0), 9) * 0.3
    a = Polygons.of([[ring(6, (0, 0), 1), hole], ring(5, (0.7, 0.3), 2), [[ring(4, (0.2, 1), 3)], [ring(3, (4, 4), 4)]]])
    return a, Polygons.of([ring(5, (0.5, 0), 5), ring(7, (0, 0.8), 6)])


def apart():
    """Columns whose items do not meet."""
    a = Polygons.of([ring(6, (0, 0), 1), [[ring(5, (0, 4), 2)], [ring(4, (2.5, -3), 3)]], ring(3, (-3, 1), 4)])
    return a, Polygons.of([ring(4, (7, 0.2), 5), [ring(5, (6, 5), 6), ring(3, (6, 5), 7) * 0.3 + [4.2, 3.5]]])


def points(count=4):
    return np.random.default_rng(8).normal(0, 2, (count, 2))


def paths():
    rings = Rings.of([ring(5, (0.3, 0.2), 1), ring(3, (3, 1), 2)[::-1], ring(8, (-2, -2), 3)])
    return rings, Polylines(rings.vertices, rings.offsets)


#: A verb and its two columns or points.
CASES = [
    *[(verb, *near()) for verb in ("intersection_area", "iou", "iof")],
    ("distance", *apart()),
    ("distance", *apart()[::-1]),
    *[(verb, points(), near()[0]) for verb in ("distance", "signed_distance", "depth")],
    *[(verb, points(), paths()[0]) for verb in ("distance", "signed_distance", "depth")],
    ("distance", points(), paths()[1]),
]
#: Those that the library has for arrays.
ON_ARRAYS = [own for own in CASES if isinstance(own[2], Polygons)]


def dressed(x):
    return geograd.Vec2(x) if isinstance(x, np.ndarray) else x


def one_by_one(verb, a, b):
    """The matrix of two columns by calls for two items."""
    item = lambda x, k: dressed(x[k : k + 1])
    call = getattr(geograd, verb)
    return np.array([[np.ravel(call(item(a, i), item(b, j)))[0] for j in range(len(b))] for i in range(len(a))])


def numbers(x):
    return x if isinstance(x, np.ndarray) else np.array(x.vertices)


def places(column, item):
    """The places of an item's numbers among those of its column."""
    at = slice(item, item + 1)
    if isinstance(column, np.ndarray):
        return at
    bounds = np.array([item, item + 1])
    for own in column.offsets[::-1] if isinstance(column, Polygons) else [column.offsets]:
        bounds = np.asarray(own)[bounds]
    return slice(*bounds)


def of(library, given, x):
    """A column of a library with other numbers; numbers of points stay an array."""
    return x if isinstance(given, np.ndarray) else getattr(library, type(given).__name__)(x, given)


def names(x):
    return x if isinstance(x, str) else type(x).__name__


@pytest.mark.parametrize(("verb", "a", "b"), ON_ARRAYS, ids=names)
def test_matrices_of_arrays(verb, a, b):
    found, expected = getattr(geograd, verb).all_pairs(dressed(a), dressed(b)), one_by_one(verb, a, b)
    assert found.shape == (len(a), len(b)) and found.any()
    np.testing.assert_allclose(found, expected, **CLOSE)


def test_matrices_of_empty_columns():
    a, b = apart()
    assert geograd.distance.all_pairs(a[:0], b).shape == (0, 2)
    assert geograd.distance.all_pairs(a, b[:0]).shape == (3, 0)
    with pytest.raises(TypeError, match="geograd.area.all_pairs is not there for Polygons"):
        geograd.area.all_pairs(a, b)


@pytest.mark.parametrize(("verb", "a", "b"), CASES, ids=names)
def test_torch_has_derivatives_of_matrices(verb, a, b):
    torch = pytest.importorskip("torch")
    import geograd.torch as ours

    columns = lambda xs: [of(ours, own, x) for own, x in zip((a, b), xs)]
    call = lambda *xs: getattr(ours, verb).all_pairs(*columns(xs))
    xs = [torch.tensor(numbers(x), requires_grad=True) for x in (a, b)]
    found = call(*xs)
    np.testing.assert_allclose(found.detach(), one_by_one(verb, a, b), **CLOSE)
    assert torch.autograd.gradcheck(call, xs, fast_mode=True)
    assert torch.autograd.gradgradcheck(call, xs, fast_mode=True)
    # A gradient is the sum of those of calls for two items.
    weights = torch.tensor(np.random.default_rng(5).normal(size=found.shape))
    gradients = torch.autograd.grad((found * weights).sum(), xs)
    expected = [np.zeros_like(x.detach()) for x in xs]
    for i in range(len(a)):
        for j in range(len(b)):
            pair = dressed(a[i : i + 1]), dressed(b[j : j + 1])
            for column, k, made, bar in zip((a, b), (i, j), expected, getattr(geograd, verb).vjp(*pair, weights[i, j].item())):
                own = places(column, k)
                made[own] += np.reshape(bar, made[own].shape)
    for one, other in zip(gradients, expected):
        assert one.any()
        np.testing.assert_allclose(one, other, **CLOSE)


@pytest.fixture
def in_double():
    """JAX in double precision in all threads: its callbacks run in several."""
    jax = pytest.importorskip("jax")
    before = jax.config.jax_enable_x64
    jax.config.update("jax_enable_x64", True)
    yield jax
    jax.config.update("jax_enable_x64", before)


@pytest.mark.parametrize(("verb", "a", "b"), CASES, ids=names)
def test_jax_has_derivatives_of_matrices(in_double, verb, a, b):
    jax = in_double
    import geograd.jax as ours

    columns = lambda xs: [of(ours, own, x) for own, x in zip((a, b), xs)]
    call = lambda xs: getattr(ours, verb).all_pairs(*columns(xs))
    xs, dice = [numbers(x) for x in (a, b)], np.random.default_rng(6)
    directions = [dice.normal(size=x.shape) for x in xs]
    moved = lambda step: [x + step * own for x, own in zip(xs, directions)]
    found, along = jax.jit(lambda xs, ds: jax.jvp(call, (xs,), (ds,)))(xs, directions)
    np.testing.assert_allclose(found, one_by_one(verb, a, b), **CLOSE)
    low, high = (np.asarray(call(moved(step))) for step in (-1e-6, 1e-6))
    assert np.any(along)
    np.testing.assert_allclose(along, (high - low) / 2e-6, rtol=1e-5, atol=1e-6)
    weights = dice.normal(size=found.shape)
    slope = jax.jit(jax.grad(lambda xs: (call(xs) * weights).sum()))
    total = sum(float((g * own).sum()) for g, own in zip(slope(xs), directions))
    assert total == pytest.approx(float((along * weights).sum()), rel=1e-9, abs=1e-12)
    second = jax.jvp(slope, (xs,), (directions,))[1]
    for one, before, after in zip(second, slope(moved(-1e-6)), slope(moved(1e-6))):
        np.testing.assert_allclose(one, (np.asarray(after) - before) / 2e-6, rtol=1e-5, atol=1e-5)


def test_jax_keeps_matrices_apart_from_calls_item_by_item(in_double):
    import geograd.jax as ours

    jax, column = in_double, near()[0]
    f = lambda call: jax.jit(lambda x: call(ours.Polygons(x, column), column))
    for call in (ours.iou, ours.iou.all_pairs, ours.iou):
        slope = jax.jit(jax.jacrev(f(call)))(column.vertices)
        assert slope.shape == (*f(call)(column.vertices).shape, *column.vertices.shape)
    assert f(ours.iou)(column.vertices).shape == (3,) and f(ours.iou.all_pairs)(column.vertices).shape == (3, 3)


@pytest.mark.parametrize("library", ["torch", "jax"])
def test_measures_have_no_matrices(library):
    pytest.importorskip(library)
    ours = importlib.import_module(f"geograd.{library}")
    a, b = (ours.Polygons.of(own) for own in near())
    with pytest.raises(TypeError, match="takes 1 arguments, not 2"):
        ours.area.all_pairs(a, b)
