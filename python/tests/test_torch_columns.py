"""Rings and paths on tensors, and second derivatives of polygons: gradcheck and gradgradcheck, formulas against the library."""

import numpy as np
import pytest

torch = pytest.importorskip("torch")

import geograd
import geograd.torch
from geograd import _columns, _formulas, _torch_polygons
from geograd.torch import Polygons, Polylines, Rings

SQUARE = [(0.0, 0.0), (4.0, 0.1), (4.2, 4.0), (0.3, 4.0)]
HOLE = [(1.0, 1.0), (2.1, 1.2), (2.0, 2.3), (1.2, 2.0)]
KITE = [(1.5, 0.7), (5.1, 1.3), (3.9, 5.2), (0.6, 3.1)]
FAR = [(9.0, 9.0), (10.0, 9.3), (9.2, 10.0)]
POINTS = [[1.5, 1.6], [8.1, 8.7]]


def tensor(x):
    return torch.tensor(x, dtype=torch.float64, requires_grad=True)


def columns():
    # The second ring turns clockwise, the hole as its border does.
    a = Polygons.of([[SQUARE, HOLE], [[SQUARE[::-1], HOLE[::-1]], [FAR]]], requires_grad=True)
    return a, Polygons.of([KITE, [KITE[::-1]]], requires_grad=True)


def twice(f, *xs):
    assert torch.autograd.gradcheck(f, xs, fast_mode=True)
    assert torch.autograd.gradgradcheck(f, xs, fast_mode=True)


# Second derivatives


@pytest.mark.parametrize("verb", ["area", "perimeter", "length", "centroid"])
def test_measures_twice(verb):
    a, _ = columns()
    twice(lambda x: getattr(geograd.torch, verb)(Polygons(x, a.column)), a.vertices)


@pytest.mark.parametrize("verb", ["intersection_area", "union_area", "iou", "iof"])
def test_overlaps_twice(verb):
    a, b = columns()
    f = getattr(geograd.torch, verb)
    twice(lambda x, y: f(Polygons(x, a.column), Polygons(y, b.column)), a.vertices, b.vertices)
    one = Polygons.of([KITE], requires_grad=True)
    twice(lambda x, y: f(Polygons(y, one.column), Polygons(x, a.column)), a.vertices, one.vertices)


@pytest.mark.parametrize("verb", ["distance", "signed_distance", "depth"])
def test_distances_from_points_twice(verb):
    a, _ = columns()
    f = getattr(geograd.torch, verb)
    twice(lambda p, x: f(p, Polygons(x, a.column)), tensor(POINTS), a.vertices)
    rings = Rings.of([SQUARE, KITE], requires_grad=True)
    twice(lambda p, x: f(p, Rings(x, rings.column)), tensor(POINTS), rings.vertices)
    twice(lambda p, x: f(p, Rings(x, [0, 8])), tensor(POINTS), rings.vertices)


SHAPES = {
    "Aabb2": [[6.0, 1, 7, 2], [5, 5, 6, 7.5]],
    "Capsule2": [[6.0, 1, 7, 2, 0.3], [5, 5, 6, 7.5, 0.1]],
    "Circle": [[6.0, 1, 0.7], [7, 5, 0.1]],
    "Obb2": [[6.0, 1, 2, 1, 0.4], [6, 5.5, 1, 2, 0.3]],
    "Segment2": [[6.0, 1, 7, 2], [5, 5, 6, 7.5]],
    "Triangle2": [[6.0, 1, 7, 2, 6.5, 3], [5, 5, 6, 7.5, 4.8, 6]],
}


@pytest.mark.parametrize("kind", SHAPES)
def test_distances_from_shapes_twice(kind):
    a, _ = columns()
    x = tensor(SHAPES[kind])
    found = geograd.torch.distance(a, x, kind=kind)
    assert (found > 0).all()
    assert np.array_equal(found.detach(), geograd.distance(a.column, getattr(geograd, kind)(x.detach().numpy())))
    twice(lambda x, y: geograd.torch.distance(Polygons(x, a.column), y, kind=kind), a.vertices, x)


def test_distances_of_two_columns_twice():
    a, _ = columns()
    parts = [[(5.1, 5.3), (6.2, 7.4), (4.9, 6)], [(40.0, 1), (41, 1), (41, 2)]]
    b = Polygons.of([[(6.0, 1), (7, 2), (6.3, 3)], parts], requires_grad=True)
    found = geograd.torch.distance(a, b)
    assert (found > 0).all()
    twice(lambda x, y: geograd.torch.distance(Polygons(x, a.column), Polygons(y, b.column)), a.vertices, b.vertices)
    # Nothing of what meets.
    assert geograd.torch.distance(a, a).tolist() == [0, 0]


