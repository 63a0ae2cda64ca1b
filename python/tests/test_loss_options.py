"""Losses of PyTorch: half precision, autocast, pairs that are not valid, weights, Gaussians."""

import copy
import pickle

import numpy as np
import pytest

torch = pytest.importorskip("torch")

import geograd
import geograd.torch
from pairs import A, B

ALL = ["IoULoss", "GIoULoss", "DIoULoss", "CIoULoss", "EIoULoss", "ProbIoULoss", "KFIoULoss", "GWDLoss", "KLDLoss"]


def made(name, **options):
    return getattr(geograd.torch, name)(**options)


def pair(dtype=torch.float32):
    return torch.tensor(A, dtype=dtype, requires_grad=True), torch.tensor(B, dtype=dtype)


@pytest.mark.parametrize("dtype", [torch.float16, torch.bfloat16])
@pytest.mark.parametrize("name", ALL)
def test_half_precision_is_computed_in_single(name, dtype):
    a, b = pair(dtype)
    value = made(name)(a, b)
    value.backward()
    expected = made(name)(a.detach().float(), b.float())
    assert value.dtype == torch.float32 and value.item() == expected.item()
    assert a.grad.dtype == dtype and torch.isfinite(a.grad).all() and a.grad.abs().sum() > 0


def test_verbs_take_half_precision_under_autocast():
    a, b = pair(torch.bfloat16)
    with torch.autocast("cpu", torch.bfloat16):
        value = geograd.torch.iou(a, b, kind="Obb2")
        matrix = geograd.torch.iou.all_pairs(a, b, kind="Obb2")
        compiled = torch.compile(lambda a, b: geograd.torch.iou(a, b, kind="Obb2"), fullgraph=True, backend="aot_eager")(a, b)
    assert value.dtype == matrix.dtype == torch.float32
    torch.testing.assert_close(compiled, value, rtol=0, atol=0)
    with pytest.raises(TypeError, match=r"bfloat16: convert with .float\(\); under torch.autocast"):
        geograd.torch.iou(a, b, kind="Obb2")


@pytest.mark.parametrize("name", ALL)
def test_a_head_trains_under_autocast(name):
    torch.manual_seed(0)
    head = torch.nn.Linear(4, 5)
    target = torch.tensor(B, dtype=torch.float32)
    optimiser = torch.optim.SGD(head.parameters(), 1e-3)
    with torch.autocast("cpu", torch.bfloat16):
        boxes = head(torch.ones(3, 4))
        boxes = torch.cat([boxes[:, :2], boxes[:, 2:4].exp(), boxes[:, 4:]], -1)
        loss = made(name)(boxes, target)
    loss.backward()
    optimiser.step()
    assert torch.isfinite(loss) and torch.isfinite(head.weight).all()


BAD = {"nan": (0, np.nan), "infinite": (1, np.inf), "negative": (2, -1.0)}


@pytest.mark.parametrize("compiled", [False, True], ids=["eager", "compiled"])
@pytest.mark.parametrize("place, number", BAD.values(), ids=BAD)
@pytest.mark.parametrize("name", ALL)
def test_pairs_that_are_not_valid(name, place, number, compiled):
    if compiled and (name not in ("GIoULoss", "GWDLoss") or place != 0):
        pytest.skip("two losses are compiled")
    a, b = pair(torch.float64)
    bad = a.detach().clone()
    bad[1, place] = number
    bad.requires_grad_()
    wrap = (lambda loss: torch.compile(loss, fullgraph=True, backend="aot_eager")) if compiled else lambda loss: loss
    for loss in (made(name), made(name, invalid="raise")):
        with pytest.raises(ValueError, match="item 1"):
            loss(bad, b)
    # NaN, with a gradient of NaN where a scaler of gradients looks for it; others are as they were.
    each = wrap(made(name, invalid="nan", reduction="none"))(bad, b)
    assert torch.isnan(each[1]) and torch.isfinite(each[[0, 2]]).all()
    torch.testing.assert_close(each[[0, 2]], made(name, reduction="none")(a, b)[[0, 2]].detach(), rtol=0, atol=0)
    (grad,) = torch.autograd.grad(each.sum(), bad)
    assert torch.isnan(grad[1]).all() and torch.isfinite(grad[[0, 2]]).all() and grad[0].abs().sum() > 0
    each = wrap(made(name, invalid="ignore", reduction="none"))(bad, b)
    (grad,) = torch.autograd.grad(each.sum(), bad)
    assert each[1] == 0 and (grad[1] == 0).all() and grad[0].abs().sum() > 0
    (expected,) = torch.autograd.grad(made(name, reduction="none")(a, b)[[0, 2]].sum(), a)
    torch.testing.assert_close(grad[[0, 2]], expected[[0, 2]], rtol=0, atol=0)


