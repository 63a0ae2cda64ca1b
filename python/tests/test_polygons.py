"""Polygons with holes and parts against shapely, their gradients against differences."""

import copy
import pickle

import numpy as np
import pytest

import geograd
from geograd import Polygons

shapely = pytest.importorskip("shapely")
OPERATIONS = ("union", "intersection", "difference", "symmetric_difference")


def star(dice, n, x=0.0, y=0.0, size=1.0):
    """A ring that does not cross itself around a centre."""
    turns = (np.arange(n) + dice.uniform(0.3, 0.7, n)) * (2 * np.pi / n)
    reach = size * dice.uniform(0.4, 1.0, n)
    return np.stack([x + reach * np.cos(turns), y + reach * np.sin(turns)], -1)


def blob(dice, x=0.0, y=0.0, size=1.0, holes=True):
    """A valid geometry: a star with up to two holes, sometimes in two parts."""
    while True:
        outer = shapely.Polygon(star(dice, int(dice.integers(3, 12)), x, y, size))
        for _ in range(int(dice.integers(0, 3)) if holes else 0):
            at = dice.normal(size=2) * 0.3 * size
            outer = outer.difference(shapely.Polygon(star(dice, 4, x + at[0], y + at[1], 0.2 * size)))
        if dice.random() < 0.3:
            outer = outer.union(shapely.Polygon(star(dice, 5, x + 2.2 * size, y, 0.7 * size)))
        outer = shapely.make_valid(outer)
        if outer.geom_type in ("Polygon", "MultiPolygon") and not outer.is_empty and outer.area > 1e-3 * size**2:
            return shapely.normalize(outer)


def blobs(seed, count, far=0.0, size=1.0):
    dice = np.random.default_rng(seed)
    a = np.array([blob(dice, far, -far, size) for _ in range(count)], object)
    b = np.array([blob(dice, far + size * dice.uniform(-1, 1), -far + size * dice.uniform(-1, 1), size) for _ in range(count)], object)
    return a, b


def box(x, y, w, h):
    return shapely.box(x, y, x + w, y + h)


def hostile():
    """Pairs with edges along each other, corners that touch, holes equal to parts, slivers."""
    frame = box(0, 0, 4, 4).difference(box(1, 1, 2, 2))
    comb = shapely.unary_union([box(0, 0, 7, 1)] + [box(2 * k, 1, 1, 5) for k in range(4)])
    return [
        (box(0, 0, 2, 2), box(0, 0, 2, 2)),
        (box(0, 0, 2, 2), box(2, 0, 2, 2)),
        (box(0, 0, 2, 2), box(2, 2, 2, 2)),
        (box(0, 0, 2, 2), box(1, 0, 2, 2)),
        (box(0, 0, 4, 4), box(1, 1, 2, 2)),
        (box(0, 0, 4, 4), box(0, 1, 2, 2)),
        (frame, box(1, 1, 2, 2)),
        (frame, frame),
        (frame, box(0, 0, 4, 4)),
        (frame, box(1, 1, 1, 2)),
        (frame, shapely.MultiPolygon([box(1, 1, 2, 2), box(4, 0, 1, 4)])),
        (shapely.MultiPolygon([box(0, 0, 1, 1), box(2, 0, 1, 1)]), box(-1, -1, 6, 6)),
        (shapely.MultiPolygon([box(0, 0, 1, 1), box(2, 0, 1, 1)]), box(1, 0, 1, 1)),
        (comb, shapely.affinity.rotate(comb, 90, origin=(3.5, 3.5))),
        (comb, shapely.affinity.translate(comb, 1, 0)),
        (shapely.Polygon([(0, 0), (1, 0), (0.5, 1e-9)]), box(0, 0, 1, 1)),
        (shapely.Polygon([(0, 0), (3, 1e-7), (6, 0), (3, 5)]), shapely.Polygon([(0, 0), (3, -1e-7), (6, 0), (3, -5)])),
        (box(0, 0, 1, 1), shapely.Polygon()),
        (shapely.Polygon(), shapely.Polygon()),
        (box(0, 0, 1, 1), box(10, 10, 1, 1)),
    ]


