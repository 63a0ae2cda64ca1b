"""Rotations of space as three angles, of arrays and of symbols."""

import numpy as np

from . import _core
from ._elementary import arctan2, cos, hypot, sin, where
from ._shapes import CLASSES

ORDERS = ("XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX", "XYX", "XZX", "YXY", "YZY", "ZXZ", "ZYZ")


def _axes(order):
    if order not in ORDERS:
        raise ValueError(f"order: one of {', '.join(ORDERS)} is needed, not {order!r}")
    return ["XYZ".index(axis) for axis in order]


def _times(a, b):
    """The rotation b, then a, as quaternions."""
    return (
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    )


def from_euler(order, angles):
    """The rotations of three angles in radians about the axes that the order names, each an axis of the body as the turns
    before have left it: ``"ZYX"`` takes yaw, pitch, roll. SciPy has the same capital letters.

    ``angles`` are an array of shape ``(..., 3)``, or three numbers or symbols of a :class:`geograd.function`.
    """
    axes = _axes(order)
    if not any(isinstance(angle, _core.Symbol) for angle in angles):
        array = np.asarray(angles)
        if array.ndim == 0 or array.shape[-1] != 3:
            raise ValueError(f"angles: an array of shape (..., 3) is needed, not {array.shape}")
        angles = np.moveaxis(array if array.dtype == np.float32 else array.astype(np.float64), -1, 0)
    turns = []
    for axis, angle in zip(axes, angles):
        half = angle * 0.5
        turn = [cos(half), half * 0.0, half * 0.0, half * 0.0]
        turn[axis + 1] = sin(half)
        turns.append(turn)
    return CLASSES["Rotation3"](*_times(_times(turns[0], turns[1]), turns[2]))


def _wrapped(angle):
    """An angle from -2 pi to 2 pi, brought to -pi to pi."""
    angle = where(angle > np.pi, angle - 2 * np.pi, angle)
    return where(angle < -np.pi, angle + 2 * np.pi, angle)


def euler(rotation, order):
    """The three angles in radians of rotations about the axes that the order names, as :func:`geograd.from_euler` takes
    them: an array of shape ``(..., 3)``, or of symbols a tuple.

    The first and the third are from -pi to pi, the middle one from -pi/2 to pi/2, or from 0 to pi where the first and the
    third axis are equal. Exactly at either end of the middle one's range only the sum or the difference of the others is
    determined: they share it equally.
    """
    axes = _axes(order)
    if not isinstance(rotation, CLASSES["Rotation3"]):
        rotation = CLASSES["Rotation3"](rotation)
    numbers = rotation.w, rotation.x, rotation.y, rotation.z
    # Bernardes and Viollet, Quaternion to Euler angles conversion, PLoS ONE 2022. They turn about fixed axes: these are
    # the angles in reverse order. Angles of two numbers need no quaternion of length one.
    w, *at = numbers
    k, j, i = axes
    is_symmetric = i == k
    k = 3 - i - j if is_symmetric else k
    is_odd = (j - i) % 3 != 1
    third = -at[k] if is_odd else at[k]
    a, b, c, d = (w, at[i], at[j], third) if is_symmetric else (w - at[j], at[i] + third, at[j] + w, third - at[i])
    middle = 2.0 * arctan2(hypot(c, d), hypot(a, b))
    half_sum, half_difference = arctan2(b, a), arctan2(d, c)
    first, last = half_sum - half_difference, half_sum + half_difference
    if not is_symmetric:
        middle = middle - np.pi / 2
        last = -last if is_odd else last
    made = _wrapped(last), middle, _wrapped(first)
    return made if isinstance(middle, _core.Symbol) else np.stack(made, -1)
