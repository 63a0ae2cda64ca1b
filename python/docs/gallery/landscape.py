"""IoU and GIoU of two rotated boxes, with their gradients

The orange box stays; the colour is the score of the blue one, by the place of its centre. Arrows are the gradient. IoU
has none where the boxes are apart; GIoU has one everywhere, and a descent of its loss brings boxes together from afar.
"""

import numpy as np
import style

import geograd

TRUTH, SIZE = [0.0, 0.0, 3.2, 1.5, 0.5], [2.6, 1.4, -0.35]
X, Y = (-5.0, 5.0), (-3.6, 3.6)


def at(x, y):
    """Returns boxes of one size and heading with these centres."""
    return np.stack([x, y, *(np.full_like(x, number) for number in SIZE)], -1)


def draw():
    figure, own = style.axes(2, size=(9.6, 4.3))
    for axes, verb, low, text in zip(own, (geograd.iou, geograd.giou), (0.0, -1.0), ("IoU", "GIoU")):
        x, y = style.grid(X, Y, 201)
        score = verb(at(x, y), np.array(TRUTH), kind="Obb2")
        ticks = [0, 0.2, 0.4, 0.6] if low == 0 else [-1, -0.5, 0, 0.5]
        style.shade(figure, axes, score, X, Y, style.RISING, low, 0.7, ticks, height=0.7)
        levels = np.linspace(low, 0.7, 15)[1:]
        axes.contour(x, y, score, levels, colors="white", linewidths=0.7, linestyles="solid")
        x, y = style.grid((-4.6, 4.6), (-3.2, 3.2), 15)
        _, (by_guess, _) = verb.value_grad(at(x, y), np.array(TRUTH), kind="Obb2")
        size = np.hypot(by_guess[..., 0], by_guess[..., 1])
        share = np.where(size > 1e-9, 0.5 * (size / size.max()) ** 0.5 / np.maximum(size, 1e-9), 0)
        moved = share > 0
        style.arrows(
            axes,
            x[moved],
            y[moved],
            (share * by_guess[..., 0])[moved],
            (share * by_guess[..., 1])[moved],
            width=0.0052,
        )
        axes.plot(x[~moved], y[~moved], ".", color=style.SOFT, markersize=2.5)
        style.box(axes, TRUTH, style.ORANGE, fill=0.22, width=2.4, zorder=4)
        style.box(axes, [-3.4, -2.2, *SIZE], style.BLUE, fill=0.30, width=2.0, zorder=4)
        axes.set_title(text)
        style.map_axes(axes, X, Y)
    return figure
