"""Kernels of CUDA: compiled by NVRTC, which needs no card, and run on a grid of one processor in place of the driver."""

import contextlib
import shutil

import numpy as np
import pytest

import geograd

torch = pytest.importorskip("torch", reason="torch is not installed")

import geograd.torch as gt
from cuda_grid import Compiler, Driver
from geograd import _cuda, _cuda_kernels, _nodes


def boxes(count, seed, dtype=torch.float64):
    rng = np.random.default_rng(seed)
    rows = np.concatenate(
        [rng.uniform(-2, 2, (count, 2)), rng.uniform(0.5, 3, (count, 2)), rng.uniform(-3, 3, (count, 1))], axis=1
    )
    return torch.tensor(rows, dtype=dtype)


def upright(count, seed, dtype=torch.float64):
    """Boxes without headings, whose kernels compile in less time."""
    x = boxes(count, seed, dtype)
    return torch.cat([x[:, :2] - x[:, 2:4] / 2, x[:, :2] + x[:, 2:4] / 2], 1)


class Card:
    """What torch would say of a card, of tensors in the memory of the processor."""

    def __init__(self):
        self.kept = []

    def is_there(self, x):
        return True

    def entered(self, device):
        return contextlib.nullcontext()

    def architecture(self, device):
        return "sm_90"

    def stream(self, device):
        return 0

    def keep(self, x, device):
        self.kept.append(x)


@pytest.fixture
def on_kernels(monkeypatch, tmp_path):
    """Everything that torch computes goes through kernels, which run on a card of one processor."""
    if shutil.which("c++") is None:
        pytest.skip("c++ is not installed, so no kernel can run without a card")
    driver, compiler = Driver(), Compiler()
    driver.texts = compiler.texts
    monkeypatch.setenv("GEOGRAD_CACHE", str(tmp_path))
    monkeypatch.setattr(_cuda_kernels, "bindings", lambda: (driver, compiler))
    monkeypatch.setattr(_cuda, "card", Card())
    yield driver
    # Kernels of a driver end with it.
    for node in list(_nodes._NODES.values()):
        for key in [key for key in node.kept if isinstance(key, tuple) and key[0] == "cuda"]:
            del node.kept[key]


@pytest.mark.parametrize("dtype", [torch.float32, torch.float64])
def test_values_and_gradients_have_the_bits_of_the_library(on_kernels, dtype):
    a, b = boxes(200, 1, dtype).requires_grad_(), boxes(200, 2, dtype).requires_grad_()
    value = gt.giou(a, b, kind="Obb2")
    by_a, by_b = torch.autograd.grad(value.sum(), (a, b))
    assert on_kernels.launches == 2
    expected, (of_a, of_b) = geograd.giou.value_grad(a.detach().numpy(), b.detach().numpy(), kind="Obb2")
    np.testing.assert_array_equal(value.detach().numpy(), expected)
    # The cotangent of a sum is one.
    np.testing.assert_array_equal(by_a.numpy(), of_a)
    np.testing.assert_array_equal(by_b.numpy(), of_b)


def test_rows_are_read_where_they_are(on_kernels):
    wide = torch.cat([torch.zeros(50, 3, dtype=torch.float64), boxes(50, 3), torch.ones(50, 2, dtype=torch.float64)], dim=1)
    a, b = wide[::2, 3:8], boxes(1, 4)[0]
    rows, *steps = _cuda._rows(a, (25,), 1, 5)
    assert rows.data_ptr() == a.data_ptr() and steps[0] == 20
    assert _cuda._rows(b, (25,), 1, 5)[1] == 0
    expected = geograd.iou(a.numpy(), b.numpy(), kind="Obb2")
    np.testing.assert_array_equal(gt.iou(a, b, kind="Obb2").numpy(), expected)
    # Every pair: rows of either list repeat, and none is copied.
    c = boxes(7, 5)
    rows, *steps = _cuda._rows(c[None], (25, 7), 7, 5)
    assert rows.data_ptr() == c.data_ptr() and steps == [0, 5]
    matrix = gt.iou(a[:, None], c[None], kind="Obb2")
    np.testing.assert_array_equal(matrix.numpy(), geograd.iou.all_pairs(a.numpy(), c.numpy(), kind="Obb2"))


@pytest.mark.parametrize("dtype", [torch.float32, torch.float64])
@pytest.mark.parametrize("form", ["row_max", "column_max"])
def test_extremes_of_rows_have_no_matrix(on_kernels, monkeypatch, dtype, form):
    monkeypatch.setattr(gt.Verb, "all_pairs", None)
    a, b = boxes(30, 1, dtype), boxes(90, 2, dtype).requires_grad_()
    values, places = getattr(gt.giou, form)(a, b, kind="Obb2")
    found, at = getattr(geograd.giou, form)(a.numpy(), b.detach().numpy(), kind="Obb2")
    np.testing.assert_array_equal(values.detach().numpy(), found)
    np.testing.assert_array_equal(places.numpy(), at)
    assert sum("double totals" in text or "best" in text for text in on_kernels.texts) == 2
    (by,) = torch.autograd.grad(values.sum(), b)
    pairs = (a, b[places]) if form == "row_max" else (a[places], b)
    (expected,) = torch.autograd.grad(gt.giou(*pairs, kind="Obb2").sum(), b)
    np.testing.assert_array_equal(by.numpy(), expected.numpy())