def test_a_scaler_skips_the_step():
    weights = torch.ones(5, requires_grad=True)
    optimiser = torch.optim.SGD([weights], 0.1)
    scaler = torch.amp.GradScaler("cpu", init_scale=4.0)
    a, b = pair()
    for factor, is_skipped in ((torch.inf, True), (1.0, False)):
        optimiser.zero_grad()
        with torch.autocast("cpu", torch.bfloat16):
            scaler.scale(geograd.torch.GIoULoss()(a.detach() * weights * factor, b)).backward()
        before = weights.detach().clone()
        scaler.step(optimiser)
        scaler.update()
        assert torch.equal(weights, before) == is_skipped
    assert scaler.get_scale() == 2.0 and torch.isfinite(weights).all()


def test_a_weight_of_zero_ignores_a_pair():
    a, b = pair(torch.float64)
    padded = torch.cat([a, torch.full((2, 5), -1.0)]).detach().requires_grad_()
    target = torch.cat([b, torch.zeros(2, 5)])
    weight = torch.tensor([1.0, 1.0, 1.0, 0.0, 0.0])
    loss = geograd.torch.GIoULoss(invalid="ignore")(padded, target, weight=weight, avg_factor=3)
    loss.backward()
    assert loss.item() == pytest.approx(geograd.torch.GIoULoss()(a, b).item(), rel=1e-15)
    assert (padded.grad[3:] == 0).all() and torch.isfinite(padded.grad).all()


@pytest.mark.parametrize("name", ALL)
def test_weights_and_factors(name):
    a, b = pair(torch.float64)
    each = made(name, reduction="none")(a, b).detach()
    weight = torch.tensor([0.5, 2.0, 1.0], dtype=torch.float64)
    mean = (each * weight).mean().item()
    assert made(name)(a, b, weight).item() == pytest.approx(mean, rel=1e-14)
    assert made(name)(a, b, weight[:, None].expand(3, 5)).item() == pytest.approx(mean, rel=1e-14)
    assert made(name, reduction="sum")(a, b, weight).item() == pytest.approx(3 * mean, rel=1e-14)
    for factor in (7.0, torch.tensor(7.0)):
        assert made(name)(a, b, weight=weight, avg_factor=factor).item() == pytest.approx(3 * mean / 7, rel=1e-14)
    torch.testing.assert_close(made(name, reduction="none")(a, b, weight, avg_factor=7.0).detach(), each * weight)
    with pytest.raises(ValueError, match="avg_factor"):
        made(name, reduction="sum")(a, b, avg_factor=7.0)
    # An image without objects.
    assert made(name)(a[:0], b[:0], weight[:0], avg_factor=0).item() == 0
    assert made(name)(a[:0], b[:0], avg_factor=torch.tensor(0.0)).item() == 0


@pytest.mark.parametrize("name", ALL)
def test_losses_are_copied(name):
    loss = made(name, reduction="sum", invalid="ignore")
    a, b = pair()
    for again in (copy.deepcopy(loss), pickle.loads(pickle.dumps(loss))):
        assert again(a, b).item() == loss(a, b).item() and again.invalid == "ignore" and "ignore" in repr(again)
    for wrong in ({"invalid": "skip"}, {"reduction": "median"}):
        with pytest.raises(ValueError, match="not '"):
            made(name, **wrong)


