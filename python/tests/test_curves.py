"""Paths of curves and triangulations: values beside shapely's and scipy's, derivatives beside differences."""

import pickle

import numpy as np
import pytest

import geograd

DROP = ("MCQALZ", [0, 0, 1, 3, 4, -2, 5, 1, 6, 3, 4, 4, 2, 5, -0.4, 0, 3])


def moved(path, place, by):
    numbers = path.numbers
    numbers[place] += by
    return geograd.CurvePath(path.steps, numbers)


def slopes(of, path, step=1e-6):
    return [(of(moved(path, k, step)) - of(moved(path, k, -step))) / (2 * step) for k in range(len(path.numbers))]


def test_measures_are_those_of_fine_chords():
    shapely = pytest.importorskip("shapely")
    path = geograd.CurvePath(*DROP)
    fine = shapely.Polygon(path.flatten(1e-8)[0])
    np.testing.assert_allclose(path.area, np.sign(path.area) * fine.area, rtol=1e-6)
    np.testing.assert_allclose(path.length, fine.length, rtol=1e-6)
    np.testing.assert_allclose(path.bounds, fine.bounds, atol=1e-7)
    points = np.random.default_rng(0).uniform(-2, 8, (300, 2))
    far = shapely.distance(shapely.points(points), fine.exterior)
    np.testing.assert_allclose(path.distance(points), far, atol=1e-7)
    np.testing.assert_array_equal(path.contains(points), shapely.contains_xy(fine, *points.T))
    on = path.closest(points)
    np.testing.assert_allclose(np.linalg.norm(on - points, axis=1), path.distance(points), rtol=1e-13)
    back = path.reversed()
    np.testing.assert_allclose([back.area, back.length], [-path.area, path.length], rtol=1e-13)
    np.testing.assert_array_equal(back.winding_number(points), -path.winding_number(points))


def test_gradients_are_those_of_differences():
    path = geograd.CurvePath(*DROP)
    for grad, of in ((path.length_grad, lambda own: own.length), (path.area_grad, lambda own: own.area)):
        value, by = grad()
        assert value == of(path)
        np.testing.assert_allclose(by, slopes(of, path), rtol=1e-6, atol=1e-8)
    bars = np.random.default_rng(5).normal(size=5)
    lengths, by = path.lengths_vjp(bars)
    np.testing.assert_array_equal(lengths, path.lengths)
    np.testing.assert_allclose(lengths.sum(), path.length, rtol=1e-15)
    np.testing.assert_allclose(by, slopes(lambda own: own.lengths @ bars, path), rtol=1e-6, atol=1e-8)
    points, upstream = np.random.default_rng(1).uniform(-2, 8, (20, 2)), np.random.default_rng(2).normal(size=20)
    by, by_points = path.distance_vjp(points, upstream)
    np.testing.assert_allclose(by, slopes(lambda own: own.distance(points) @ upstream, path), rtol=1e-5, atol=1e-7)
    ways = (points - path.closest(points)) / path.distance(points)[:, None]
    np.testing.assert_allclose(by_points, ways * upstream[:, None], rtol=1e-12)


def test_lengths_of_many_curves_are_those_of_each():
    draw = np.random.default_rng(6)
    each = draw.uniform(-1, 1, (50, 8))
    path = geograd.CurvePath("MC" * 50, each.ravel())
    alone = [geograd.CurvePath("MC", own).length_grad() for own in each]
    lengths, by = path.lengths_vjp(np.ones(50))
    np.testing.assert_array_equal(lengths, [length for length, _ in alone])
    np.testing.assert_array_equal(by.reshape(50, 8), [by for _, by in alone])
    with pytest.raises(ValueError, match="upstream: 3 numbers where there are 50 pieces"):
        path.lengths_vjp(np.ones(3))
    assert geograd.CurvePath("M", [0, 0]).lengths.shape == (0,)


def test_paths_of_svg_are_read():
    path = geograd.CurvePath.of_svg("M1,0 h2 v2 l-1 1 Q 0 3 .5 2 t-.5-1 C0 .5 0.5 0 .75 0 s.1 0 .25 0z m5 5 1 0 a1 1 0 0 1-1-1.e0a1 1 0 011-1Z")
    assert path.steps == "MLLLQQCCZMLAAZ"
    expected = [1, 0, 3, 0, 3, 2, 2, 3, 0, 3, 0.5, 2, 1, 1, 0, 1, 0, 0.5, 0.5, 0, 0.75, 0, 1, 0, 0.85, 0, 1, 0]
    np.testing.assert_allclose(path.numbers[:28], expected, atol=1e-15)
    quarter = np.tan(np.pi / 8)
    np.testing.assert_allclose(path.numbers[28:], [6, 5, 7, 5, 6, 4, quarter, 7, 3, quarter])
    half = geograd.CurvePath.of_svg("M0 0A5 5 0 1 1 6 0")
    np.testing.assert_allclose(half.numbers[-1], 3)
    for text in ("M0", "M0 0 X", "L", "M0 0 L a 1"):
        with pytest.raises(ValueError, match="path|elements"):
            geograd.CurvePath.of_svg(text)


