"""Geometries of shapely and GeoPandas as shapes and paths, and back."""

import doctest
import math

import numpy as np
import pytest

import geograd

reason = "shapely is not installed: geograd.shapely is not tested"
shapely = pytest.importorskip("shapely", reason=reason)
if not hasattr(shapely, "to_ragged_array"):
    pytest.skip("shapely is older than 2: geograd.shapely is not tested", allow_module_level=True)

import geograd.shapely as ours


def rectangles(count, seed):
    draw = np.random.default_rng(seed)
    return np.c_[draw.uniform(-50, 50, (count, 2)), draw.uniform(1, 9, (count, 2)), draw.uniform(-3, 3, count)]


HOLED = shapely.Polygon([(0, 0), (0, 9), (9, 9), (9, 0)], [[(1, 1), (3, 1), (3, 3)], [(5, 5), (5, 7), (7, 7)]])
PLAIN = shapely.Polygon([(0, 0), (4, 0), (4, 2)])
SECOND = shapely.Polygon([(5, 0), (5, 8), (9, 8)], [[(6, 6), (7, 7), (6, 7)]])
PARTS = shapely.MultiPolygon([shapely.box(0, 0, 1, 1), SECOND])


def test_the_example_of_the_module():
    found = doctest.testmod(ours)
    assert found.failed == 0 and found.attempted > 6


def test_rectangles_there_and_back():
    start = rectangles(50, 1)
    polygons = ours.geometries(geograd.Obb2(start))
    assert polygons.shape == (50,) and np.allclose(shapely.area(polygons), start[:, 2] * start[:, 3])
    for given in (polygons, list(polygons), tuple(polygons)):
        found = ours.boxes(given)
        assert type(found) is geograd.Obb2 and geograd.iou(found, geograd.Obb2(start)).min() > 1 - 1e-12
    np.testing.assert_allclose(ours.boxes(polygons).array[:, :4], start[:, :4], atol=1e-12)
    # The other sense and another first corner are the same rectangle.
    corners = shapely.get_coordinates(polygons).reshape(50, 5, 2)[:, :4]
    turned = [shapely.Polygon(np.roll(own, k, 0)[:: 1 - 2 * (k % 2)]) for k, own in enumerate(corners)]
    assert geograd.iou(ours.boxes(turned), geograd.Obb2(start)).min() > 1 - 1e-12
    one = ours.boxes(polygons[3])
    assert len(one) == 1 and np.allclose(one.array[0], ours.boxes(polygons).array[3])
    assert ours.geometries(geograd.Obb2(start[0])).shape == ()
    assert ours.geometries(geograd.Obb2(start.reshape(5, 10, 5))).shape == (5, 10)


def test_rectangles_are_told_from_other_polygons():
    with pytest.raises(ValueError, match="geometry 1 has 3 corners, not 4; minimum_boxes"):
        ours.boxes([shapely.box(0, 0, 1, 1), PLAIN])
    skew = shapely.Polygon([(0, 0), (4, 0), (5, 2), (1, 2)])
    kite = shapely.Polygon([(0, 0), (4, 0), (4.5, 2), (0, 2)])
    trapezoid = shapely.Polygon([(0, 0), (4, 0), (3, 2), (1, 2)])
    for bad in (skew, kite, trapezoid):
        with pytest.raises(ValueError, match="geometry 0 is no rectangle: it differs by"):
            ours.boxes([bad])
    assert len(ours.boxes([kite], tolerance=0.2)) == 1
    nearly = shapely.Polygon([(0, 0), (4, 1e-7), (4, 2), (0, 2)])
    np.testing.assert_allclose(ours.boxes([nearly]).array, [[2, 1, 4, 2, 0]], atol=1e-6)


def test_smallest_rectangles():
    start = rectangles(40, 2)
    found = ours.minimum_boxes(ours.geometries(geograd.Obb2(start)))
    assert geograd.iou(found, geograd.Obb2(start)).min() > 1 - 1e-9
    assert (found.width >= found.height).all()
    assert found.heading.min() >= -math.pi / 2 and found.heading.max() < math.pi / 2
    clouds = [shapely.MultiPoint(np.random.default_rng(k).normal(0, 3, (12, 2))) for k in range(20)]
    around = ours.geometries(ours.minimum_boxes(clouds))
    np.testing.assert_allclose(shapely.area(around), shapely.area(shapely.minimum_rotated_rectangle(clouds)), rtol=1e-9)
    assert shapely.covers(shapely.buffer(around, 1e-9), clouds).all()
    flat = ours.minimum_boxes([shapely.Point(1, 2), shapely.LineString([(0, 0), (3, 3)]), HOLED]).array
    np.testing.assert_allclose(flat[0], [1, 2, 0, 0, 0], atol=1e-12)
    np.testing.assert_allclose(flat[1], [1.5, 1.5, math.hypot(3, 3), 0, math.pi / 4], atol=1e-12)
    assert np.allclose(flat[2, 2:4], 9)


