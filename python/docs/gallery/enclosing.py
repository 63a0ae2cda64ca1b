"""The least rectangle and the smallest circle around a polygon

Arrows are the derivatives of the area and of the radius by every vertex. Only the vertices that carry the figure have
one: the others may move a little without changing it.
"""

import numpy as np
import style

import geograd

CORNERS = np.array([(-2.0, -0.9), (-0.2, -1.7), (1.9, -0.9), (2.3, 0.5), (0.6, 1.5), (-1.4, 1.1)])
POLYGON = np.array([*CORNERS.ravel(), len(CORNERS)])


def by_vertices(verb, of):
    """Returns the figure, and the gradient by the vertices of one number made of it."""
    figure = verb(POLYGON, kind="ConvexPolygon6").array
    return figure, verb.vjp(POLYGON, of(figure), kind="ConvexPolygon6")[:12].reshape(6, 2)


def draw():
    figure, (left, right) = style.axes(2, size=(10.0, 4.2))
    # The area of a rectangle grows by its height with the width, and the other way round.
    rectangle, slope = by_vertices(geograd.minimum_rectangle, lambda r: np.array([0, 0, r[3], r[2], 0.0]))
    style.box(left, rectangle, style.ORANGE, fill=0.08, width=2.2)
    left.set_title(f"Least rectangle, area {rectangle[2] * rectangle[3]:.2f}")
    circle, turn = by_vertices(geograd.minimum_circle, lambda _: np.array([0, 0, 1.0]))
    right.add_patch(
        style.plt.Circle(
            circle[:2],
            circle[2],
            facecolor=(*style.matplotlib.colors.to_rgb(style.TEAL), 0.08),
            edgecolor=style.TEAL,
            linewidth=2.2,
        )
    )
    right.set_title(f"Smallest circle, radius {circle[2]:.2f}")
    for axes, slopes, size in ((left, slope, 0.28), (right, turn, 1.1)):
        style.outline(axes, CORNERS, style.BLUE, fill=0.16, width=2.0, zorder=3)
        axes.plot(*CORNERS.T, "o", color=style.BLUE, markersize=6, zorder=4)
        moved = np.hypot(*slopes.T) > 1e-9
        style.arrows(axes, *CORNERS[moved].T, *(size * slopes[moved]).T, width=0.006)
        style.map_axes(axes, (-3.6, 3.8), (-2.7, 2.7))
    return figure
