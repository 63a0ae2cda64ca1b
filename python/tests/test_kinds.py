"""kind= of plain arrays, equality of shapes, arrays of shapes, poses, cameras."""

import numpy as np
import pytest

import geograd
from conftest import asked, columns, fixed_rows, samples

ROWS = fixed_rows()


def alike(row):
    """The only shape that a row takes, if it takes one beside lone numbers."""
    kinds = {kind for kind, (_, _, width) in zip(row["kinds"], row["takes"]) if width > 1}
    return kinds.pop() if len(kinds) == 1 else None


def others(verb, row):
    """The kinds of rows of as many arguments, of the same shape and lone numbers."""
    return [
        own["kinds"] for name, own in ROWS
        if name == verb and len(own["kinds"]) == len(row["kinds"]) and set(own["kinds"]) <= {alike(row), "number"}
    ]


@pytest.mark.parametrize("verb, row", [x for x in ROWS if alike(x[1])], ids=lambda x: x["name"] if isinstance(x, dict) else "")
def test_one_kind_for_all_arguments_is_that_kind_for_each(verb, row):
    if any(width == 1 for _, _, width in row["takes"]):
        pytest.skip("shapes of one number stand beside those of several")
    if any(kinds.count(alike(row)) > row["kinds"].count(alike(row)) for kinds in others(verb, row)):
        pytest.skip("there is a row of more such shapes, which is meant")
    arrays = columns(row, samples(row, 4))
    call = getattr(geograd, verb)
    expected, found = call(*arrays, **asked(row)), call(*arrays, kind=alike(row), to=row["gives"][0][1])
    for a, b in zip(*[x if isinstance(x, tuple) else (x,) for x in (expected, found)]):
        np.testing.assert_array_equal(np.asarray(a), np.asarray(b))


KINDS = ("Obb2", "Aabb2", "Vec2", "Vec3", "Segment2", "Circle", "Obb3")


@pytest.mark.parametrize("kind", KINDS)
def test_distances_of_plain_arrays_by_one_kind(kind):
    row = next(row for verb, row in ROWS if verb == "distance" and row["kinds"] == [kind, kind])
    a, b = columns(row, samples(row, 6))
    shape = getattr(geograd, kind)
    np.testing.assert_array_equal(geograd.distance(a, b, kind=kind), geograd.distance(shape(a), shape(b)))
    np.testing.assert_array_equal(geograd.distance(a, b, kind=shape), geograd.distance(shape(a), shape(b)))
    matrix = geograd.distance.all_pairs(shape(a), shape(b))
    np.testing.assert_array_equal(geograd.distance.all_pairs(a, b, kind=kind), matrix)
    for form in ("value_grad", "row_max"):
        found, expected = (getattr(geograd.distance, form)(*x) for x in ((shape(a), shape(b)), (shape(a), shape(b))))
        found = getattr(geograd.distance, form)(a, b, kind=kind)
        np.testing.assert_array_equal(found[0], expected[0])
    assert np.isfinite(geograd.distance.vjp(a, b, np.ones(6), kind=kind)[0]).all()


def test_lone_numbers_are_still_a_row():
    near = geograd.distance(np.array([1.0, 5.0]), np.array([3.0, 4.0]))
    np.testing.assert_array_equal(near, [2.0, 1.0])
    np.testing.assert_array_equal(geograd.distance(np.array([1.0, 5.0]), np.array([3.0, 4.0]), kind="number"), near)


def test_paths_need_no_kind_beside_that_of_an_array():
    points = np.array([[0.5, 0.5], [3.0, 0.0]])
    ring = geograd.Rings(np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]), [0, 4])
    np.testing.assert_array_equal(geograd.distance(points, ring, kind="Vec2"), [0.5, 2.0])


def test_the_distance_to_a_ring_says_that_it_is_to_its_edges():
    assert "also one inside" in geograd.distance.__doc__ and "signed distance where positive" in geograd.distance.__doc__


