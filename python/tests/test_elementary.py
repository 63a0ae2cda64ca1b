"""NumPy's elementary functions in functions that are recorded: their values and derivatives, near their limits, too."""

import math

import numpy as np
import pytest

import geograd
from geograd._elementary import ELEMENTARY

SMALL = [1e-300, 1e-200, 1e-30, 1e-12, 3e-9, 1e-5, 1e-3]
MIDDLE = [0.01, 0.1, 0.3, 0.4999999, 0.5, 0.5000001, 0.7, 0.999, 0.9999999999999999]
LARGE = [1.0, 1.0000000000000002, 1.5, 2.0, 3.7, 8.0, 19.0, 33.0]
HUGE = [1e3, 1e8, 1e16, 1e30, 1e150, 1e300]
#: Positive inputs, whether their negatives are, too, the derivative, and how many units in the last place are allowed.
FUNCTIONS = {
    "sinh": ([*SMALL, *MIDDLE, *LARGE, 700.0, 710.4], True, np.cosh),
    "cosh": ([*SMALL, *MIDDLE, *LARGE, 700.0, 710.4], True, np.sinh),
    "tanh": ([*SMALL, *MIDDLE, *LARGE, *HUGE], True, lambda x: 1 / np.cosh(np.minimum(abs(x), 700)) ** 2),
    "arcsinh": ([*SMALL, *MIDDLE, *LARGE, *HUGE], True, lambda x: 1 / np.hypot(1, x)),
    "arccosh": ([1.0 + x for x in SMALL if x > 1e-8] + LARGE[1:] + HUGE, False, lambda x: 1 / np.sqrt(x - 1) / np.sqrt(x + 1)),
    "arctanh": ([*SMALL, *MIDDLE], True, lambda x: 1 / ((1 - x) * (1 + x))),
    "arcsin": ([*SMALL, *MIDDLE], True, lambda x: 1 / np.sqrt((1 - x) * (1 + x))),
    "arccos": ([*SMALL, *MIDDLE], True, lambda x: -1 / np.sqrt((1 - x) * (1 + x))),
    "arctan": ([*SMALL, *MIDDLE, *LARGE, *HUGE[:-2]], True, lambda x: 1 / (1 + x * x)),
    "expm1": ([*SMALL, *MIDDLE, *LARGE, 700.0], True, np.exp),
    "log1p": ([*SMALL, *MIDDLE, *LARGE, *HUGE], False, lambda x: 1 / (1 + x)),
    "log2": ([*SMALL[1:], *MIDDLE, *LARGE, *HUGE], False, lambda x: 1 / (x * math.log(2))),
    "log10": ([*SMALL[1:], *MIDDLE, *LARGE, *HUGE], False, lambda x: 1 / (x * math.log(10))),
    "cbrt": ([*SMALL[1:], *MIDDLE, *LARGE, *HUGE], True, lambda x: np.cbrt(x) / (3 * x)),
    "exp2": ([*SMALL, *MIDDLE, *LARGE], True, lambda x: math.log(2) * np.exp2(x)),
}


def recorded(name):
    ufunc = getattr(np, name)
    return geograd.function(lambda x: ufunc(x))


def inputs(name, dtype):
    positive, has_negative, _ = FUNCTIONS[name]
    limits = np.finfo(dtype)
    x = np.array([x for x in positive if float(limits.tiny) < x < float(limits.max)], dtype)
    return np.concatenate([x, -x]) if has_negative else x


@pytest.mark.parametrize("dtype", ["f8", "f4"])
@pytest.mark.parametrize("name", FUNCTIONS)
def test_values_and_derivatives(name, dtype):
    x = inputs(name, dtype)
    with np.errstate(all="ignore"):
        expected = getattr(np, name)(x.astype("f8"))
        slopes = FUNCTIONS[name][2](x.astype("f8"))
    most = float(np.finfo(dtype).max)
    ordinary = (abs(expected) < most) & (abs(slopes) < most / 4) & ((abs(slopes) > 1 / most) | (slopes == 0))
    x, expected, slopes = x[ordinary], expected[ordinary], slopes[ordinary]
    assert len(x) > 8
    value, slope = recorded(name).value_grad(x)
    unit = np.finfo(dtype).eps
    # An exponent is rounded once for each unit of it.
    units = 4 * (1 + abs(x)) if name == "exp2" else 4
    np.testing.assert_array_less(abs(value - expected), units * unit * abs(expected) + np.finfo(dtype).tiny)
    # By cosh(x) ** 2, which the reference rounds, too.
    np.testing.assert_array_less(abs(slope - slopes), 4 * units * unit * abs(slopes) + np.finfo(dtype).tiny)


