"""geograd.torch: every row by gradcheck, gradgradcheck and opcheck; torch.func, torch.compile, losses, errors."""

import pickle

import numpy as np
import pytest

torch = pytest.importorskip("torch")

import geograd
import geograd.torch
from geograd import _core, _nodes
from pairs import A, B
from samples import ROWS, hard, ordinary, smooth


def pair(dtype=torch.float64, grad=True):
    return tuple(torch.tensor(x, dtype=dtype, requires_grad=grad) for x in (A, B))


def iou(a, b):
    return geograd.torch.iou(a, b, kind="Obb2")


def on_tensors(row):
    verb = getattr(geograd.torch, row.verb)
    return lambda *xs: verb(*xs, kind=row.kinds)


def on_free(row, arrays):
    """The function of the numbers that are not whole, and these."""
    whole = [getattr(getattr(geograd, shape, None), "_codes", 0) for _, shape, _ in row.takes]
    fixed = [torch.tensor(x[..., x.shape[-1] - n :]) if n else None for x, n in zip(arrays, whole)]
    free = [torch.tensor(x[..., : x.shape[-1] - n] if n else x, requires_grad=True) for x, n in zip(arrays, whole)]
    join = lambda x, rest: x if rest is None else torch.cat([x, rest], -1)
    of = on_tensors(row)
    return (lambda *xs: of(*map(join, xs, fixed))), free


# The weight of CIoU is held fixed in the first; the second is for convex corners, and corners are drawn at random.
APART = ("ciou_fixed_weight", "intersection_area(Vec2x4,Vec2x4)")
SMOOTH = [row for row in ROWS if not str(row).startswith(APART)]


@pytest.mark.parametrize("row", SMOOTH, ids=str)
def test_first_derivatives_of_every_row(row):
    arrays = smooth(row, 4, order=1)
    assert arrays is not None, "no smooth sample was found"
    function, xs = on_free(row, arrays)
    scale = max(1.0, max(float(np.abs(x).max()) for x in arrays))
    assert torch.autograd.gradcheck(function, xs, eps=1e-6 * scale, atol=1e-4, rtol=1e-4)


@pytest.mark.parametrize("row", [row for row in SMOOTH if row.has_program], ids=str)
def test_second_derivatives_of_every_row(row):
    arrays = smooth(row, 2, order=2)
    if arrays is None:
        pytest.skip("no sample was found at which differences of the gradient agree from both sides")
    function, xs = on_free(row, arrays)
    assert torch.autograd.gradgradcheck(function, xs, eps=1e-6, atol=1e-3, rtol=1e-3)


@pytest.mark.parametrize("row", ROWS, ids=str)
def test_opcheck_of_every_row(row):
    node = _nodes.of_verb(row.verb, row.kinds, None)
    xs = [torch.tensor(x, requires_grad=True) for x in ordinary(row, 3)]
    checks = ("test_schema", "test_autograd_registration", "test_faketensor")
    found = torch.library.opcheck(torch.ops.geograd.call.default, (node.name, xs), test_utils=checks)
    assert set(found.values()) == {"SUCCESS"}


@pytest.mark.parametrize("row", ROWS, ids=str)
def test_hard_inputs_of_every_row_have_the_derivatives_of_numpy(row):
    arrays = hard(row)
    if arrays is None:
        pytest.skip("its shapes have no hard cases")
    xs = [torch.tensor(x, requires_grad=True) for x in arrays]
    results = on_tensors(row)(*xs)
    results = results if isinstance(results, tuple) else (results,)
    rng = np.random.default_rng(1)
    bars = [rng.uniform(-1, 1, tuple(result.shape)) for result in results]
    grads = torch.autograd.grad(results, xs, [torch.tensor(bar) for bar in bars])
    expected = getattr(geograd, row.verb).vjp(*arrays, *bars, kind=row.kinds)
    expected = expected if isinstance(expected, tuple) else (expected,)
    for grad, own in zip(grads, expected):
        np.testing.assert_array_equal(grad.numpy(), np.asarray(own))


