"""Scores of detection, and what their gradients say

A box slides across another one, which is higher and turned by 0.4. Above are the scores, below their derivatives by the
place. IoU is silent once the boxes are apart; the Gaussian score `probiou` fades; GIoU and DIoU still pull.
"""

import numpy as np
import style

import geograd

SCORES = [("iou", style.BLUE), ("giou", style.ORANGE), ("diou", style.TEAL), ("probiou", style.RED)]


def draw():
    figure, (above, below) = style.axes(1, 2, size=(8.6, 5.6), sharex=True)
    x = np.linspace(-5, 5, 801)
    boxes = np.stack([x, *(np.full_like(x, number) for number in (0.0, 3.2, 1.3, 0.4))], -1)
    truth = np.array([0.0, 0.0, 2.0, 2.6, 0.0])
    for name, color in SCORES:
        value, (by_boxes, _) = getattr(geograd, name).value_grad(boxes, truth, kind="Obb2")
        above.plot(x, value, color=color, label=name)
        below.plot(x, by_boxes[:, 0], color=color)
    above.set_title("Score")
    above.legend(loc="upper right", bbox_to_anchor=(1.0, 1.08))
    below.set_title("Derivative by x")
    below.set(xlabel="x of the sliding box", xlim=(-5, 5))
    for axes in (above, below):
        axes.axhline(0, color=style.SOFT, linewidth=0.8)
        axes.grid(axis="y", color=style.LINE, linewidth=0.7)
    return figure
