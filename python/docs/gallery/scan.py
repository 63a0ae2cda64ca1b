"""Rays of a scanner on a street

A scanner sends 360 rays; `geograd.first_hit` returns the way to the nearest car along each, and its Jacobian by the
car. The curves on the right are the ways, and their derivatives by the heading of the car that was hit.
"""

import numpy as np
import style

import geograd

CARS = np.array(
    [
        [4.6, 2.3, 4.2, 1.8, 0.05],
        [-3.8, 2.6, 4.0, 1.8, -0.1],
        [6.4, -2.2, 4.4, 1.8, 3.0],
        [-5.8, -1.9, 3.9, 1.7, 0.2],
        [0.8, -3.4, 4.2, 1.8, 0.5],
    ]
)
COLORS = [style.BLUE, style.TEAL, style.GOLD, style.RED, "#6b4fa0"]
REACH = 9.5


def scanned(count=360):
    """Returns directions, ways, the car that each ray meets (-1 for none), and derivatives of the ways by that car."""
    turn = np.linspace(-np.pi, np.pi, count, endpoint=False)
    rays = np.stack([np.zeros(count), np.zeros(count), np.cos(turn), np.sin(turn)], -1)
    way, met, slopes = np.full(count, REACH), np.full(count, -1), np.zeros((count, 5))
    for k, car in enumerate(CARS):
        hit = geograd.first_hit(rays, car, kind=("Ray2", "Obb2"))
        nearer = (hit.kind > 0) & (hit.parameter < way)
        # The first row of the Jacobian is the way's; its columns are the ray's four numbers and the car's five.
        by_car = geograd.first_hit.jacobian(rays, car, kind=("Ray2", "Obb2"))[:, 0, 4:]
        way, met = np.where(nearer, hit.parameter, way), np.where(nearer, k, met)
        slopes[nearer] = by_car[nearer]
    return turn, way, met, slopes


def draw():
    turn, way, met, slopes = scanned()
    figure = style.plt.figure(figsize=(10.4, 4.6), layout="constrained")
    spread = figure.add_gridspec(2, 2, width_ratios=[1.55, 1])
    street, above, below = (figure.add_subplot(spread[place]) for place in (np.s_[:, 0], np.s_[0, 1], np.s_[1, 1]))
    x, y = way * np.cos(turn), way * np.sin(turn)
    for k in range(-1, len(CARS)):
        own, color = met == k, style.LINE if k < 0 else COLORS[k]
        street.plot(
            np.stack([np.zeros(own.sum()), x[own]]),
            np.stack([np.zeros(own.sum()), y[own]]),
            color=color,
            linewidth=0.7,
            alpha=0.8,
            zorder=2,
        )
        if k >= 0:
            style.box(street, CARS[k], color, fill=0.22, width=2.2, zorder=4)
            street.plot(x[own], y[own], ".", color=style.INK, markersize=2.5, zorder=5)
            degrees, ways, headings = (
                np.where(own, numbers, np.nan) for numbers in (np.degrees(turn), way, slopes[:, 4])
            )
            above.plot(degrees, ways, ".", color=color, markersize=4)
            below.plot(degrees, headings, ".", color=color, markersize=4)
    street.plot(0, 0, "o", color=style.INK, markersize=9, zorder=6)
    style.map_axes(street, (-8.6, 9.2), (-5.4, 4.4))
    above.set(title="Way to the hit", xlim=(-180, 180), xticks=[], ylim=(0, 8))
    below.set(
        title="Its derivative by the car's heading",
        xlim=(-180, 180),
        xticks=[-180, -90, 0, 90, 180],
        xlabel="direction (degrees)",
    )
    below.axhline(0, color=style.LINE, linewidth=1)
    return figure