def difference(f, x, step=1e-6):
    """The gradient of a function of an array by central differences."""
    made = np.zeros_like(x)
    for place in np.ndindex(x.shape):
        low, high = x.copy(), x.copy()
        low[place] -= step
        high[place] += step
        made[place] = (f(high) - f(low)) / (2 * step)
    return made


def moved(polygons, vertices):
    return Polygons(vertices, polygons.offsets)


# The column


def test_a_column_is_that_of_shapely_and_back():
    a, _ = blobs(1, 50)
    a[7] = shapely.Polygon()
    column = Polygons.from_shapely(a)
    assert len(column) == 50 and column.vertices.dtype == np.float64
    back = column.to_shapely()
    assert shapely.equals_exact(shapely.normalize(back[:7]), shapely.normalize(a[:7])).all()
    assert shapely.equals(back, a).all() and back[7].is_empty
    assert (Polygons.of(a) == column).all() and (Polygons.of(list(a)) == column).all()
    full = [[part] for part in shapely.get_parts(a) if not part.is_empty]
    _, (rings, parts, polygons) = shapely.to_ragged_array(shapely.multipolygons(full))[1:]
    whole = Polygons.of(np.array([part for part, in full], object))
    assert [list(x) for x in whole.offsets[1:]] == [list(parts), list(polygons)]
    assert (np.diff(whole.offsets[0]) == np.diff(rings) - 1).all()


def test_lists_nest_as_deep_as_parts_and_holes_do():
    square = [(0, 0), (4, 0), (4, 4), (0, 4)]
    hole = np.array([(1, 1), (2, 1), (2, 2), (1, 2), (1, 1)])
    other = [(5, 0), (6, 0), (6, 1)]
    column = Polygons.of([square, [square, hole], [[square, hole], [other]], np.array(other), [], box(0, 0, 1, 1).exterior.coords])
    assert geograd.area(column).tolist() == [16, 15, 15.5, 0.5, 0, 1]
    assert [[len(part) for part in parts] for parts in column.tolist()] == [[1], [2], [2, 1], [1], [], [1]]
    assert (Polygons.of(column.tolist()) == column).all()
    for bad in ([[(0, 0), (1, 0, 0), (1, 1)]], [[[]]], [3.0], [[1.0, 2.0]]):
        with pytest.raises((ValueError, TypeError), match="polygon 0|ring|sequence|inhomogeneous"):
            Polygons.of(bad)
    boxes = geograd.Obb2([[0, 0, 2, 1, 0.3], [1, 1, 2, 2, 0]])
    assert geograd.area(Polygons.of(boxes)) == pytest.approx([2, 4])
    assert geograd.area(Polygons.of(geograd.Aabb2([[0, 0, 2, 3]]))) == [6]
    assert geograd.area(Polygons.of(geograd.Rings.of([square, other]))).tolist() == [16, 0.5]


def test_bad_columns_say_which_polygon():
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    for offsets, words in (
        (([0, 3],), "offsets of rings: the last one is 4"),
        (([1, 4],), "offsets of rings: the first one is 0"),
        (([0, 4], [0, 2]), "offsets of parts: the last one is 1"),
        (([0, 4, 3, 4], [0, 3]), "offset 2 is less"),
        (([], [0], [0]), "the first one is 0"),
    ):
        with pytest.raises(ValueError, match=words):
            Polygons(square, offsets)
    with pytest.raises(TypeError, match="whole numbers"):
        Polygons(square, ([0.0, 4.0],))
    with pytest.raises(ValueError, match="negative"):
        Polygons(square, ([-1, 4],))
    with pytest.raises(ValueError, match=r"\(V, 2\)"):
        Polygons([[0, 0, 0]], ([0, 1],))
    with pytest.raises(ValueError, match="polygon 1: "):
        Polygons(square + [[0, 0], [1, np.nan], [1, 1]], ([0, 4, 7],))
    with pytest.raises(ValueError, match="polygon 0: "):
        Polygons([[0, 0], [1, 1], [0, 0], [1, 1]], ([0, 4],))
    lists = [[square], [square, [(0.1, 0.1), (0.2, "x"), (0.2, 0.2)]]]
    with pytest.raises(ValueError, match=r"polygon 1: part 1: ring 1: vertex 1 is \(0.2, 'x'\), and two numbers"):
        Polygons.of([square, lists])
    with pytest.raises(ValueError, match=r"polygon 0: ring 1: vertices of shape \(V, 2\)"):
        Polygons.of([[square, [(0, 0, 0)] * 3]])
    with pytest.raises(ValueError, match="polygon 1: ring 1: vertex 2 has a coordinate"):
        Polygons.of([square, [square, [(0.1, 0.1), (0.2, 0.1), (0.2, np.nan)]]])
    with pytest.raises(TypeError, match="polygon 1: .* not None"):
        Polygons.of([square, None])
    with pytest.raises(TypeError, match="geometry 1: .*LineString"):
        Polygons.from_shapely([box(0, 0, 1, 1), shapely.LineString([(0, 0), (1, 1)])])
    with pytest.raises(TypeError, match="geometry 0: .*missing"):
        Polygons.from_shapely([None])


