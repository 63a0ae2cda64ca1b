"""Formats, broadcasting, results in place, and what is refused."""

import gc
import resource
import sys

import numpy as np
import pytest

import geograd


def test_formats(boxes):
    a, b = boxes
    single = a.astype(np.float32), b.astype(np.float32)
    assert geograd.iou(*single, kind="Obb2").dtype == np.float32
    assert geograd.iou(single[0], b, kind="Obb2").dtype == np.float64
    assert geograd.iou(a.astype(">f8"), b, kind="Obb2").dtype == np.float64
    np.testing.assert_array_equal(geograd.iou(a.astype(">f8"), b, kind="Obb2"), geograd.iou(a, b, kind="Obb2"))
    whole = np.array([[0, 0, 2, 2, 0]])
    assert geograd.iou(whole, whole, kind="Obb2").tolist() == [1.0]
    assert geograd.iou([0, 0, 2, 2, 0], whole[0], kind=geograd.Obb2) == 1.0


def test_strides_and_lists(boxes):
    a, b = boxes
    wide = np.zeros((len(a), 9))
    wide[:, 2:7] = a
    expected = geograd.iou(a, b, kind="Obb2")
    np.testing.assert_array_equal(geograd.iou(wide[:, 2:7], np.asfortranarray(b), kind="Obb2"), expected)
    np.testing.assert_array_equal(geograd.iou(a[::-1], b[::-1], kind="Obb2"), expected[::-1])
    np.testing.assert_array_equal(geograd.iou(a.tolist(), b.tolist(), kind="Obb2"), expected)
    read_only = a.copy()
    read_only.flags.writeable = False
    np.testing.assert_array_equal(geograd.iou(read_only, b, kind="Obb2"), expected)


def test_broadcasting(boxes):
    a, b = (geograd.Obb2(x) for x in boxes)
    first = geograd.Obb2(np.repeat(boxes[0][:1], 40, 0))
    np.testing.assert_array_equal(geograd.iou(a[0], b), geograd.iou(first, b))
    np.testing.assert_array_equal(geograd.iou(a[:1], b), geograd.iou(first, b))
    batches = geograd.Obb2(boxes[0].reshape(4, 10, 5)), geograd.Obb2(boxes[1].reshape(4, 10, 5))
    value, (by_a, by_b) = geograd.iou.value_grad(*batches)
    assert value.shape == (4, 10) and by_a.shape == by_b.shape == (4, 10, 5)
    np.testing.assert_array_equal(value.reshape(-1), geograd.iou(a, b))
    outer = geograd.iou(geograd.Obb2(boxes[0][:, None]), geograd.Obb2(boxes[1][None]))
    np.testing.assert_allclose(outer, geograd.iou.all_pairs(a, b), rtol=1e-13, atol=1e-300)
    matrices = geograd.iou.all_pairs(*batches)
    assert matrices.shape == (4, 10, 10)
    largest, place = geograd.iou.row_max(*batches)
    for i in range(4):
        np.testing.assert_array_equal(matrices[i], geograd.iou.all_pairs(batches[0][i], batches[1][i]))
    np.testing.assert_array_equal(largest, matrices.max(-1))
    np.testing.assert_array_equal(place, matrices.argmax(-1))
    shared = geograd.iou.all_pairs(batches[0], b[:7])
    np.testing.assert_array_equal(shared[2], geograd.iou.all_pairs(batches[0][2], b[:7]))
    one, grads = geograd.iou.value_grad(a[0], b[0])
    assert np.ndim(one) == 0 and grads[0].shape == (5,)
    # One row that stands for all has a gradient for every item.
    assert geograd.iou.value_grad(a[0], b)[1][0].shape == (40, 5)
    empty = geograd.Obb2(np.zeros((0, 5)))
    assert geograd.iou(empty, empty).shape == (0,) == geograd.iou(a[0], empty).shape
    assert geograd.iou.all_pairs(a, empty).shape == (40, 0)
    assert geograd.iou.sum(a, empty) == 0.0


