"""Rotations as three angles: by matrices of turns about one axis, by SciPy, and by their derivatives."""

import numpy as np
import pytest

import geograd
from geograd._euler import ORDERS


def turn(axis, angle):
    """The matrix of a turn about an axis."""
    i, j = (axis + 1) % 3, (axis + 2) % 3
    made = np.eye(3)
    made[[i, i, j, j], [i, j, i, j]] = np.cos(angle), -np.sin(angle), np.sin(angle), np.cos(angle)
    return made


def matrix(q):
    """The matrix of a quaternion."""
    w, v = q[0] / np.linalg.norm(q), q[1:] / np.linalg.norm(q)
    cross = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return np.eye(3) + 2 * w * cross + 2 * cross @ cross


@pytest.mark.parametrize("order", ORDERS)
def test_rotations_are_products_of_turns_and_come_back(order):
    draw = np.random.default_rng(1)
    low, high = (0.0, np.pi) if order[0] == order[2] else (-np.pi / 2, np.pi / 2)
    angles = draw.uniform(-np.pi, np.pi, (50, 3))
    angles[:, 1] = draw.uniform(low, high, 50)
    made = geograd.from_euler(order, angles)
    for row, (a, b, c) in zip(made.array, angles):
        i, j, k = ["XYZ".index(axis) for axis in order]
        np.testing.assert_allclose(matrix(row), turn(i, a) @ turn(j, b) @ turn(k, c), atol=1e-14)
    np.testing.assert_allclose(geograd.euler(made, order), angles, atol=1e-7)
    # A quaternion of any length, of either sign.
    np.testing.assert_allclose(geograd.euler(made.array * -3.0, order), angles, atol=1e-7)
    rotation = pytest.importorskip("scipy.spatial.transform").Rotation
    other = rotation.from_quat(made.array[:, [1, 2, 3, 0]]).as_euler(order)
    np.testing.assert_allclose(geograd.euler(made, order), other, atol=1e-7)


@pytest.mark.parametrize("order", ORDERS)
def test_angles_share_what_is_not_determined(order):
    is_symmetric = order[0] == order[2]
    for middle in (0.0, np.pi) if is_symmetric else (-np.pi / 2, np.pi / 2):
        made = geograd.from_euler(order, [0.7, middle, 0.2])
        first, second, last = geograd.euler(made, order)
        assert abs(second - middle) < 1e-7
        if middle == 0.0:
            assert abs(first - 0.45) < 1e-15 and abs(last - 0.45) < 1e-15
        back = geograd.from_euler(order, [first, second, last])
        np.testing.assert_allclose(matrix(back.array), matrix(made.array), atol=1e-7)


def test_formats_and_mistakes():
    assert geograd.from_euler("ZYX", np.zeros((2, 5, 3), np.float32)).array.dtype == np.float32
    assert geograd.from_euler("ZYX", np.zeros((2, 5, 3))).array.shape == (2, 5, 4)
    assert geograd.euler(geograd.Rotation3([1.0, 0.0, 0.0, 0.0]), "XYX").shape == (3,)
    with pytest.raises(ValueError, match="order: one of XYZ"):
        geograd.from_euler("zyx", [0.0, 0.0, 0.0])
    with pytest.raises(ValueError, match="shape"):
        geograd.from_euler("ZYX", [[0.0, 0.0]])


def test_derivatives_of_a_recorded_function():
    @geograd.function
    def again(yaw: float, pitch: float, roll: float):
        turned = geograd.from_euler("ZYX", [yaw, pitch, roll])
        return sum(geograd.euler(turned, "XZX"))

    x = [0.3, -0.4, 0.9]
    value, gradient = again.value_grad(*x)
    assert abs(value - geograd.euler(geograd.from_euler("ZYX", x), "XZX").sum()) < 1e-14
    for k in range(3):
        ends = []
        for step in (-1e-6, 1e-6):
            there = list(x)
            there[k] += step
            ends.append(again(*there))
        assert abs((ends[1] - ends[0]) / 2e-6 - gradient[k]) < 1e-8

    @geograd.function
    def back(yaw: float, pitch: float, roll: float):
        first, middle, last = geograd.euler(geograd.from_euler("ZYX", [yaw, pitch, roll]), "ZYX")
        return first + 2.0 * middle + 3.0 * last

    np.testing.assert_allclose(back.value_grad(*x)[1], [1.0, 2.0, 3.0], rtol=1e-13)
    # Far from the ends of the ranges, where angles jump.
    within = lambda *angles: max(map(abs, angles)) < 1.4
    # Angles have the digits of right angles, small ones, too.
    assert geograd.check(back, inside=within, resolution=2e-6, quiet=True).passed
