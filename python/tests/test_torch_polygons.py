"""Polygons on tensors: gradients by gradcheck, formats, refusals."""

import numpy as np
import pytest

torch = pytest.importorskip("torch")

import geograd
import geograd.torch
from geograd.torch import Polygons

SQUARE = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]
HOLE = [(1.0, 1.0), (2.1, 1.2), (2.0, 2.3), (1.2, 2.0)]
KITE = [(1.5, 0.7), (5.1, 1.3), (3.9, 5.2), (0.6, 3.1)]
FAR = [(9.0, 9.0), (10.0, 9.3), (9.2, 10.0)]


def columns(dtype=torch.float64):
    a = Polygons.of([[SQUARE, HOLE], [[SQUARE, HOLE], [FAR]]], dtype, True)
    b = Polygons.of([KITE, KITE], dtype, True)
    return a, b


@pytest.mark.parametrize("verb", ["area", "perimeter", "length", "centroid"])
def test_measures(verb):
    a, _ = columns()
    f = getattr(geograd.torch, verb)
    assert torch.autograd.gradcheck(lambda x: f(Polygons(x, a.column)), a.vertices)
    assert f(a).shape == ((2, 2) if verb == "centroid" else (2,))


@pytest.mark.parametrize("verb", ["iou", "iof", "intersection_area", "union_area"])
def test_overlaps(verb):
    a, b = columns()
    f = getattr(geograd.torch, verb)
    of = lambda x, y: f(Polygons(x, a.column), Polygons(y, b.column))
    assert torch.autograd.gradcheck(of, (a.vertices, b.vertices))
    # One polygon stands for all, and a column of arrays is a constant.
    one = Polygons.of([KITE], requires_grad=True)
    assert torch.autograd.gradcheck(lambda x, y: f(Polygons(x, a.column), Polygons(y, one.column)), (a.vertices, one.vertices))
    f(a, b.column).sum().backward()
    assert a.vertices.grad.abs().sum() > 0


@pytest.mark.parametrize("verb", ["distance", "signed_distance", "depth"])
def test_distances(verb):
    a, _ = columns()
    f = getattr(geograd.torch, verb)
    points = torch.tensor([[1.5, 1.6], [8.1, 8.7]], dtype=torch.float64, requires_grad=True)
    assert torch.autograd.gradcheck(lambda p, x: f(p, Polygons(x, a.column)), (points, a.vertices))
    # A column of arrays, in either place.
    assert torch.equal(f(points, a.column), f(a.column, points))


@pytest.mark.parametrize("valid", [False, True])
@pytest.mark.parametrize("name", ["union", "intersection", "difference", "symmetric_difference"])
def test_operations(name, valid):
    a, b = columns()
    f = getattr(geograd.torch, name)

    def of(x, y):
        made = f(Polygons(x, a.column), Polygons(y, b.column), valid=valid)
        return geograd.torch.area(made), geograd.torch.centroid(made)

    # Vertices of valid results are on a grid of roundings.
    assert torch.autograd.gradcheck(of, (a.vertices, b.vertices), eps=1e-5, atol=1e-5)
    made = f(a, b)
    assert len(made) == 2 and made.vertices.requires_grad
    assert np.array_equal(made.vertices.detach().numpy(), getattr(geograd, name)(a.column, b.column).vertices)


def test_rings_descend_to_a_target():
    torch.manual_seed(0)
    target = geograd.Polygons.of([[SQUARE, HOLE]])
    turns = torch.arange(8, dtype=torch.float64) * (2 * np.pi / 8)
    ring = (2 + torch.stack([turns.cos(), turns.sin()], -1))[None].requires_grad_()
    start = geograd.torch.iou(Polygons.rings(ring), target).item()
    optimiser = torch.optim.Adam([ring], 0.05)
    for _ in range(60):
        optimiser.zero_grad()
        loss = 1 - geograd.torch.iou(Polygons.rings(ring), target).mean()
        loss.backward()
        optimiser.step()
    assert start < 0.3 and 1 - loss.item() > 0.8


def test_single_precision_stays():
    a, b = columns(torch.float32)
    iou = geograd.torch.iou(a, b)
    assert iou.dtype == torch.float32 and geograd.torch.union(a, b).vertices.dtype == torch.float32
    iou.sum().backward()
    assert a.vertices.grad.dtype == torch.float32
    assert geograd.torch.iou(a, columns()[1]).dtype == torch.float64
    points = torch.zeros(2, 2)
    assert geograd.torch.distance(points, a).dtype == torch.float32


def test_a_graph_that_is_compiled_breaks_and_goes_on():
    a, b = columns()

    @torch.compile(backend="eager")
    def loss(x):
        return (1 - geograd.torch.iou(Polygons(x * 2, a.column), b)).sum()

    x = (a.vertices.detach() / 2).requires_grad_()
    loss(x).backward()
    plain = (a.vertices.detach() / 2).requires_grad_()
    (1 - geograd.torch.iou(Polygons(plain * 2, a.column), b)).sum().backward()
    assert torch.equal(x.grad, plain.grad)


def test_refusals():
    a, b = columns()
    with pytest.raises(TypeError, match="takes no Polygons"):
        geograd.torch.giou(a, b)
    with pytest.raises(TypeError, match="takes 2 arguments, not 1"):
        geograd.torch.iou(a)
    with pytest.raises(TypeError, match="float16"):
        Polygons(torch.zeros(4, 2, dtype=torch.float16), ([0, 4],))
    with pytest.raises(ValueError, match="16 are needed, not 3|are needed"):
        Polygons(torch.zeros(3, 2), a.column)
    with pytest.raises(ValueError, match="polygon 0"):
        Polygons.rings(torch.full((1, 4, 2), float("nan")))
    with pytest.raises(TypeError, match="tensor of points"):
        geograd.torch.distance([0.0, 0.0], a)
    assert "valid" in geograd.torch.union.__doc__ and "torch.Polygons" in repr(a)