def test_the_first_of_equal_results_counts_and_nan_is_kept(on_kernels):
    a = upright(3, 1)
    b = torch.cat([a[1:2]] * 70 + [a[:1]])
    values, places = gt.iou.row_max(a, b, kind="Aabb2")
    assert places[:2].tolist() == [70, 0] and values[:2].tolist() == [1.0, 1.0]
    b[40, 0] = float("nan")
    values, places = gt.iou.row_max(a, b, kind="Aabb2")
    assert values.isnan().all() and places.tolist() == [40, 40, 40]
    values, places = gt.iou.row_max(a, b[:0], kind="Aabb2")
    assert values.tolist() == [-np.inf] * 3 and places.tolist() == [-1] * 3
    assert gt.iou.row_max(a[:0], b, kind="Aabb2")[0].shape == (0,)


def test_pairs_above_a_threshold_are_in_order(on_kernels, monkeypatch):
    monkeypatch.setattr(gt.Verb, "all_pairs", None)
    a, b = upright(40, 1).requires_grad_(), upright(50, 2)
    rows, columns, values = gt.iou.above(a, b, 0.2, kind="Aabb2")
    expected = geograd.iou.above(a.detach().numpy(), b.numpy(), 0.2, kind="Aabb2")
    assert len(rows) > 20
    for found, known in zip((rows, columns, values.detach()), expected):
        np.testing.assert_array_equal(found.numpy(), known)
    assert values.requires_grad
    assert gt.iou.count_above(a.detach(), b, 0.2, kind="Aabb2") == len(rows)
    assert gt.iou.count_above(a.detach(), b, 2.0, kind="Aabb2") == 0
    assert [len(x) for x in gt.iou.above(a, b, 2.0, kind="Aabb2")] == [0, 0, 0]


def test_groups_are_taken_apart(on_kernels):
    a, b = upright(12, 1), upright(20, 2)
    groups = torch.tensor([0, 5, 5, 12]), torch.tensor([0, 0, 8, 20])
    offsets = tuple(x.numpy() for x in groups)
    for form in ("row_max", "column_max"):
        values, places = getattr(gt.giou, form)(a, b, groups=groups, kind="Aabb2")
        found, at = getattr(geograd.giou, form)(a.numpy(), b.numpy(), groups=offsets, kind="Aabb2")
        np.testing.assert_array_equal(values.numpy(), found)
        np.testing.assert_array_equal(places.numpy(), at)
    found = gt.giou.above(a, b, -0.5, groups=groups, kind="Aabb2")
    expected = geograd.giou.above(a.numpy(), b.numpy(), -0.5, groups=offsets, kind="Aabb2")
    for x, known in zip(found, expected):
        np.testing.assert_array_equal(x.numpy(), known)
    with pytest.raises(ValueError, match="offsets of `b`"):
        gt.giou.row_max(a, b, groups=(groups[0], groups[1] + 1), kind="Aabb2")


@pytest.mark.parametrize("dtype", [torch.float32, torch.float64])
@pytest.mark.parametrize("form", ["sum", "mean"])
def test_sums_of_pairs_have_gradients_of_any_order(on_kernels, dtype, form):
    a, b = upright(60, 1, dtype).requires_grad_(), upright(33, 2, dtype).requires_grad_()
    total = getattr(gt.giou, form)(a, b, kind="Aabb2")
    plain = getattr(gt.giou, form)(a.detach(), b.detach(), kind="Aabb2")
    by = torch.autograd.grad(total, (a, b), create_graph=True)
    first = torch.autograd.grad(getattr(gt.giou, form)(a, b, kind="Aabb2"), (a, b))
    expected, grads = getattr(geograd.giou, f"{form}_grad")(a.detach().numpy(), b.detach().numpy(), kind="Aabb2")
    close = dict(rtol=2e-5, atol=2e-4) if dtype == torch.float32 else dict(rtol=1e-12, atol=1e-12)
    for found in (total, plain):
        np.testing.assert_allclose(found.detach().numpy(), expected, **close)
    for found, again, known in zip(by, first, grads):
        np.testing.assert_allclose(found.detach().numpy(), known, **close)
        np.testing.assert_allclose(again.numpy(), known, **close)
    (second,) = torch.autograd.grad(by[0][0, 0], a)
    if dtype == torch.float64:
        hessian = geograd.giou.hessian(a[:1].detach().numpy(), b.detach().numpy(), kind="Aabb2")[:, 0, :4].sum(0)
        hessian /= a.shape[0] * b.shape[0] if form == "mean" else 1
        np.testing.assert_allclose(second[0].numpy(), hessian, rtol=1e-9, atol=1e-9)
        assert not second[1:].any()