@pytest.mark.parametrize("flags", ["0 0", "0 1", "1 0", "1 1"])
@pytest.mark.parametrize("tolerance", [None, 1e-2, 1e-9])
def test_arcs_of_ellipses_are_within_a_tolerance(flags, tolerance):
    # Both points are on the ellipse of half axes 3 and 1 about (2, 1), turned by 30 degrees, at 20 and 130 degrees of it.
    turn = np.deg2rad(30)
    axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]) * [[3], [1]]
    at = lambda angles: np.array([2, 1]) + np.stack([np.cos(angles), np.sin(angles)], -1) @ axes
    start, to = at(np.deg2rad([20, 130]))
    path = geograd.CurvePath.of_svg("M{:.17g} {:.17g}A3 1 30 {} {:.17g} {:.17g}".format(*start, flags, *to), tolerance=tolerance)
    np.testing.assert_array_equal(path.numbers[-2:], to)
    # The ellipse about the given centre, or the one about its mirror image in the middle of both points.
    is_large, is_positive = flags.split()
    own = (is_large == "1") != (is_positive == "1")
    angles = np.linspace(20, 130, 500) if is_large == "0" else np.linspace(130, 380, 500)
    points = at(np.deg2rad(angles))
    points = points if own else start + to - points
    allowed = 3e-6 if tolerance is None else tolerance
    assert path.distance(points).max() < allowed
    # The area between the arc and its chord: sectors of an ellipse have those of its angle.
    area = geograd.CurvePath(path.steps + "Z", path.numbers).area
    sector = np.deg2rad(250 if is_large == "1" else 110)
    np.testing.assert_allclose(area, (1.5 if is_positive == "1" else -1.5) * (sector - np.sin(sector)), atol=20 * allowed)


def test_short_ellipses_reach_and_flat_ones_are_lines():
    # Radii that do not reach are scaled: half an ellipse of half axes 10 and 5.
    path = geograd.CurvePath.of_svg("M0 0 A 2 1 0 0 1 20 0 Z")
    np.testing.assert_allclose(path.area, np.pi * 25, rtol=1e-5)
    assert geograd.CurvePath.of_svg("M0 0 A 0 1 0 0 1 20 0 Z").steps == "MLZ"
    assert geograd.CurvePath.of_svg("M3 0 A 2 1 0 0 1 3 0 Z").steps == "MLZ"


def test_wrong_paths_are_refused():
    for steps, numbers, match in (
        ("MX", [0, 0], "MLQCAZ"),
        ("ML", [0, 0, 1], "too few"),
        ("M", [0, 0, 1], "more"),
        ("L", [0, 0], "begin a contour"),
        ("ML", [0, 0, 1, np.nan], "finite"),
        ("M", [[0, 0]], "one axis"),
    ):
        with pytest.raises(ValueError, match=match):
            geograd.CurvePath(steps, numbers)
    path = geograd.CurvePath("M", [1, 2])
    assert np.isnan(path.distance([(0, 0)])).all() and path.length == 0
    with pytest.raises(ValueError, match="no pieces"):
        path.closest([(0, 0)])
    with pytest.raises(ValueError, match="tolerance"):
        geograd.CurvePath(*DROP).flatten(0)
    with pytest.raises(ValueError, match="points"):
        path.distance([1, 2])
    again = pickle.loads(pickle.dumps(geograd.CurvePath(*DROP)))
    np.testing.assert_array_equal(again.numbers, DROP[1])


def test_triangulations_are_those_of_scipy():
    spatial = pytest.importorskip("scipy.spatial")
    points = np.random.default_rng(3).uniform(size=(500, 2))
    mesh, other = geograd.Delaunay(points), spatial.Delaunay(points)
    assert {frozenset(own) for own in mesh.triangles.tolist()} == {frozenset(own) for own in other.simplices.tolist()}
    np.testing.assert_array_equal(np.sort(mesh.hull), np.sort(spatial.ConvexHull(points).vertices))
    for k, (corners, beside) in enumerate(zip(mesh.triangles, mesh.neighbours)):
        for corner, neighbour in zip(corners, beside):
            if neighbour >= 0:
                assert k in mesh.neighbours[neighbour] and corner not in mesh.triangles[neighbour]
    assert len(points) - len(mesh.edges) + len(mesh) == 1
    centers, radii = mesh.circles
    gaps = np.linalg.norm(points[mesh.triangles] - centers[:, None], axis=-1)
    np.testing.assert_allclose(gaps, np.tile(radii[:, None], 3), rtol=1e-9)


