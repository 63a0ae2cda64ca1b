"""Derivatives at kinks

Lines are values, thin lines the slopes of both sides, and the thick bar is the derivative that the library returns. It
is the mean of the sides where two branches tie or a bound is met, and zero for a norm at zero.
"""

import numpy as np
import style

import geograd


@geograd.function
def tie(x: float):
    return geograd.maximum(0.25 * x, x)


@geograd.function
def size(x: float):
    return abs(x)


@geograd.function
def norm(x: float):
    return geograd.hypot(x, 0.0 * x)


@geograd.function
def bound(x: float):
    return geograd.clip(x, -1.5, 0.0)


PANELS = [(tie, "max(x/4, x)"), (size, "|x|"), (norm, "norm of (x, 0)"), (bound, "clip(x, −1.5, 0)")]


def draw():
    figure, panels = style.axes(4, size=(11.0, 3.3), sharey=True)
    x = np.linspace(-1.2, 1.2, 241)
    for axes, (f, text) in zip(panels, PANELS):
        at, slope = (float(part) for part in f.value_grad(np.array(0.0)))
        step = 1e-6
        sides = [(float(f(np.array(h))) - at) / h for h in (-step, step)]
        axes.plot(x, f(x), color=style.BLUE, linewidth=2.6, zorder=3)
        for side in sides:
            axes.plot(x, at + side * x, color=style.SOFT, linewidth=1.0, linestyle=(0, (4, 3)), zorder=2)
        half = 0.55 / np.hypot(1, slope)
        axes.plot([-half, half], [at - slope * half, at + slope * half], color=style.ORANGE, linewidth=5, zorder=4)
        axes.plot(0, at, "o", color=style.INK, markersize=6, zorder=5)
        axes.set_title(text)
        below, above, returned = (f"{number:.4g}".replace("-", "−") for number in (*sides, slope))
        axes.text(
            0.5,
            -0.2,
            f"sides {below} and {above},\nreturned {returned}",
            transform=axes.transAxes,
            ha="center",
            va="top",
            color=style.INK,
        )
        axes.set(xlim=(-1.2, 1.2), ylim=(-1.3, 1.3), xticks=[-1, 0, 1], yticks=[-1, 0, 1])
        axes.set_aspect("equal")
        axes.grid(color=style.LINE, linewidth=0.7)
    return figure