def test_out(boxes):
    a, b = (geograd.Obb2(x) for x in boxes)
    value, by_a = np.empty(40), np.empty((40, 5))
    got = geograd.iou.value_grad(a, b, out=(value, (by_a, None)))
    assert got[0] is value and got[1][0] is by_a and got[1][1] is None
    expected, derivatives = geograd.iou.value_grad(a, b)
    np.testing.assert_array_equal(value, expected)
    np.testing.assert_array_equal(by_a, derivatives[0])
    matrix = np.empty((40, 40))
    assert geograd.iou.all_pairs(a, b, out=matrix) is matrix
    np.testing.assert_array_equal(np.diag(matrix), expected)
    rings = geograd.Rings(boxes[0][:, :2], np.arange(41))
    np.testing.assert_array_equal(geograd.signed_area(rings, out=value), np.zeros(40))


@pytest.mark.parametrize(
    ("out", "error", "says"),
    [
        (lambda a, b: np.empty(39), ValueError, "shape"),
        (lambda a, b: np.empty(40, np.float32), TypeError, "float64"),
        (lambda a, b: np.empty(80)[::2], ValueError, "C order"),
        (lambda a, b: a.reshape(-1)[:40], ValueError, "shares memory"),
        (lambda a, b: a[:, 0], ValueError, "C order"),
        (lambda a, b: [np.empty(40)] * 2, ValueError, "2 arrays where 1"),
        (lambda a, b: 3.0, TypeError, "array"),
    ],
)
def test_out_that_is_refused(boxes, out, error, says):
    a, b = boxes
    before = a.copy()
    with pytest.raises(error, match=says):
        geograd.iou(a, b, kind="Obb2", out=out(a, b))
    np.testing.assert_array_equal(a, before)


def test_out_is_left_alone(boxes):
    a, b = boxes
    a = a.copy()
    a[3, 2] = -1
    out = np.full(40, 7.0)
    with pytest.raises(ValueError, match=r"`a` item 3: width is negative"):
        geograd.iou(a, b, kind="Obb2", out=out)
    assert (out == 7).all()
    out.flags.writeable = False
    with pytest.raises(ValueError, match="read-only"):
        geograd.iou(b, b, kind="Obb2", out=out)
    same = np.empty((40, 5))
    with pytest.raises(ValueError, match="shares memory"):
        geograd.iou.value_grad(b, b, kind="Obb2", out=(np.empty(40), (same, same)))


BAD = {
    "half": (lambda a: a.astype(np.float16), TypeError, "float16"),
    "long": (lambda a: a.astype(np.longdouble), TypeError, "float32 or float64"),
    "complex": (lambda a: a + 1j, TypeError, "complex"),
    "objects": (lambda a: a.astype(object), TypeError, "objects"),
    "masked": (lambda a: np.ma.array(a), TypeError, "masked"),
    "text": (lambda a: a.astype(str), TypeError, "text"),
    "truths": (lambda a: a > 0, TypeError, "truths"),
    "none": (lambda a: None, TypeError, "objects"),
    "ragged": (lambda a: [[1.0, 2.0], [3.0]], TypeError, "`a`"),
    "width": (lambda a: a[:, :4], ValueError, r"\(\.\.\., 5\).*width"),
    "lone": (lambda a: 1.0, ValueError, "shape"),
    "rows": (lambda a: a[:7], ValueError, "7 rows|40"),
    "nan": (lambda a: np.where(np.arange(40)[:, None] == 2, np.nan, a), ValueError, "item 2: x is not a finite number"),
    "infinite": (lambda a: np.where(np.arange(40)[:, None] == 5, np.inf, a), ValueError, "item 5"),
    "negative": (lambda a: -a, ValueError, "item 0: width is negative"),
}


