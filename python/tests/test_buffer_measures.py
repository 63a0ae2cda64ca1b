"""Areas and perimeters of offsets with exact arcs, Minkowski sums: against shapely, closed forms and differences."""

import pickle

import numpy as np
import pytest

import geograd

FRAME = [[(0, 0), (6, 0), (6, 5), (3, 4), (0, 6)], [(2, 2), (2, 3), (4, 3)]]
HOOK = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (1.0, 1.0)]
SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]
BOTH = [geograd.buffer_area, geograd.buffer_perimeter]


def test_measures_are_the_limit_of_shapely():
    shapely = pytest.importorskip("shapely")
    column, distances = geograd.Polygons.of([FRAME, FRAME, FRAME, FRAME]), [0.3, 1.1, -0.3, -4.0]
    line, around = geograd.Polylines.of([HOOK, HOOK]), [0.2, 0.7]
    for own, d, shape in ((column, distances, shapely.Polygon(FRAME[0], FRAME[1:])), (line, around, shapely.LineString(HOOK))):
        truth = [shape.buffer(x, quad_segs=2000) for x in d]
        assert geograd.buffer_area.is_exact(own, d).all()
        np.testing.assert_allclose(geograd.buffer_area(own, d), [x.area for x in truth], rtol=2e-7)
        np.testing.assert_allclose(geograd.buffer_perimeter(own, d), [x.length for x in truth], rtol=2e-7)


def test_closed_forms_and_formats():
    squares = geograd.Polygons.of([SQUARE, SQUARE])
    d = np.array([1.0, -0.5])
    np.testing.assert_allclose(geograd.buffer_area(squares, d), [32 + np.pi, 9], rtol=1e-14)
    np.testing.assert_allclose(geograd.buffer_perimeter(squares, d), [16 + 2 * np.pi, 12], rtol=1e-14)
    single = geograd.Polygons(np.array(squares.vertices, np.float32), squares.offsets)
    area = geograd.buffer_area(single, 1.0)
    assert area.dtype == np.float32 and abs(area[0] - 32 - np.pi) < 1e-5
    assert pickle.loads(pickle.dumps(geograd.buffer_area)) is geograd.buffer_area
    assert geograd.buffer_area(geograd.Polygons.of([]), 1.0).shape == (0,)


def test_a_path_that_lies_along_itself_says_so():
    folded = geograd.Polylines.of([HOOK, [(0, 0), (4, 0), (2, 0), (2, 3)]])
    assert geograd.buffer_perimeter.is_exact(folded, 0.5).tolist() == [True, False]
    np.testing.assert_allclose(geograd.buffer_area(folded, 0.5)[1], 6.5 + 0.375 * np.pi, rtol=1e-5)


@pytest.mark.parametrize("measure", BOTH)
@pytest.mark.parametrize("of", [geograd.Polygons.of([FRAME, FRAME]), geograd.Polylines.of([HOOK, HOOK])])
def test_derivatives_are_differences(measure, of):
    vertices, distance = np.array(of.vertices), np.array([0.2, 0.3])

    def value(vertices, distance):
        return measure(type(of)(vertices, of.offsets), distance) @ [1.0, 2.0]

    values, (by_vertices, by_distance) = measure.value_grad(of, distance)
    np.testing.assert_array_equal(values, measure(of, distance))
    pulled, pulled_distance = measure.vjp(of, distance, [1.0, 2.0])
    half = len(vertices) // 2
    np.testing.assert_allclose(pulled[:half], by_vertices[:half], atol=1e-14)
    np.testing.assert_allclose(pulled[half:], 2 * by_vertices[half:], atol=1e-14)
    np.testing.assert_allclose(pulled_distance, by_distance * [1, 2], atol=1e-14)
    if measure is geograd.buffer_area:
        np.testing.assert_allclose(by_distance, geograd.buffer_perimeter(of, distance), rtol=1e-13)
    step = 1e-6
    for k in range(vertices.size):
        moved = np.zeros(vertices.size)
        moved[k] = step
        moved = moved.reshape(vertices.shape)
        slope = (value(vertices + moved, distance) - value(vertices - moved, distance)) / (2 * step)
        assert abs(slope - pulled.ravel()[k]) < 1e-7
    # One distance for all has the sum.
    together = measure.vjp(of, 0.25, 1.0)[1]
    np.testing.assert_allclose(together, measure.vjp(of, [0.25, 0.25], 1.0)[1].sum(), rtol=1e-14)


def test_tensors_have_derivatives():
    torch = pytest.importorskip("torch")
    import geograd.torch

    column = geograd.torch.Polygons.of([FRAME, FRAME], requires_grad=True)
    distance = torch.tensor([0.25, -0.1], dtype=torch.float64, requires_grad=True)
    geograd.torch.buffer_area(column, distance).sum().backward()
    np.testing.assert_allclose(distance.grad.numpy(), geograd.buffer_perimeter(column.column, [0.25, -0.1]), rtol=1e-13)
    by_vertices = geograd.buffer_area.vjp(column.column, [0.25, -0.1], 1.0)[0]
    np.testing.assert_array_equal(column.vertices.grad.numpy(), by_vertices)


