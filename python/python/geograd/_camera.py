"""Cameras: which points they see."""

import numpy as np

from . import _core
from ._shapes import CLASSES

_CAMERAS = ("Pinhole", "BrownConrady", "Fisheye")


def sees(points, camera):
    """Whether each camera sees each point of its frame: an array of truths, over the leading axes of both.

    ``points`` are a :class:`geograd.Vec3` or an array of shape ``(..., 3)``, ``camera`` a :class:`geograd.Pinhole`,
    :class:`geograd.BrownConrady` or :class:`geograd.Fisheye`. :func:`geograd.project` gives a pixel for every point, the
    principal point for those of the camera's plane; where the camera does not see the point, the pixel means nothing. A
    camera sees what is ahead of it, by more than a thousandth of the distance from its axis, and a lens what it does not
    map to the pixel of a point closer to the axis. A fisheye sees up to 3 radians from its axis.
    """
    kind = type(camera).__name__
    if not isinstance(camera, _core.Shape) or kind not in _CAMERAS:
        raise TypeError(f"geograd.sees takes a camera, {', '.join(_CAMERAS)}, not {kind}")
    points = points if isinstance(points, CLASSES["Vec3"]) else CLASSES["Vec3"](points)
    points, cameras = points.array, camera.array
    lead = np.broadcast_shapes(points.shape[:-1], cameras.shape[:-1])
    row = lambda x: np.ascontiguousarray(np.broadcast_to(x, (*lead, x.shape[-1])), np.float64).reshape(-1, x.shape[-1])
    return np.array(_core.sees(row(points), row(cameras), kind), bool).reshape(lead)
