"""Kernels of CUDA: compiled by NVRTC, which needs no card, and run on a grid of one processor in place of the driver."""

import ctypes
import pathlib
import shutil
import subprocess
import tempfile

import numpy as np
import pytest

import geograd

torch = pytest.importorskip("torch", reason="torch is not installed")

import geograd.torch as gt
from geograd import _cuda, _nodes, _torch

GRID = pathlib.Path(__file__).parents[2] / "tests" / "batches" / "cuda_grid.h"


def boxes(count, seed, dtype=torch.float64):
    rng = np.random.default_rng(seed)
    rows = np.concatenate(
        [rng.uniform(-2, 2, (count, 2)), rng.uniform(0.5, 3, (count, 2)), rng.uniform(-3, 3, (count, 1))], axis=1
    )
    return torch.tensor(rows, dtype=dtype)


class OnProcessor:
    """A kernel on the processor: compiled as C++, thread after thread."""

    def __init__(self, source, double, takes, gives):
        self.folder = tempfile.TemporaryDirectory()
        path = pathlib.Path(self.folder.name)
        run = (
            '\nextern "C" void run(long long count, long long inner, const long long *columns, const long long *steps, const long long *outs) {\n'
            "    for (blockIdx.x = 0; blockIdx.x * 64 < count + 64; blockIdx.x += 1) {\n"
            "        for (threadIdx.x = 0; threadIdx.x < 64; threadIdx.x += 1) {\n"
            f"            geograd_rows(count, inner{{}}{{}});\n        }}\n    }}\n}}\n"
        )
        kind = "double" if double else "float"
        columns = "".join(f", (const {kind} *)columns[{k}], steps[{2 * k}], steps[{2 * k + 1}]" for k in range(takes))
        outs = "".join(f", ({kind} *)outs[{k}]" for k in range(gives))
        run = run.replace("{}{}", columns + outs)
        (path / "kernel.cpp").write_text(f'#define GRID\n#include "{GRID}"\n{source}{run}')
        subprocess.run(
            ["c++", "-std=c++11", "-O1", "-ffp-contract=off", "-shared", "-fPIC", "-o", path / "kernel.so", path / "kernel.cpp"],
            check=True,
        )
        self.run = ctypes.CDLL(str(path / "kernel.so")).run

    def __call__(self, device, count, inner, columns, outs):
        addresses = lambda tensors: (ctypes.c_longlong * len(tensors))(*[x.data_ptr() for x in tensors])
        steps = [step for _, *both in columns for step in both]
        steps = (ctypes.c_longlong * len(steps))(*steps)
        columns = addresses([x for x, _, _ in columns])
        self.run(ctypes.c_longlong(count), ctypes.c_longlong(inner), columns, steps, addresses(outs))


@pytest.fixture
def on_kernels(monkeypatch):
    """Everything that torch computes goes through kernels."""
    if shutil.which("c++") is None:
        pytest.skip("c++ is not installed, so no kernel can run without a card")
    made = []

    def kernel_of(node, dtype, device):
        key = ("processor", dtype)
        if key not in node.kept:
            double = dtype == torch.float64
            node.kept[key] = OnProcessor(_cuda.source_of(node, dtype), double, len(node.takes), len(node.gives))
        made.append(node.name)
        return node.kept[key]

    monkeypatch.setattr(_cuda, "kernel_of", kernel_of)
    monkeypatch.setattr(_torch, "computed", lambda node, xs: _cuda.computed(node, xs, _torch.lead_of(node, xs)))
    return made


@pytest.mark.parametrize("dtype", [torch.float32, torch.float64])
def test_values_and_gradients_have_the_bits_of_the_library(on_kernels, dtype):
    a, b = boxes(200, 1, dtype).requires_grad_(), boxes(200, 2, dtype).requires_grad_()
    value = gt.giou(a, b, kind="Obb2")
    by_a, by_b = torch.autograd.grad(value.sum(), (a, b))
    assert on_kernels
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
    image = _cuda.compiled(_cuda.source_of(node, torch.float32), architecture, nvrtc)
    assert image[:4] == b"\x7fELF" and b"geograd_rows" in image
    (kept,) = tmp_path.iterdir()
    assert kept.read_bytes() == image
    kept.write_bytes(b"kept")
    assert _cuda.compiled(_cuda.source_of(node, torch.float32), architecture, nvrtc) == b"kept"


def test_a_wrong_text_is_refused(nvrtc, monkeypatch, tmp_path):
    monkeypatch.setenv("GEOGRAD_CACHE", str(tmp_path))
    with pytest.raises(_cuda.Unavailable, match="NVRTC refuses"):
        _cuda.compiled("int wrong(", "sm_80", nvrtc)
    assert not list(tmp_path.iterdir())