def gaussians(boxes):
    """Means and covariances, as mmrotate makes them."""
    cos, sin = boxes[:, 4].cos(), boxes[:, 4].sin()
    turn = torch.stack([cos, -sin, sin, cos], -1).reshape(-1, 2, 2)
    half = 0.5 * torch.diag_embed(boxes[:, 2:4])
    return boxes[:, :2], turn @ half.square() @ turn.transpose(1, 2)


def by_mmrotate(loss, a, b):
    """mmrotate's formulas by matrices: Yang et al. 2021, for the Wasserstein distance and the divergence."""
    (xy_a, of_a), (xy_b, of_b) = gaussians(a), gaussians(b)
    trace = lambda x: x.diagonal(dim1=-2, dim2=-1).sum(-1)
    if isinstance(loss, geograd.torch.GWDLoss):
        root = (of_a.det() * of_b.det()).sqrt()
        shapes = trace(of_a) + trace(of_b) - 2 * (trace(of_a @ of_b) + 2 * root).sqrt()
        distance = ((xy_a - xy_b).square().sum(-1) + shapes).sqrt()
        if loss.normalize:
            distance = distance / (2 * root.sqrt().sqrt())
    else:
        inverse, apart = of_a.inverse(), (xy_a - xy_b)[..., None]
        distance = 0.5 * (apart.transpose(1, 2) @ inverse @ apart)[:, 0, 0]
        distance = distance + 0.5 * trace(inverse @ of_b) + 0.5 * (of_a.det().log() - of_b.det().log()) - 1
        distance = distance.sqrt() if loss.sqrt else distance
    distance = {"log1p": torch.log1p, "sqrt": torch.sqrt, "none": lambda x: x}[loss.fun](distance)
    return 1 - 1 / (loss.tau + distance) if loss.tau >= 1 else distance


OPTIONS = [{}, {"fun": "sqrt", "tau": 2.0}, {"fun": "none", "tau": 0.0}]


@pytest.mark.parametrize("options", OPTIONS, ids=str)
@pytest.mark.parametrize("name, switch", [("GWDLoss", "normalize"), ("KLDLoss", "sqrt")])
def test_losses_of_gaussians_are_those_of_mmrotate(name, switch, options):
    for on in (True, False):
        loss = made(name, reduction="none", **{switch: on}, **options)
        a, b = pair(torch.float64)
        found, expected = loss(a, b), by_mmrotate(loss, a, b)
        torch.testing.assert_close(found, expected, rtol=1e-11, atol=1e-12)
        grads = [torch.autograd.grad(x.sum(), a)[0] for x in (found, expected)]
        torch.testing.assert_close(*grads, rtol=1e-9, atol=1e-9)
        assert torch.autograd.gradcheck(loss, (a, b.clone().requires_grad_()))


@pytest.mark.parametrize("kind, width", [("Obb2", 5), ("Obb3", 10)])
@pytest.mark.parametrize("name", ["GWDLoss", "KLDLoss"])
def test_losses_of_gaussians_at_equal_boxes(name, kind, width):
    box = torch.tensor([[0.5, 1.0, 4.0, 2.0, 0.3]] if width == 5 else [[1.0, 2, 3, 4, 2, 1, 0.8, 0.1, -0.3, 0.4]], dtype=torch.float64)
    box.requires_grad_()
    loss = made(name, kind=kind)(box, box.detach())
    loss.backward()
    assert loss.item() == pytest.approx(0, abs=1e-7) and torch.isfinite(box.grad).all()
    flat = box.detach().clone()
    flat[0, 3] = 0.0
    flat.requires_grad_()
    made(name, kind=kind)(flat, box.detach() + 0.1).backward()
    assert torch.isfinite(flat.grad).all()
    with pytest.raises(ValueError, match="fun is"):
        made(name, fun="log2p")
