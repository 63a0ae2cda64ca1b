"""Arrays of a card that are not torch's, by both protocols, on a card of one processor."""

import gc
import shutil

import numpy as np
import pytest

import geograd
import geograd.cuda as gc_
from cuda_grid import Compiler, Driver
from geograd import _cuda_arrays, _cuda_kernels


class ByInterface:
    """An array of CuPy, as far as it says where it is."""

    def __init__(self, x, stream=None):
        self.x, self.stream = x, stream

    @property
    def __cuda_array_interface__(self):
        told = dict(self.x.__array_interface__)
        return {**told, "version": 3, "stream": self.stream}


def placed(x):
    """A copy in other memory: arrays of one address would be one."""
    return ByInterface(x.copy())


class ByDLPack:
    """An array of a library that has DLPack alone."""

    def __init__(self, x):
        self.x = x

    def __dlpack_device__(self):
        return 2, 0

    def __dlpack__(self, *, stream):
        assert stream == 1
        return self.x.__dlpack__()


@pytest.fixture
def driver(monkeypatch, tmp_path):
    if shutil.which("c++") is None:
        pytest.skip("c++ is not installed, so no kernel can run without a card")
    driver = Driver()
    monkeypatch.setenv("GEOGRAD_CACHE", str(tmp_path))
    monkeypatch.setattr(_cuda_kernels, "bindings", lambda compiler=Compiler(): (driver, compiler))
    yield driver
    _cuda_arrays._KNOWN.clear()
    for node in list(gc_._nodes._NODES.values()):
        for key in [key for key in node.kept if isinstance(key, tuple) and key[0] == "cuda"]:
            del node.kept[key]


def upright(count, seed, dtype=np.float64):
    rng = np.random.default_rng(seed)
    low = rng.uniform(-2, 2, (count, 2))
    return np.concatenate([low, low + rng.uniform(0.5, 3, (count, 2))], 1).astype(dtype)


@pytest.mark.parametrize("wrap", [ByInterface, ByDLPack])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_any_array_of_a_card_is_read_where_it_is(driver, wrap, dtype):
    a, b = upright(40, 1, dtype), upright(40, 2, dtype)
    value = gc_.giou(wrap(a), wrap(b), kind="Aabb2")
    assert isinstance(value, gc_.Array) and value.dtype == dtype and value.shape == (40,)
    np.testing.assert_array_equal(value.numpy(), geograd.giou(a, b, kind="Aabb2"))
    # Rows apart, one row for all, and results of it as arguments.
    wide = np.concatenate([np.zeros((40, 3), dtype), a], 1)
    value, (by_a, by_b) = gc_.giou.value_grad(wrap(wide[::2, 3:]), wrap(b[0]), kind="Aabb2")
    expected, (of_a, of_b) = geograd.giou.value_grad(a[::2], np.repeat(b[:1], 20, 0), kind="Aabb2")
    for found, known in ((value, expected), (by_a, of_a), (by_b, of_b)):
        np.testing.assert_array_equal(found.numpy(), known)
    again = gc_.giou.vjp(wrap(wide[::2, 3:]), wrap(b[0]), value, kind="Aabb2")[0]
    upstream = np.ascontiguousarray(expected)
    known = geograd.giou.vjp(a[::2], np.repeat(b[:1], 20, 0), upstream, kind="Aabb2")[0]
    np.testing.assert_array_equal(again.numpy(), known)
    assert driver.contexts == []