@pytest.mark.parametrize("bad", BAD)
def test_bad_arrays(boxes, bad):
    make, error, says = BAD[bad]
    with pytest.raises(error, match=says):
        geograd.iou(make(boxes[0]), boxes[1], kind="Obb2")
    with pytest.raises(error, match=says):
        geograd.iou.value_grad(make(boxes[0]), boxes[1], kind="Obb2")
    if bad not in ("rows", "lone"):
        with pytest.raises(error, match=says):
            geograd.iou.all_pairs(make(boxes[0]), boxes[1], kind="Obb2")


def test_wrong_calls(boxes):
    a, b = (geograd.Obb2(x) for x in boxes)
    for call, error, says in [
        (lambda: geograd.iou(a), TypeError, r"\(Obb2, Obb2\)"),
        (lambda: geograd.iou(a, b, b), TypeError, r"no row"),
        (lambda: geograd.iou(a, geograd.Circle(boxes[1][:, :3])), TypeError, r"\(Obb2, Circle\).*\(Aabb2, Aabb2\)"),
        (lambda: geograd.iou(a, b, kind="Obb9"), ValueError, "no shape is called"),
        (lambda: geograd.iou(a, b, kind=("Obb2",)), TypeError, "every argument"),
        (lambda: geograd.iou(a, b, kind=3), TypeError, "kind"),
        (lambda: geograd.iou(a, b, backend="tpu"), ValueError, "tpu"),
        (lambda: geograd.iou.vjp(a, b), TypeError, "vjp"),
        (lambda: geograd.iou.above(a, b, float("nan")), ValueError, "threshold"),
        (lambda: geograd.iou.all_pairs_vjp(a, b, np.ones((40, 39))), ValueError, "upstream"),
        (lambda: geograd.iou.sum(geograd.Obb2(boxes[0].reshape(4, 10, 5)), b), ValueError, "leading axes"),
        (lambda: geograd.iou.all_pairs(*[geograd.Obb2(x.reshape(n, -1, 5)) for x, n in zip(boxes, (4, 5))]), ValueError, "batches"),
        (lambda: geograd.convert(geograd.ImageBox(boxes[0])), TypeError, "to=.*Le90"),
        (lambda: geograd.corners.value_grad(a), TypeError, "8 numbers"),
        (lambda: geograd.Obb2(boxes[0][:, :4]), ValueError, "heading"),
        (lambda: geograd.Obb2(1.0, 2.0), TypeError, "x, y, width"),
        (lambda: geograd.Rings(boxes[0], [0, 40]), ValueError, r"\(V, 2\)"),
        (lambda: geograd.signed_area(geograd.Rings(boxes[0][:, :2], [0, 30])), ValueError, "offsets"),
        (lambda: geograd.signed_area(geograd.Rings(boxes[0][:, :2], [0, -1, 40])), ValueError, "negative"),
        (lambda: geograd.signed_area(geograd.Rings(boxes[0][:, :2], [0.0, 40.0])), TypeError, "whole"),
        (lambda: geograd.signed_distance(a, geograd.Rings(boxes[0][:, :2], [0, 40])), TypeError, "no row"),
    ]:
        with pytest.raises(error, match=says):
            call()


def test_huge_broadcasts_are_refused():
    a = np.lib.stride_tricks.as_strided(np.ones(5), (2**40, 1, 5), (0, 0, 8))
    b = np.lib.stride_tricks.as_strided(np.ones(5), (1, 2**40, 5), (0, 0, 8))
    with pytest.raises((MemoryError, ValueError)):
        geograd.iou(a, b, kind="Obb2")