def test_columns_index_iterate_join_and_pickle():
    a, _ = blobs(2, 12)
    column = Polygons.of(a)
    areas = geograd.area(column)
    assert geograd.area(column[3]) == areas[3] and geograd.area(column[-1]) == areas[-1]
    assert (geograd.area(column[2:9:3]) == areas[2:9:3]).all()
    assert (geograd.area(column[areas > 1]) == areas[areas > 1]).all()
    assert (geograd.area(column[[5, 0, 5]]) == areas[[5, 0, 5]]).all()
    assert len(column[[]]) == 0 and len(column[:0]) == 0
    assert [geograd.area(own)[0] for own in column] == areas.tolist()
    with pytest.raises(IndexError, match="polygon 12 of 12"):
        column[12]
    joined = Polygons.concatenate([column[:5], column[5:]])
    assert (joined == column).all() and all((x == y).all() for x, y in zip(joined.offsets, column.offsets))
    assert not (column != column).any() and not (column == column[::-1])[0]
    for other in (pickle.loads(pickle.dumps(column)), copy.deepcopy(column), copy.copy(column)):
        assert type(other) is Polygons and (other == column).all()
    assert repr(column).startswith("<Polygons 12 of ")
    with pytest.raises(ValueError, match="read-only"):
        column.vertices[0] = 0
    assert column.bounds.array == pytest.approx(shapely.bounds(a))
    single = Polygons(column.vertices.astype(np.float32), column.offsets)
    assert geograd.area(single).dtype == np.float32
    assert geograd.area(single) == pytest.approx(areas, rel=1e-5)
    assert geograd.iou(single, single).dtype == np.float32 and geograd.iou(single, column).dtype == np.float64


def test_arrow_columns_are_geoarrow():
    pa = pytest.importorskip("pyarrow")
    a, _ = blobs(3, 20)
    a[4] = shapely.Polygon()
    column = Polygons.of(a)
    arrow = column.to_arrow()
    assert arrow.type.extension_name == "geoarrow.multipolygon" and len(arrow) == 20
    assert (Polygons.from_arrow(arrow) == column).all()
    assert (Polygons.from_arrow(pa.chunked_array([arrow.slice(0, 6).storage, arrow.slice(6).storage])) == column).all()
    assert (Polygons.from_arrow(arrow.storage.slice(3, 5)) == column[3:8]).all()
    assert (Polygons.from_arrow(pa.array(shapely.to_wkb(a))) == column).all()
    one = shapely.get_parts(a)
    vertices, (rings, parts) = shapely.to_ragged_array(one)[1:]
    pairs = pa.FixedSizeListArray.from_arrays(pa.array(vertices.ravel()), 2)
    lists = pa.ListArray.from_arrays(pa.array(parts, pa.int32()), pa.ListArray.from_arrays(pa.array(rings, pa.int32()), pairs))
    assert (Polygons.from_arrow(lists) == Polygons.of(one)).all()
    with pytest.raises(TypeError, match="lists of rings"):
        Polygons.from_arrow(pa.array([1.0]))


