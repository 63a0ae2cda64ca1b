"""Every row of the table in every form, against its recorded program run one item at a time, differences, and sums of its own."""

import numpy as np
import pytest
from conftest import asked, columns, fixed_rows, samples

import geograd

ROWS = fixed_rows()
STRAIGHT = [(verb, row) for verb, row in ROWS if row["sort"] == "straight"]


def ids(rows):
    return [row["name"] for _, row in rows]


def results(row, value):
    """All numbers of the results of every item."""
    parts = value if isinstance(value, tuple) else (value,)
    count = len(parts[0])
    return np.concatenate([np.asarray(part).reshape(count, -1) for part in parts], 1)


def one_number(row):
    return len(row["gives"]) == 1 and row["gives"][0][2] == 0


def differing(a, b, size=None):
    """The largest difference as a share of the size of the numbers."""
    size = np.abs(b).max(initial=1e-300) if size is None else size
    return np.abs(a - b).max(initial=0.0) / max(size, 1e-300)


@pytest.mark.parametrize(("verb", "row"), ROWS, ids=ids(ROWS))
def test_values(verb, row):
    call = getattr(geograd, verb)
    numbers = samples(row)
    assert len(numbers) == 24, "no valid inputs"
    arguments = columns(row, numbers)
    value = results(row, call(*arguments, **asked(row)))
    assert value.shape[0] == 24 and np.isfinite(value).all()
    # One by one, and by shapes.
    for i in (0, 23):
        one = call(*[argument[i] for argument in arguments], **asked(row))
        np.testing.assert_array_equal(results(row, tuple(np.asarray(x)[None] for x in one) if isinstance(one, tuple) else np.asarray(one)[None])[0], value[i])
    dressed = [getattr(geograd, kind)(argument) if size else argument for argument, (_, kind, size) in zip(arguments, row["takes"])]
    np.testing.assert_array_equal(results(row, call(*dressed, to=asked(row)["to"])), value)
    if row["sort"] == "straight":
        program = call.program(**asked(row))
        expected = np.array([program.eval(list(item)) for item in numbers])
        assert differing(value, expected) < 1e-12
    # In single precision to its digits, of what is as well conditioned as that.
    single = results(row, call(*columns(row, numbers, np.float32), **asked(row)))
    assert single.dtype == np.float32
    assert np.median(np.abs(single - value)) <= 1e-4 * (1 + np.abs(value).max())


@pytest.mark.parametrize(("verb", "row"), ROWS, ids=ids(ROWS))
def test_gradients(verb, row):
    call = getattr(geograd, verb)
    numbers = samples(row)
    arguments = columns(row, numbers)
    upstream = [np.random.default_rng(1).normal(size=(24, size) if size else 24) for _, _, size in row["gives"]]
    bars = call.vjp(*arguments, *upstream, **asked(row))
    bars = bars if isinstance(bars, tuple) else (bars,)
    for bar, argument in zip(bars, arguments):
        assert bar.shape == argument.shape and bar.dtype == np.float64
    flat = np.concatenate([bar.reshape(24, -1) for bar in bars], 1)
    if one_number(row):
        value, by = call.value_grad(*arguments, **asked(row))
        by = by if isinstance(by, tuple) else (by,)
        np.testing.assert_array_equal(value, call(*arguments, **asked(row)))
        derivatives = np.concatenate([one.reshape(24, -1) for one in by], 1)
        scaled = derivatives * upstream[0][:, None]
        if row["sort"] == "straight":
            assert differing(flat, scaled) < 1e-9
    if row["sort"] == "straight":
        program = call.program(form="vjp", **asked(row))
        cotangents = np.concatenate([x.reshape(24, -1) for x in upstream], 1)
        expected = np.array([program.eval([*item, *bar]) for item, bar in zip(numbers, cotangents)])
        assert differing(flat, expected) < 1e-12


