"""Queries of meshes beside libigl, Embree (by trimesh) and trimesh, one thread: medians of processor time, in turns.

    pip install geograd numpy libigl trimesh embreex
    OMP_NUM_THREADS=1 python python/benches/meshes.py

Values are compared before they are timed: distances to 1e-12, hits of rays to single precision, in which Embree computes.
"""

import os

os.environ["OMP_NUM_THREADS"] = "1"
os.environ["IGL_NUM_THREADS"] = "1"

import igl
import numpy as np
import trimesh
from columns import timed
from trimesh.ray.ray_pyembree import RayMeshIntersector

import geograd

QUERIES = 20_000


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


def line(name, theirs, ours, each):
    a, b = timed((theirs, ours))
    print(f"| {name} | {1e6 * a / each:.3f} | {1e6 * b / each:.3f} | {a / b:.2f} |", flush=True)


def of_mesh(name, vertices, faces):
    draw = np.random.default_rng(9)
    near = vertices[draw.integers(0, len(vertices), QUERIES)] + draw.uniform(-0.01, 0.01, (QUERIES, 3))
    places = {"near": near, "anywhere": draw.uniform(-0.6, 0.6, (QUERIES, 3))}
    ways = draw.normal(size=(QUERIES, 3))
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    own, other = geograd.Mesh(vertices, faces), trimesh.Trimesh(vertices, faces, process=False)
    tree = igl.AABB()
    tree.init(vertices, faces)
    line(f"{name}, building the tree, libigl", lambda: igl.AABB().init(vertices, faces), lambda: geograd.Mesh(vertices, faces), 1)
    embree = RayMeshIntersector(other)
    line(f"{name}, building the tree, Embree", lambda: RayMeshIntersector(other).intersects_first(near[:1], ways[:1]), lambda: geograd.Mesh(vertices, faces), 1)
    for place, points in places.items():
        squared = tree.squared_distance(vertices, faces, points)[0]
        np.testing.assert_allclose(own.distance(points), np.sqrt(squared), rtol=1e-12, atol=1e-12)
        line(f"{name}, closest points {place}, libigl", lambda: tree.squared_distance(vertices, faces, points), lambda: own.closest(points), QUERIES)
        few = points[:500]
        line(f"{name}, closest points {place}, trimesh", lambda: trimesh.proximity.closest_point(other, few), lambda: own.closest(few), 500)
    one = near[:1]
    line(f"{name}, closest point of one, libigl", lambda: tree.squared_distance(vertices, faces, one), lambda: own.closest(one), 1)
    for place, points in places.items():
        same = np.mean(own.rays(points, ways)[1] == embree.intersects_first(points, ways))
        assert same > 0.999, same
        line(f"{name}, first hits of rays {place}, Embree", lambda: embree.intersects_first(points, ways), lambda: own.rays(points, ways), QUERIES)


def main():
    geograd.set_num_threads(1)
    print("| what | theirs, µs | geograd, µs | ratio |\n| --- | ---: | ---: | ---: |")
    for long, around in ((100, 10), (1000, 20), (5000, 40)):
        of_mesh(f"knot of {2 * long * around} faces", *knot(long, around))


if __name__ == "__main__":
    main()
