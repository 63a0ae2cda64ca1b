"""Losses under MMRotate's names: against formulas of matrices, and against its files where the package lies.

MMRotate needs compiled operators to be imported. Its losses need none: ``pip install --no-deps mmrotate`` is enough
here.
"""

import doctest
import importlib.machinery
import importlib.util
import math
import pathlib
import pickle
import sys
import types

import numpy as np
import pytest

torch = pytest.importorskip("torch", reason="torch is not installed: geograd.mmrotate is not tested")

import geograd.mmrotate as ours

GAUSSIANS = ["gwd", "kld", "jd", "kld_symmax", "kld_symmin"]


def boxes(count, seed, dtype=torch.float64):
    draw = np.random.default_rng(seed)
    rows = np.c_[draw.uniform(0, 20, (count, 2)), draw.uniform(3, 30, (count, 2)), draw.uniform(-2, 2, count)]
    return torch.tensor(rows, dtype=dtype)


def reduce(loss, weight=None, reduction="mean", avg_factor=None):
    """What mmdet documents of its weighted losses."""
    loss = loss if weight is None else loss * weight
    if avg_factor is not None and reduction == "mean":
        return loss.sum() / (avg_factor + torch.finfo(torch.float32).eps)
    return {"none": lambda x: x, "mean": torch.mean, "sum": torch.sum}[reduction](loss)


def weighted(f):
    def loss(p, t, weight=None, reduction="mean", avg_factor=None, **more):
        return reduce(f(p, t, **more), weight, reduction, avg_factor)

    return loss


@pytest.fixture(scope="module")
def original():
    """The files of losses and of boxes, without the package around them."""
    spec = importlib.util.find_spec("mmrotate")
    if spec is None:
        pytest.skip("mmrotate is not there (pip install --no-deps mmrotate): its losses are not compared")
    root = pathlib.Path(spec.submodule_search_locations[0])
    register = types.SimpleNamespace(register_module=lambda: lambda cls: cls)
    stubs = {
        "mmdet.models.losses.utils": {"weighted_loss": weighted},
        "of_mmrotate.models.builder": {"ROTATED_LOSSES": register},
    }
    parents = [package + part for package in ("mmdet", "of_mmrotate") for part in ("", ".models", ".models.losses")]
    names = [*stubs, *parents]
    kept = {name: sys.modules.get(name) for name in names}
    for name in names:
        made = types.ModuleType(name)
        made.__path__ = []
        made.__dict__.update(stubs.get(name, {}))
        sys.modules[name] = made
    found = types.SimpleNamespace()
    try:
        of_losses = ("gaussian_dist_loss", "gaussian_dist_loss_v1", "kf_iou_loss")
        files = {f"models.losses.{name}": f"models/losses/{name}.py" for name in of_losses}
        for name, file in {**files, "transforms": "core/bbox/transforms.py"}.items():
            if name == "transforms":
                pytest.importorskip("cv2", reason="OpenCV is not installed: mmrotate's boxes are not compared")
            spec = importlib.util.spec_from_file_location(f"of_mmrotate.{name}", root / file)
            module = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(module)
            setattr(found, name.split(".")[-1], module)
    finally:
        for name, module in kept.items():
            sys.modules.pop(name)
            if module is not None:
                sys.modules[name] = module
    return found


def covariance(box):
    _, _, w, h, r = box
    turn = np.array([[math.cos(r), -math.sin(r)], [math.sin(r), math.cos(r)]])
    return turn @ np.diag([w * w / 4, h * h / 4]) @ turn.T


def root(matrix):
    values, vectors = np.linalg.eigh(matrix)
    return vectors @ np.diag(np.sqrt(np.maximum(values, 0))) @ vectors.T


def divergence(p, q, alpha):
    """KL(p || q), with the offset of the centres over alpha."""
    a, b, offset = covariance(p), covariance(q), (p[:2] - q[:2]) / alpha
    inverse = np.linalg.inv(b)
    return (offset @ inverse @ offset + np.trace(inverse @ a) - 2 + math.log(np.linalg.det(b) / np.linalg.det(a))) / 2


def distance(loss, p, t, alpha=1.0, own=True):
    if loss == "gwd":
        a, b = covariance(p), covariance(t)
        shape = np.trace(a + b - 2 * root(root(a) @ b @ root(a)))
        scale = 2 * (np.linalg.det(a) * np.linalg.det(b)) ** (1 / 8) if own else 1
        return math.sqrt(((p[:2] - t[:2]) ** 2).sum() + alpha**2 * shape) / scale
    forth, back = divergence(t, p, alpha), divergence(p, t, alpha)
    of = {"kld": forth, "jd": (forth + back) / 2, "kld_symmax": max(forth, back), "kld_symmin": min(forth, back)}[loss]
    return math.sqrt(of) if own else of