def test_shapes_are_equal_row_by_row():
    x = np.arange(15.0).reshape(3, 5)
    y = x.copy()
    y[1, 3] += 1
    a, b = geograd.Obb2(x), geograd.Obb2(y)
    np.testing.assert_array_equal(a == geograd.Obb2(x.copy()), [True, True, True])
    np.testing.assert_array_equal(a == b, [True, False, True])
    np.testing.assert_array_equal(a != b, [False, True, False])
    np.testing.assert_array_equal(a == geograd.Obb2(y.astype("f4")), [True, False, True])
    assert a[0] == geograd.Obb2(x[0]) and not a[0] != geograd.Obb2(x[0])
    np.testing.assert_array_equal(a == a[0], [True, False, False])
    assert not geograd.Vec2(1.0, 2.0) == geograd.Circle(1.0, 2.0, 3.0)
    assert not (a == None) and a != "a box"  # noqa: E711
    nan = geograd.Vec2(np.nan, 0.0)
    assert not nan == nan
    with pytest.raises(TypeError, match="unhashable"):
        hash(a)


def test_shapes_of_symbols_are_compared_by_numbers():
    @geograd.function
    def same(a: geograd.Vec2, b: geograd.Vec2):
        return np.where(a == b, 1.0, 0.0)

    with pytest.raises(TypeError, match="number by number"):
        same(np.zeros(2), np.zeros(2))


@pytest.mark.skipif(int(np.__version__.partition(".")[0]) < 2, reason="copy=False means something else before NumPy 2")
def test_no_copy_is_an_error_where_one_is_needed():
    x = np.arange(10.0).reshape(2, 5)
    shape = geograd.Obb2(x)
    assert np.shares_memory(np.asarray(shape, copy=False), x)
    assert np.shares_memory(np.asarray(shape, dtype=np.float64, copy=False), x)
    for wanted in (np.float32, ">f8", object):
        with pytest.raises(ValueError, match="copy"):
            np.asarray(shape, dtype=wanted, copy=False)
        assert np.asarray(shape, dtype=wanted).dtype == wanted
    assert np.asarray(shape, dtype=np.float32).dtype == np.float32
    copy = np.array(shape, copy=True)
    assert not np.shares_memory(copy, x) and (copy == x).all()
    columns = geograd._core.Columns([np.zeros(3), np.ones(3)])
    with pytest.raises(ValueError, match="copy"):
        np.asarray(geograd.Vec2(columns), copy=False)
    assert np.asarray(geograd.Vec2(columns)).shape == (3, 2)


@pytest.mark.parametrize("dtype", ["f4", "f8"])
def test_a_pose_moves_rigidly_whatever_the_length_of_its_rotation(dtype):
    segment = geograd.Segment2(np.array([0, 0, 1, 0], dtype))
    moved = geograd.move(geograd.Pose2(np.array([1, 1, 0, 0], dtype)), segment)
    np.testing.assert_allclose(np.asarray(moved), [0, 0, 0.5**0.5, 0.5**0.5], rtol=4 * np.finfo(dtype).eps)
    pose = np.array([3, 4, 10, 20], dtype)
    rigid = np.asarray(geograd.move(geograd.Pose2(pose), segment))
    np.testing.assert_allclose(rigid, [10, 20, 10.6, 20.8], rtol=4 * np.finfo(dtype).eps)
    for length in (0.2, 2.0, 1e15, 1e-15):
        scaled = pose * np.array([length, length, 1, 1], dtype)
        again = np.asarray(geograd.move(geograd.Pose2(scaled), segment))
        np.testing.assert_allclose(again, rigid, rtol=4 * np.finfo(dtype).eps)
    with pytest.raises(ValueError, match="`pose` item 0: rotation.cos and sin are both zero"):
        geograd.move(geograd.Pose2(np.zeros(4, dtype)), segment)