def test_geopandas_reads_and_gives_columns():
    geopandas = pytest.importorskip("geopandas")
    a, _ = blobs(4, 10)
    series = geopandas.GeoSeries(a)
    column = Polygons.of(series)
    assert geograd.area(column) == pytest.approx(series.area.to_numpy())
    assert (geopandas.GeoSeries.from_arrow(column).geom_equals(series)).all()


# Values


def close(found, expected, scale=1.0):
    assert found == pytest.approx(np.asarray(expected, float), rel=1e-9, abs=1e-10 * scale)


@pytest.mark.parametrize("far,size", [(0.0, 1.0), (1e6, 1.0), (0.0, 1e-6), (0.0, 1e9)])
def test_measures_are_those_of_shapely(far, size):
    a, b = blobs(5, 200, far, size)
    p, q = Polygons.of(a), Polygons.of(b)
    # Coordinates far away have less digits, in shapely's sums more than in ours.
    digits = 1e-9 * max(1.0, far / size)
    assert geograd.area(p) == pytest.approx(shapely.area(a), rel=digits)
    assert geograd.perimeter(p) == pytest.approx(shapely.length(a), rel=1e-9)
    assert (geograd.length(p) == geograd.perimeter(p)).all()
    centres = geograd.centroid(p).array
    assert centres == pytest.approx(shapely.get_coordinates(shapely.centroid(a)), rel=1e-9, abs=digits * size)
    shared = shapely.area(shapely.intersection(a, b))
    assert geograd.intersection_area(p, q) == pytest.approx(shared, rel=digits, abs=digits * size**2)
    whole = shapely.area(shapely.union(a, b))
    assert geograd.union_area(p, q) == pytest.approx(whole, rel=digits)
    assert geograd.iou(p, q) == pytest.approx(shared / whole, rel=digits, abs=digits)
    assert geograd.iof(p, q) == pytest.approx(shared / shapely.area(a), rel=digits, abs=digits)
    points = np.random.default_rng(0).uniform(-2, 2, (200, 2)) * size + [far, -far]
    spots = shapely.points(points)
    assert geograd.distance(points, p) == pytest.approx(shapely.distance(spots, a), rel=digits, abs=digits * size)
    inside = shapely.contains(a, spots)
    assert (geograd.contains(p, points) == inside).all() and inside.any() and not inside.all()
    signed = np.where(inside, -1, 1) * shapely.distance(spots, shapely.boundary(a))
    assert geograd.signed_distance(points, p) == pytest.approx(signed, rel=digits, abs=digits * size)
    assert (geograd.signed_distance(p, points) == geograd.signed_distance(points, p)).all()
    assert (geograd.depth(points, p) == -geograd.signed_distance(points, p)).all()


@pytest.mark.parametrize("valid", [False, True])
@pytest.mark.parametrize("name", OPERATIONS)
def test_operations_are_those_of_shapely(name, valid):
    for far, size in ((0.0, 1.0), (1e5, 1.0), (0.0, 1e-5)):
        a, b = blobs(6, 150, far, size)
        made = getattr(geograd, name)(a, b, valid=valid)
        expected = getattr(shapely, name)(a, b)
        digits = 1e-10 * max(1.0, far / size)
        assert geograd.area(made) == pytest.approx(shapely.area(expected), rel=digits, abs=digits * size**2)
        assert geograd.length(made) == pytest.approx(shapely.length(expected), rel=digits, abs=digits * size)
        back = made.to_shapely()
        if valid:
            assert shapely.is_valid(back).all()
        apart = shapely.area(shapely.symmetric_difference(shapely.make_valid(back), expected))
        assert (apart <= 1e-9 * max(1.0, far / size) * size**2).all()