def shaped(d, fun, tau):
    d = {"log1p": math.log1p, "sqrt": math.sqrt, "none": float}[fun](d)
    return 1 - 1 / (tau + d) if tau >= 1 else d


def test_the_example_of_the_module():
    found = doctest.testmod(ours)
    assert found.failed == 0 and found.attempted > 5


@pytest.mark.parametrize("loss", GAUSSIANS)
@pytest.mark.parametrize("fun", ["log1p", "sqrt", "none"])
def test_losses_of_gaussians_are_their_formulas(loss, fun):
    p, t = boxes(20, 1), boxes(20, 2)
    for tau, alpha, own in ((0.0, 1.0, True), (1.0, 0.5, False), (2.0, 3.0, True)):
        option = {"normalize" if loss == "gwd" else "sqrt": own}
        found = ours.GDLoss(loss, fun=fun, tau=tau, alpha=alpha, reduction="none", **option)(p, t)
        expected = [shaped(distance(loss, a, b, alpha, own), fun, tau) for a, b in zip(p.numpy(), t.numpy())]
        np.testing.assert_allclose(found.numpy(), expected, rtol=1e-9)


@pytest.mark.parametrize("loss", GAUSSIANS)
def test_losses_of_gaussians_are_mmrotates(original, loss):
    for dtype, near in ((torch.float64, 1e-9), (torch.float32, 2e-3)):
        p, t = boxes(50, 1, dtype).requires_grad_(), boxes(50, 2, dtype)
        weight = torch.rand(50, dtype=dtype)
        for more in (
            {}, {"fun": "sqrt", "tau": 1.0}, {"fun": "none", "tau": 2.0, "alpha": 0.3},
            {"alpha": 2.0, "loss_weight": 5.0, "reduction": "sum"},
            {"normalize" if loss == "gwd" else "sqrt": False},
        ):
            wide = {"weight": weight[:, None].expand(50, 5)}
            for call in ({}, {"weight": weight}, wide, {"weight": weight, "reduction_override": "none"}):
                losses = [cls(loss, **more)(p, t, **call) for cls in (original.gaussian_dist_loss.GDLoss, ours.GDLoss)]
                torch.testing.assert_close(losses[1], losses[0], rtol=near, atol=near)
                expected, found = [torch.autograd.grad(x.sum(), p)[0] for x in losses]
                torch.testing.assert_close(found, expected, rtol=near, atol=near)
        call = {"weight": weight, "avg_factor": 7.0}
        losses = [cls(loss)(p, t, **call) for cls in (original.gaussian_dist_loss.GDLoss, ours.GDLoss)]
        torch.testing.assert_close(losses[1], losses[0], rtol=near, atol=near)


def test_boxes_of_a_unit_image(original):
    # Floors of the original under inner roots change the loss of small boxes.
    p, t = [x * torch.tensor([0.01, 0.01, 0.001, 0.001, 1.0]) for x in (boxes(20, 1), boxes(20, 2))]
    found = ours.GDLoss("gwd", fun="none", reduction="none")(p, t)
    np.testing.assert_allclose(found, [distance("gwd", a, b) for a, b in zip(p.numpy(), t.numpy())], rtol=1e-9)
    expected = original.gaussian_dist_loss.GDLoss("gwd", fun="none", reduction="none")(p, t)
    assert ((expected - found).abs() > 0.1 * found).any()


@pytest.mark.parametrize("loss", ["gwd", "kld", "bcd"])
def test_first_losses_are_mmrotates(original, loss):
    p, t = boxes(50, 1).requires_grad_(), boxes(50, 2)
    for fun in ("sqrt", "log1p", ""):
        for tau in (1.0, 2.0):
            # The original gives one loss for each box, whatever the reduction, and needs weights.
            expected = original.gaussian_dist_loss_v1.GDLoss_v1(loss, fun=fun, tau=tau)(p, t, torch.ones(50))
            expected = expected.reshape(-1)
            found = ours.GDLoss_v1(loss, fun=fun, tau=tau, reduction="none")(p, t)
            torch.testing.assert_close(found, expected, rtol=1e-9, atol=1e-12)
            expected, found = [torch.autograd.grad(x.sum(), p)[0] for x in (expected, found)]
            torch.testing.assert_close(found, expected, rtol=1e-8, atol=1e-11)