def test_opcheck_under_aot_and_of_the_adjoint():
    a, b = pair()
    node = _nodes.of_verb("iou", "Obb2", 2)
    torch.library.opcheck(torch.ops.geograd.call.default, (node.name, [a, b]))
    bar = torch.ones(3, dtype=torch.float64, requires_grad=True)
    torch.library.opcheck(torch.ops.geograd.call.default, (node.vjp().name, [a, b, bar]))


def test_transforms_agree():
    a, b = pair(grad=False)
    grads = torch.vmap(torch.func.grad(iou))(a, b)
    by_a = geograd.iou.value_grad(A, B, kind="Obb2")[1][0]
    np.testing.assert_array_equal(grads.numpy(), by_a)
    of_first = lambda x: iou(x, b[0])
    expected = geograd.iou.hessian(A[:1], B[:1], kind="Obb2")[0, :5, :5]
    for hessian in (torch.func.hessian(of_first), torch.func.jacrev(torch.func.jacrev(of_first))):
        np.testing.assert_allclose(hessian(a[0]).numpy(), expected, atol=1e-12)
    _, along = torch.func.jvp(lambda x: iou(x, b), (a,), (torch.ones_like(a),))
    np.testing.assert_allclose(along.numpy(), by_a.sum(-1), atol=1e-14)
    mapped = torch.vmap(lambda x: iou(x, b).sum())(a)
    np.testing.assert_allclose(mapped.numpy(), geograd.iou.all_pairs(A, B, kind="Obb2").sum(1), rtol=1e-14)
    inner = torch.vmap(torch.vmap(iou, in_dims=(None, 0)), in_dims=(0, None))(a, b)
    np.testing.assert_array_equal(inner.numpy(), geograd.iou.all_pairs(A, B, kind="Obb2"))
    assert torch.autograd.gradcheck(iou, pair(), check_forward_ad=True)


def test_leading_axes_broadcast():
    a, b = pair()
    matrix = iou(a[:, None], b[None])
    assert matrix.shape == (3, 3)
    np.testing.assert_array_equal(matrix.detach().numpy(), geograd.iou.all_pairs(A, B, kind="Obb2"))
    matrix.sum().backward()
    expected = geograd.iou.sum_grad(A, B, kind="Obb2")[1]
    np.testing.assert_allclose(a.grad.numpy(), expected[0], atol=1e-14)
    alone = iou(a[0], b)
    np.testing.assert_array_equal(alone.detach().numpy(), matrix[0].detach().numpy())
    assert iou(a[0], b[0]).shape == () and iou(a[:0], b[:0]).shape == (0,)


def test_compiled_functions_have_one_graph():
    a, b = pair()
    loss = torch.compile(lambda a, b: (1 - iou(a, b)).mean(), fullgraph=True)
    loss(a, b).backward()
    expected = torch.autograd.grad((1 - iou(a, b)).mean(), a)[0]
    torch.testing.assert_close(a.grad, expected, rtol=0, atol=0)


@geograd.function
def reach(point: geograd.Vec2, car: geograd.Obb2, weight: float):
    return weight * geograd.signed_distance(point, car)


def test_own_functions():
    own = geograd.torch.function(reach)
    point = torch.tensor([[3.0, 1.0], [0.1, 0.2], [-2.0, 1.0]], dtype=torch.float64, requires_grad=True)
    weight = torch.tensor([1.0, 2.0, 3.0], dtype=torch.float64, requires_grad=True)
    _, b = pair()
    np.testing.assert_array_equal(
        own(point, b, weight).detach().numpy(), reach(point.detach().numpy(), B, weight.detach().numpy())
    )
    assert torch.autograd.gradcheck(own, (point, b, weight))
    assert torch.autograd.gradgradcheck(own, (point, b, weight))
    compiled = torch.compile(lambda p, q: own(p, q, 2.0).sum(), fullgraph=True)
    torch.testing.assert_close(compiled(point, b), own(point, b, 2.0).sum())


