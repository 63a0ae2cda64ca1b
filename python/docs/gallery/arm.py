"""A robot arm keeps clear of obstacles

An arm of three links, each a capsule. The straight way from the first pose to the last one goes through both obstacles.
The gradient of the clearance by the joint angles moves all poses at once: the arm folds before each obstacle and
stretches behind it.
"""

import numpy as np
import style
from own_function import capsule

import geograd

LENGTHS, RADIUS = (1.9, 1.6, 1.2), 0.16
OBSTACLES = np.array([[3.75, 1.9, 0.5], [1.5, 3.75, 0.5]])
FIRST, LAST, POSES = np.array([-0.6, 0.6, 0.6]), np.array([1.4, 0.6, 0.6]), 25
WANTED = 0.2


def joints(angles):
    """Returns the four joints of an arm: numbers, arrays or symbols."""
    places, turn, x, y = [(0.0, 0.0)], 0.0, 0.0, 0.0
    for length, angle in zip(LENGTHS, angles):
        turn = turn + angle
        x, y = x + length * geograd.cos(turn), y + length * geograd.sin(turn)
        places.append((x, y))
    return places


@geograd.function
def clearance(angles: 3, obstacle: geograd.Circle):
    places = joints(angles)
    links = [geograd.Capsule2(*a, *b, RADIUS) for a, b in zip(places, places[1:])]
    near = [geograd.signed_distance(geograd.Vec2(obstacle.x, obstacle.y), link) - obstacle.radius for link in links]
    return geograd.minimum(geograd.minimum(near[0], near[1]), near[2])


def planned(steps=2000):
    """Returns the poses of the straight way, and those after the descent."""
    start = FIRST + np.linspace(0, 1, POSES)[:, None] * (LAST - FIRST)
    angles = start.copy()
    for _ in range(steps):
        force = np.zeros_like(angles)
        for obstacle in OBSTACLES:
            gap, (by_angles, _) = clearance.value_grad(angles, obstacle)
            force += np.maximum(WANTED - gap, 0)[:, None] * by_angles
        # Neighbours pull a pose to their middle, so that the way stays even.
        force[1:-1] += 0.2 * (angles[2:] + angles[:-2] - 2 * angles[1:-1])
        angles[1:-1] += 0.3 * force[1:-1]
    return start, angles


def between(angles, times=20):
    """Returns poses and so many between each two of them, at even steps of the angles."""
    at = np.linspace(0, len(angles) - 1, times * (len(angles) - 1) + 1)
    return at, np.stack([np.interp(at, np.arange(len(angles)), column) for column in angles.T], -1)


def least(angles):
    """Returns the clearance of each pose from the nearest obstacle."""
    return np.min([clearance(angles, obstacle) for obstacle in OBSTACLES], axis=0)


def arm(axes, angles, color, **options):
    places = joints(angles)
    for a, b in zip(places, places[1:]):
        style.outline(axes, capsule([*a, *b, RADIUS]), color, **options)


def draw():
    start, angles = planned()
    figure, (left, middle, curve) = style.axes(3, size=(10.8, 4.2), width_ratios=[1, 1, 0.9])
    for axes, poses, color, text in (
        (left, start, style.ORANGE, "Straight way"),
        (middle, angles, style.BLUE, "After the descent"),
    ):
        for k, pose in enumerate(poses):
            ends = k in (0, POSES - 1)
            arm(axes, pose, color, fill=0.06, edge=0.9 if ends else 0.4, width=1.8 if ends else 1.0, zorder=3)
        for x, y, radius in OBSTACLES:
            axes.add_patch(
                style.plt.Circle((x, y), radius, facecolor="#5b6975", edgecolor=style.INK, linewidth=1.5, zorder=2)
            )
        axes.plot(0, 0, "s", color=style.INK, markersize=9, zorder=6)
        axes.set_title(text)
        style.map_axes(axes, (-2.9, 4.7), (-1.5, 5.0))
    for poses, color, text in ((start, style.ORANGE, "straight way"), (angles, style.BLUE, "after the descent")):
        at, dense = between(poses)
        curve.plot(at, least(dense), color=color, label=text)
    curve.axhline(WANTED, color=style.SOFT, linewidth=1.2, linestyle=(0, (4, 3)))
    curve.axhline(0, color=style.INK, linewidth=1.0)
    curve.set(title="Clearance", xlabel="pose", xlim=(0, POSES - 1))
    curve.legend(loc="lower left", bbox_to_anchor=(0.0, -0.42))
    return figure