def test_formulas_have_the_values_of_the_library():
    shapely = pytest.importorskip("shapely")
    from test_separation import apart

    a, b = (geograd.Polygons.of(own) for own in apart(7, 60))
    hostile = [geograd.Polygons.of(np.array([shapely.box(*x) for x in own], object)) for own in (
        [(0, 0, 2, 2), (0, 0, 2, 2), (0, 0, 4, 4)], [(0, 0, 2, 2), (2, 0, 4, 2), (1, 1, 2, 3)]
    )]
    points = np.random.default_rng(0).normal(size=(60, 2)) * 2
    of = _columns.Layout.of
    for verb, own in [
        *[(verb, [x]) for verb in ("area", "perimeter", "centroid") for x in (a, b, hostile[0])],
        *[(verb, pair) for verb in ("intersection_area", "union_area", "iou", "iof", "distance") for pair in ((a, b), hostile)],
        *[(verb, [points, a]) for verb in ("distance", "signed_distance", "depth")],
    ]:
        layouts = [_columns.Rows("Vec2", 60) if x is points else of(x) for x in own]
        operation = _columns.Operation(verb, layouts)
        xs = [x if x is points else np.array(x.vertices) for x in own]
        given = [torch.as_tensor(x) for x in operation.choices(xs)]
        sizes = [("float" if x.dtype.is_floating_point else "int", len(x)) for x in given]
        assert sizes == _formulas.sizes(operation)
        found = _formulas.value(_torch_polygons._Space, operation, given, [torch.as_tensor(x) for x in xs])
        np.testing.assert_allclose(found, operation.value(xs), rtol=1e-9, atol=1e-12, err_msg=verb)


def test_a_hessian_is_that_of_the_shoelace():
    x = tensor([(0.0, 0.0), (3.0, 0.0), (1.0, 2.0)])
    of = lambda x: geograd.torch.area(Polygons(x, ([0, 3],))).sum()
    plain = lambda x: (x[:, 0] * x.roll(-1, 0)[:, 1] - x[:, 1] * x.roll(-1, 0)[:, 0]).sum() / 2
    expected = torch.autograd.functional.hessian(plain, x)
    assert torch.allclose(torch.autograd.functional.hessian(of, x), expected) and expected.abs().sum() > 0


def test_what_has_no_second_derivatives_says_so():
    a, b = columns()
    (first,) = torch.autograd.grad(geograd.torch.union(a, b).vertices.sum(), a.vertices, create_graph=True)
    with pytest.raises(TypeError, match="boolean operation of polygons have no second"):
        first.sum().backward()
    rings = Rings.of([SQUARE], requires_grad=True)
    (first,) = torch.autograd.grad(geograd.torch.second_moments(rings).sum(), rings.vertices, create_graph=True)
    with pytest.raises(TypeError, match="geograd.second_moments of Rings has no second derivatives"):
        first.sum().backward()


@pytest.mark.slow
def test_third_derivatives_are_those_of_differences():
    a, b = columns()

    def second(x):
        (first,) = torch.autograd.grad(geograd.torch.iou(Polygons(x, a.column), b).sum(), x, create_graph=True)
        return torch.autograd.grad((first**2).sum(), x, create_graph=True)

    assert torch.autograd.gradcheck(second, a.vertices)


# Paths


def test_verbs_of_rings():
    rings = Rings.of([SQUARE, KITE[::-1]], requires_grad=True)
    for verb in ("area", "signed_area", "perimeter", "centroid"):
        twice(lambda x: getattr(geograd.torch, verb)(Rings(x, rings.offsets)), rings.vertices)
    moments = geograd.torch.second_moments
    assert torch.autograd.gradcheck(lambda x: moments(Rings(x, rings.offsets)), rings.vertices)
    winding = geograd.torch.winding
    assert torch.autograd.gradcheck(lambda p, x: winding(p, Rings(x, rings.offsets)), (tensor(POINTS), rings.vertices))
    found = geograd.torch.signed_area(rings)
    assert np.array_equal(found.detach(), geograd.signed_area(rings.column)) and found[1] < 0 < found[0]


def test_verbs_of_polylines_and_clouds():
    lines = Polylines.of([SQUARE, KITE[:2]], requires_grad=True)
    twice(lambda x: geograd.torch.length(Polylines(x, lines.column)), lines.vertices)
    twice(lambda p, x: geograd.torch.distance(p, Polylines(x, lines.column)), tensor(POINTS), lines.vertices)
    spots = np.random.default_rng(1).normal(size=(7, 3))
    space = Polylines(tensor(spots), [0, 3, 7])
    twice(lambda x: geograd.torch.length(Polylines(x, [0, 3, 7])), space.vertices)
    points = tensor(np.ones((2, 3)) * 2)
    of = lambda p, x: geograd.torch.distance(p, Polylines(x, [0, 3, 7]))
    assert torch.autograd.gradcheck(of, (points, space.vertices))
    (first,) = torch.autograd.grad(of(points, space.vertices).sum(), points, create_graph=True)
    with pytest.raises(TypeError, match="has no second derivatives"):
        first.sum().backward()
    for verb, size in (("centroid", 3), ("second_moments", 6)):
        f = lambda x: getattr(geograd.torch, verb)(geograd.torch.Clouds(x, [0, 3, 7]))
        assert f(space.vertices).shape == (2, size) and torch.autograd.gradcheck(f, space.vertices)


