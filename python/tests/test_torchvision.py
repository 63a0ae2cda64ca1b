"""Stand-ins for torchvision: against the original, and against shapely where the original is wrong."""

import doctest

import numpy as np
import pytest

torch = pytest.importorskip("torch", reason="torch is not installed: geograd.torchvision is not tested")

import geograd.torchvision as ours

MATRICES = ["box_iou", "generalized_box_iou", "distance_box_iou", "complete_box_iou"]
LOSSES = ["generalized_box_iou_loss", "distance_box_iou_loss", "complete_box_iou_loss"]
UPRIGHT = ["xyxy", "xywh", "cxcywh"]
ROTATED = ["cxcywhr", "xywhr", "xyxyxyxy"]


@pytest.fixture(scope="module")
def ops():
    return pytest.importorskip("torchvision", reason="torchvision is not installed: the original is not compared").ops


def boxes(count, seed, dtype=torch.float64, turned=False):
    draw = np.random.default_rng(seed)
    at, size = draw.uniform(0, 50, (count, 2)), draw.uniform(2, 30, (count, 2))
    rows = np.c_[at, size, draw.uniform(-400, 400, count)] if turned else np.c_[at, at + size]
    return torch.tensor(rows, dtype=dtype)


def polygons(rotated):
    """Corners of cxcywhr boxes by complex numbers: y points down, and angles turn x towards -y."""
    x, y, w, h, r = rotated.double().numpy().T
    turn = np.exp(-1j * np.radians(r))
    corners = [x + 1j * y + turn * (a * w + b * h * 1j) / 2 for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return np.stack([np.stack([c.real, c.imag], -1) for c in corners], 1)


def exact(a, b):
    shapely = pytest.importorskip("shapely", reason="shapely is not installed: rotated IoU is not compared")
    a, b = shapely.polygons(polygons(a))[:, None], shapely.polygons(polygons(b))[None]
    shared = shapely.area(shapely.intersection(a, b))
    return shared / (shapely.area(a) + shapely.area(b) - shared)


def test_the_example_of_the_module():
    assert doctest.testmod(ours).failed == 0 and doctest.testmod(ours).attempted > 5


@pytest.mark.parametrize("dtype", [torch.float32, torch.float64], ids=str)
@pytest.mark.parametrize("name", MATRICES)
def test_matrices_are_torchvisions(ops, name, dtype):
    a, b = boxes(40, 1, dtype).requires_grad_(), boxes(30, 2, dtype).requires_grad_()
    expected, found = getattr(ops, name)(a, b), getattr(ours, name)(a, b)
    near = {"rtol": 0, "atol": 3e-6 if dtype == torch.float32 else 1e-14}
    torch.testing.assert_close(found, expected, **near)
    with torch.no_grad():
        torch.testing.assert_close(getattr(ours, name)(a, b), expected, **near)
    up = torch.rand_like(expected)
    grads = torch.autograd.grad(expected, (a, b), up)
    torch.testing.assert_close(torch.autograd.grad(found, (a, b), up), grads, rtol=1e-4, atol=near["atol"] * 30)
    assert grads[0].abs().sum() > 0.01


@pytest.mark.parametrize("eps", [1e-7, 0.5])
@pytest.mark.parametrize("name", LOSSES + MATRICES[2:])
def test_eps_has_the_places_of_torchvisions(ops, name, eps):
    # Boxes so small that eps is seen.
    a, b = (boxes(20, 1) / 100).requires_grad_(), boxes(20, 2) / 100
    expected, found = getattr(ops, name)(a, b, eps=eps), getattr(ours, name)(a, b, eps=eps)
    torch.testing.assert_close(found, expected, rtol=0, atol=1e-13)
    up = torch.rand_like(expected)
    (expected,) = torch.autograd.grad(expected, a, up)
    torch.testing.assert_close(torch.autograd.grad(found, a, up)[0], expected, rtol=0, atol=1e-10)


@pytest.mark.parametrize("fmt", UPRIGHT)
def test_formats_of_upright_boxes(ops, fmt):
    a, b = boxes(12, 1), boxes(9, 2)
    in_fmt = [ops.box_convert(x, "xyxy", fmt) for x in (a, b)]
    torch.testing.assert_close(ours.box_iou(*in_fmt, fmt=fmt), ops.box_iou(*in_fmt, fmt=fmt), rtol=0, atol=1e-14)
    found = ours.generalized_box_iou(*in_fmt, fmt=fmt)
    torch.testing.assert_close(found, ops.generalized_box_iou(a, b), rtol=0, atol=1e-14)
    torch.testing.assert_close(ours.box_area(in_fmt[0], fmt), ops.box_area(in_fmt[0], fmt))


@pytest.mark.parametrize("name", LOSSES)
@pytest.mark.parametrize("reduction", ["none", "mean", "sum"])
def test_losses_are_torchvisions(ops, name, reduction):
    for dtype, near in ((torch.float32, 1e-5), (torch.float64, 1e-13), (torch.float16, 1e-5)):
        a, b = boxes(50, 1, dtype).requires_grad_(), boxes(50, 2, dtype)
        expected, found = [getattr(m, name)(a, b, reduction=reduction) for m in (ops, ours)]
        torch.testing.assert_close(found, expected, rtol=near, atol=near)
        expected, found = [torch.autograd.grad(x.sum(), a)[0] for x in (expected, found)]
        assert found.dtype == dtype
        more = 1e-2 if dtype == torch.float16 else 1e-3
        torch.testing.assert_close(found.double(), expected.double(), rtol=more, atol=near)


@pytest.mark.parametrize("name", LOSSES)
def test_no_boxes_and_one_box(ops, name):
    for reduction in ("none", "mean", "sum"):
        a, b = torch.zeros((0, 4), requires_grad=True), torch.zeros(0, 4)
        expected, found = [getattr(m, name)(a, b, reduction=reduction) for m in (ops, ours)]
        assert found.shape == expected.shape and found.dtype == expected.dtype and found.sum() == 0
        found.sum().backward()
        assert a.grad.shape == (0, 4)
    one = torch.tensor([0.0, 0, 2, 2])
    assert getattr(ours, name)(one, one).shape == getattr(ops, name)(one, one).shape == ()
    with pytest.raises(ValueError, match="reduction is 'none', 'mean' or 'sum', not 'max'"):
        getattr(ours, name)(one, one, reduction="max")


def test_shapes_of_matrices(ops):
    for name in MATRICES:
        for a, b in (((0, 4), (3, 4)), ((2, 5, 4), (2, 6, 4)), ((5, 4), (3, 6, 4)), ((0, 3, 4), (0, 2, 4))):
            a, b = torch.zeros(a), torch.zeros(b)
            a[..., 2:], b[..., 2:] = 1, 2
            assert getattr(ours, name)(a, b).shape == getattr(ops, name)(a, b).shape, (name, a.shape)
        with pytest.raises(IndexError):
            getattr(ours, name)(torch.rand(4), torch.rand(3, 4))
    batch = [torch.stack([boxes(4, seed), boxes(4, seed + 1)]).requires_grad_() for seed in (1, 7)]
    for name in MATRICES:
        expected, found = [getattr(m, name)(*batch) for m in (ops, ours)]
        torch.testing.assert_close(found, expected)
        expected, found = [torch.autograd.grad(x.sin().sum(), batch) for x in (expected, found)]
        torch.testing.assert_close(found, expected)


def test_formats_of_numbers(ops):
    whole = torch.tensor([[0, 0, 4, 4], [1, 1, 3, 9]])
    for a in (whole, whole.int(), whole.half(), whole.bfloat16(), whole.float(), whole.double()):
        for name in MATRICES:
            expected, found = getattr(ops, name)(a, a), getattr(ours, name)(a, a)
            assert found.dtype == expected.dtype, (name, a.dtype)
            torch.testing.assert_close(found, expected, rtol=1e-5, atol=1e-5)
        assert ours.box_area(a).dtype == ops.box_area(a).dtype
    # Products of more than 32 bits, which overflow in torchvision.
    wide = torch.tensor([[0, 0, 50_000, 50_000], [0, 0, 100_000, 50_000]], dtype=torch.int32)
    assert ours.box_iou(wide, wide).tolist() == [[1, 0.5], [0.5, 1]] != ops.box_iou(wide, wide).tolist()
    assert ours.box_iou(torch.zeros(1, 4), torch.zeros(1, 4)).isnan().all()


@pytest.mark.parametrize("in_fmt", UPRIGHT + ROTATED)
@pytest.mark.parametrize("out_fmt", UPRIGHT + ROTATED)
def test_conversions_are_torchvisions(ops, in_fmt, out_fmt):
    start = boxes(20, 3, turned=in_fmt in ROTATED)
    rows = ops.box_convert(start, "cxcywhr" if in_fmt in ROTATED else "xyxy", in_fmt)
    for x in (rows, rows.float(), rows.round().long(), rows[:0], rows.reshape(4, 5, -1)):
        try:
            expected = ops.box_convert(x, in_fmt, out_fmt)
        except NotImplementedError:
            with pytest.raises(NotImplementedError):
                ours.box_convert(x, in_fmt, out_fmt)
            continue
        found = ours.box_convert(x, in_fmt, out_fmt)
        assert found.dtype == expected.dtype and found.shape == expected.shape
        if x.is_floating_point():
            torch.testing.assert_close(found, expected, rtol=1e-5, atol=1e-4 if x.dtype == torch.float32 else 1e-11)
        else:
            # The last bit before rounding decides.
            assert (found - expected).abs().max() <= 1
    with pytest.raises(ValueError):
        ours.box_convert(rows, "xyxy", "xyhw")


@pytest.mark.parametrize("fmt", ROTATED)
def test_rotated_iou_is_that_of_polygons(fmt):
    a, b = boxes(30, 1, turned=True), boxes(25, 2, turned=True)
    for dtype, near in ((torch.float64, 1e-12), (torch.float32, 2e-5)):
        found = ours.box_iou(*[ours.box_convert(x, "cxcywhr", fmt).to(dtype) for x in (a, b)], fmt=fmt)
        assert found.dtype == dtype and abs(found.double().numpy() - exact(a, b)).max() < near
    areas = ours.box_area(ours.box_convert(a, "cxcywhr", fmt), fmt)
    torch.testing.assert_close(areas, a[:, 2] * a[:, 3])


#: Two rotated boxes of cxcywhr, and the IoU that torchvision 0.29.2 gives.
WRONG = [
    ([6.0, 9.0, 7.0, 6.0, 30.0], [8.0, 9.0, 2.0, 4.0, 30.0], 0.2357),
    (
        [1000.0075073242188, 1000.0042724609375, 39.99436950683594, 19.989837646484375, 29.983835220336914],
        [999.990478515625, 999.98095703125, 39.98350143432617, 19.98418617248535, 29.934795379638672], 0.3324,
    ),
    (
        [0.003982304595410824, 0.005861595738679171, 0.0033925827592611313, 0.005499979481101036, 20.316425323486328],
        [0.005889099091291428, 0.0015822404529899359, 0.0018947238568216562, 0.004075170494616032, 61.006080627441406],
        1.0,
    ),
]


@pytest.mark.parametrize("a, b, theirs", WRONG)
def test_where_torchvision_is_wrong(ops, a, b, theirs):
    a, b = torch.tensor([a]), torch.tensor([b])
    truth = exact(a, b).item()
    assert abs(ours.box_iou(a, b, fmt="cxcywhr").item() - truth) < 1e-6
    assert abs(ours.box_iou(a.double(), b.double(), fmt="cxcywhr").item() - truth) < 1e-13
    assert abs(theirs - truth) > 0.04
    # A later version may be right.
    found = ops.box_iou(a, b, fmt="cxcywhr").item()
    assert abs(found - theirs) < 1e-3 or abs(found - truth) < 1e-3


def test_rotated_boxes_of_right_angles_score_as_upright_ones(ops):
    a, b = boxes(10, 1), boxes(10, 2)
    turned = [torch.cat([ops.box_convert(x, "xyxy", "cxcywh"), torch.zeros(10, 1)], -1).double() for x in (a, b)]
    torch.testing.assert_close(ours.box_iou(*turned, fmt="cxcywhr"), ops.box_iou(a, b))
    hull = ours.generalized_box_iou(*turned, fmt="cxcywhr")
    # The convex hull is no larger than the box around both.
    assert (hull >= ops.generalized_box_iou(a, b) - 1e-12).all() and (hull <= ops.box_iou(a, b) + 1e-12).all()


@pytest.mark.parametrize("name", MATRICES + LOSSES)
@pytest.mark.parametrize("fmt", UPRIGHT + ROTATED)
def test_gradients(name, fmt):
    start = [boxes(3, seed, turned=fmt in ROTATED) for seed in (11, 12)]
    start = [ours.box_convert(x, "cxcywhr" if fmt in ROTATED else "xyxy", fmt).requires_grad_() for x in start]
    call = getattr(ours, name)
    if "complete" in name:
        # Its weight is a constant in the gradient, so that no difference quotient has it.
        start[1] = start[0].detach() * torch.tensor(1.0)
        shift = torch.zeros(start[0].shape[-1], dtype=torch.float64)
        shift[:2] = 0.3
        if fmt in ("xyxy", "xyxyxyxy"):
            shift[0::2], shift[1::2] = 0.3, 0.3
        start[1] = (start[1] + shift).requires_grad_()
        start = [x[:1].detach().requires_grad_() for x in start]
    assert torch.autograd.gradcheck(lambda a, b: call(a, b, fmt=fmt), start, eps=1e-6, atol=1e-6)


def test_second_derivatives_and_torch_func(ops):
    a, b = boxes(3, 1).requires_grad_(), boxes(3, 2).requires_grad_()
    for name in ("generalized_box_iou_loss", "generalized_box_iou", "distance_box_iou"):
        assert torch.autograd.gradgradcheck(getattr(ours, name), (a, b), atol=1e-6)
    one = lambda a, b: ours.generalized_box_iou_loss(a, b)
    expected = torch.autograd.grad(ops.generalized_box_iou_loss(a, b).sum(), a)[0]
    torch.testing.assert_close(torch.func.vmap(torch.func.grad(one))(a.detach(), b.detach()), expected)
    direction = torch.rand(3, 4, dtype=torch.float64)
    _, along = torch.func.jvp(one, (a.detach(), b.detach()), (direction, torch.zeros_like(b)))
    torch.testing.assert_close(along.sum(), (expected * direction).sum())
    with torch.autograd.forward_ad.dual_level():
        found = one(torch.autograd.forward_ad.make_dual(a.detach(), direction), b.detach())
        torch.testing.assert_close(torch.autograd.forward_ad.unpack_dual(found).tangent, along)
    turned = [boxes(3, seed, turned=True).requires_grad_() for seed in (1, 2)]
    assert torch.autograd.gradgradcheck(lambda a, b: ours.box_iou(a, b, fmt="cxcywhr"), turned, atol=1e-5)


def test_compiled():
    a, b = boxes(5, 1, torch.float32).requires_grad_(), boxes(5, 2, torch.float32)

    def loss(a, b):
        upright = ours.complete_box_iou_loss(a, b, reduction="mean") + ours.box_iou(a, b).sum()
        turned = [torch.cat([x, 9 * x[:, :1]], -1) for x in (a, b)]
        return upright + ours.generalized_box_iou_loss(*turned, reduction="sum", fmt="cxcywhr")

    compiled = torch.compile(loss, backend="aot_eager", fullgraph=True)
    (expected,) = torch.autograd.grad(loss(a, b), a)
    torch.testing.assert_close(torch.autograd.grad(compiled(a, b), a)[0], expected)


@pytest.mark.parametrize("threshold", [0.0, 0.3, 0.5, 0.99])
def test_suppression_is_torchvisions(ops, threshold):
    draw = np.random.default_rng(5)
    for count in (0, 1, 200):
        a = boxes(count, 3, torch.float32)
        # Ties of scores, too.
        scores = torch.tensor(draw.integers(0, 40, count) / 40, dtype=torch.float32)
        classes = torch.tensor(draw.integers(-3, 4, count))
        for name, more in (("nms", ()), ("batched_nms", (classes,)), ("batched_nms", (classes + 3,))):
            expected, found = [getattr(m, name)(a, scores, *more, threshold) for m in (ops, ours)]
            assert found.dtype == torch.int64 and found.tolist() == expected.tolist()


def test_suppression_of_rotated_boxes():
    a, scores = boxes(150, 3, turned=True), torch.rand(150, generator=torch.Generator().manual_seed(1))
    overlaps = exact(a, a)
    kept = []
    for i in scores.argsort(descending=True).tolist():
        if all(overlaps[i, k] <= 0.3 for k in kept):
            kept.append(i)
    for fmt in ROTATED:
        assert ours.nms(ours.box_convert(a, "cxcywhr", fmt), scores, 0.3, fmt=fmt).tolist() == kept
    assert 5 < len(kept) < 145
    classes = torch.arange(150) % 7
    found = ours.batched_nms(a, scores, classes, 0.3, fmt="cxcywhr").tolist()
    parts = [torch.nonzero(classes == c).squeeze(1) for c in range(7)]
    parts = [part[ours.nms(a[part], scores[part], 0.3, fmt="cxcywhr")].tolist() for part in parts]
    assert sorted(found) == sorted(i for part in parts for i in part)


def test_classes_stay_apart_at_negative_coordinates(ops):
    a = torch.tensor([[-10.0, -10, -8, -8], [-10, -10, -8, -8]])
    scores, classes = torch.tensor([0.9, 0.8]), torch.tensor([0, 1])
    assert ours.batched_nms(a, scores, classes, 0.5).tolist() == [0, 1]
    # Shifted apart by the largest coordinate plus 1, the classes move by -7, and still meet where it is -1.
    near = a + 7
    assert ours.batched_nms(near, scores, classes, 0.5).tolist() == [0, 1]
    assert ops.batched_nms(near, scores, classes, 0.5).tolist() == [0]


def test_errors(ops):
    a, scores = boxes(3, 1, torch.float32), torch.rand(3)
    for bad in ((a[0], scores[:1]), (a[:, :3], scores), (a, scores[:2]), (a, scores[:, None])):
        for m in (ops, ours):
            with pytest.raises(RuntimeError):
                m.nms(*bad, 0.5)
    with pytest.raises(RuntimeError, match="`idxs` has shape"):
        ours.batched_nms(a, scores, torch.zeros(2), 0.5)
    for m in (ops, ours):
        with pytest.raises(ValueError):
            m.box_iou(a, a, fmt="yxyx")
        with pytest.raises(ValueError):
            m.box_area(a, fmt="yxyx")
    with pytest.raises(ValueError, match=r"`boxes2`: fmt='cxcywhr' needs a tensor of shape \(..., 5\), not \(3, 4\)"):
        ours.box_iou(torch.ones(3, 5), a, fmt="cxcywhr")
    flipped = torch.tensor([[0.0, 0, 1, 1, 0], [0, 0, -1, 1, 0]])
    with pytest.raises(ValueError, match="item 1: width is negative"):
        ours.box_iou(flipped, flipped, fmt="cxcywhr")
    with pytest.raises(ValueError, match="`boxes2` item 2: .* is not a finite number"):
        ours.box_iou(a, torch.where(torch.arange(3)[:, None] == 2, torch.nan, a))
    # Upright boxes with sides below zero are computed as torchvision computes them.
    bad = torch.tensor([[4.0, 0, 1, 1], [0, 0, 2, 2]])
    found, expected = [m.generalized_box_iou_loss(bad, bad.flip(0)) for m in (ours, ops)]
    torch.testing.assert_close(found, expected)