def test_points_segments_and_upright_boxes():
    draw = np.random.default_rng(3)
    for kind, of, into, width in (
        (geograd.Vec2, shapely.points, ours.points, 2), (geograd.Vec3, shapely.points, ours.points, 3),
        (geograd.Segment2, shapely.linestrings, ours.segments, 4),
        (geograd.Segment3, shapely.linestrings, ours.segments, 6),
    ):
        numbers = draw.normal(0, 5, (30, width))
        found = into(of(numbers.reshape(30, -1, width // 2) if width > 3 else numbers))
        assert type(found) is kind and np.array_equal(found.array, numbers)
        assert np.array_equal(into(ours.geometries(found)).array, numbers)
    bounds = ours.upright_boxes([PLAIN, HOLED, shapely.Point(3, 4), shapely.LineString([(1, 2), (0, 5)])])
    assert type(bounds) is geograd.Aabb2
    assert bounds.array.tolist() == [[0, 0, 4, 2], [0, 0, 9, 9], [3, 4, 3, 4], [0, 2, 1, 5]]
    assert np.array_equal(shapely.bounds(ours.geometries(bounds)), bounds.array)
    with pytest.raises(ValueError, match="geometry 1 has 3 points: lines of two points are needed"):
        ours.segments([shapely.LineString([(0, 0), (1, 1)]), shapely.LineString([(0, 0), (1, 1), (2, 0)])])


def test_rings():
    given = [PLAIN, shapely.LinearRing([(0, 0), (0, 3), (3, 3)]), shapely.MultiPolygon([shapely.box(2, 2, 5, 6)])]
    found = ours.rings(given)
    assert type(found) is geograd.Rings and found.offsets.tolist() == [0, 3, 6, 10]
    assert abs(geograd.signed_area(found)).tolist() == [4, 4.5, 12]
    back = ours.geometries(found)
    assert shapely.equals(back, [given[0], shapely.Polygon(given[1]), given[2].geoms[0]]).all()
    np.testing.assert_allclose(geograd.perimeter(found), shapely.length(back))
    point = shapely.Point(7.0, -2.0)
    distance = geograd.distance(geograd.Vec2(7.0, -2.0), found)
    np.testing.assert_allclose(distance, shapely.distance(point, shapely.boundary(back)))
    for bad, what in ((HOLED, "holes"), (PARTS, "several parts")):
        with pytest.raises(ValueError, match=f"geometry 1 has {what}: all_rings"):
            ours.rings([PLAIN, bad])


def test_all_rings_have_the_area_and_its_gradient():
    given = [HOLED, PARTS, PLAIN, shapely.orient_polygons(HOLED) if hasattr(shapely, "orient_polygons") else HOLED]
    found, rows = ours.all_rings(given)
    assert rows.tolist() == [0, 0, 0, 1, 1, 1, 2, 3, 3, 3]
    area, grad = geograd.signed_area.value_grad(found)
    np.testing.assert_allclose(np.bincount(rows, area), shapely.area(given))
    assert ((area > 0) == [True, False, False, True, True, False, True, True, False, False]).all()
    # A vertex of an outer ring of the second geometry, moved.
    vertices, step = np.array(found.vertices), 1e-6
    place = int(found.offsets[4])
    for place, axis in ((place, 0), (place, 1), (place + 1, 0), (place + 1, 1)):
        moved = vertices.copy()
        moved[place, axis] += step
        change = geograd.signed_area(geograd.Rings(moved, found.offsets)).sum() - area.sum()
        assert np.asarray(grad)[place, axis] == pytest.approx(change / step, abs=1e-6)
    assert abs(np.asarray(grad)).max(1).min() > 0.1


def test_lengths_of_segments_in_rings():
    draw = np.random.default_rng(3)
    turn = np.arange(15) * 2 * np.pi / 15
    spokes = np.stack([np.cos(turn), np.sin(turn)], -1)
    stars = spokes * draw.uniform(0.4, 1.3, (500, 15, 1))
    segments = draw.uniform(-1.5, 1.5, (500, 4))
    paths = geograd.Rings(stars.reshape(-1, 2), np.arange(501) * 15)
    lines = shapely.linestrings(segments.reshape(-1, 2, 2))
    known = shapely.length(shapely.intersection(lines, shapely.polygons(stars)))
    assert (known > 0).mean() > 0.6
    found, (by_segment, by_vertices) = geograd.length_inside.value_grad(geograd.Segment2(segments), paths)
    np.testing.assert_allclose(found, known, atol=1e-13)
    # All lengths grow with the drawing.
    grown = (by_segment * segments).sum(1) + (by_vertices * paths.vertices).reshape(500, 30).sum(1)
    np.testing.assert_allclose(grown, known, atol=1e-12)


def test_polylines():
    given = [shapely.LineString([(0, 0), (1, 1), (2, 0)]), shapely.LinearRing([(0, 0), (4, 0), (4, 3)])]
    found = ours.polylines(given)
    assert type(found) is geograd.Polylines and found.offsets.tolist() == [0, 3, 7]
    np.testing.assert_allclose(geograd.length(found), shapely.length(given))
    assert shapely.equals(ours.geometries(found), [given[0], shapely.LineString(given[1].coords)]).all()
    space = ours.polylines([shapely.LineString([(0, 0, 0), (1, 2, 2)])])
    assert space.vertices.shape == (2, 3) and geograd.length(space)[0] == 3
    assert shapely.has_z(ours.geometries(space)).all()


def test_other_shapes():
    triangles = np.random.default_rng(1).normal(0, 4, (6, 6))
    made = ours.geometries(geograd.Triangle2(triangles))
    np.testing.assert_allclose(shapely.area(made), geograd.area(geograd.Triangle2(triangles)))
    quads = geograd.corners(geograd.Obb2(rectangles(6, 1)))
    assert shapely.equals(ours.geometries(quads), ours.geometries(geograd.Obb2(rectangles(6, 1)))).all()
    clouds = geograd.Clouds.of([np.eye(3), np.ones((2, 3))])
    assert shapely.get_num_geometries(ours.geometries(clouds)).tolist() == [3, 2]
    with pytest.raises(TypeError, match="Sphere has no geometry"):
        ours.geometries(geograd.Sphere(np.ones((2, 4))))
    with pytest.raises(TypeError, match="not of ndarray"):
        ours.geometries(np.ones((2, 5)))
    with pytest.raises(ValueError, match="ring 1 has 2 vertices"):
        ours.geometries(geograd.Rings.of([np.eye(3)[:, :2], np.eye(2)]))


def test_geopandas():
    geopandas = pytest.importorskip("geopandas", reason="geopandas is not installed: GeoSeries are not tested")
    start = geograd.Obb2(rectangles(9, 4))
    made = ours.series(start, index=range(10, 19), crs=3857)
    assert type(made) is geopandas.GeoSeries and made.index[0] == 10 and made.crs.to_epsg() == 3857
    for given in (made, made.array, made.values, made.to_numpy()):
        np.testing.assert_allclose(ours.boxes(given).array[:, :4], start.array[:, :4], atol=1e-12)
    assert len(ours.rings(made)) == len(ours.minimum_boxes(made)) == len(ours.upright_boxes(made)) == 9
    rows = ours.all_rings(geopandas.GeoSeries([HOLED, PLAIN], index=["a", "b"]))[1]
    assert rows.tolist() == [0, 0, 0, 1]


def test_no_geometries():
    calls = ours.points, ours.segments, ours.boxes, ours.minimum_boxes, ours.upright_boxes, ours.rings, ours.polylines
    for none in ([], np.array([], object)):
        for call in calls:
            made = call(none)
            assert len(made) == 0 and ours.geometries(made).shape == (0,)
        found, rows = ours.all_rings(none)
        assert len(found) == len(rows) == 0


def test_missing_empty_and_other_geometries():
    calls = (
        (ours.points, shapely.Point(1, 1)), (ours.segments, shapely.LineString([(0, 0), (1, 1)])),
        (ours.boxes, shapely.box(0, 0, 1, 1)),
        (ours.rings, PLAIN), (ours.all_rings, HOLED), (ours.polylines, shapely.LineString([(0, 0), (1, 1)])),
        (ours.minimum_boxes, PLAIN), (ours.upright_boxes, PLAIN),
    )
    for call, good in calls:
        with pytest.raises(ValueError, match="geometry 1 is missing"):
            call([good, None])
        with pytest.raises(ValueError, match="geometry 2 is empty"):
            call([good, good, type(good)()])
        if call not in (ours.minimum_boxes, ours.upright_boxes):
            with pytest.raises(ValueError, match="geometry 1 is a MultiPoint: .* are needed"):
                call([good, shapely.MultiPoint([(0, 0), (1, 1)])])