def test_a_camera_says_which_points_it_sees():
    camera = geograd.Pinhole([500, 500, 320, 240])
    points = np.array([[0.2, -0.1, 2], [1, 0, 0], [0, 0, 0], [0.2, -0.1, -2], [1, 0, 1e-4]])
    np.testing.assert_array_equal(geograd.sees(points, camera), [True, False, False, False, False])
    pixels = np.asarray(geograd.project(geograd.Vec3(points), camera))
    assert np.isfinite(pixels).all()
    np.testing.assert_array_equal(pixels[:2], [[370, 215], [320, 240]])
    assert geograd.sees(geograd.Vec3(points[0]), camera) and geograd.sees(points[0], camera).shape == ()
    both = geograd.Pinhole(np.array([[500, 500, 320, 240], [1, 1, 0, 0.0]]))
    assert geograd.sees(points[:, None], both).shape == (5, 2)
    assert geograd.sees(points.astype("f4"), camera).tolist() == [True, False, False, False, False]
    assert "sees" in geograd.project.__doc__
    with pytest.raises(TypeError, match="takes a camera"):
        geograd.sees(points, points)


def test_lenses_see_as_far_as_the_radius_grows():
    # r (1 - 0.2 r^2) grows until r^2 = 5 / 3.
    lens = geograd.BrownConrady([500, 500, 320, 240, -0.2, 0, 0, 0, 0])
    radii = np.array([0.5, 1.2, 1.35, 2.0])
    points = np.stack([radii, 0 * radii, 1 + 0 * radii], -1)
    np.testing.assert_array_equal(geograd.sees(points, lens), radii**2 < 5 / 3)
    fisheye = geograd.Fisheye([300, 300, 500, 500, 0, 0, 0, 0])
    angles = np.array([0.0, 1.0, np.pi / 2, 2.9, 3.1])
    points = np.stack([np.sin(angles), 0 * angles, np.cos(angles)], -1)
    np.testing.assert_array_equal(geograd.sees(points, fisheye), angles < 3)


ROOTS = {"numpy": np.sqrt, "geograd": geograd.sqrt, "power": lambda x: x**0.5}


@pytest.mark.filterwarnings("ignore:invalid value")
@pytest.mark.parametrize("name", ROOTS)
@pytest.mark.parametrize("dtype", ["f4", "f8"])
def test_roots_of_a_traced_function_are_those_of_numpy(name, dtype):
    root = ROOTS[name]
    traced = geograd.function(lambda x: root(x))
    x = np.array([-4, -1, -1e-30, 0, 1e-30, 1, 4, 9] * 40, dtype)
    np.testing.assert_array_equal(traced(x), np.sqrt(x))
    value, slope = traced.value_grad(x)
    np.testing.assert_array_equal(value, np.sqrt(x))
    with np.errstate(divide="ignore"):
        right = np.where(x == 0, 0, 0.5 / np.sqrt(x)).astype(dtype)
    np.testing.assert_allclose(slope, right, rtol=4 * np.finfo(dtype).eps)
    curved = traced.hessian(x)[..., 0, 0]
    assert np.isnan(curved[x < 0]).all() and (curved[x == 0] == 0).all()
    np.testing.assert_allclose(curved[x >= 1], -0.25 * x[x >= 1] ** -1.5, rtol=8 * np.finfo(dtype).eps)


@pytest.mark.filterwarnings("ignore:invalid value")
def test_roots_inside_of_choices_and_roots():
    chosen = geograd.function(lambda x: np.where(x > 0, np.sqrt(x), x))
    value, slope = chosen.value_grad(np.array([-4.0, 0.0, 4.0]))
    np.testing.assert_array_equal(value, [-4, 0, 2])
    np.testing.assert_array_equal(slope, [1, 1, 0.25])
    nested = geograd.function(lambda x: np.sqrt(np.log(x)))
    np.testing.assert_array_equal(np.isnan(nested(np.array([-1.0, 0.5, 1.0, 2.0]))), [True, True, False, False])
    length = geograd.function(lambda x, y: np.linalg.norm(np.array([x, y])))
    value, slopes = length.value_grad(np.array([3.0, 0.0]), np.array([4.0, 0.0]))
    np.testing.assert_array_equal(value, [5, 0])
    np.testing.assert_allclose(np.stack(slopes), [[0.6, 0], [0.8, 0]], rtol=1e-15)
