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
from knots import QUERIES, each, line, places
from trimesh.ray.ray_pyembree import RayMeshIntersector

import geograd


def of_mesh(name, vertices, faces):
    points_of, ways = places(vertices)
    own, other = geograd.Mesh(vertices, faces), trimesh.Trimesh(vertices, faces, process=False)
    tree = igl.AABB()
    tree.init(vertices, faces)
    line(f"{name}, building the tree, libigl", lambda: igl.AABB().init(vertices, faces), lambda: geograd.Mesh(vertices, faces), 1)
    embree = RayMeshIntersector(other)
    line(f"{name}, building the tree, Embree", lambda: RayMeshIntersector(other).intersects_first(points_of["near"][:1], ways[:1]), lambda: geograd.Mesh(vertices, faces), 1)
    for place, points in points_of.items():
        squared = tree.squared_distance(vertices, faces, points)[0]
        np.testing.assert_allclose(own.distance(points), np.sqrt(squared), rtol=1e-12, atol=1e-12)
        line(f"{name}, closest points {place}, libigl", lambda: tree.squared_distance(vertices, faces, points), lambda: own.closest(points), QUERIES)
        few = points[:500]
        line(f"{name}, closest points {place}, trimesh", lambda: trimesh.proximity.closest_point(other, few), lambda: own.closest(few), 500)
    one = points_of["near"][:1]
    line(f"{name}, closest point of one, libigl", lambda: tree.squared_distance(vertices, faces, one), lambda: own.closest(one), 1)
    for place, points in points_of.items():
        same = np.mean(own.rays(points, ways)[1] == embree.intersects_first(points, ways))
        assert same > 0.999, same
        line(f"{name}, first hits of rays {place}, Embree", lambda: embree.intersects_first(points, ways), lambda: own.rays(points, ways), QUERIES)


def main():
    geograd.set_num_threads(1)
    print("| what | theirs, µs | geograd, µs | ratio |\n| --- | ---: | ---: | ---: |")
    each(of_mesh)


if __name__ == "__main__":
    main()
