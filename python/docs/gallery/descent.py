"""Boxes descend into place

Four detections follow the gradient of GIoU for 80 steps of Adam, each one call for all boxes. Pale outlines are earlier
steps; the curves on the right are the IoU with the truth.
"""

import numpy as np
import style

import geograd

TRUTHS = np.array(
    [[-3.6, 1.1, 2.6, 1.3, 0.5], [-0.2, -1.3, 2.2, 1.6, -0.3], [2.6, 1.3, 1.5, 2.8, 0.25], [3.6, -1.7, 2.4, 1.0, 0.9]]
)
STARTS = TRUTHS + [
    [1.1, 0.8, -0.9, 0.6, -0.55],
    [-1.9, 0.3, 0.9, -0.7, 0.5],
    [-0.9, -0.9, 0.9, -1.1, -0.5],
    [1.5, 1.0, -0.7, 0.8, -0.7],
]
#: The share of the step that each number takes: an angle moves the corners of a long box by more than its own change.
SHARE = np.array([1.0, 1.0, 1.0, 1.0, 0.4])
COLORS = [style.BLUE, style.TEAL, style.GOLD, style.RED]


def descend(steps=80):
    """Returns the boxes of every step of Adam, and their IoU with the truths."""
    boxes, mean, square, seen, scores = STARTS.copy(), 0.0, 0.0, [], []
    for step in range(steps):
        seen.append(boxes.copy())
        scores.append(geograd.iou(boxes, TRUTHS, kind="Obb2"))
        _, (slope, _) = geograd.giou.value_grad(boxes, TRUTHS, kind="Obb2")
        mean, square = 0.9 * mean + 0.1 * slope, 0.99 * square + 0.01 * slope**2
        rate = 0.08 * SHARE * np.cos(0.5 * np.pi * step / steps) ** 2
        boxes = boxes + rate * (mean / (1 - 0.9 ** (step + 1))) / (np.sqrt(square / (1 - 0.99 ** (step + 1))) + 1e-9)
    return np.array(seen), np.array(scores)


def draw():
    seen, scores = descend()
    figure, (axes, curves) = style.axes(2, size=(10.2, 4.6), width_ratios=[1.75, 1])
    for k, color in enumerate(COLORS):
        style.box(axes, TRUTHS[k], style.INK, fill=0.05, width=1.4, linestyle=(0, (4, 3)), zorder=2)
        for step, edge in ((0, 0.35), (5, 0.4), (10, 0.45), (16, 0.5), (24, 0.55)):
            style.box(axes, seen[step, k], color, fill=0.03, width=1.2, edge=edge, zorder=3)
        style.box(axes, seen[-1, k], color, fill=0.14, width=2.2, zorder=4)
        axes.plot(seen[:, k, 0], seen[:, k, 1], color=color, linewidth=1.4, zorder=5)
        axes.plot(*seen[0, k, :2], "o", color=color, markersize=5, zorder=5)
        curves.plot(scores[:, k], color=color)
    axes.plot([], [], color=style.INK, linewidth=1.4, linestyle=(0, (4, 3)), label="truth")
    axes.plot([], [], "o", color=style.SOFT, markersize=5, label="start of a centre")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0.02), ncols=2)
    style.map_axes(axes, (-5.3, 6.3), (-3.6, 3.2))
    curves.set(xlabel="step", title="IoU", ylim=(-0.02, 1.04), xlim=(0, len(scores) - 1))
    curves.grid(axis="y", color=style.LINE, linewidth=0.8)
    return figure
