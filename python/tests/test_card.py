"""The same calls on a card of CUDA, where there is one: tensors of torch, arrays of CuPy and JAX, other streams."""

import numpy as np
import pytest

import geograd

torch = pytest.importorskip("torch", reason="torch is not installed")
if not torch.cuda.is_available():
    pytest.skip("torch finds no card of CUDA", allow_module_level=True)

import geograd.cuda as arrays
import geograd.torch as gt

CARD = torch.device("cuda")
EXACT = dict(rtol=0, atol=0)


def boxes(count, seed, dtype=torch.float64):
    rng = np.random.default_rng(seed)
    rows = [rng.uniform(-2, 2, (count, 2)), rng.uniform(0.5, 3, (count, 2)), rng.uniform(-3, 3, (count, 1))]
    return torch.tensor(np.concatenate(rows, 1), dtype=dtype)


def pair(count, dtype=torch.float64):
    """Boxes on the processor and on the card, which have gradients on both."""
    here = [boxes(count, seed, dtype).requires_grad_() for seed in (1, 2)]
    return here, [x.detach().to(CARD).requires_grad_() for x in here]


def same(found, known, **close):
    assert found.is_cuda
    torch.testing.assert_close(found.detach().cpu(), known.detach(), equal_nan=True, **(close or EXACT))


@pytest.mark.parametrize("dtype", [torch.float32, torch.float64])
def test_values_and_gradients_have_the_bits_of_the_processor(dtype):
    here, there = pair(5000, dtype)
    for verb in ("iou", "giou", "kfiou", "probiou"):
        known, found = (getattr(gt, verb)(*x, kind="Obb2") for x in (here, there))
        same(found, known)
        for by, of in zip(torch.autograd.grad(found.sum(), there), torch.autograd.grad(known.sum(), here)):
            same(by, of)


def test_strided_and_broadcast_rows():
    here = torch.cat([boxes(60, 1), boxes(60, 2)], 1)
    there = here.to(CARD)
    value = lambda x: gt.giou(x[::2, None, :5], x[None, 1::3, 5:], kind="Obb2")
    same(value(there), value(here))
    half = here.to(CARD, torch.float32)[:, :5].half()
    with pytest.raises(TypeError, match="float16"):
        gt.area(half, kind="Obb2")


@pytest.mark.parametrize("dtype", [torch.float32, torch.float64])
def test_reductions_of_all_pairs(dtype):
    (a, b), (x, y) = pair(700, dtype)
    b, y = b[:300], y[:300]
    same(gt.iou.all_pairs(x, y, kind="Obb2"), gt.iou.all_pairs(a, b, kind="Obb2"))
    groups = torch.tensor([0, 100, 100, 700]), torch.tensor([0, 70, 90, 300])
    for form in ("row_max", "column_max"):
        for of in ({}, {"groups": groups}):
            known, found = (getattr(gt.giou, form)(*lists, kind="Obb2", **of) for lists in ((a, b), (x, y)))
            for one, other in zip(found, known):
                same(one, other)
    known, found = (gt.iou.above(*lists, 0.3, kind="Obb2") for lists in ((a, b), (x, y)))
    assert len(found[0]) > 100
    for one, other in zip(found, known):
        same(one, other)
    assert gt.iou.count_above(x, y, 0.3, kind="Obb2") == len(known[0])
    near = dict(rtol=1e-4, atol=1e-5) if dtype == torch.float32 else dict(rtol=1e-11, atol=1e-12)
    known, found = (gt.giou.mean(*lists, kind="Obb2") for lists in ((a, b), (x, y)))
    same(found, known, **near)
    for by, of in zip(torch.autograd.grad(found, (x, y)), torch.autograd.grad(known, (a, b))):
        same(by, of, **near)


def test_second_derivatives_and_own_functions():
    @geograd.function
    def clearance(p: geograd.Vec2, box: geograd.Obb2):
        return geograd.signed_distance(p, box) ** 2

    on_tensors = gt.function(clearance)
    seconds = []
    for device in ("cpu", CARD):
        p = torch.tensor([[3.0, 0.3], [0.1, 2.2]], dtype=torch.float64, device=device, requires_grad=True)
        (first,) = torch.autograd.grad(on_tensors(p, boxes(2, 6).to(device)).sum(), p, create_graph=True)
        seconds.append(torch.autograd.grad(first.sum(), p)[0])
    same(seconds[1], seconds[0], rtol=1e-13, atol=1e-13)
    box = boxes(3, 6).to(CARD).requires_grad_()
    other = boxes(3, 7).to(CARD)
    assert torch.autograd.gradcheck(lambda x: gt.giou(x, other, kind="Obb2"), box)
    assert torch.autograd.gradgradcheck(lambda x: gt.giou(x, other, kind="Obb2"), box)


