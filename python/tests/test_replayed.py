"""Replays of searches by the decisions of one item: on the processor, on a card of CUDA, in JAX."""

import shutil

import numpy as np
import pytest

import geograd
import geograd.cuda as cuda
from cuda_grid import Compiler, Driver
from geograd import _cuda_arrays, _cuda_kernels

RNG = np.random.default_rng(5)


def moved(item, whole, by=1e-3):
    """Rows beside an item, whose decisions are the same; counts stay."""
    rows = item + by * RNG.uniform(-1, 1, (40, len(item)))
    if whole:
        rows[:, -whole:] = item[-whole:]
    return rows


def hexagon(x, y):
    turn = np.arange(6) * np.pi / 3 + 0.1
    return np.concatenate([np.stack([x + np.cos(turn), y + 0.8 * np.sin(turn)], 1).ravel(), [6.0]])


def hull(x):
    corners = np.stack(np.meshgrid([0, 1.0], [0, 1.2], [0, 0.9], indexing="ij"), -1).reshape(8, 3)
    return np.concatenate([(corners + [x, 0.3, 0.2] + 0.02 * RNG.uniform(-1, 1, (8, 3))).ravel(), [8.0]])


#: Verbs, shapes, and items whose decisions small motions do not change; how many whole numbers end an argument.
CASES = [
    ("diameter", ("ConvexPolygon6",), [hexagon(0, 0) * np.append(np.tile([1.0, 0.9], 6), 1)], [1]),
    ("distance", ("Hull3_8", "Hull3_8"), [hull(0.0), hull(2.5)], [1, 1]),
    ("closest_points", ("Vec3", "Hull3_8"), [np.array([0.4, 0.5, 3.0]), hull(0.0)], [0, 1]),
]


@pytest.mark.parametrize("verb, kinds, item, whole", CASES, ids=[case[0] for case in CASES])
def test_a_replay_is_the_search_beside_its_item(verb, kinds, item, whole):
    of = getattr(geograd, verb)
    replay = of.replayed(*item, kind=kinds)
    for dtype, near in ((np.float64, 1e-13), (np.float32, 1e-5)):
        rows = [moved(x, count).astype(dtype) for x, count in zip(item, whole)]
        found, known = replay(*rows), of(*rows, kind=kinds)
        as_array = lambda x: np.asarray(x.array if hasattr(x, "array") else x)
        assert as_array(found).dtype == dtype and np.ptp(as_array(known), 0).min() > 0
        np.testing.assert_allclose(as_array(found), as_array(known), rtol=near, atol=near)
        upstream = np.ones_like(as_array(known))
        # The cotangent of a count is the count itself for a search, zero for a function of numbers.
        for by, of_search, count in zip(_tuple(replay.vjp(*rows, upstream)), _tuple(of.vjp(*rows, upstream, kind=kinds)), whole):
            end = by.shape[-1] - count
            np.testing.assert_allclose(by[:, :end], of_search[:, :end], rtol=1e3 * near, atol=1e3 * near)
            assert (by[:, end:] == 0).all()


def _tuple(x):
    return x if isinstance(x, tuple) else (x,)


def test_shapes_choose_the_row_and_other_items_are_refused():
    replay = geograd.diameter.replayed(geograd.ConvexPolygon6(hexagon(0, 0)))
    assert replay(hexagon(0, 0)[None]).shape == (1,) and geograd.diameter.hints(hexagon(0, 0), kind="ConvexPolygon6") == []
    with pytest.raises(ValueError, match="a replay is of one item, not of 2"):
        geograd.diameter.replayed(np.stack([hexagon(0, 0)] * 2), kind="ConvexPolygon6")
    with pytest.raises(TypeError, match="no row has kind"):
        geograd.diameter.replayed(hexagon(0, 0), kind="Obb2")
    # A straight line replays itself.
    boxes = np.array([[0.0, 0, 2, 1, 0.3], [0.5, 0.2, 2, 1, 0.1]])
    own = geograd.iou.replayed(*boxes, kind="Obb2")
    assert own(boxes[:1], boxes[1:]) == geograd.iou(boxes[:1], boxes[1:], kind="Obb2")