@pytest.mark.parametrize("name, second", [("sinh", np.sinh), ("cosh", np.cosh), ("tanh", lambda x: -2 * np.tanh(x) / np.cosh(x) ** 2)])
def test_second_derivatives_keep_their_digits_near_zero(name, second):
    x = np.array([*SMALL[2:], *MIDDLE, 1.0, 2.0])
    np.testing.assert_allclose(recorded(name).hessian(x)[:, 0, 0], second(x), rtol=1e-13)


@pytest.mark.parametrize(
    "name, x, expected",
    [
        ("sinh", -0.0, 0.0), ("sinh", 800.0, np.inf), ("sinh", -800.0, -np.inf), ("cosh", -800.0, np.inf), ("tanh", -800.0, -1.0),
        ("arcsinh", -1e308, -math.asinh(1e308)), ("arctanh", 1.0, np.inf), ("arctanh", -1.0, -np.inf), ("arctanh", 1.5, np.nan),
        ("arccosh", 1.0, 0.0), ("arccosh", 0.5, np.nan), ("arcsin", 1.0, math.pi / 2), ("arcsin", -1.0, -math.pi / 2),
        ("arcsin", 1.1, np.nan), ("arccos", 1.0, 0.0), ("arccos", -1.0, math.pi), ("arccos", -1.1, np.nan), ("expm1", -800.0, -1.0),
        ("expm1", 800.0, np.inf), ("log1p", -1.0, -np.inf), ("log1p", -2.0, np.nan), ("log2", 0.0, -np.inf), ("log2", -1.0, np.nan),
        ("cbrt", 0.0, 0.0), ("cbrt", -27.0, -3.0), ("floor", -0.5, -1.0), ("ceil", -0.5, 0.0), ("trunc", -1.5, -1.0), ("rint", 2.5, 2.0),
        ("rint", -3.5, -4.0), ("floor", 1e300, 1e300), ("floor", 4503599627370495.5, 4503599627370495.0), ("sign", -3.0, -1.0),
        ("sign", 0.0, 0.0),
    ],
)
def test_ends(name, x, expected):
    found = recorded(name)(x)
    np.testing.assert_allclose(found, expected, rtol=4e-16)


@pytest.mark.parametrize("name", [name for name, count in ELEMENTARY.items() if count == 1])
def test_nan_passes(name):
    assert np.isnan(geograd.function(lambda x: getattr(np, name)(np.log(x)))(-1.0)), name


def test_roundings_have_no_derivative():
    x = np.array([-2.5, -0.3, 0.5, 7.9, 1e20])
    for name in ("floor", "ceil", "trunc", "rint", "sign"):
        value, slope = geograd.function(lambda x: getattr(np, name)(x)).value_grad(x)
        np.testing.assert_array_equal(value, getattr(np, name)(x))
        np.testing.assert_array_equal(slope, 0)