def test_areas_of_triangles_have_derivatives():
    points = np.random.default_rng(4).uniform(size=(30, 2))
    mesh = geograd.Delaunay(points)
    upstream = np.random.default_rng(5).normal(size=len(mesh))
    by = mesh.areas_vjp(upstream)

    def total(points):
        a, b, c = np.moveaxis(points[mesh.triangles], 1, 0)
        u, v = b - a, c - a
        return 0.5 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) @ upstream

    for place in np.ndindex(5, 2):
        step = np.zeros_like(points)
        step[place] = 1e-6
        np.testing.assert_allclose(by[place], (total(points + step) - total(points - step)) / 2e-6, rtol=1e-6, atol=1e-9)


def test_hard_points_have_a_triangulation():
    grid = np.stack(np.meshgrid(np.arange(20), np.arange(15)), -1).reshape(-1, 2).astype(float)
    mesh = geograd.Delaunay(np.concatenate([grid, grid]))
    assert len(mesh) == 2 * 19 * 14 and mesh.areas.sum() == 19 * 14 and len(mesh.hull) == 2 * (19 + 14)
    np.testing.assert_array_equal(mesh.firsts, np.tile(np.arange(300), 2))
    line = geograd.Delaunay([(0, 0), (2, 2), (1, 1)])
    assert len(line) == 0 and line.hull.tolist() == [0, 2, 1] and line.edges.tolist() == [[0, 2], [1, 2]]
    assert len(geograd.Delaunay(np.zeros((0, 2)))) == 0
    with pytest.raises(ValueError, match="item 1"):
        geograd.Delaunay([(0, 0), (np.inf, 0)])


def test_places_are_located_as_by_scipy():
    spatial = pytest.importorskip("scipy.spatial")
    draw = np.random.default_rng(11)
    points, places = draw.uniform(0, 1, (500, 2)), draw.uniform(-0.1, 1.1, (2000, 2))
    mesh, theirs = geograd.Delaunay(points), spatial.Delaunay(points)
    found, known = mesh.locate(places), theirs.find_simplex(places)
    np.testing.assert_array_equal(found == -1, known == -1)
    is_inside = found >= 0
    own = np.sort(mesh.triangles[found[is_inside]], axis=1)
    np.testing.assert_array_equal(own, np.sort(theirs.simplices[known[is_inside]], axis=1))
    assert mesh.locate(np.zeros((0, 2))).shape == (0,)
    with pytest.raises(ValueError, match="places"):
        mesh.locate([1.0, 2.0])


def test_weights_interpolate_as_scipy_does():
    interpolate = pytest.importorskip("scipy.interpolate")
    draw = np.random.default_rng(12)
    points, places, heights = draw.uniform(0, 1, (300, 2)), draw.uniform(-0.1, 1.1, (1000, 2)), draw.normal(size=300)
    mesh = geograd.Delaunay(points)
    triangles, weights = mesh.barycentric(places)
    np.testing.assert_array_equal(triangles, mesh.locate(places))
    is_inside = triangles >= 0
    assert (weights[~is_inside] == 0).all() and 500 < is_inside.sum() < 1000
    np.testing.assert_allclose(weights[is_inside].sum(1), 1, rtol=1e-15)
    found = (heights[mesh.triangles[triangles]] * weights).sum(1)
    expected = interpolate.LinearNDInterpolator(points, heights)(places)
    np.testing.assert_allclose(found[is_inside], expected[is_inside], rtol=1e-9, atol=1e-9)


def test_weights_have_derivatives():
    draw = np.random.default_rng(13)
    points, places, heights = draw.uniform(0, 1, (40, 2)), draw.uniform(0.2, 0.8, (60, 2)), draw.normal(size=40)
    mesh = geograd.Delaunay(points)
    triangles, weights = mesh.barycentric(places)
    corners = mesh.triangles[triangles]
    by_points, by_places = mesh.barycentric_vjp(places, np.where(triangles[:, None] >= 0, heights[corners], 0))

    def heights_at(points, places):
        a, b, c = np.moveaxis(points[corners], 1, 0)
        basis = np.stack([b - a, c - a], -1)
        shares = np.linalg.solve(basis, (places - a)[..., None])[..., 0]
        rise = np.stack([heights[corners[:, 1]] - heights[corners[:, 0]], heights[corners[:, 2]] - heights[corners[:, 0]]], -1)
        return (heights[corners[:, 0]] + (shares * rise).sum(1))[triangles >= 0].sum()

    for place in np.ndindex(5, 2):
        step = np.zeros_like(points)
        step[place] = 1e-6
        slope = (heights_at(points + step, places) - heights_at(points - step, places)) / 2e-6
        np.testing.assert_allclose(by_points[place], slope, rtol=1e-5, atol=1e-6)
        step = np.zeros_like(places)
        step[place] = 1e-6
        slope = (heights_at(points, places + step) - heights_at(points, places - step)) / 2e-6
        np.testing.assert_allclose(by_places[place], slope, rtol=1e-5, atol=1e-6)
    with pytest.raises(ValueError, match="weights_bar"):
        mesh.barycentric_vjp(places, np.zeros(60))
