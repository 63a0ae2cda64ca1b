"""Colours, axes and shapes that all pictures of the gallery share."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.patches import Polygon

import geograd

INK, SOFT, LINE, PAPER = "#22303c", "#66788a", "#d5dde4", "#ffffff"
BLUE, ORANGE, TEAL, GOLD, RED = "#2166ac", "#d8612c", "#23857a", "#d99a1c", "#b8323a"

#: From far (light) to near or high (dark).
RISING = LinearSegmentedColormap.from_list("rising", ["#f7fafc", "#cfe1ee", "#8fbbd9", "#4a8dbf", "#1d5c98"])
#: Inside (warm), border (white), outside (cold).
SIGNED = LinearSegmentedColormap.from_list("signed", ["#d8612c", "#f0b088", "#ffffff", "#a9cbe3", "#4a8dbf"])

plt.rcParams.update(
    {
        "figure.facecolor": PAPER,
        "axes.facecolor": PAPER,
        "savefig.facecolor": PAPER,
        "font.family": "DejaVu Sans",
        "font.size": 11,
        "axes.titlesize": 12,
        "axes.titleweight": "bold",
        "axes.titlelocation": "left",
        "axes.titlepad": 9,
        "axes.labelsize": 11,
        "text.color": INK,
        "axes.labelcolor": INK,
        "axes.titlecolor": INK,
        "axes.edgecolor": LINE,
        "axes.linewidth": 1.0,
        "xtick.color": SOFT,
        "ytick.color": SOFT,
        "xtick.labelsize": 10,
        "ytick.labelsize": 10,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "legend.frameon": False,
        "legend.fontsize": 10,
        "lines.linewidth": 2.0,
        "lines.solid_capstyle": "round",
        "svg.fonttype": "path",
        "svg.hashsalt": "geograd",
    }
)


def axes(columns=1, rows=1, size=(8.0, 4.5), **options):
    """Returns a figure and its axes."""
    return plt.subplots(rows, columns, figsize=size, layout="constrained", **options)


def map_axes(own, x=None, y=None, ticks=False):
    """Gives axes one scale for both directions, and no frame unless ticks are wanted."""
    own.set_aspect("equal")
    if x is not None:
        own.set_xlim(*x)
    if y is not None:
        own.set_ylim(*y)
    if not ticks:
        own.set_xticks([])
        own.set_yticks([])
        for spine in own.spines.values():
            spine.set_visible(False)


def outline(own, corners, color, fill=0.18, width=2.0, edge=1.0, **options):
    """Adds a polygon: its outline, and its inside as a tint; `fill` and `edge` are opacities."""
    tint, line = matplotlib.colors.to_rgba(color, fill), matplotlib.colors.to_rgba(color, edge)
    patch = Polygon(
        np.asarray(corners).reshape(-1, 2),
        closed=True,
        facecolor=tint,
        edgecolor=line,
        linewidth=width,
        joinstyle="round",
        **options,
    )
    own.add_patch(patch)
    return patch


def box(own, numbers, color, **options):
    """Adds a rotated box: x, y, width, height, heading."""
    return outline(own, geograd.corners(numbers, kind="Obb2"), color, **options)


def arrows(own, x, y, u, v, color=INK, **options):
    """Adds arrows whose lengths are in units of the axes."""
    options = {"width": 0.0042, "headwidth": 4.2, "headlength": 4.8, "headaxislength": 4.3, "zorder": 5, **options}
    return own.quiver(x, y, u, v, color=color, angles="xy", scale_units="xy", scale=1, **options)


def shade(figure, own, values, x, y, colors, low, high, ticks, label=None, height=0.82):
    """Adds a field as colours, with a bar; `values` are on a grid of the ranges `x` and `y`."""
    image = own.imshow(
        values, extent=(*x, *y), origin="lower", cmap=colors, vmin=low, vmax=high, interpolation="bilinear"
    )
    bar = figure.colorbar(image, ax=own, shrink=height, pad=0.02, aspect=26, ticks=ticks)
    bar.outline.set_visible(False)
    bar.ax.tick_params(length=0)
    if label:
        bar.set_label(label)


def grid(x, y, count):
    """Returns two matrices of coordinates, `count` along x."""
    step = (x[1] - x[0]) / (count - 1)
    return np.meshgrid(np.linspace(*x, count), np.arange(y[0], y[1] + step / 2, step))
