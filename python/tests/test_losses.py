"""Losses of PyTorch: of no boxes, compiled in a new process, of centres."""

import math
import subprocess
import sys

import numpy as np
import pytest

torch = pytest.importorskip("torch")

import geograd
import geograd.torch
from geograd import _nodes
from pairs import A, B


@pytest.mark.parametrize("dtype", [torch.float32, torch.float64], ids=str)
@pytest.mark.parametrize("name", _nodes.LOSSES)
def test_the_loss_of_no_boxes_is_zero_with_gradient_zero(name, dtype):
    for reduction in ("mean", "sum"):
        loss = getattr(geograd.torch, name)(reduction=reduction)
        a = torch.zeros((0, 5), dtype=dtype, requires_grad=True)
        value = loss(a, torch.zeros((0, 5), dtype=dtype))
        assert value.item() == 0 and value.dtype == dtype
        value.backward()
        assert a.grad.shape == (0, 5)
    # A batch whose second image has no objects: the loss of the first one.
    weights = torch.ones(5, dtype=dtype, requires_grad=True)
    loss = getattr(geograd.torch, name)()
    boxes = [torch.tensor(x, dtype=dtype) for x in (A, B)]
    whole = loss(boxes[0] * weights, boxes[1])
    (expected,) = torch.autograd.grad(whole, weights)
    both = loss(boxes[0] * weights, boxes[1]) + loss(boxes[0][:0] * weights, boxes[1][:0])
    (found,) = torch.autograd.grad(both, weights)
    assert both.item() == whole.item() and torch.equal(found, expected) and torch.isfinite(found).all()


def test_one_loss_of_any_verb_has_the_mean_of_torch():
    a, b = torch.tensor(A), torch.tensor(B)
    for verb in ("iou", "giou", "kfiou", "probiou"):
        each = geograd.torch.Loss(verb, reduction="none")(a, b)
        assert geograd.torch.Loss(verb)(a, b).item() == each.mean().item()


FRESH = """
import pickle, sys
import torch, geograd.torch
a = torch.tensor([[0.0, 0.0, 4.0, 2.0, 0.1], [3.0, 1.0, 4.0, 2.0, 0.5]], requires_grad=True)
b = torch.tensor([[0.5, 0.2, 4.2, 1.8, 0.1], [3.0, 1.5, 4.0, 2.0, 0.9]])
for name in sys.argv[2:]:
    if sys.argv[1] == "loss":
        loss = getattr(geograd.torch, name)()
    elif sys.argv[1] == "pickled":
        loss = pickle.loads(PICKLED[name])
    else:
        verb = getattr(geograd.torch, name)
        loss = lambda a, b: verb(a, b, kind="Obb2").sum()
    value = torch.compile(loss, fullgraph=True, backend="aot_eager")(a, b)
    (grad,) = torch.autograd.grad(value, a)
    (own,) = torch.autograd.grad(loss(a, b), a)
    assert torch.equal(grad, own) and grad.abs().sum() > 0, name
    torch._dynamo.reset()
none = torch.zeros((0, 5), requires_grad=True)
if sys.argv[1] == "loss":
    value = torch.compile(geograd.torch.GIoULoss(), fullgraph=True, backend="aot_eager", dynamic=True)
    assert value(a, b).item() > 0 and value(none, none.detach()).item() == 0
print("done")
"""


@pytest.mark.slow
@pytest.mark.parametrize("way", ["loss", "pickled", "verb"])
def test_a_graph_without_breaks_needs_no_call_before(way):
    import pickle

    names = [*_nodes.LOSSES.values()] if way == "verb" else [*_nodes.LOSSES]
    text = FRESH
    if way == "pickled":
        kept = {name: pickle.dumps(getattr(geograd.torch, name)()) for name in names}
        text = f"PICKLED = {kept!r}\n{FRESH}"
    done = subprocess.run([sys.executable, "-c", text, way, *names], capture_output=True, text=True, timeout=600)
    assert done.returncode == 0 and done.stdout.endswith("done\n"), done.stderr[-3000:]