@pytest.mark.parametrize("name", OPERATIONS)
def test_hostile_pairs(name):
    pairs = hostile()
    a, b = (np.array([pair[k] for pair in pairs], object) for k in (0, 1))
    expected = shapely.area(getattr(shapely, name)(a, b))
    for valid in (False, True):
        made = getattr(geograd, name)(a, b, valid=valid)
        close(geograd.area(made), expected)
        assert shapely.is_valid(made.to_shapely()).all() or not valid
        # Results may be inputs.
        again = getattr(geograd, name)(made, b, valid=valid)
        shape = shapely.make_valid(made.to_shapely())
        close(geograd.area(again), shapely.area(getattr(shapely, name)(shape, b)))
    p, q = Polygons.of(a), Polygons.of(b)
    close(geograd.intersection_area(p, q), shapely.area(shapely.intersection(a, b)))
    close(geograd.union_area(p, q), shapely.area(shapely.union(a, b)))


def test_rings_that_cross_themselves_follow_the_fill_rule():
    bow = [(0, 0), (2, 2), (2, 0), (0, 2)]
    twice = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0.5), (3, 0.5), (3, 3), (1, 3), (1, 0)]
    around = Polygons.of([box(-1, -1, 9, 9)])
    column = Polygons.of([bow, twice])
    odd = geograd.intersection(column, around)
    nonzero = geograd.intersection(column, around, fill="nonzero")
    assert geograd.area(odd)[0] == 2 and geograd.area(nonzero)[0] == 2
    assert geograd.area(nonzero)[1] > geograd.area(odd)[1]
    at = np.array([[2.0, 1.5]])
    assert geograd.contains(column[1], at) != geograd.contains(column[1], at, fill="nonzero")
    whole = column.make_valid()
    assert shapely.is_valid(whole.to_shapely()).all() and (geograd.area(whole) == geograd.area(odd)).all()
    with pytest.raises(ValueError, match='"even_odd" or "nonzero"'):
        geograd.contains(column, at, fill="odd")


def test_one_polygon_or_point_stands_for_all():
    a, b = blobs(7, 20)
    p, q = Polygons.of(a), Polygons.of(b)
    assert (geograd.iou(p[2], q) == geograd.iou(p[[2] * 20], q)).all()
    assert (geograd.area(geograd.union(p[2], q)) == geograd.area(geograd.union(p[[2] * 20], q))).all()
    points = np.random.default_rng(0).uniform(-1, 1, (50, 2))
    assert (geograd.distance(points, p[0]) == [geograd.distance(x, p[0])[0] for x in points]).all()
    assert geograd.distance(geograd.Vec2(0.0, 0.0), p).shape == (20,)
    with pytest.raises(ValueError, match="`b` has 3 rows where 20 are needed"):
        geograd.iou(p, q[:3])
    _, (one, all_q) = geograd.iou.value_grad(p[2], q)
    _, (each, same_q) = geograd.iou.value_grad(p[[2] * 20], q)
    assert one == pytest.approx(each.reshape(20, -1, 2).sum(0)) and (all_q == same_q).all()
    _, (by_points, by_one) = geograd.signed_distance.value_grad(points, p[2])
    _, (same, by_each) = geograd.signed_distance.value_grad(points, p[[2] * 50])
    assert (by_points == same).all() and by_one == pytest.approx(by_each.reshape(50, -1, 2).sum(0))
    empty = p[:0]
    assert geograd.iou(empty, empty).shape == (0,) and len(geograd.union(empty, empty)) == 0
    assert geograd.iou.value_grad(empty, p[0])[1][1].shape == (len(p[0].vertices), 2)
    assert geograd.iou(empty, p[0]).shape == (0,) and geograd.area(empty).shape == (0,)


def test_all_pairs_are_a_matrix():
    a, b = blobs(8, 12)
    for verb in (geograd.iou, geograd.iof, geograd.intersection_area, geograd.union_area):
        matrix = verb.all_pairs(Polygons.of(a), Polygons.of(b[:9]))
        assert matrix.shape == (12, 9)
        rows = [verb(Polygons.of(a[k : k + 1]), Polygons.of(b[:9])) for k in range(12)]
        assert (matrix == rows).all()


def test_the_union_of_a_column():
    a, b = blobs(9, 60)
    column = Polygons.of(np.concatenate([a, b]))
    for valid in (False, True):
        made = column.union_all(valid=valid)
        assert len(made) == 1
        expected = shapely.union_all(np.concatenate([a, b]))
        assert geograd.area(made)[0] == pytest.approx(expected.area, rel=1e-10)
    assert shapely.is_valid(made.to_shapely()).all()