@pytest.mark.parametrize("fun", ["none", "ln", "exp"])
def test_filter_losses_are_mmrotates(original, fun):
    p, t = boxes(50, 1).requires_grad_(), boxes(50, 2)
    encoded, wanted = torch.randn(2, 50, 5, dtype=torch.float64).mul(0.3)
    encoded.requires_grad_()
    weight = torch.rand(50, dtype=torch.float64)
    averaged = {"weight": weight, "avg_factor": 9.0}
    for call in ({}, {"weight": weight}, averaged, {"reduction_override": "sum"}, {"beta": 0.5, "eps": 0.1}):
        modules = [cls(fun, loss_weight=3.0) for cls in (original.kf_iou_loss.KFLoss, ours.KFLoss)]
        losses = [module(encoded, wanted, pred_decode=p, targets_decode=t, **call) for module in modules]
        torch.testing.assert_close(losses[1], losses[0], rtol=1e-9, atol=1e-9)
        expected, found = [torch.autograd.grad(x.sum(), (p, encoded)) for x in losses]
        torch.testing.assert_close(found, expected, rtol=1e-8, atol=1e-10)


def test_the_filter_loss_is_its_formula():
    p, t = boxes(10, 1), boxes(10, 2)
    none = torch.zeros(10, 5).double()
    found = ours.KFLoss(reduction="none")(none, none, pred_decode=p, targets_decode=t)
    for value, a, b in zip(found.tolist(), p.numpy(), t.numpy()):
        a, b = covariance(a), covariance(b)
        both = np.linalg.inv(np.linalg.inv(a) + np.linalg.inv(b))
        sizes = [4 * math.sqrt(np.linalg.det(x)) for x in (a, b, both)]
        assert value == pytest.approx(1 - sizes[2] / (sizes[0] + sizes[1] - sizes[2] + 1e-6), abs=1e-12)


@pytest.mark.parametrize("mode", ["linear", "square", "log"])
def test_the_loss_of_iou(mode):
    shapely = pytest.importorskip("shapely", reason="shapely is not installed: exact IoU is not compared")
    p, t = boxes(40, 1), boxes(40, 2)
    t[0, :2] += 100
    polygons = [shapely.polygons(ours.obb2poly(x).numpy().reshape(-1, 4, 2)) for x in (p, t)]
    shared = shapely.area(shapely.intersection(*polygons))
    iou = np.maximum(shared / (shapely.area(polygons[0]) + shapely.area(polygons[1]) - shared), 1e-6)
    expected = {"linear": 1 - iou, "square": 1 - iou**2, "log": -np.log(iou)}[mode]
    p.requires_grad_()
    found = ours.RotatedIoULoss(mode=mode, reduction="none", loss_weight=2.0)(p, t)
    np.testing.assert_allclose(found.detach().numpy(), 2 * expected, atol=1e-9)
    (grad,) = torch.autograd.grad(found.sum(), p)
    assert not grad[0].any() and grad[1:].abs().sum() > 0.1
    assert ours.RotatedIoULoss(linear=True).mode == "linear"


def test_representation_by_correlation(original):
    p, t = boxes(20, 1), boxes(20, 2)

    def correlated(x):
        made = []
        for box in x.numpy():
            matrix = covariance(box)
            deviations = np.sqrt(np.diag(matrix))
            made.append([*box[:2], *deviations, matrix[0, 1] / deviations.prod()])
        return torch.tensor(np.array(made))

    a, b = correlated(p).requires_grad_(), correlated(t)
    for loss in GAUSSIANS:
        for more in ({}, {"alpha": 0.5, "fun": "sqrt", "tau": 1.0}):
            found = ours.GDLoss(loss, "xy_stddev_pearson", reduction="none", **more)(a, b)
            torch.testing.assert_close(found, ours.GDLoss(loss, reduction="none", **more)(p, t), rtol=1e-7, atol=1e-7)
            expected = original.gaussian_dist_loss.GDLoss(loss, "xy_stddev_pearson", reduction="none", **more)(a, b)
            torch.testing.assert_close(found, expected, rtol=1e-7, atol=1e-7)
            grads = [torch.autograd.grad(x.sum(), a)[0] for x in (expected, found)]
            torch.testing.assert_close(grads[1], grads[0], rtol=1e-6, atol=1e-8)
            assert ours.GDLoss(loss, "xy_stddev_pearson", **more)(a.float(), b.float()).dtype == torch.float32
        # A correlation of 1 has no inverse: it counts as a little less.
        one = torch.where(torch.arange(5) == 4, 1.0, a.detach())
        both = original.gaussian_dist_loss.GDLoss, ours.GDLoss
        expected, found = [cls(loss, "xy_stddev_pearson")(one, b) for cls in both]
        assert found.isfinite()
        torch.testing.assert_close(found, expected, rtol=1e-4, atol=0)


def losses():
    yield ours.RotatedIoULoss()
    yield ours.RotatedIoULoss(mode="square")
    for loss in GAUSSIANS:
        yield ours.GDLoss(loss, tau=1.0)
    for loss in ("gwd", "kld", "bcd"):
        yield ours.GDLoss_v1(loss)
        yield ours.GDLoss_v1(loss, fun="")
    for fun in ("none", "ln", "exp"):
        yield ours.KFLoss(fun)