@pytest.mark.slow
def test_failing_calls_leak_nothing(boxes):
    a, b = boxes
    shape = geograd.Obb2(a)
    wrong = geograd.Obb2(-b)
    calls = [
        lambda: geograd.iou(shape, wrong),
        lambda: geograd.iou(a, b),
        lambda: geograd.iou(a[:, :4], b, kind="Obb2"),
        lambda: geograd.iou(a, b, kind="Obb2", out=a[:, 0]),
    ]

    def fail(times):
        for _ in range(times // len(calls)):
            for call in calls:
                try:
                    call()
                except (TypeError, ValueError):
                    continue
                raise AssertionError("a call that must fail did not")

    fail(20_000)
    gc.collect()
    before, objects = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, len(gc.get_objects())
    held = sys.getrefcount(a)
    fail(100_000)
    gc.collect()
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    # A leak of a hundred bytes a call would be ten thousand KiB.
    assert grown < 8192, f"{grown} KiB more"
    assert len(gc.get_objects()) < objects + 100
    assert sys.getrefcount(a) == held


def test_shapes(boxes):
    a = geograd.Obb2(boxes[0])
    assert len(a) == 40 and a.x.shape == (40,) and a.array is boxes[0]
    np.testing.assert_array_equal(a[3].array, boxes[0][3])
    assert isinstance(a[boxes[0][:, 0] > 2], geograd.Obb2)
    np.testing.assert_array_equal(np.asarray(a), boxes[0])
    fields = geograd.Obb2(x=1.0, y=boxes[0][:, 0], width=1, height=2.0, heading=0)
    assert fields.array.shape == (40, 5) and (fields.height == 2).all()
    upright = geograd.Aabb2(0.0, 0.0, 1.0, 2.0)
    assert isinstance(upright.max, geograd.Vec2) and upright.max.y == 2
    segment = geograd.Segment2(from_x=0.0, from_y=1.0, to_x=2.0, to_y=3.0)
    assert segment.from_.y == 1 and (segment.to - segment.from_).length() == pytest.approx(8**0.5)
    import pickle

    np.testing.assert_array_equal(pickle.loads(pickle.dumps(a)).array, a.array)
    assert pickle.loads(pickle.dumps(geograd.iou)) is not None
    np.testing.assert_array_equal(geograd.alpha_iou(a, a, 3.0), np.ones(40))
    np.testing.assert_allclose(geograd.alpha_iou(a, a, np.linspace(1, 2, 40)), np.ones(40))


def test_other_libraries(boxes):
    a, b = boxes
    arrow = pytest.importorskip("pyarrow")
    column = arrow.FixedSizeListArray.from_arrays(arrow.array(a.reshape(-1)), 5)
    np.testing.assert_array_equal(geograd.iou(column, b, kind="Obb2"), geograd.iou(a, b, kind="Obb2"))
    chunked = arrow.chunked_array([column[:10], column[10:]])
    np.testing.assert_array_equal(geograd.Obb2(chunked).array, a)
    with pytest.raises(ValueError, match="null"):
        geograd.Obb2(arrow.array([[1.0] * 5, None], arrow.list_(arrow.float64(), 5)))
    with pytest.raises(TypeError, match="fixed_size_list"):
        geograd.Obb2(arrow.array([[1.0] * 5]))


def test_geometries():
    shapely = pytest.importorskip("shapely")
    polygons = [shapely.box(0, 0, 2, 1), shapely.Polygon([(0, 0), (3, 0), (0, 4)])]
    rings = geograd.Rings.of(polygons)
    np.testing.assert_allclose(np.abs(geograd.signed_area(rings)), shapely.area(polygons))
    points = shapely.points([[0.5, 0.5], [5.0, 0.0]])
    np.testing.assert_allclose(
        np.maximum(geograd.signed_distance(geograd.Vec2(points), rings), 0), shapely.distance(points, polygons), atol=1e-12
    )
    with pytest.raises(ValueError, match="holes"):
        geograd.Rings.of([shapely.box(0, 0, 3, 3) - shapely.box(1, 1, 2, 2)])
    with pytest.raises(TypeError, match="Vec2"):
        geograd.Obb2(points)
    lines = geograd.Polylines.of([shapely.LineString([(0, 0), (3, 4)])])
    assert geograd.length(lines).tolist() == [5.0]