def test_a_point_that_is_no_number_is_nowhere_and_has_no_distance():
    p = Polygons.of([box(0, 0, 1, 1)])
    points = np.array([[0.5, 0.5], [0, np.nan], [np.inf, 0]])[[1, 2, 0]]
    for verb in (geograd.distance, geograd.signed_distance):
        with pytest.raises(ValueError, match="`point` item 1: y is not a finite number"):
            verb(points[[2, 0]], p)
    assert geograd.contains(p, points).tolist() == [False, False, True]
    none = Polygons.of([shapely.Polygon()])
    assert not geograd.contains(none, [0.0, 0.0])[0] and geograd.area(none) == [0] and geograd.length(none) == [0]


# Gradients


def checked(f, gradient, x, tolerance=2e-6):
    expected = difference(f, x)
    assert np.abs(gradient - expected).max() <= tolerance * (1 + np.abs(expected).max())


def test_gradients_of_measures_are_those_of_differences():
    a, _ = blobs(10, 8)
    p = Polygons.of(a)
    for verb in (geograd.area, geograd.perimeter):
        value, gradient = verb.value_grad(p)
        assert (value == verb(p)).all()
        checked(lambda x: verb(moved(p, x)).sum(), gradient, p.vertices.copy())
        weights = np.arange(1.0, 9.0)
        checked(lambda x: (verb(moved(p, x)) * weights).sum(), verb.vjp(p, weights), p.vertices.copy())
    bars = np.random.default_rng(0).normal(size=(8, 2))
    checked(lambda x: (geograd.centroid(moved(p, x)).array * bars).sum(), geograd.centroid.vjp(p, bars), p.vertices.copy())
    with pytest.raises(TypeError, match="one number"):
        geograd.centroid.value_grad(p)


@pytest.mark.parametrize("name", ["intersection_area", "union_area", "iou", "iof"])
def test_gradients_of_overlaps_are_those_of_differences(name):
    a, b = blobs(11, 10)
    p, q, verb = Polygons.of(a), Polygons.of(b), getattr(geograd, name)
    value, (by_p, by_q) = verb.value_grad(p, q)
    assert value == pytest.approx(verb(p, q)) and (value > 0).sum() > 5
    checked(lambda x: verb(moved(p, x), q).sum(), by_p, p.vertices.copy())
    checked(lambda x: verb(p, moved(q, x)).sum(), by_q, q.vertices.copy())
    weights = np.arange(1.0, 11.0)
    checked(lambda x: (verb(moved(p, x), q) * weights).sum(), verb.vjp(p, q, weights)[0], p.vertices.copy())


@pytest.mark.parametrize("name", ["distance", "signed_distance", "depth"])
def test_gradients_of_distances_are_those_of_differences(name):
    a, _ = blobs(12, 12)
    p, verb = Polygons.of(a), getattr(geograd, name)
    points = np.random.default_rng(1).uniform(-1.2, 1.2, (12, 2))
    value, (by_points, by_p) = verb.value_grad(points, p)
    assert (value == verb(points, p)).all()
    checked(lambda x: verb(x, p).sum(), by_points, points)
    checked(lambda x: verb(points, moved(p, x)).sum(), by_p, p.vertices.copy())
    swapped = verb.value_grad(p, points)[1]
    assert (swapped[0] == by_p).all() and (swapped[1] == by_points).all()


def test_signed_distance_on_the_border_has_the_outward_normal():
    frame = Polygons.of([box(0, 0, 4, 4).difference(box(1, 1, 2, 2))])
    points = np.array([[4.0, 2.0], [2.0, 0.0], [3.0, 2.0], [2.0, 1.0], [4.0, 4.0]])
    value, (by, _) = geograd.signed_distance.value_grad(points, frame)
    assert (value == 0).all() and by.tolist() == [[1, 0], [0, -1], [-1, 0], [0, 1], [0, 0]]
    middle, (by, by_frame) = geograd.signed_distance.value_grad([2.0, 2.0], frame)
    assert middle == [1.0] and np.abs(by).max() == 0 and np.abs(by_frame.sum(0)).max() == 0


