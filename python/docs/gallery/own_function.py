"""A distance of your own: shapes blended into one

A function of five lines: the smooth minimum of the distances of a box, a circle and a capsule, recorded once. The
library differentiates it; arrows are the gradient by the point, which follows the blend.
"""

import numpy as np
import style

import geograd

X, Y = (-4.8, 4.8), (-2.9, 2.9)
BODY, HEAD, ARM = [-0.9, -0.3, 3.0, 1.7, 0.25], [1.75, 0.95, 0.95], [-2.6, 0.8, -3.6, 1.7, 0.3]


@geograd.function
def blended(point: geograd.Vec2, body: geograd.Obb2, head: geograd.Circle, arm: geograd.Capsule2, radius: float):
    near = geograd.signed_distance(point, body)
    for other in (geograd.signed_distance(point, head), geograd.signed_distance(point, arm)):
        share = geograd.maximum(radius - abs(near - other), 0.0) / radius
        near = geograd.minimum(near, other) - share * share * radius / 4
    return near


def field(x, y):
    """Returns values and gradients by the point."""
    points = np.stack([x.ravel(), y.ravel()], -1)
    value, grads = blended.value_grad(points, *(np.array(shape) for shape in (BODY, HEAD, ARM)), 1.3)
    return value.reshape(x.shape), grads[0].reshape(*x.shape, 2)


def draw():
    figure, axes = style.axes(size=(8.6, 5.3))
    x, y = style.grid(X, Y, 241)
    value, _ = field(x, y)
    style.shade(
        figure, axes, value, X, Y, style.SIGNED, -1.6, 1.6, [-1.5, -1, -0.5, 0, 0.5, 1, 1.5], "blended distance"
    )
    axes.contour(x, y, value, np.arange(0.25, 3, 0.25), colors=style.BLUE, linewidths=0.6)
    axes.contour(x, y, value, np.arange(-1.5, -0.1, 0.25), colors=style.ORANGE, linewidths=0.8, linestyles="solid")
    axes.contour(x, y, value, [0.0], colors=style.INK, linewidths=2.4)
    x, y = style.grid((-4.4, 4.4), (-2.6, 2.6), 18)
    _, slope = field(x, y)
    style.arrows(axes, x, y, 0.32 * slope[..., 0], 0.32 * slope[..., 1], width=0.0034)
    style.box(axes, BODY, style.SOFT, fill=0, width=1.2, linestyle=(0, (4, 3)), zorder=3)
    axes.add_patch(
        style.plt.Circle(HEAD[:2], HEAD[2], fill=False, edgecolor=style.SOFT, linewidth=1.2, linestyle=(0, (4, 3)))
    )
    style.outline(axes, capsule(ARM), style.SOFT, fill=0, width=1.2, linestyle=(0, (4, 3)), zorder=3)
    style.map_axes(axes, X, Y)
    return figure


def capsule(numbers):
    """Returns the outline of a capsule as points."""
    ax, ay, bx, by, radius = numbers
    turn = np.arctan2(by - ay, bx - ax) + np.linspace(-np.pi / 2, np.pi / 2, 24)
    far = np.stack([bx + radius * np.cos(turn), by + radius * np.sin(turn)], -1)
    near = np.stack([ax - radius * np.cos(turn), ay - radius * np.sin(turn)], -1)
    return np.concatenate([far, near])