@pytest.mark.parametrize("loss", list(losses()), ids=repr)
def test_gradients_and_no_boxes(loss):
    p, t = boxes(4, 3), boxes(4, 3) + torch.tensor([1.5, 1.0, 0.4, 0.3, 0.2])
    p, t = p.requires_grad_(), t.double().requires_grad_()
    assert torch.autograd.gradcheck(lambda p, t: loss(p, t), (p, t), atol=1e-6)
    # Equal boxes have a gradient, too.
    (grad,) = torch.autograd.grad(loss(p, p.detach()), p)
    assert grad.isfinite().all()
    none = torch.zeros((0, 5), requires_grad=True)
    for call in ({}, {"weight": torch.zeros(0)}, {"avg_factor": 3.0}):
        value = loss(none, torch.zeros(0, 5), **call)
        assert value.item() == 0 and value.dtype == torch.float32
        value.backward()
    assert none.grad.shape == (0, 5) and loss(none, none, reduction_override="none").shape == (0,)
    # No box counts.
    for weight in (torch.zeros(4), torch.zeros(4, 5)):
        value = loss(p, t, weight=weight)
        assert value.item() == 0 and not torch.autograd.grad(value, p)[0].any()
    # Sides that a head made negative.
    bad = torch.tensor([[0.0, 0, -1, 2, 0]], requires_grad=True)
    value = loss(bad, torch.tensor([[0.0, 0, 1, 2, 0]]))
    value.backward()
    assert value.isfinite() and bad.grad.isfinite().all()
    assert repr(pickle.loads(pickle.dumps(loss))) == repr(loss)
    half = loss(boxes(3, 1).half(), boxes(3, 2).half())
    assert half.dtype == torch.float32


def test_versions_are_mmrotates(original):
    draw = np.random.default_rng(3)
    start = boxes(200, 4)
    start[:, 4] = torch.tensor(draw.uniform(-7, 7, 200))
    for version in ("oc", "le90", "le135"):
        polys = ours.obb2poly(start, version)
        torch.testing.assert_close(polys, original.transforms.obb2poly(start, version))
        expected, found = original.transforms.poly2obb(polys, version), ours.poly2obb(polys, version)
        torch.testing.assert_close(found, expected, rtol=1e-9, atol=1e-9)
        torch.testing.assert_close(found, ours.regular(start, version), rtol=1e-9, atol=1e-9)
        expected, found = [m.norm_angle(start[:, 4], version) for m in (original.transforms, ours)]
        torch.testing.assert_close(found, expected)
        expected = original.transforms.obb2xyxy(ours.regular(start, version), version)
        torch.testing.assert_close(ours.obb2xyxy(start, version), expected)
        # The same rectangles.
        loss = ours.RotatedIoULoss(mode="linear", reduction="none")(start, ours.regular(start, version))
        assert loss.abs().max() < 1e-12


def test_ranges_of_versions():
    start = boxes(300, 4)
    start[:, 4] *= 4
    for version, low, high in (("oc", 0, 0.5), ("le90", -0.5, 0.5), ("le135", -0.25, 0.75)):
        angle = ours.regular(start, version)[:, 4] / math.pi
        assert angle.min() >= low and angle.max() < high
    for version in ("le90", "le135"):
        found = ours.regular(start, version)
        assert (found[:, 2] >= found[:, 3]).all()


def test_errors():
    p = boxes(3, 1)
    for make, message in (
        (lambda: ours.RotatedIoULoss(mode="ln"), "mode is one of 'linear', 'square', 'log', not 'ln'"),
        (lambda: ours.GDLoss("bcd"), "loss_type is one of"),
        (lambda: ours.GDLoss("gwd", fun="exp"), "fun is one of"),
        (lambda: ours.GDLoss("gwd", representation="xyxy"), "representation is one of"),
        (lambda: ours.KFLoss(reduction="max"), "reduction is one of"),
        (lambda: ours.GDLoss_v1("jd"), "loss_type is one of"),
        (lambda: ours.RotatedIoULoss()(p, p[:2]), "`pred` has 3 boxes, and `target` has 2"),
        (lambda: ours.RotatedIoULoss()(p[:, :4], p), r"`pred`: a tensor of shape \(N, 5\)"),
        (lambda: ours.RotatedIoULoss()(p, p, weight=torch.ones(2)), "`weight`: one for each of 3 boxes"),
        (lambda: ours.RotatedIoULoss()(p, p, avg_factor=2, reduction_override="sum"), "avg_factor goes with"),
        (lambda: ours.RotatedIoULoss()(p, p, reduction_override="max"), "reduction_override is one of"),
        (lambda: ours.RotatedIoULoss()(p, p * math.nan), "`target` item 0: .* is not a finite number"),
        (lambda: ours.poly2obb(torch.ones(2, 8), "le180"), "version is one of"),
    ):
        with pytest.raises(ValueError, match=message):
            make()
