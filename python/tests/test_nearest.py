"""The nearest of many gives what a search through all pairs gives."""

import numpy as np
import pytest

import geograd

RNG = np.random.default_rng(31)


def rods(count, dtype=np.float64):
    start = RNG.uniform(-3, 3, (count, 3))
    return np.concatenate([start, start + RNG.uniform(-1, 1, (count, 3)), RNG.uniform(0, 0.2, (count, 1))], 1).astype(dtype)


def balls(count, dtype=np.float64):
    made = np.concatenate([RNG.uniform(-3, 3, (count, 3)), RNG.uniform(0, 0.5, (count, 1))], 1).astype(dtype)
    made[count // 2] = made[0]
    return made


KIND = {"kind": ("Capsule3", "Sphere")}
VERBS = [geograd.distance, geograd.signed_distance]


def first_least(matrix, axis, within=np.inf):
    """The least of a matrix along an axis and its first place; inf and -1 beyond a cap."""
    places, values = matrix.argmin(axis), matrix.min(axis)
    return np.where(values <= within, values, np.inf), np.where(values <= within, places, -1)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("verb", VERBS)
def test_least_of_rows_and_columns(verb, dtype):
    if verb is geograd.distance:
        a, b, kind = rods(20, dtype), rods(600, dtype), {"kind": "Capsule3"}
    else:
        a, b, kind = rods(20, dtype)[:, :3].copy(), balls(600, dtype), {"kind": ("Vec3", "Sphere")}
    matrix = verb.all_pairs(a, b, **kind)
    for within in (None, 0.3, 0.0, -0.05):
        cap = np.inf if within is None else dtype(within)
        for form, axis in ((verb.row_min, 1), (verb.column_min, 0)):
            values, places = form(a, b, within=within, **kind)
            expected = first_least(matrix, axis, cap)
            assert values.dtype == dtype
            np.testing.assert_array_equal(values, expected[0])
            np.testing.assert_array_equal(places, expected[1])
        value, row, column = verb.nearest(a, b, within=within, **kind)
        best = matrix.min()
        expected = (best, *np.unravel_index(matrix.argmin(), matrix.shape)) if best <= cap else (np.inf, -1, -1)
        assert (value, row, column) == expected
    rows, columns, values = verb.below(a, b, 0.2, **kind)
    expected = np.nonzero(matrix < dtype(0.2))
    np.testing.assert_array_equal(rows, expected[0])
    np.testing.assert_array_equal(columns, expected[1])
    np.testing.assert_array_equal(values, matrix[expected])
    assert verb.count_below(a, b, 0.2, **kind) == len(rows)


def test_batches_and_empty_lists():
    a, b, kind = np.stack([rods(4), rods(4)]), rods(9), {"kind": "Capsule3"}
    values, places = geograd.distance.row_min(a, b, **kind)
    assert values.shape == places.shape == (2, 4)
    value, row, column = geograd.distance.nearest(a, b, **kind)
    assert value.shape == row.shape == column.shape == (2,)
    np.testing.assert_array_equal(value, values.min(1))
    values, places = geograd.distance.row_min(a, b[:0], **kind)
    assert (values == np.inf).all() and (places == -1).all() and values.shape == (2, 4)
    assert geograd.distance.nearest(a[0], b[:0], **kind) == (np.inf, -1, -1)
    assert len(geograd.distance.below(a[0], b[:0], 1.0, **kind)[0]) == 0


def test_groups():
    a, b, kind = rods(12), rods(30), {"kind": "Capsule3"}
    groups = ([0, 5, 5, 12], [0, 10, 11, 30])
    matrix = geograd.distance.all_pairs(a, b, **kind)
    own = [np.repeat(np.arange(3), np.diff(offsets)) for offsets in groups]
    inside = np.where(own[0][:, None] == own[1], matrix, np.inf)
    for form, axis in ((geograd.distance.row_min, 1), (geograd.distance.column_min, 0)):
        values, places = form(a, b, groups=groups, **kind)
        np.testing.assert_array_equal(values, inside.min(axis))
        np.testing.assert_array_equal(places, np.where(np.isfinite(inside.min(axis)), inside.argmin(axis), -1))
    values, rows, columns = geograd.distance.nearest(a, b, groups=groups, **kind)
    np.testing.assert_array_equal(values[[0, 2]], [inside[:5].min(), inside[5:].min()])
    assert values[1] == np.inf and rows[1] == columns[1] == -1
    np.testing.assert_array_equal(inside[rows[[0, 2]], columns[[0, 2]]], values[[0, 2]])
    rows, columns, _ = geograd.distance.below(a, b, 0.5, groups=groups, **kind)
    np.testing.assert_array_equal((rows, columns), np.nonzero(inside < 0.5))


def test_gradients():
    a, b, kind = rods(6), rods(40), {"kind": "Capsule3"}
    (values, places), (by_a, by_b) = geograd.signed_distance.row_min_grad(a, b, **kind)
    expected, (own, other) = geograd.signed_distance.value_grad(a, b[places], **kind)
    np.testing.assert_array_equal(values, expected)
    np.testing.assert_array_equal(by_a, own)
    summed = np.zeros_like(b)
    np.add.at(summed, places, other)
    np.testing.assert_allclose(by_b, summed, atol=1e-15)
    (value, row, column), (by_a, by_b) = geograd.signed_distance.nearest_grad(a, b, **kind)
    assert value == values.min() and np.count_nonzero(by_a.any(1)) == np.count_nonzero(by_b.any(1)) == 1
    # Equal results share the gradient.
    point, twice = np.zeros((1, 2)), np.array([[3.0, 0.0], [0.0, 3.0], [9.0, 9.0]])
    (values, places), (by_a, by_b) = geograd.distance.row_min_grad(point, twice, kind="Vec2")
    assert (values[0], places[0]) == (3.0, 0)
    np.testing.assert_array_equal(by_a, [[-0.5, -0.5]])
    np.testing.assert_array_equal(by_b, [[0.5, 0.0], [0.0, 0.5], [0.0, 0.0]])
    (values, _), (by_a, _) = geograd.distance.column_min_grad(point, twice, within=5.0, kind="Vec2")
    np.testing.assert_array_equal(values, [3.0, 3.0, np.inf])
    np.testing.assert_array_equal(by_a, [[-1.0, -1.0]])


def test_own_functions():
    @geograd.function
    def way(a: geograd.Vec2, b: geograd.Circle):
        return geograd.distance(a, b) + 0.25

    @geograd.function
    def back(a: geograd.Vec2, b: geograd.Vec2):
        return -geograd.distance(a, b)

    a, b = RNG.uniform(-3, 3, (8, 2)), np.concatenate([RNG.uniform(-3, 3, (50, 2)), RNG.uniform(0, 0.3, (50, 1))], 1)
    matrix = way.all_pairs(a, b)
    for lower in (None, "distance"):
        values, places = way.row_min(a, b, lower=lower)
        np.testing.assert_array_equal(values, matrix.min(1))
        np.testing.assert_array_equal(places, matrix.argmin(1))
    # A bound that does not hold shows that pairs are skipped.
    line = np.stack([np.arange(1.0, 101), np.zeros(100)], 1)
    assert back.row_min(line[:1] * 0, line)[1] == [99]
    assert back.row_min(line[:1] * 0, line, lower="distance")[1] < [50]


def test_bad_arguments():
    a, kind = rods(2), {"kind": "Capsule3"}
    with pytest.raises(TypeError, match="within: a number is needed"):
        geograd.distance.row_min(a, a, within="near", **kind)
    with pytest.raises(ValueError, match="threshold"):
        geograd.distance.row_min(a, a, within=np.nan, **kind)
    with pytest.raises(ValueError, match="threshold"):
        geograd.distance.below(a, a, np.inf, **kind)
    with pytest.raises(ValueError, match="lower: "):
        geograd.distance.row_min(a, a, lower="far", **kind)
    with pytest.raises(TypeError, match="lower: a name is needed"):
        geograd.distance.row_min(a, a, lower=3, **kind)
    bad = a.copy()
    bad[1, 0] = np.nan
    with pytest.raises(ValueError, match="item 1"):
        geograd.distance.row_min(a, bad, **kind)
    with pytest.raises(ValueError, match="groups"):
        geograd.distance.row_min(a, a, groups=([0, 1], [0, 2]), **kind)