@pytest.mark.parametrize("name", ["buffer_area", "buffer_perimeter"])
def test_tensors_have_second_derivatives(name):
    torch = pytest.importorskip("torch")
    import geograd.torch

    measure = getattr(geograd.torch, name)
    for cls, rows, d in ((geograd.torch.Polygons, [FRAME], 0.25), (geograd.torch.Polylines, [HOOK, HOOK[::-1]], 0.3)):
        column = cls.of(rows)
        distance = torch.full((len(rows),), d, dtype=torch.float64, requires_grad=True)
        vertices = column.vertices.clone().requires_grad_()

        def value(vertices, distance):
            return measure(cls(vertices, column.column), distance)

        assert torch.autograd.gradcheck(value, (vertices, distance), atol=1e-6)
        assert torch.autograd.gradgradcheck(value, (vertices, distance), atol=1e-5)


def test_errors_name_what_is_wrong():
    square = geograd.Polygons.of([SQUARE])
    with pytest.raises(ValueError, match="distance"):
        geograd.buffer_area(square, [1.0, 2.0])
    with pytest.raises(ValueError, match="distance"):
        geograd.buffer_area(square, np.nan)
    with pytest.raises(ValueError, match="fill"):
        geograd.buffer_area(square, 1.0, fill="odd")
    with pytest.raises(TypeError, match="column"):
        geograd.buffer_area(geograd.Rings.of([SQUARE]), 1.0)


def test_minkowski_sums_and_no_fit_polygons():
    shapely = pytest.importorskip("shapely")
    frame = geograd.Polygons.of([[SQUARE, [(1, 1), (3, 1), (3, 3), (1, 3)]]])
    tip = geograd.Polygons.of([[(0, 0), (1, 0), (0.5, 1.5)]])
    for valid in (False, True):
        made = geograd.minkowski_sum(frame, tip, valid=valid)
        # The hole narrows by the width and the height of the tip, and keeps its slanted sides apart.
        outer = shapely.union_all([shapely.MultiPoint([(x + u, y + v) for x in (0, 4) for y in (0, 4) for u, v in ((0, 0), (1, 0), (0.5, 1.5))]).convex_hull])
        hole = shapely.Polygon([(1, 1), (3, 1), (3, 3), (1, 3)])
        for u, v in ((0, 0), (1, 0), (0.5, 1.5)):
            hole = hole.intersection(shapely.Polygon([(1 + u, 1 + v), (3 + u, 1 + v), (3 + u, 3 + v), (1 + u, 3 + v)]))
        np.testing.assert_allclose(geograd.area(made), outer.area - hole.area, rtol=1e-13)
    moves = geograd.no_fit_polygon(tip, tip)
    np.testing.assert_allclose(geograd.area(moves), 6 * 0.75, rtol=1e-14)
    upstream = geograd.area.vjp(moves, 1.0)
    by_a, by_b = geograd.no_fit_polygon.vjp(tip, tip, upstream)
    np.testing.assert_allclose(by_a.sum(0), 0, atol=1e-14)
    vertices, step = np.array(tip.vertices), 1e-6
    for k in range(6):
        sides = []
        for sign in (1, -1):
            moved = vertices.ravel().copy()
            moved[k] += sign * step
            other = geograd.Polygons(moved.reshape(-1, 2), tip.offsets)
            sides.append(geograd.area(geograd.no_fit_polygon(tip, other))[0])
        assert abs((sides[0] - sides[1]) / (2 * step) - by_b.ravel()[k]) < 1e-7


def test_borders_of_lines_and_arcs_have_the_measures():
    ring = np.array([[0, 0], [9, 1], [8, 6], [5, 2.5], [1, 7]], float)
    hole = np.array([[3, 1.5], [3.2, 2.5], [4, 1.6]])
    shapes = geograd.Polygons.of([ring, ring[::-1], [ring, hole], ring])
    d = np.array([0.75, 0.75, 0.05, -5.0])
    borders = geograd.buffer.curves(shapes, d)
    assert borders[3] is None
    areas, lengths = geograd.buffer_area(shapes, d), geograd.buffer_perimeter(shapes, d)
    np.testing.assert_allclose([own.area for own in borders[:3]], areas[:3], rtol=1e-13)
    np.testing.assert_allclose([own.length for own in borders[:3]], lengths[:3], rtol=1e-13)
    assert borders[2].steps.count("M") == 2 and "A" in borders[2].steps
    path = geograd.Polylines([[0, 0], [4, 0], [4, 3]], [0, 3])
    [border] = geograd.buffer.curves(path, 0.5)
    np.testing.assert_allclose(border.area, geograd.buffer_area(path, 0.5)[0], rtol=1e-13)
    assert geograd.buffer.curves(geograd.Polygons.of([]), 1.0) == []
    with pytest.raises(ValueError, match="distance"):
        geograd.buffer.curves(shapes, [1.0, 2.0])
