"""Signed distance of a polygon, with its gradient

Lines join places of equal distance, orange ones inside. Arrows are the gradient by the point: of length one, towards
the outside, also in the notches. The same call returns the gradient by every vertex of the polygon.
"""

import numpy as np
import style

import geograd

RING = [
    (-2.9, -1.7),
    (-0.7, -1.9),
    (0.2, -0.5),
    (1.2, -1.8),
    (3.0, -1.2),
    (2.2, 0.3),
    (3.1, 1.8),
    (0.9, 1.2),
    (-0.4, 2.1),
    (-1.1, 0.7),
    (-3.0, 1.3),
    (-2.1, -0.1),
]
X, Y = (-4.6, 4.6), (-3.1, 3.1)


def field(x, y):
    """Returns signed distances and their gradients by the points."""
    points = geograd.Vec2(np.stack([x.ravel(), y.ravel()], -1))
    value, (by_point, _) = geograd.signed_distance.value_grad(points, geograd.Rings.of([RING]))
    return value.reshape(x.shape), by_point.reshape(*x.shape, 2)


def draw():
    figure, axes = style.axes(size=(8.6, 5.6))
    x, y = style.grid(X, Y, 241)
    value, _ = field(x, y)
    style.shade(
        figure, axes, value, X, Y, style.SIGNED, -1.8, 1.8, [-1.5, -1, -0.5, 0, 0.5, 1, 1.5], "signed distance"
    )
    axes.contour(x, y, value, np.arange(0.3, 2.4, 0.3), colors=style.BLUE, linewidths=0.7)
    axes.contour(x, y, value, np.arange(-1.2, -0.1, 0.3), colors=style.ORANGE, linewidths=0.9, linestyles="solid")
    style.outline(axes, RING, style.INK, fill=0, width=2.4, zorder=4)
    x, y = style.grid((-4.25, 4.25), (-2.75, 2.75), 18)
    _, slope = field(x, y)
    style.arrows(axes, x, y, 0.34 * slope[..., 0], 0.34 * slope[..., 1], width=0.0034)
    style.map_axes(axes, X, Y)
    return figure
