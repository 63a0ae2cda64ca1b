"""The harness on functions of Python."""

import numpy as np
import pytest

import geograd


@geograd.function
def turned(a: geograd.Obb2, b: geograd.Obb2):
    return 1 - geograd.iou(a, b) + 0.1 * (a.heading - b.heading) ** 2


def test_a_traced_function(capsys):
    reports = geograd.check(turned, samples=30)
    assert reports and reports.passed
    assert [report.dtype for report in reports] == ["float64", "float32"]
    assert all(report.samples > 30 for report in reports)
    assert "checked" in capsys.readouterr().out


def area(box: geograd.Obb2):
    return box.width * box.height


def right(box: geograd.Obb2):
    return [0 * box.x, 0 * box.x, box.height, box.width, 0 * box.x]


@pytest.mark.slow
def test_callables():
    assert geograd.check(area, right, samples=30, quiet=True)
    wrong = lambda box: [0.0, 0.0, box.height, 1.01 * box.width, 0.0]
    reports = geograd.check(area, wrong, samples=30, quiet=True)
    assert not reports
    reason, name, numbers = reports[0].failures[0]
    assert name == "box.height" and len(numbers) == 5
    assert "REFUSED" in str(reports) and "input = [" in str(reports)
    single = geograd.check(area, right, samples=30, quiet=True, dtype=np.float32)
    assert single and single[0].dtype == "float32"


def test_arrays_of_numbers():
    square = lambda x: (x**2).sum()
    assert geograd.check(square, lambda x: 2 * x, takes=4, samples=50, quiet=True)
    # A tenth of the inputs have another gradient by a millionth.
    steady = lambda x: 2 * x * (1 + 1e-6 * (x > 1))
    assert not geograd.check(square, steady, takes=1, samples=100, hard=False, quiet=True)
    pair = lambda x, y: np.array([x * y, x - y])
    vjp = lambda x, y, bar: (y * bar[0] + bar[1], x * bar[0] - bar[1])
    assert geograd.check(pair, vjp=vjp, takes=[float, float], samples=50, quiet=True)
    assert not geograd.check(pair, vjp=lambda x, y, bar: (y * bar[0], x * bar[0]), takes=[float, float], samples=50, quiet=True)


def test_domains_and_kinks():
    root = lambda x: np.sqrt(x)
    derivative = lambda x: 0.5 / np.sqrt(x)
    assert geograd.check(root, derivative, takes=[float], inside=lambda x: x > 1e-3, samples=50, quiet=True)
    larger = lambda x, y: max(x, y)
    assert geograd.check(larger, lambda x, y: (float(x > y) + 0.5 * (x == y), float(y > x) + 0.5 * (x == y)), takes=[float] * 2, quiet=True)
    both = lambda x, y: (float(x >= y), float(y >= x))
    assert not geograd.check(larger, both, takes=[float] * 2, points=[[1.0, 1.0]], quiet=True)


def test_what_is_refused():
    with pytest.raises(ZeroDivisionError):
        geograd.check(lambda x: 1 / 0, lambda x: x, takes=[float], quiet=True)
    with pytest.raises(ValueError, match="2 numbers where 1"):
        geograd.check(lambda x: x, lambda x: [x, x], takes=[float], quiet=True)
    with pytest.raises(TypeError, match="gradient is needed"):
        geograd.check(lambda x: x, takes=[float])
    with pytest.raises(TypeError, match="takes="):
        geograd.check(lambda x: x, lambda x: x)
    with pytest.raises(TypeError, match="__wrapped__"):
        geograd.check(turned, lambda a, b: a)
