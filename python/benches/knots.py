"""Knots of triangles for benchmarks, and lines of tables."""

import numpy as np
from columns import timed

QUERIES = 20_000
#: How many quadrilaterals knots have along and around.
SIZES = (100, 10), (1000, 20), (5000, 40)


def knot(long, around):
    """A rough tube along a trefoil knot: long times around quadrilaterals, each two faces."""
    draw = np.random.default_rng(5)

    def at(t):
        r = np.cos(3 * t) + 2
        return np.stack([r * np.cos(2 * t), r * np.sin(2 * t), -np.sin(3 * t)], -1) / 6.8

    t = np.arange(long) * 2 * np.pi / long
    along = at(t + 1e-4) - at(t - 1e-4)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    side = np.cross(along, [0.3, 0.5, 0.81])
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    up = np.cross(along, side)
    turn = np.arange(around) * 2 * np.pi / around
    rough = 0.05 * draw.uniform(0.99, 1.01, (long, around, 1))
    ring = np.cos(turn)[:, None] * side[:, None] + np.sin(turn)[:, None] * up[:, None]
    vertices = (at(t)[:, None] + rough * ring).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(long), np.arange(around), indexing="ij")
    corner = lambda i, j: (i % long) * around + j % around
    a, b, c, d = corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)
    faces = np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], axis=-1).reshape(-1, 3)
    return vertices, np.ascontiguousarray(faces)


def places(vertices):
    """Points near the mesh and anywhere, and directions of unit length."""
    draw = np.random.default_rng(9)
    near = vertices[draw.integers(0, len(vertices), QUERIES)] + draw.uniform(-0.01, 0.01, (QUERIES, 3))
    anywhere = draw.uniform(-0.6, 0.6, (QUERIES, 3))
    ways = draw.normal(size=(QUERIES, 3))
    return {"near": near, "anywhere": anywhere}, ways / np.linalg.norm(ways, axis=1, keepdims=True)


def each(of_mesh):
    """Runs on knots of every size."""
    for long, around in SIZES:
        of_mesh(f"knot of {2 * long * around} faces", *knot(long, around))


def line(name, theirs, ours, count):
    a, b = timed((theirs, ours))
    print(f"| {name} | {1e6 * a / count:.3f} | {1e6 * b / count:.3f} | {a / b:.2f} |", flush=True)
