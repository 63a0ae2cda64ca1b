"""Columns of GeoArrow as shapes and paths, and back: against GeoPandas."""

import doctest

import numpy as np
import pytest

import geograd

pa = pytest.importorskip("pyarrow", reason="pyarrow is not installed: geograd.geoarrow is not tested")

import geograd.geoarrow as ours


@pytest.fixture(scope="module")
def geopandas():
    reason = "geopandas 1 is not installed: GeoArrow is not compared"
    return pytest.importorskip("geopandas", reason=reason, minversion="1.0")


@pytest.fixture(scope="module")
def shapely():
    return pytest.importorskip("shapely", reason="shapely is not installed: GeoArrow is not compared")


def column(geopandas, geometries, interleaved=True):
    frame = geopandas.GeoDataFrame(geometry=geopandas.GeoSeries(geometries, crs=3857))
    return pa.table(frame.to_arrow(geometry_encoding="geoarrow", interleaved=interleaved)).column("geometry")


def boxes(count=7, seed=1):
    draw = np.random.default_rng(seed)
    return np.c_[draw.uniform(-50, 50, (count, 2)), draw.uniform(1, 9, (count, 2)), draw.uniform(-3, 3, count)]


def test_the_example_of_the_module():
    found = doctest.testmod(ours)
    assert found.failed == 0 and found.attempted > 4


def test_geopandas_reads_what_is_written(geopandas, shapely):
    import geograd.shapely

    draw = np.random.default_rng(2)
    for shapes in (
        geograd.Obb2(boxes()), geograd.Aabb2(np.c_[boxes()[:, :2], boxes()[:, :2] + 1]),
        geograd.Triangle2(draw.normal(0, 3, (5, 6))),
        geograd.Vec2(draw.normal(0, 3, (5, 2))), geograd.Vec3(draw.normal(0, 3, (5, 3))),
        geograd.Segment2(draw.normal(0, 3, (5, 4))), geograd.Segment3(draw.normal(0, 3, (5, 6))),
        geograd.Rings.of([np.eye(3)[:, :2], draw.normal(0, 1, (5, 2))]),
        geograd.Polylines.of([draw.normal(0, 1, (4, 2)), draw.normal(0, 1, (2, 2))]),
        geograd.Polylines.of([draw.normal(0, 1, (4, 3))]), geograd.corners(geograd.Obb2(boxes())),
    ):
        frame = geopandas.GeoDataFrame.from_arrow(ours.table(shapes, crs="EPSG:3857"))
        expected = geograd.shapely.geometries(shapes)
        assert shapely.equals(frame.geometry.to_numpy(), expected).all() and frame.crs.to_epsg() == 3857
        assert np.array_equal(shapely.has_z(frame.geometry.to_numpy()), shapely.has_z(expected))
    named = ours.table(geograd.Obb2(boxes()), "outline")
    assert geopandas.GeoDataFrame.from_arrow(named, geometry="outline").crs is None


@pytest.mark.parametrize("interleaved", [True, False])
def test_what_geopandas_writes(geopandas, shapely, interleaved):
    import geograd.shapely

    holed = shapely.Polygon([(0, 0), (0, 9), (9, 9), (9, 0)], [[(1, 1), (3, 1), (3, 3)], [(5, 5), (5, 7), (7, 7)]])
    parts = shapely.MultiPolygon([shapely.box(0, 0, 1, 1), holed])
    plain = [shapely.Point(0, 0).buffer(2), shapely.box(1, 2, 3, 5)]
    for given in (plain, [shapely.MultiPolygon([x]) for x in plain]):
        found = ours.rings(column(geopandas, given, interleaved))
        expected = geograd.shapely.rings(given)
        assert np.array_equal(found.vertices, expected.vertices) and np.array_equal(found.offsets, expected.offsets)
    for given in ([holed, *plain], [parts, *plain, holed]):
        found, rows = ours.all_rings(column(geopandas, given, interleaved))
        expected, expected_rows = geograd.shapely.all_rings(given)
        assert rows.tolist() == expected_rows.tolist()
        np.testing.assert_allclose(np.bincount(rows, geograd.signed_area(found)), shapely.area(given))
        assert np.array_equal(found.vertices, expected.vertices) and np.array_equal(found.offsets, expected.offsets)
    lines = [shapely.LineString([(0, 0), (1, 1), (2, 0)]), shapely.LineString([(5, 5), (6, 9)])]
    found = ours.polylines(column(geopandas, lines, interleaved))
    np.testing.assert_allclose(geograd.length(found), shapely.length(lines))
    points = np.random.default_rng(1).normal(0, 4, (6, 2))
    assert np.array_equal(ours.points(column(geopandas, shapely.points(points), interleaved)).array, points)
    space = np.random.default_rng(1).normal(0, 4, (6, 3))
    assert type(ours.points(column(geopandas, shapely.points(space), interleaved))) is geograd.Vec3
    for bad, what in ((holed, "holes"), (parts, "several parts")):
        with pytest.raises(ValueError, match=f"geometry 1 has {what}: all_rings"):
            ours.rings(column(geopandas, [plain[0], bad], interleaved))


def test_slices_chunks_and_gradients():
    made = ours.table(geograd.Obb2(boxes(9))).column("geometry")
    whole = geograd.signed_area(ours.rings(made))
    np.testing.assert_allclose(whole, boxes(9)[:, 2] * boxes(9)[:, 3])
    np.testing.assert_allclose(geograd.signed_area(ours.rings(made.slice(3, 4))), whole[3:7])
    chunks = pa.chunked_array([made.slice(0, 2).combine_chunks(), made.slice(2).combine_chunks()])
    np.testing.assert_allclose(geograd.signed_area(ours.all_rings(chunks)[0]), whole)
    rings = ours.rings(made)
    area, grad = geograd.signed_area.value_grad(rings)
    moved = np.array(rings.vertices)
    moved[5, 0] += 1e-6
    change = geograd.signed_area(geograd.Rings(moved, rings.offsets)).sum() - area.sum()
    assert np.asarray(grad)[5, 0] == pytest.approx(change / 1e-6, abs=1e-6) and abs(np.asarray(grad)[5, 0]) > 0.1


def test_no_rows_nulls_and_other_columns():
    for shapes, call in (
        (geograd.Vec2(np.zeros((0, 2))), ours.points), (geograd.Obb2(np.zeros((0, 5))), ours.rings),
        (geograd.Segment2(np.zeros((0, 4))), ours.polylines),
    ):
        assert len(call(ours.table(shapes).column("geometry"))) == 0
    found, rows = ours.all_rings(ours.table(geograd.Obb2(np.zeros((0, 5)))).column("geometry"))
    assert len(found) == len(rows) == 0
    points = ours.table(geograd.Vec2(np.ones((3, 2)))).column("geometry").combine_chunks()
    null = pa.array([[1.0, 2.0], None], points.type)
    with pytest.raises(ValueError, match=r"geometry 1 is null \(1 of 2 are\)"):
        ours.points(null)
    for call in (ours.rings, ours.all_rings, ours.polylines):
        with pytest.raises(TypeError, match="of GeoArrow is needed, not of fixed_size_list"):
            call(points)
    with pytest.raises(TypeError, match="a column of points of GeoArrow is needed, not of binary"):
        ours.points(pa.array([b"wkb"]))
    with pytest.raises(TypeError, match="Sphere has no geometry"):
        ours.table(geograd.Sphere(np.ones((2, 4))))
    with pytest.raises(ValueError, match="ring 0 has 2 vertices"):
        ours.table(geograd.Rings.of([np.eye(2)]))
