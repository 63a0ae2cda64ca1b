"""geograd.torch: forms of two lists and conversions."""

import numpy as np
import pytest

torch = pytest.importorskip("torch")

import geograd
import geograd.torch
from pairs import A, B

KIND = {"kind": "Obb2"}
MANY = np.concatenate([A, B, A + 0.1, B - 0.2])


def tensors(*arrays):
    return [torch.tensor(x, requires_grad=True) for x in arrays]


def test_all_pairs():
    a, b = tensors(MANY, B)
    matrix = geograd.torch.giou.all_pairs(a, b, **KIND)
    np.testing.assert_array_equal(matrix.detach().numpy(), geograd.giou.all_pairs(MANY, B, **KIND))
    bars = torch.tensor(np.random.default_rng(1).normal(size=(12, 3)))
    grads = torch.autograd.grad(matrix, (a, b), bars)
    for grad, expected in zip(grads, geograd.giou.all_pairs_vjp(MANY, B, bars.numpy(), **KIND)):
        np.testing.assert_array_equal(grad.numpy(), expected)
    crossed = geograd.torch.giou(a[:, None], b[None], **KIND)
    for grad, expected in zip(grads, torch.autograd.grad(crossed, (a, b), bars)):
        torch.testing.assert_close(grad, expected, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("form", ["all_pairs", "sum", "mean"])
def test_derivatives_of_any_order(form):
    a, b = tensors(A, B)
    of = lambda a, b: getattr(geograd.torch.iou, form)(a, b, **KIND)
    assert torch.autograd.gradcheck(of, (a, b))
    assert torch.autograd.gradgradcheck(of, (a, b))
    expected = torch.func.hessian(lambda a: geograd.torch.iou(a[:, None], B_, **KIND).sum())(a.detach())
    total = torch.func.hessian(lambda a: of(a, B_).sum())(a.detach())
    torch.testing.assert_close(total, expected if form != "mean" else expected / 9, rtol=1e-10, atol=1e-10)


B_ = torch.tensor(B)


def test_sums_are_those_of_numpy():
    a, b = tensors(MANY, B)
    for form in ("sum", "mean"):
        value = getattr(geograd.torch.iou, form)(a, b, **KIND)
        expected, grads = getattr(geograd.iou, f"{form}_grad")(MANY, B, **KIND)
        assert value.item() == expected
        for grad, own in zip(torch.autograd.grad(value, (a, b)), grads):
            np.testing.assert_array_equal(grad.numpy(), own)
    assert geograd.torch.iou.mean(a[:0], b, **KIND).item() == 0


def test_batches_and_transforms():
    a, b = tensors(np.stack([A, B]), B)
    matrices = geograd.torch.iou.all_pairs(a, b, **KIND)
    assert matrices.shape == (2, 3, 3)
    np.testing.assert_array_equal(matrices[1].detach().numpy(), geograd.iou.all_pairs(B, B, **KIND))
    mapped = torch.vmap(lambda x: geograd.torch.iou.all_pairs(x, b, **KIND))(a)
    torch.testing.assert_close(mapped, matrices, rtol=0, atol=0)
    compiled = torch.compile(lambda a, b: geograd.torch.iou.all_pairs(a, b, **KIND).sum(), fullgraph=True, backend="aot_eager")
    torch.testing.assert_close(compiled(a[0], b), matrices[0].sum(), rtol=1e-14, atol=0)


def test_results_of_several_numbers():
    segments = np.array([[0.0, 0, 1, 0], [0, 1, 1, 3], [2, 2, 3, 3]])
    a, b = tensors(segments, segments + 0.5)
    pairs = geograd.torch.closest_points.all_pairs(a, b, kind="Segment2")
    np.testing.assert_allclose(pairs.detach().numpy(), np.asarray(geograd.closest_points.all_pairs(segments, segments + 0.5, kind="Segment2")), atol=1e-15)


def test_row_max_and_column_max():
    a, b = tensors(MANY, B)
    for form, axis in (("row_max", 1), ("column_max", 0)):
        values, places = getattr(geograd.torch.iou, form)(a, b, **KIND)
        expected = getattr(geograd.iou, form)(MANY, B, **KIND)
        np.testing.assert_array_equal(values.detach().numpy(), expected[0])
        np.testing.assert_array_equal(places.numpy(), expected[1])
        grads = torch.autograd.grad(values.sum(), (a, b))
        best = geograd.torch.iou.all_pairs(a, b, **KIND).max(axis).values.sum()
        for grad, own in zip(grads, torch.autograd.grad(best, (a, b))):
            torch.testing.assert_close(grad, own, rtol=1e-12, atol=1e-12)
    values, places = geograd.torch.iou.row_max(a, b[:0], **KIND)
    assert torch.isinf(values).all() and (places == -1).all()
    values, places = geograd.torch.iou.column_max(a[:0], b, **KIND)
    assert torch.isinf(values).all() and (places == -1).all()


def test_the_nearest_of_many():
    a, b = tensors(MANY, B)
    gap = geograd.torch.signed_distance
    matrix = gap.all_pairs(a, b, **KIND)
    for form, axis in (("row_min", 1), ("column_min", 0)):
        values, places = getattr(gap, form)(a, b, **KIND)
        expected = getattr(geograd.signed_distance, form)(MANY, B, **KIND)
        np.testing.assert_array_equal(values.detach().numpy(), expected[0])
        np.testing.assert_array_equal(places.numpy(), expected[1])
        grads = torch.autograd.grad(values.sum(), (a, b))
        best = matrix.min(axis).values.sum()
        for grad, own in zip(grads, torch.autograd.grad(best, (a, b), retain_graph=True)):
            torch.testing.assert_close(grad, own, rtol=1e-12, atol=1e-12)
    value, row, column = gap.nearest(a, b, **KIND)
    assert value.shape == () and value == matrix.min() == matrix[row, column]
    (grad,) = torch.autograd.grad(value, a)
    assert torch.count_nonzero(grad.any(1)) == 1
    rows, columns, values = gap.below(a, b, 0.5, **KIND)
    assert gap.count_below(a, b, 0.5, **KIND) == len(rows) == int((matrix < 0.5).sum())
    torch.testing.assert_close(values, matrix[rows, columns], rtol=0, atol=0)
    values, places = gap.row_min(a, b, within=-99.0, **KIND)
    assert torch.isinf(values).all() and (places == -1).all()


def test_groups():
    a, b = tensors(MANY, B)
    groups = (torch.tensor([0, 5, 5, 12]), [0, 2, 3, 3])
    arrays = ([0, 5, 5, 12], [0, 2, 3, 3])
    values, places = geograd.torch.iou.row_max(a, b, groups=groups, **KIND)
    expected = geograd.iou.row_max(MANY, B, groups=arrays, **KIND)
    np.testing.assert_array_equal(values.detach().numpy(), expected[0])
    np.testing.assert_array_equal(places.numpy(), expected[1])
    (grad,) = torch.autograd.grad(values[:5].sum(), a)
    assert torch.isfinite(grad).all()
    found = geograd.torch.iou.above(a, b, 0.05, groups=groups, **KIND)
    for own, other in zip(found, geograd.iou.above(MANY, B, 0.05, groups=arrays, **KIND)):
        np.testing.assert_array_equal(own.detach().numpy(), other)


def test_above():
    a, b = tensors(MANY, B)
    rows, columns, values = geograd.torch.iou.above(a, b, 0.1, **KIND)
    for own, other in zip((rows, columns, values), geograd.iou.above(MANY, B, 0.1, **KIND)):
        np.testing.assert_array_equal(own.detach().numpy(), other)
    assert geograd.torch.iou.count_above(a, b, 0.1, **KIND) == len(rows) > 2
    (grad,) = torch.autograd.grad(values.sum(), a)
    mask = geograd.torch.iou.all_pairs(a, b, **KIND)
    (own,) = torch.autograd.grad(mask[mask > 0.1].sum(), a)
    torch.testing.assert_close(grad, own, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("dtype", [torch.float32, torch.float64, torch.bfloat16])
def test_suppress(dtype):
    shapes, scores = torch.tensor(MANY).to(dtype), torch.linspace(0.2, 0.9, 12).to(dtype)
    kept = geograd.torch.iou.suppress(shapes, scores, 0.1, **KIND)
    wide = torch.float64 if dtype == torch.float64 else torch.float32
    numbers = shapes.to(wide).numpy(), scores.to(wide).numpy()
    np.testing.assert_array_equal(kept.numpy(), geograd.iou.suppress(*numbers, 0.1, **KIND))
    assert kept.dtype == torch.int64 and 0 < len(kept) < 12
    classes = torch.arange(12) % 3
    both = geograd.torch.iou.suppress(shapes.requires_grad_(), scores, 0.1, classes=classes, most=2, **KIND)
    np.testing.assert_array_equal(both.numpy(), geograd.iou.suppress(*numbers, 0.1, classes=classes.numpy(), most=2, **KIND))


def test_conversions():
    box = torch.tensor([[1.0, 2.0, 4.0, 2.0, 1.9], [0.0, 0.0, 1.0, 3.0, -0.4]], dtype=torch.float64, requires_grad=True)
    for to in ("Le90", "Le135", "OpenCvBox", "Detectron2Box", geograd.Le90):
        convert = lambda x: geograd.torch.convert(x, kind="ImageBox", to=to)
        np.testing.assert_array_equal(convert(box).detach().numpy(), geograd.convert(geograd.ImageBox(box.detach().numpy()), to=to).array)
        assert torch.autograd.gradcheck(convert, box) and torch.autograd.gradgradcheck(convert, box)
    with pytest.raises(TypeError, match="several results are possible; say which by to=, one of"):
        geograd.torch.convert(box, kind="ImageBox")
    with pytest.raises(TypeError, match="no row has kind='ImageBox' and to='Obb3'"):
        geograd.torch.convert(box, kind="ImageBox", to="Obb3")
    compiled = torch.compile(lambda x: geograd.torch.convert(x, kind="ImageBox", to="Le90"), fullgraph=True, backend="aot_eager")
    torch.testing.assert_close(compiled(box), geograd.torch.convert(box, kind="ImageBox", to="Le90"), rtol=0, atol=0)


def test_names_that_are_alike_are_named():
    a, b = tensors(A, B)
    with pytest.raises(TypeError, match="no shape is called 'obb2'; is it Obb2"):
        geograd.torch.iou(a, b, kind="obb2")
    with pytest.raises(ValueError, match="no verb is called 'gious'; is it giou"):
        geograd.torch.Loss("gious")
    with pytest.raises(TypeError, match="corners: no row has kind='Obb2'"):
        geograd.torch.corners.all_pairs(a, b, kind="Obb2")