@pytest.mark.parametrize(("verb", "row"), STRAIGHT, ids=ids(STRAIGHT))
def test_derivatives_agree_with_each_other(verb, row):
    call = getattr(geograd, verb)
    numbers = samples(row, 6)
    arguments = columns(row, numbers)
    directions = [np.random.default_rng(k).normal(size=argument.shape) for k, argument in enumerate(arguments)]
    jacobian = call.jacobian(*arguments, **asked(row)).reshape(6, -1, numbers.shape[1])
    along = np.concatenate([x.reshape(6, -1) for x in directions], 1)
    _, derivative = call.jvp(*arguments, *directions, **asked(row))
    expected = np.einsum("nij,nj->ni", jacobian, along)
    size = np.einsum("nij,nj->ni", np.abs(jacobian), np.abs(along)).max(initial=1e-300)
    assert differing(results(row, derivative), expected, size) < 1e-9
    if one_number(row) and numbers.shape[1] <= 12:
        hessian = call.hessian(*arguments, **asked(row))
        # Second derivatives of what is linear are rounding alone.
        size = max(np.abs(hessian).max(), 1e-8 * np.abs(jacobian).max())
        assert differing(hessian, np.swapaxes(hessian, 1, 2), size) < 1e-6
        products = call.hvp(*arguments, *directions, **asked(row))
        products = products if isinstance(products, tuple) else (products,)
        products = np.concatenate([x.reshape(6, -1) for x in products], 1)
        expected = np.einsum("nij,nj->ni", hessian, along)
        assert differing(products, expected, size * np.abs(along).max() * numbers.shape[1]) < 1e-6


PAIRS = [(verb, row) for verb, row in ROWS if len(row["takes"]) == 2 and one_number(row)]


@pytest.mark.parametrize(("verb", "row"), PAIRS, ids=ids(PAIRS))
def test_pairs(verb, row):
    call = getattr(geograd, verb)
    a, b = columns(row, samples(row, 12))
    b = b[:7]
    by = {"kind": asked(row)["kind"]}
    matrix = call.all_pairs(a, b, **by)
    assert matrix.shape == (12, 7)
    size = np.abs(matrix).max(initial=1e-300)
    for i in (0, 11):
        row_of = call(a[i], b, **by)
        assert differing(matrix[i], row_of, size) < 1e-12
    largest, place = call.row_max(a, b, **by)
    np.testing.assert_array_equal(largest, matrix.max(1))
    np.testing.assert_array_equal(place, matrix.argmax(1))
    largest, place = call.column_max(a, b, **by)
    np.testing.assert_array_equal(largest, matrix.max(0))
    np.testing.assert_array_equal(place, matrix.argmax(0))
    threshold = float(np.median(matrix))
    rows_of, columns_of, values = call.above(a, b, threshold, **by)
    expected = np.argwhere(matrix > threshold)
    np.testing.assert_array_equal(np.stack([rows_of, columns_of], 1), expected)
    np.testing.assert_array_equal(values, matrix[rows_of, columns_of])
    assert call.count_above(a, b, threshold, **by) == len(expected)
    np.testing.assert_allclose(call.sum(a, b, **by), matrix.sum(), rtol=1e-9, atol=1e-9 * size)
    np.testing.assert_allclose(call.mean(a, b, **by), matrix.mean(), rtol=1e-9, atol=1e-9 * size)
    ones = np.ones_like(matrix)
    pulled = call.all_pairs_vjp(a, b, ones, **by)
    total, derivatives = call.sum_grad(a, b, **by)
    mean, shares = call.mean_grad(a, b, **by)
    np.testing.assert_allclose([total, mean], [call.sum(a, b, **by), call.mean(a, b, **by)], rtol=1e-12)
    for one, two, share, argument in zip(pulled, derivatives, shares, (a, b)):
        assert one.shape == argument.shape
        np.testing.assert_allclose(one, two, rtol=1e-9, atol=1e-9 * max(np.abs(two).max(), 1e-300))
        if row["sort"] == "straight":
            np.testing.assert_allclose(share * matrix.size, two, rtol=1e-9, atol=1e-9 * max(np.abs(two).max(), 1e-300))
