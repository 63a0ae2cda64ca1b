"""Shapes over indices of a shared array: the same bits as copied rows, and derivatives brought back to the array."""

import pickle

import numpy as np
import pytest

import geograd

RNG = np.random.default_rng(5)
VERTICES = RNG.standard_normal((300, 3))
FACES = np.stack([np.arange(900) % 300, (np.arange(900) * 7 + 1) % 300, (np.arange(900) * 11 + 2) % 300], axis=1)


def copied(shared=VERTICES, indices=FACES):
    return shared[indices].reshape(len(indices), -1)


@pytest.mark.parametrize("format", [np.float32, np.float64])
@pytest.mark.parametrize("whole", [np.int64, np.int32, np.uint32])
def test_every_form_has_the_bits_of_rows(format, whole):
    vertices = VERTICES.astype(format)
    own = geograd.Triangle3.indexed(vertices, FACES.astype(whole))
    rows = geograd.Triangle3(copied(vertices))
    points = geograd.Vec3(RNG.standard_normal((900, 3)).astype(format))
    for ours, theirs in [
        (geograd.area(own), geograd.area(rows)),
        (geograd.area.value_grad(own), geograd.area.value_grad(rows)),
        (geograd.distance.value_grad(points, own), geograd.distance.value_grad(points, rows)),
        (geograd.distance.value_grad(points[0], own), geograd.distance.value_grad(points[0], rows)),
        (geograd.distance.hessian(points, own), geograd.distance.hessian(points, rows)),
        (geograd.distance.jvp(points, own, points, own), geograd.distance.jvp(points, rows, points, rows)),
        (geograd.distance.all_pairs(points[:20], own), geograd.distance.all_pairs(points[:20], rows)),
        (geograd.distance.row_min(points, own), geograd.distance.row_min(points, rows)),
        (geograd.distance.sum_grad(points, own), geograd.distance.sum_grad(points, rows)),
        (own.array, rows.array),
        (own[3:9].array, rows[3:9].array),
        (own.numbers[4], rows.numbers[4]),
    ]:
        flat = lambda x: [part for one in x for part in flat(one)] if isinstance(x, tuple) else [np.asarray(x)]
        for one, other in zip(flat(ours), flat(theirs)):
            assert one.dtype == other.dtype
            np.testing.assert_array_equal(one, other)
    assert len(own) == 900 and repr(own) == repr(rows)
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(own)).array, rows.array)


def test_batches_and_one_row():
    batches = geograd.Vec3(RNG.standard_normal((2, 5, 3)))
    own, rows = geograd.Triangle3.indexed(VERTICES, FACES), geograd.Triangle3(copied())
    np.testing.assert_array_equal(geograd.distance.all_pairs(batches, own), geograd.distance.all_pairs(batches, rows))
    one = geograd.Triangle3.indexed(VERTICES, FACES[:1])
    np.testing.assert_array_equal(geograd.distance(batches[0], one), geograd.distance(batches[0], rows[:1]))
    none = geograd.Triangle3.indexed(VERTICES, np.zeros((0, 3), int))
    assert geograd.area(none).shape == (0,) and none.gathered(np.zeros((0, 9))).shape == (300, 3)


def test_own_functions_read_indices():
    @geograd.function
    def height(face: geograd.Triangle3, scale: float):
        return scale * (face.a.z + face.b.z + face.c.z)

    own, rows = geograd.Triangle3.indexed(VERTICES, FACES), geograd.Triangle3(copied())
    value, (by_face, by_scale) = height.value_grad(own, 2.0)
    expected, (by_rows, _) = height.value_grad(rows, 2.0)
    np.testing.assert_array_equal(value, expected)
    np.testing.assert_array_equal(by_face, by_rows)
    counts = np.bincount(FACES.ravel(), minlength=300)
    np.testing.assert_allclose(own.gathered(by_face)[:, 2], 2.0 * counts)
    assert by_scale.shape == (900,)


@pytest.mark.parametrize("format", [np.float32, np.float64])
def test_gathered_derivatives_are_those_of_the_sum(format):
    own = geograd.Triangle3.indexed(VERTICES.astype(format), FACES)
    _, by_face = geograd.area.value_grad(own)
    found = own.gathered(by_face)
    assert found.dtype == format and found.shape == (300, 3)
    expected = np.zeros((300, 3))
    np.add.at(expected, FACES.ravel(), np.asarray(by_face, float).reshape(-1, 3))
    np.testing.assert_array_equal(found, expected.astype(format))
    for k, axis in [(0, 0), (17, 2), (299, 1)]:
        moved = [VERTICES.copy(), VERTICES.copy()]
        for own_moved, step in zip(moved, (1e-6, -1e-6)):
            own_moved[k, axis] += step
        sums = [geograd.area(geograd.Triangle3.indexed(x, FACES)).sum() for x in moved]
        assert abs((sums[0] - sums[1]) / 2e-6 - found[k, axis]) < (1e-3 if format == np.float32 else 1e-6)


def test_listed_pairs_of_one_array():
    discs = np.array([[0.0, 0.0, 1.0], [3.0, 0.0, 1.0], [9.0, 0.0, 1.0]])
    left, right = geograd.Circle.indexed(discs, [0, 1]), geograd.Circle.indexed(geograd.Circle(discs), np.array([1, 2]))
    value, (by_left, by_right) = geograd.distance.value_grad(left, right)
    assert value.tolist() == [1.0, 4.0]
    both = left.gathered(by_left) + right.gathered(by_right)
    assert both[1].tolist() == [0.0, 0.0, -2.0]


def test_changes_of_the_shared_array_are_seen():
    vertices = VERTICES.copy()
    own = geograd.Triangle3.indexed(vertices, FACES)
    before = geograd.area(own)
    vertices *= 2.0
    np.testing.assert_allclose(geograd.area(own), 4.0 * before)


@pytest.mark.parametrize(
    ("make", "kind", "text"),
    [
        (lambda: geograd.Triangle3.indexed(VERTICES, [[0, 1, 300]]), ValueError, "item 0: index 300 in place 2"),
        (lambda: geograd.Triangle3.indexed(VERTICES, [[0, 1, 2], [0, -1, 2]]), ValueError, "item 1: index -1 in place 1"),
        (lambda: geograd.Triangle3.indexed(VERTICES, [[0, 1]]), ValueError, "2 of rows of 3 do not make it"),
        (lambda: geograd.Obb2.indexed(np.zeros((3, 1)), [[0, 1, 2, 0, 1]]), ValueError, "do not make it"),
        (lambda: geograd.Capsule2.indexed(np.zeros((3, 5)), [[[0]]]), ValueError, "takes rows of shape"),
        (lambda: geograd.Circle.indexed(np.zeros((3, 3)), [0.5]), TypeError, "whole numbers are needed"),
        (lambda: geograd.Triangle3.indexed(VERTICES, FACES).gathered(np.zeros((3, 9))), ValueError, "derivatives: an array"),
        (lambda: geograd.Vec3(VERTICES).gathered(VERTICES), TypeError, "no indices"),
    ],
)
def test_wrong_indices_are_named(make, kind, text):
    with pytest.raises(kind, match=text.replace("(", r"\(")):
        make()


def test_numbers_that_are_not_finite_name_the_row():
    vertices = VERTICES.copy()
    vertices[7, 1] = np.nan
    row = int(np.argmax((FACES == 7).any(1)))
    with pytest.raises(ValueError, match=f"item {row}: "):
        geograd.area(geograd.Triangle3.indexed(vertices, FACES))