def test_an_own_function_compiled_outlives_its_wrapper():
    def value():
        own = geograd.torch.function(geograd.function(lambda x, y: x * y + 1.0))
        return torch.compile(lambda x: own(x, x).sum(), fullgraph=True, backend="aot_eager")(x)

    x = torch.tensor([1.0, 2.0], requires_grad=True)
    value().backward()
    torch.testing.assert_close(x.grad, torch.tensor([2.0, 4.0]))


def smooth(share):
    share = abs(share)
    return 4.5 * share**2 if share < 1 / 9 else share - 1 / 18


def test_the_kfiou_loss_sees_centres():
    loss = geograd.torch.KFIoULoss(reduction="none")
    box = torch.tensor([[3.0, -1.0, 4.0, 2.0, 0.3]], dtype=torch.float64)
    assert loss(box, box).item() == pytest.approx(0, abs=1e-15)
    heading = 0.3
    values = []
    for x, y in ((0.1, 0.0), (4.0, 0.0), (0.0, 1.0), (100.0, -7.0)):
        away = box.clone()
        away[0, 0] += x
        away[0, 1] += y
        # Only the centre differs: the offset along the target's sides, over these.
        along = (math.cos(heading) * x + math.sin(heading) * y) / 4
        across = (math.cos(heading) * y - math.sin(heading) * x) / 2
        value = loss(away, box).item()
        assert value == pytest.approx(smooth(along) + smooth(across), rel=1e-12)
        twice = geograd.torch.KFIoULoss(reduction="none", centers=2.0)(away, box).item()
        assert twice == pytest.approx(2 * value, rel=1e-12)
        assert geograd.torch.KFIoULoss(reduction="none", centers=0)(away, box).item() == pytest.approx(0, abs=1e-15)
        values.append(value)
    assert values[-1] > 20
    assert torch.autograd.gradcheck(loss, (away.requires_grad_(), box.clone().requires_grad_()))


def test_the_kfiou_loss_has_the_gradient_of_mmrotate_in_its_shapes():
    a = torch.tensor(A, requires_grad=True)
    b = torch.tensor(B)
    (ours,) = torch.autograd.grad(geograd.torch.KFIoULoss(centers=0, reduction="sum")(a, b), a)
    (theirs,) = torch.autograd.grad(geograd.torch.Loss("kfiou", reduction="sum")(a, b), a)
    torch.testing.assert_close(ours, theirs, rtol=0, atol=0)


def test_the_kfiou_loss_in_space():
    turned = lambda v, q: np.asarray(q_rotate(q, v))

    def q_rotate(q, v):
        q = np.asarray(q) / np.linalg.norm(q)
        w, u = q[0], q[1:]
        return v + 2 * np.cross(u, np.cross(u, v) + w * np.asarray(v))

    q = [0.8, 0.1, -0.3, 0.4]
    box = torch.tensor([[1.0, 2.0, 3.0, 4.0, 2.0, 1.0, *q]], dtype=torch.float64)
    loss = geograd.torch.KFIoULoss("Obb3", reduction="none")
    assert loss(box, box).item() == pytest.approx(0, abs=1e-14)
    for k, size in enumerate((4.0, 2.0, 1.0)):
        offset = turned(3.0 * np.eye(3)[k], q)
        away = box.clone()
        away[0, :3] += torch.tensor(offset)
        assert loss(away, box).item() == pytest.approx(smooth(3.0 / size), rel=1e-12)


def test_the_kfiou_loss_alone_trains_a_box():
    target = torch.tensor([[20.0, -10.0, 4.0, 2.0, 0.7]])
    x = torch.tensor([[0.0, 0.0, 3.0, 3.0, 0.1]], requires_grad=True)
    loss = geograd.torch.KFIoULoss()
    optimiser = torch.optim.Adam([x], lr=0.2)
    for step in range(600):
        optimiser.param_groups[0]["lr"] = 0.2 * (1 - step / 600)
        optimiser.zero_grad()
        loss(x, target).backward()
        optimiser.step()
    assert geograd.torch.iou(x.detach(), target, kind="Obb2").item() > 0.9