def test_many_sums_of_chunks_are_added_in_steps(on_kernels):
    a, b = upright(700, 1), upright(3, 2)
    expected = geograd.iou.sum(a.numpy(), b.numpy(), kind="Aabb2")
    np.testing.assert_allclose(float(gt.iou.sum(a, b, kind="Aabb2")), expected, rtol=1e-12)
    assert gt.iou.sum(a[:0], b, kind="Aabb2") == 0 and gt.iou.mean(a, b[:0], kind="Aabb2") == 0


def test_a_matrix_pulls_back_without_gradients_of_pairs(on_kernels):
    a, b = upright(25, 1).requires_grad_(), upright(40, 2).requires_grad_()
    weights = torch.from_numpy(np.random.default_rng(3).normal(size=(40, 25))).T
    by = torch.autograd.grad((gt.giou.all_pairs(a, b, kind="Aabb2") * weights).sum(), (a, b))
    upstream = np.ascontiguousarray(weights.numpy())
    expected = geograd.giou.all_pairs_vjp(a.detach().numpy(), b.detach().numpy(), upstream, kind="Aabb2")
    for found, known in zip(by, expected):
        np.testing.assert_allclose(found.numpy(), known, rtol=1e-12, atol=1e-12)


def test_lists_of_pairs_may_be_strided(on_kernels):
    wide = torch.cat([upright(20, 1), upright(20, 2)], 1)
    a, b = wide[::2, :4], wide[1::3, 4:]
    values, places = gt.iou.row_max(a, b, kind="Aabb2")
    found, at = geograd.iou.row_max(a.numpy().copy(), b.numpy().copy(), kind="Aabb2")
    np.testing.assert_array_equal(values.numpy(), found)
    np.testing.assert_array_equal(places.numpy(), at)


def test_second_derivatives_and_own_functions(on_kernels):
    @geograd.function
    def clearance(p: geograd.Vec2, box: geograd.Obb2):
        return geograd.signed_distance(p, box) ** 2

    on_tensors = gt.function(clearance)
    p = torch.tensor([[3.0, 0.3], [0.1, 2.2]], dtype=torch.float64, requires_grad=True)
    box = boxes(2, 6)
    value = on_tensors(p, box)
    (first,) = torch.autograd.grad(value.sum(), p, create_graph=True)
    (second,) = torch.autograd.grad(first[:, 0].sum(), p)
    hessian = clearance.hessian(p.detach().numpy(), box.numpy())
    np.testing.assert_allclose(second.numpy(), hessian[:, 0, :2], rtol=1e-12, atol=1e-12)


def test_nothing_and_nan(on_kernels):
    none = torch.zeros(0, 5, dtype=torch.float64)
    assert gt.iou(none, none, kind="Obb2").shape == (0,)
    a = boxes(3, 7)
    a[1, 2] = float("nan")
    value = gt.iou(a, boxes(3, 8), kind="Obb2")
    assert value.isnan().tolist() == [False, True, False]


def test_what_has_no_kernel_says_so():
    node = _nodes.of_verb("minimum_circle", "ConvexPolygon6", 1)
    with pytest.raises(_cuda.Unavailable, match="no kernel for CUDA"):
        _cuda.source_of(node, torch.float64)


@pytest.fixture
def nvrtc():
    bindings = pytest.importorskip("cuda.bindings.nvrtc", reason="cuda-bindings is not installed")
    try:
        bindings.nvrtcVersion()
    except Exception as error:
        pytest.skip(f"NVRTC does not load: {error}")
    return bindings


@pytest.mark.parametrize("architecture", ["sm_80", "sm_90"])
@pytest.mark.parametrize("verb, kind", [("iou", "Obb2"), ("giou", "Obb2"), ("signed_distance", ("Vec3", "Obb3")), ("kfiou", "Obb2")])
def test_nvrtc_compiles_kernels_without_a_card(nvrtc, monkeypatch, tmp_path, architecture, verb, kind):
    monkeypatch.setenv("GEOGRAD_CACHE", str(tmp_path))
    node = _nodes.of_verb(verb, kind, 2).vjp()
    image = _cuda_kernels.compiled(_cuda.source_of(node, torch.float32), architecture, nvrtc)
    assert image[:4] == b"\x7fELF" and b"geograd_rows" in image
    (kept,) = tmp_path.iterdir()
    assert kept.read_bytes() == image
    kept.write_bytes(b"kept")
    assert _cuda_kernels.compiled(_cuda.source_of(node, torch.float32), architecture, nvrtc) == b"kept"


def test_a_wrong_text_is_refused(nvrtc, monkeypatch, tmp_path):
    monkeypatch.setenv("GEOGRAD_CACHE", str(tmp_path))
    with pytest.raises(_cuda.Unavailable, match="NVRTC refuses"):
        _cuda_kernels.compiled("int wrong(", "sm_80", nvrtc)
    assert not list(tmp_path.iterdir())