def test_pairs_and_their_reductions(driver):
    a, b = upright(30, 1), upright(50, 2)
    x, y = ByInterface(a), ByDLPack(b)
    matrix = geograd.iou.all_pairs(a, b, kind="Aabb2")
    np.testing.assert_array_equal(gc_.iou.all_pairs(x, y, kind="Aabb2").numpy(), matrix)
    for form, axis, best, at in (
        ("row_max", 1, np.max, np.argmax), ("row_min", 1, np.min, np.argmin),
        ("column_max", 0, np.max, np.argmax), ("column_min", 0, np.min, np.argmin),
    ):
        driver.largest = 0
        values, places = getattr(gc_.iou, form)(x, y, kind="Aabb2")
        np.testing.assert_array_equal(values.numpy(), best(matrix, axis))
        np.testing.assert_array_equal(places.numpy(), at(matrix, axis))
        assert driver.largest < matrix.nbytes / 4, form
    for form, mask in (("above", matrix > 0.2), ("below", matrix < 0.01)):
        rows, columns, values = getattr(gc_.iou, form)(x, y, 0.2 if form == "above" else 0.01, kind="Aabb2")
        known = np.nonzero(mask)
        np.testing.assert_array_equal(rows.numpy(), known[0])
        np.testing.assert_array_equal(columns.numpy(), known[1])
        np.testing.assert_array_equal(values.numpy(), matrix[mask])
    assert gc_.iou.count_above(x, y, 0.2, kind="Aabb2") == (matrix > 0.2).sum()
    total, grads = gc_.iou.sum_grad(x, y, kind="Aabb2")
    expected, known = geograd.iou.sum_grad(a, b, kind="Aabb2")
    np.testing.assert_allclose(total.numpy(), [expected], rtol=1e-13)
    np.testing.assert_allclose(gc_.iou.sum(x, y, kind="Aabb2").numpy(), [expected], rtol=1e-13)
    for found, of in zip(grads, known):
        np.testing.assert_allclose(found.numpy(), of, rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("wrap", [ByInterface, ByDLPack])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_results_go_where_the_caller_wants_them(driver, wrap, dtype):
    a, b = upright(30, 1, dtype), upright(30, 2, dtype)
    expected, known = geograd.giou.value_grad(a, b, kind="Aabb2")
    value, by_a, by_b = (np.full(size, np.nan, dtype) for size in ((30,), (30, 4), (30, 4)))
    place = wrap(value)
    assert gc_.giou(ByInterface(a), ByInterface(b), kind="Aabb2", out=place) is place
    np.testing.assert_array_equal(value, expected)
    value[:] = np.nan
    places = wrap(value), (wrap(by_a), wrap(by_b))
    found, grads = gc_.giou.value_grad(ByInterface(a), ByInterface(b), kind="Aabb2", out=places)
    assert found is places[0] and grads == places[1] and driver.memory == {}
    for one, other in ((value, expected), (by_a, known[0]), (by_b, known[1])):
        np.testing.assert_array_equal(one, other)
    # What is not wanted is nowhere.
    by_b[:] = np.nan
    found, grads = gc_.giou.value_grad(ByInterface(a), ByInterface(b), kind="Aabb2", out=[None, None, wrap(by_b)])
    assert found is None and grads[0] is None
    np.testing.assert_array_equal(by_b, known[1])
    upstream = np.linspace(-1, 1, 30).astype(dtype)
    gc_.giou.vjp(ByInterface(a), ByInterface(b), ByInterface(upstream), kind="Aabb2", out=(wrap(by_a), wrap(by_b)))
    for one, other in zip((by_a, by_b), geograd.giou.vjp(a, b, upstream, kind="Aabb2")):
        np.testing.assert_array_equal(one, other)
    along = np.empty(30, dtype)
    gc_.giou.jvp(*map(ByInterface, (a, b, by_a, by_b)), kind="Aabb2", out=(None, wrap(along)))
    np.testing.assert_array_equal(along, geograd.giou.jvp(a, b, by_a, by_b, kind="Aabb2")[1])
    matrix = np.empty((30, 30), dtype)
    gc_.giou.all_pairs(ByInterface(a), ByInterface(b), kind="Aabb2", out=wrap(matrix))
    np.testing.assert_array_equal(matrix, geograd.giou.all_pairs(a, b, kind="Aabb2"))
    # A result of geograd's is a place, too.
    again = gc_.giou(ByInterface(a), ByInterface(b), kind="Aabb2")
    gc_.giou(ByInterface(a), ByInterface(a), kind="Aabb2", out=again)
    np.testing.assert_array_equal(again.numpy(), geograd.giou(a, a, kind="Aabb2"))


def test_streams_of_results_are_waited_for(driver):
    a, place = upright(5, 1), np.empty(5)
    gc_.area(ByInterface(a), kind="Aabb2", out=ByInterface(place, stream=1))
    assert driver.waited == []
    gc_.area(ByInterface(a), kind="Aabb2", out=ByInterface(place, stream=9))
    # Before the kernel that of the place, after it that of the kernel.
    assert driver.waited == [9, 0]
    gc_.area(ByInterface(a), kind="Aabb2", out=ByDLPack(place))
    assert driver.waited == [9, 0, 0] and driver.contexts == []


def test_places_that_do_not_fit_are_left_as_they_were(driver):
    a, b = upright(6, 1), upright(6, 2)
    x, y = ByInterface(a), ByInterface(b)
    value, by_a, by_b = np.full(6, 7.0), np.full((6, 4), 7.0), np.full((6, 4), 7.0)

    def refused(kind, text, *out):
        launches = driver.launches
        with pytest.raises(kind, match=text):
            gc_.iou.value_grad(x, y, kind="Aabb2", out=out)
        assert driver.launches == launches and (value == 7).all() and (by_b == 7).all()

    refused(ValueError, r"out: 2 arrays where 3 are needed \(value, by a, by b; None for what", ByInterface(value), ByInterface(by_a))
    refused(ValueError, r"out \(by b\): an array of shape \(6, 4\) is needed, not \(6, 3\)", ByInterface(value), None, ByInterface(by_b[:, :3].copy()))
    refused(TypeError, r"out \(by b\): an array of float64", ByInterface(value), None, ByInterface(by_b.astype(np.float32)))
    refused(ValueError, r"out \(by b\): its numbers are not one after", ByInterface(value), None, ByInterface(np.zeros((6, 9))[:, :4]))
    refused(ValueError, r"out \(by b\): it shares memory", ByInterface(value), ByInterface(by_b), ByInterface(by_b))
    refused(ValueError, r"out \(by b\): it shares memory with an argument", ByInterface(value), None, ByInterface(a))
    refused(TypeError, r"out \(by b\): an array on a card is needed, not float", ByInterface(value), None, 1.0)
    refused(TypeError, r"out \(value\) is not on a card of CUDA, but on device 1", value, None, None)
    by_b.flags.writeable = False
    refused(ValueError, r"out \(by b\): it is read-only", ByInterface(value), None, ByInterface(by_b))
    # A place right behind the argument shares nothing with it.
    both = np.concatenate([a, np.zeros((2, 4))]).reshape(-1)
    gc_.area(ByInterface(both[:24].reshape(6, 4)), kind="Aabb2", out=ByInterface(both[24:30]))
    np.testing.assert_array_equal(both[24:30], geograd.area(a, kind="Aabb2"))


GROUPS = [0, 3, 3, 9, 20, 20, 24], [0, 5, 8, 8, 30, 34, 40]


@pytest.mark.parametrize("wrap", [list, np.array, lambda x: placed(np.array(x)), lambda x: placed(np.array(x, np.int32))])
def test_groups_are_a_loop_of_calls(driver, wrap):
    a, b = upright(24, 1), upright(40, 2)
    x, y, groups = ByInterface(a), ByDLPack(b), tuple(map(wrap, GROUPS))
    for form in ("row_max", "column_max", "row_min", "column_min"):
        found = getattr(gc_.giou, form)(x, y, groups=groups, kind="Aabb2")
        for one, other in zip(found, getattr(geograd.giou, form)(a, b, groups=GROUPS, kind="Aabb2")):
            np.testing.assert_array_equal(one.numpy(), other)
    for form in ("above", "below"):
        found = getattr(gc_.giou, form)(x, y, 0.1, groups=groups, kind="Aabb2")
        known = getattr(geograd.giou, form)(a, b, 0.1, groups=GROUPS, kind="Aabb2")
        assert len(known[0]) > 10
        for one, other in zip(found, known):
            np.testing.assert_array_equal(one.numpy(), other)
        assert getattr(gc_.giou, f"count_{form}")(x, y, 0.1, groups=groups, kind="Aabb2") == len(known[0])
    parts = [(slice(*GROUPS[0][k : k + 2]), slice(*GROUPS[1][k : k + 2])) for k in range(6)]
    known = [geograd.giou.sum_grad(a[i], b[j], kind="Aabb2") for i, j in parts]
    total, grads = gc_.giou.sum_grad(x, y, groups=groups, kind="Aabb2")
    np.testing.assert_allclose(total.numpy(), [sum(one for one, _ in known)], rtol=1e-13)
    np.testing.assert_allclose(gc_.giou.sum(x, y, groups=groups, kind="Aabb2").numpy(), total.numpy(), rtol=1e-15)
    for k in range(2):
        np.testing.assert_allclose(grads[k].numpy(), np.concatenate([of[k] for _, of in known]), rtol=1e-12, atol=1e-13)


def test_groups_that_do_not_fit_say_why(driver):
    x = ByInterface(upright(5, 1))
    for groups, kind, text in (
        (([0, 5],), TypeError, "of both lists"), (([0, 4], [0, 5]), ValueError, "of `a` must rise from 0 to 5"),
        (([0, 5], [0, 3, 5]), ValueError, "of `b` must rise"), (([0.0, 5.0], [0, 5]), TypeError, "whole numbers, not float64"),
        (([0, 3, 2, 5], [0, 1, 2, 5]), ValueError, "of `a` must rise"),
        (([0, 5], ByInterface(np.zeros((4, 2), np.int64)[:, 0])), ValueError, "one after another"),
    ):
        with pytest.raises(kind, match=text):
            gc_.iou.row_max(x, x, groups=groups, kind="Aabb2")


def test_own_functions_and_directions(driver):
    @geograd.function
    def gap(p: geograd.Vec2, weight: float):
        return weight * geograd.sqrt(p.x * p.x + p.y * p.y)

    p, weight = upright(9, 3)[:, :2].copy(), np.linspace(1, 2, 9)
    value, (by_p, by_weight) = gc_.function(gap).value_grad(ByInterface(p), ByInterface(weight))
    expected, (of_p, of_weight) = gap.value_grad(p, weight)
    for found, known in ((value, expected), (by_p, of_p), (by_weight, of_weight)):
        np.testing.assert_array_equal(found.numpy(), known)
    along = [np.ones_like(p), np.zeros_like(weight)]
    value, moved = gc_.function(gap).jvp(*map(ByInterface, (p, weight, *along)))
    np.testing.assert_array_equal(moved.numpy(), gap.jvp(p, weight, *along)[1])


def test_memory_is_freed_and_streams_are_waited_for(driver):
    a = upright(5, 1)
    value = gc_.area(ByInterface(a, stream=77), kind="Aabb2")
    assert driver.waited == [77] and len(driver.memory) == 1
    told = value.__cuda_array_interface__
    assert told["data"][0] in driver.memory and told["shape"] == (5,) and told["typestr"] == "<f8" and told["stream"] == 1
    del value
    gc.collect()
    assert driver.memory == {}


def test_what_is_refused_says_why(driver, monkeypatch):
    a = upright(5, 1)
    x = ByInterface(a)
    with pytest.raises(TypeError, match="an array on a card is needed, not list"):
        gc_.area([1.0], kind="Aabb2")
    with pytest.raises(TypeError, match="not on a card of CUDA, but on device 1"):
        gc_.area(a, kind="Aabb2")
    with pytest.raises(TypeError, match="one format is needed"):
        gc_.iou(x, ByInterface(a.astype(np.float32)), kind="Aabb2")
    with pytest.raises(TypeError, match="float32 and float64 are computed, not int64"):
        gc_.area(ByInterface(a.astype(np.int64)), kind="Aabb2")
    with pytest.raises(ValueError, match=r"shape \(..., 4\) is needed, not \(5, 3\)"):
        gc_.area(ByInterface(a[:, :3]), kind="Aabb2")
    with pytest.raises(ValueError, match="beside each other"):
        gc_.area(ByInterface(np.asfortranarray(a)), kind="Aabb2")
    with pytest.raises(_cuda_kernels.Unavailable, match="no kernel for CUDA"):
        gc_.minimum_circle(ByInterface(np.zeros((2, 13))), kind="ConvexPolygon6")
    with pytest.raises(AttributeError, match="is it iou"):
        gc_.iuo
    assert gc_.iou(ByInterface(a[:0]), ByInterface(a[:0]), kind="Aabb2").shape == (0,)