def test_one_stands_for_all_and_formats_stay():
    rings = Rings.of([SQUARE], torch.float32, True)
    points = torch.tensor(POINTS, requires_grad=True)
    found = geograd.torch.distance(points, rings)
    assert found.dtype == torch.float32 and found.shape == (2,)
    found.sum().backward()
    assert points.grad.shape == (2, 2) and rings.vertices.grad.shape == (4, 2)
    # A column of arrays, and one point of no axis in front.
    point = tensor(POINTS[1])
    both = geograd.torch.distance(point, geograd.Rings.of([SQUARE, KITE]))
    both.sum().backward()
    assert both.shape == (2,) and point.grad.shape == (2,)
    inside = geograd.torch.contains(rings, points)
    assert inside.dtype == torch.bool and inside.tolist() == [True, False]
    assert inside.tolist() == geograd.contains(rings.column, np.array(POINTS)).tolist()
    assert "torch.Rings 1" in repr(rings) and len(rings) == 1 and type(rings.detach()) is geograd.Rings


def test_refusals():
    a, b = columns()
    rings = Rings.of([SQUARE, KITE])
    with pytest.raises(TypeError, match="geograd.iou takes no paths; they have area"):
        geograd.torch.iou(rings, rings)
    with pytest.raises(TypeError, match="takes 2 arguments, not 1"):
        geograd.torch.distance(rings)
    with pytest.raises(TypeError, match="rows of 5 numbers are no points"):
        geograd.torch.distance(a, torch.zeros(2, 5))
    with pytest.raises(TypeError, match="kind= names the shape"):
        geograd.torch.distance(a, torch.zeros(2, 5), kind="Line2")
    with pytest.raises(ValueError, match="columns have 2 and 3 rows"):
        geograd.torch.distance(torch.zeros(3, 2), rings)
    with pytest.raises(TypeError, match="beside it, not list"):
        geograd.torch.distance([0.0, 0.0], rings)
    with pytest.raises(ValueError, match="none is less"):
        geograd.torch.area(Rings(torch.zeros(4, 2), [0, 3, 2, 4]))
    with pytest.raises(TypeError, match="bfloat16"):
        Rings(torch.zeros(4, 2, dtype=torch.bfloat16), [0, 4])


@pytest.mark.slow
def test_all_pairs_of_columns():
    dice = np.random.default_rng(9)
    a, b = (own.detach() for own in columns())
    x, y = (Polygons.of(own, requires_grad=True) for own in (a, b))
    matrix, weights = geograd.torch.iou.all_pairs(x, y), tensor(dice.normal(size=(len(a), len(b))))
    assert np.array_equal(matrix.detach(), geograd.iou.all_pairs(a, b)) and matrix.any()
    (matrix * weights).sum().backward()
    expected = sum(geograd.iou.vjp(a, b[j], weights[:, j].numpy(force=True))[0] for j in range(len(b)))
    np.testing.assert_allclose(x.vertices.grad, expected, atol=1e-14)
    again = lambda p, q: geograd.torch.iou.all_pairs(Polygons(p, a), Polygons(q, b))
    leaves = [own.vertices.detach().clone().requires_grad_() for own in (x, y)]
    assert torch.autograd.gradcheck(again, leaves) and torch.autograd.gradgradcheck(again, leaves)
    rings = geograd.Rings.of([dice.normal(size=(6, 2)) for _ in range(3)])
    lines = geograd.Polylines(rings.vertices, rings.offsets)
    points = torch.tensor(dice.normal(size=(5, 2)), requires_grad=True)
    for verb, cls, own in (("signed_distance", Rings, rings), ("distance", Polylines, lines)):
        call = lambda p, v: getattr(geograd.torch, verb).all_pairs(p, cls(v, own))
        given = points, torch.tensor(own.vertices, requires_grad=True)
        expected = [[getattr(geograd, verb)(geograd.Vec2(p), own[j : j + 1])[0] for j in range(3)] for p in points.detach().numpy()]
        np.testing.assert_allclose(call(*given).detach(), expected)
        assert torch.autograd.gradcheck(call, given) and torch.autograd.gradgradcheck(call, given)