@pytest.mark.parametrize("valid", [False, True])
@pytest.mark.parametrize("name", OPERATIONS)
def test_gradients_of_operations_are_those_of_differences(name, valid):
    a, b = blobs(13, 6)
    p, q, verb = Polygons.of(a), Polygons.of(b), getattr(geograd, name)
    made = verb(p, q, valid=valid)
    # The area of the result, and its centroid, by the vertices of the inputs.
    for upstream, f in (
        (geograd.area.value_grad(made)[1], lambda m: geograd.area(m).sum()),
        (geograd.perimeter.value_grad(made)[1], lambda m: geograd.perimeter(m).sum()),
    ):
        by_p, by_q = verb.vjp(p, q, upstream, valid=valid)
        checked(lambda x: f(verb(moved(p, x), q, valid=valid)), by_p, p.vertices.copy(), 2e-5)
        checked(lambda x: f(verb(p, moved(q, x), valid=valid)), by_q, q.vertices.copy(), 2e-5)
    with pytest.raises(ValueError, match="upstream|broadcast"):
        verb.vjp(p, q, upstream[:-1], valid=valid)


def test_the_area_of_an_intersection_has_one_gradient_by_both_ways():
    a, b = blobs(14, 100)
    p, q = Polygons.of(a), Polygons.of(b)
    shared = geograd.intersection(p, q)
    by_clipping = geograd.intersection.vjp(p, q, geograd.area.value_grad(shared)[1])
    _, by_motion = geograd.intersection_area.value_grad(p, q)
    for found, expected in zip(by_clipping, by_motion):
        assert found == pytest.approx(expected, rel=1e-7, abs=1e-9)


def test_translations_of_hostile_pairs_move_nothing_together():
    """The area of the intersection stays when both move: the gradients by all vertices add up to zero."""
    for p, q in hostile():
        value, (by_p, by_q) = geograd.intersection_area.value_grad(Polygons.of([p]), Polygons.of([q]))
        assert np.isfinite(by_p).all() and np.isfinite(by_q).all()
        assert np.abs(by_p.sum(0) + by_q.sum(0)).max(initial=0) < 1e-9
        equal, (by_p, by_q) = geograd.iou.value_grad(Polygons.of([p]), Polygons.of([p]))
        assert equal[0] in (0.0, 1.0) and not by_p.any() and not by_q.any()


# Refusals and threads


def test_forms_and_shapes_that_polygons_lack():
    p = Polygons.of([box(0, 0, 1, 1)])
    with pytest.raises(TypeError, match="geograd.giou takes no Polygons"):
        geograd.giou(p, p)
    with pytest.raises(TypeError, match="value_grad, vjp, all_pairs"):
        geograd.iou.hessian(p, p)
    with pytest.raises(TypeError, match="takes a, b, not 1"):
        geograd.iou(p)
    with pytest.raises(TypeError, match="no options"):
        geograd.iou(p, p, backend="gpu")
    with pytest.raises(ValueError, match=r"\(N, 2\)"):
        geograd.distance(np.zeros((2, 3)), p)
    assert "Polygons" in geograd.iou.__doc__ and "either of two polygons" in geograd.union.__doc__
    assert pickle.loads(pickle.dumps(geograd.union)) is geograd.union
    assert pickle.loads(pickle.dumps(geograd.union_area)) is geograd.union_area


def test_results_are_the_same_on_any_number_of_threads():
    a, b = blobs(15, 300)
    p, q = Polygons.of(a), Polygons.of(b)
    points = np.random.default_rng(2).uniform(-1, 1, (5000, 2))
    before, found = geograd.get_num_threads(), []
    try:
        for threads in (1, 3):
            geograd.set_num_threads(threads)
            found.append(
                [
                    geograd.iou.value_grad(p[0], q)[1][0], geograd.union(p, q).vertices, geograd.area(p),
                    geograd.signed_distance.value_grad(points, p[0])[1][1],
                ]
            )
    finally:
        geograd.set_num_threads(before)
    assert all((x == y).all() for x, y in zip(*found))
