"""Non-maximum suppression of rotated boxes

A detector answers every object many times. `geograd.iou.suppress` keeps the best box of each, here at an IoU of 0.3.
Crossing objects stay, since it compares the boxes themselves and not their bounds.
"""

import numpy as np
import style

import geograd

OBJECTS = np.array(
    [
        [-3.3, 0.9, 3.2, 1.0, 0.7],
        [-3.0, 1.0, 3.0, 0.9, -0.75],
        [0.5, -0.9, 2.6, 1.3, 0.1],
        [3.4, 0.9, 3.2, 1.0, -0.4],
        [3.7, -1.3, 1.2, 2.0, 0.3],
        [0.3, 1.5, 2.2, 0.8, -0.1],
    ]
)
COLORS = [style.BLUE, style.ORANGE, style.TEAL, style.GOLD, style.RED, "#6b4fa0"]


def detections(seed=4, each=9):
    """Returns boxes around the objects, their scores, and the object of each."""
    draw = np.random.default_rng(seed)
    owner = np.repeat(np.arange(len(OBJECTS)), each)
    boxes = OBJECTS[owner] + draw.normal(0, [0.16, 0.16, 0.16, 0.10, 0.07], (len(owner), 5))
    scores = 0.95 - 1.6 * np.abs(boxes - OBJECTS[owner])[:, :2].sum(1) + draw.uniform(-0.03, 0.03, len(owner))
    return boxes, np.clip(scores, 0.05, 1.0), owner


def draw():
    boxes, scores, owner = detections()
    kept = geograd.iou.suppress(boxes, scores, 0.3, kind="Obb2")
    figure, panels = style.axes(2, size=(10.2, 3.9))
    for axes, rows, text in zip(panels, (range(len(boxes)), kept), (f"{len(boxes)} detections", f"{len(kept)} kept")):
        for row in rows:
            if axes is panels[0]:
                style.box(axes, boxes[row], COLORS[owner[row]], fill=0.03, width=1.2, edge=0.25 + 0.6 * scores[row])
                continue
            style.box(axes, boxes[row], COLORS[owner[row]], fill=0.16, width=2.4)
            highest = max(geograd.corners(boxes[row], kind="Obb2").array.reshape(4, 2), key=lambda corner: corner[1])
            axes.text(
                highest[0],
                highest[1] + 0.12,
                f"{scores[row]:.2f}",
                ha="center",
                va="bottom",
                color=COLORS[owner[row]],
            )
        axes.set_title(text)
        style.map_axes(axes, (-5.3, 5.6), (-2.9, 2.9))
    return figure