@pytest.mark.parametrize("name, verb", _nodes.LOSSES.items())
def test_losses(name, verb):
    loss = getattr(geograd.torch, name)
    a, b = pair(torch.float32)
    score = getattr(geograd, verb)(A.astype("f4"), B.astype("f4"), kind="Obb2")
    # That of KFIoU adds one of centres, which is tested apart.
    of_score, most = ({"centers": 0}, 1 / 3) if name == "KFIoULoss" else ({}, 1)
    np.testing.assert_allclose(loss(reduction="none", **of_score)(a, b).detach().numpy(), most - score, atol=1e-6)
    np.testing.assert_allclose(loss(**of_score)(a, b).item(), (most - score).mean(), atol=1e-6)
    np.testing.assert_allclose(loss(reduction="sum", **of_score)(a, b).item(), (most - score).sum(), atol=1e-6)
    assert not list(loss().state_dict()) and loss.__name__ in repr(loss())
    copy = pickle.loads(pickle.dumps(loss(reduction="sum")))
    assert copy(a, b).item() == loss(reduction="sum")(a, b).item()
    with pytest.raises(ValueError, match="reduction"):
        loss(reduction="median")


def test_errors_say_what_to_do():
    a, b = pair()
    with pytest.raises(TypeError, match=r"kind= must name.*\(Obb2, Obb2\)"):
        geograd.torch.iou(a, b)
    with pytest.raises(TypeError, match=r"float16: convert with .float\(\)"):
        iou(a.half(), b.half())
    with pytest.raises(ValueError, match=r"`a` needs a tensor of shape \(..., 5\)"):
        iou(a[:, :4], b)
    with pytest.raises(TypeError, match="takes tensors"):
        iou(A, B)
    bad = a.detach().clone()
    bad[2, 2] = -1.0
    with pytest.raises(ValueError, match="`a` item 2: width is negative"):
        iou(bad, b)
    with pytest.raises(AttributeError, match="no attribute 'iuo'"):
        geograd.torch.iuo
    if torch.cuda.is_available():
        assert torch.allclose(iou(a.cuda(), b.cuda()).cpu(), iou(a, b))


def test_a_tensor_elsewhere_says_what_to_do():
    class Elsewhere(torch.Tensor):
        device = torch.device("xpu:0")

    class OnCard(torch.Tensor):
        device = torch.device("cuda:0")

    with pytest.raises(TypeError, match=r"xpu:0: move it with \.cpu\(\)"):
        iou(torch.ones(2, 5).as_subclass(Elsewhere), torch.ones(2, 5))
    with pytest.raises(TypeError, match="one tensor is on cuda:0, another on cpu"):
        iou(torch.ones(2, 5).as_subclass(OnCard), torch.ones(2, 5))


def test_formats_promote():
    a, b = pair()
    assert iou(a.float(), b.float()).dtype == torch.float32
    assert iou(a.float(), b).dtype == torch.float64


@pytest.mark.slow
def test_the_harness_on_autograd():
    torch.manual_seed(1)
    x, y = torch.tensor(A[0]), torch.tensor(B[0])
    report = geograd.torch.check(iou, x, y, samples=20, quiet=True)
    assert report

    class Wrong(torch.autograd.Function):
        @staticmethod
        def forward(ctx, x):
            ctx.save_for_backward(x)
            return (x * x).sum()

        @staticmethod
        def backward(ctx, bar):
            return bar * ctx.saved_tensors[0] * 2.001

    assert not geograd.torch.check(Wrong.apply, torch.tensor([0.5, 2.0]), samples=20, quiet=True)


def test_nodes_are_found_by_name_in_another_process():
    a, b = pair(grad=False)
    name = _nodes.of_verb("iou", "Obb2", 2).vjp().vjp().name
    _nodes._NODES.clear()
    assert _nodes.named(name).gives == [5, 5, 0]
    iou(a, b)