def test_compiled_functions_and_autocast():
    _, (x, y) = pair(100, torch.float32)
    plain = gt.giou(x, y, kind="Obb2")
    compiled = torch.compile(lambda x, y: (1 - gt.giou(x, y, kind="Obb2")).mean())
    torch.testing.assert_close(compiled(x, y), (1 - plain).mean())
    (by,) = torch.autograd.grad(compiled(x, y), x)
    torch.testing.assert_close(by, torch.autograd.grad((1 - plain).mean(), x)[0])
    with torch.autocast("cuda", torch.float16):
        torch.testing.assert_close(gt.giou(x.half(), y.half(), kind="Obb2"), gt.giou(x.half().float(), y.half().float(), kind="Obb2"))


def test_losses_train_on_a_card():
    target = boxes(64, 1, torch.float32).to(CARD)
    box = (target + 0.2).requires_grad_()
    optimizer = torch.optim.Adam([box], lr=0.02)
    losses = []
    for _ in range(60):
        optimizer.zero_grad()
        loss = (1 - gt.giou(box, target, kind="Obb2")).mean()
        loss.backward()
        optimizer.step()
        losses.append(loss.item())
    assert losses[-1] < losses[0] / 4, losses[::20]


def test_kernels_run_on_the_current_stream():
    _, (x, y) = pair(200_000, torch.float32)
    known = gt.iou(x, y, kind="Obb2")
    stream = torch.cuda.Stream()
    for _ in range(5):
        with torch.cuda.stream(stream):
            # Whoever ran on another stream would read the zeros.
            a = torch.zeros_like(x)
            torch.cuda._sleep(2_000_000)
            a += x
            value = gt.iou(a, y, kind="Obb2")
            a.zero_()
        stream.synchronize()
        assert torch.equal(value, known)
    graph = torch.cuda.CUDAGraph()
    with torch.cuda.graph(graph), torch.no_grad():
        value = gt.iou(x, y, kind="Obb2")
    graph.replay()
    assert torch.equal(value, known)


def test_what_has_no_kernel_says_so():
    with pytest.raises(RuntimeError, match="processor"):
        gt.minimum_circle(torch.zeros(2, 13, device=CARD), kind="ConvexPolygon6")
    with pytest.raises((TypeError, ValueError), match="device|cpu"):
        gt.iou(boxes(2, 1).to(CARD), boxes(2, 1), kind="Obb2")


def test_arrays_of_cupy():
    cupy = pytest.importorskip("cupy", reason="CuPy is not installed")
    a, b = (boxes(3000, seed).numpy() for seed in (1, 2))
    x, y = cupy.asarray(a), cupy.asarray(b)
    value, (by_a, by_b) = arrays.giou.value_grad(x, y, kind="Obb2")
    known, (of_a, of_b) = geograd.giou.value_grad(a, b, kind="Obb2")
    for found, expected in ((value, known), (by_a, of_a), (by_b, of_b)):
        np.testing.assert_array_equal(cupy.asnumpy(cupy.asarray(found)), expected)
    values, places = arrays.iou.row_max(x[::3], y, kind="Obb2")
    expected, at = geograd.iou.row_max(a[::3].copy(), b, kind="Obb2")
    np.testing.assert_array_equal(cupy.asnumpy(cupy.asarray(values)), expected)
    np.testing.assert_array_equal(cupy.asnumpy(cupy.asarray(places)), at)
    with cupy.cuda.Stream(non_blocking=True):
        moved = x + 0.5
        value = cupy.asarray(arrays.area(moved, kind="Obb2"))
    np.testing.assert_array_equal(cupy.asnumpy(value), geograd.area(a + 0.5, kind="Obb2"))


def test_arrays_of_jax_by_dlpack():
    jax = pytest.importorskip("jax", reason="jax is not installed")
    try:
        device = jax.devices("gpu")[0]
    except RuntimeError as error:
        pytest.skip(str(error))
    a = boxes(50, 1, torch.float32).numpy()
    value = arrays.area(jax.device_put(a, device), kind="Obb2")
    np.testing.assert_array_equal(value.numpy(), geograd.area(a, kind="Obb2"))