def test_remainders_are_those_of_numpy():
    rng = np.random.default_rng(3)
    a, b = rng.uniform(-50, 50, (2, 2000))
    whole = np.round(rng.uniform(-9, 9, 200))
    a, b = np.concatenate([a, whole, 3 * whole, [0.0, -1e-20]]), np.concatenate([b, whole + 0.5, whole + 0.5, [1.0, 1.0]])
    rest = geograd.function(lambda a, b: a % b)
    value, (by_a, by_b) = rest.value_grad(a, b)
    np.testing.assert_allclose(value, a % b, atol=1e-13)
    np.testing.assert_array_equal(by_a, 1)
    np.testing.assert_allclose(by_b, -np.floor(a / b), atol=1)
    np.testing.assert_array_equal(geograd.function(lambda a, b: np.mod(a, b))(a, b), value)
    np.testing.assert_array_equal(geograd.function(lambda a, b: a // b)(a, b), a // b)
    np.testing.assert_allclose(geograd.function(lambda a: a % 2.0)(a), a % 2.0, atol=1e-13)
    np.testing.assert_allclose(geograd.function(lambda b: 2.0 % b)(b), 2.0 % b, atol=1e-13)


@pytest.mark.parametrize("p", [0, 1, 3, -2, 65, -100, 0.5, -0.5, 1.5, 2.5, 0.3, -0.3, 7.25, 1 / 3])
def test_powers(p):
    x = np.array([0.1, 0.2, 1.0, 1.7, 13.0])
    power = geograd.function(lambda x: x**p)
    value, slope = power.value_grad(x)
    np.testing.assert_allclose(value, x**p, rtol=2e-14)
    np.testing.assert_allclose(slope, p * x ** (p - 1.0), rtol=2e-14)
    below = np.array([-2.0, -0.5])
    with np.errstate(invalid="ignore"):
        np.testing.assert_allclose(power(below), below**p, rtol=1e-13)
    with np.errstate(divide="ignore"):
        assert power(0.0) == np.float64(0.0) ** p
    if p > 1:
        assert power.value_grad(0.0)[1] == 0


def test_powers_of_symbols():
    x, y = np.array([0.3, 2.0, 5.0]), np.array([1.7, -2.0, 0.5])
    of_symbols = geograd.function(lambda x, y: x**y)
    value, (by_x, by_y) = of_symbols.value_grad(x, y)
    np.testing.assert_allclose(value, x**y, rtol=1e-14)
    np.testing.assert_allclose(by_x, y * x ** (y - 1), rtol=1e-14)
    np.testing.assert_allclose(by_y, x**y * np.log(x), rtol=1e-14)
    np.testing.assert_array_equal(of_symbols([0.0, 0.0, 0.0], [2.0, 0.0, -1.0]), [0.0, 1.0, np.inf])
    assert np.isnan(of_symbols(-1.0, 2.5))
    np.testing.assert_allclose(geograd.function(lambda y: 2**y)(y), 2**y, rtol=1e-14)
    np.testing.assert_allclose(geograd.function(lambda x, y: np.power(x, y))(x, y), x**y, rtol=1e-14)


def test_the_logarithm_of_exponentials():
    a = np.array([0.0, 1000.0, -1000.0, 3.0, 0.0, -np.inf, np.inf])[:5]
    b = np.array([0.0, 1000.0, -1000.5, -40.0, -800.0])
    both = geograd.function(lambda a, b: np.logaddexp(a, b))
    value, (by_a, by_b) = both.value_grad(a, b)
    np.testing.assert_allclose(value, np.logaddexp(a, b), rtol=1e-15)
    np.testing.assert_allclose(by_a, 1 / (1 + np.exp(b - a)), rtol=1e-15)
    np.testing.assert_allclose(by_b, np.exp(b - a) / (1 + np.exp(b - a)), rtol=1e-13, atol=1e-300)
    np.testing.assert_allclose(both.hessian(0.0, 0.0), [[0.25, -0.25], [-0.25, 0.25]], rtol=1e-15)
    # A small sum of large terms: ln(1 + 1e-12).
    assert both(0.0, math.log(1e-12)) == pytest.approx(1e-12, rel=1e-13)


@pytest.mark.parametrize("name", [name for name, count in ELEMENTARY.items() if count == 1 and name != "sign"])
def test_arrays_of_symbols_have_them(name):
    x = np.array([1.25, 1.5]) if name == "arccosh" else np.array([0.25, 0.5])
    each = geograd.function(_of_two(name))
    np.testing.assert_allclose(each(x), getattr(np, name)(x).sum(), rtol=1e-14)


def _of_two(name):
    def of_two(q: 2):
        return sum(getattr(np, name)(np.array([q[0], q[1]])))

    return of_two


def test_functions_of_numbers_are_those_of_numpy():
    for name, count in ELEMENTARY.items():
        x = np.array([1.5, 1.25]) if name in ("arccosh", "power") else np.array([0.5, 0.25])
        np.testing.assert_array_equal(getattr(geograd, name)(*[x] * count), getattr(np, name)(*[x] * count))
        assert name in geograd.__all__ and getattr(geograd, name).__doc__.endswith(".")