def ellipsoids():
    a, b = np.array([0.0, 0, 0, 1, 2, 1.5, 1, 0, 0, 0]), np.array([4, 1, 0.5, 1, 1, 0.7, 0.9, 0.1, 0.2, 0.3])
    b[6:] /= np.linalg.norm(b[6:])
    return a, b


def test_hints_are_arguments_and_derivatives_by_them_are_zero():
    a, b = ellipsoids()
    replay = geograd.distance.replayed(a, b, kind="Ellipsoid")
    rows = np.stack([b + [0.01 * k, 0, 0, 0, 0, 0, 0, 0, 0, 0] for k in range(4)])
    # Each item has hints of its own.
    hints = np.array([geograd.distance.hints(a, row, kind="Ellipsoid") for row in rows])
    assert (np.ptp(hints, 0) > 0).any() and hints.shape[1] > 100
    value, (by_a, by_b, by_hints) = replay.value_grad(a, rows, hints)
    known, (of_a, of_b) = geograd.distance.value_grad(a, rows, kind="Ellipsoid")
    np.testing.assert_allclose(value, known, rtol=1e-13)
    np.testing.assert_allclose(by_b, of_b, rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(by_a, of_a, rtol=1e-10, atol=1e-12)
    assert (by_hints == 0).all()
    single = geograd.distance.hints(a, b, kind="Ellipsoid", double=False)
    assert single == np.float32(single).tolist() and len(single) == hints.shape[1]
    # The printed program names them.
    program = geograd.distance.replay(a, b, kind="Ellipsoid")
    assert f"hints[{hints.shape[1] - 1}]" in program.c_header()
    assert program.eval([*a, *b, *hints[0]]) == [known[0]]


class OnCard:
    def __init__(self, x):
        self.x = x

    @property
    def __cuda_array_interface__(self):
        return {**self.x.__array_interface__, "version": 3, "stream": None}


@pytest.fixture
def card(monkeypatch, tmp_path):
    if shutil.which("c++") is None:
        pytest.skip("c++ is not installed, so no kernel can run without a card")
    driver = Driver()
    monkeypatch.setenv("GEOGRAD_CACHE", str(tmp_path))
    monkeypatch.setattr(_cuda_kernels, "bindings", lambda compiler=Compiler(): (driver, compiler))
    yield driver
    _cuda_arrays._KNOWN.clear()


def test_a_card_runs_replays(card):
    verb, kinds, item, whole = CASES[1]
    replay = geograd.distance.replayed(*item, kind=kinds)
    rows = [moved(x, count) for x, count in zip(item, whole)]
    value, grads = cuda.function(replay).value_grad(*map(OnCard, rows))
    known, of = replay.value_grad(*rows)
    np.testing.assert_array_equal(value.numpy(), known)
    for by, one in zip(grads, of):
        np.testing.assert_array_equal(by.numpy(), one)
    assert card.launches == 1
    with pytest.raises(cuda.Unavailable, match="geograd.distance.replayed makes a function of one item's decisions"):
        cuda.distance(*map(OnCard, rows), kind=kinds)


def test_engines_of_gradients_take_replays(monkeypatch):
    torch = pytest.importorskip("torch")
    import geograd.torch

    verb, kinds, item, whole = CASES[1]
    rows = [moved(x, count) for x, count in zip(item, whole)]
    replay = geograd.distance.replayed(*item, kind=kinds)
    x, y = (torch.tensor(own, requires_grad=True) for own in rows)
    value = geograd.torch.function(replay)(x, y)
    (by,) = torch.autograd.grad(value.sum(), x)
    np.testing.assert_array_equal(by.numpy(), replay.value_grad(*rows)[1][0])
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    import geograd.jax

    monkeypatch.setenv("GEOGRAD_JAX_PALLAS", "interpret")
    monkeypatch.setattr(geograd.jax._jax, "_computed", None)
    found = jax.jit(jax.grad(lambda a, b: geograd.jax.function(replay)(a, b).sum()))(*rows)
    np.testing.assert_allclose(found, by.numpy(), rtol=1e-9, atol=1e-11)
