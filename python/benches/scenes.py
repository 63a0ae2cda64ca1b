"""Queries of meshes beside Open3D's scenes, which are Embree's in single precision, one thread: medians of processor time, in turns.

    pip install geograd numpy shapely open3d
    OMP_NUM_THREADS=1 python python/benches/scenes.py

Values are compared before they are timed, to single precision.
"""

import os

os.environ["OMP_NUM_THREADS"] = "1"

import numpy as np
import open3d
from knots import QUERIES, each, line, places

import geograd


def of_mesh(name, vertices, faces):
    points_of, ways = places(vertices)
    own, scene = geograd.Mesh(vertices, faces), open3d.t.geometry.RaycastingScene(nthreads=1)
    scene.add_triangles(vertices.astype(np.float32), faces.astype(np.uint32))
    for place, points in points_of.items():
        at = open3d.core.Tensor(points.astype(np.float32))
        rays = open3d.core.Tensor(np.c_[points, ways].astype(np.float32))
        np.testing.assert_allclose(scene.compute_distance(at, nthreads=1).numpy(), own.distance(points), atol=1e-6)
        faces_there = scene.cast_rays(rays, nthreads=1)["primitive_ids"].numpy().astype(np.int64)
        hit = faces_there < len(faces)
        assert np.mean(np.where(hit, faces_there, -1) == own.rays(points, ways)[1]) > 0.999
        line(f"{name}, closest points {place}", lambda: scene.compute_closest_points(at, nthreads=1), lambda: own.closest(points), QUERIES)
        line(f"{name}, signed distances {place}", lambda: scene.compute_signed_distance(at, nthreads=1), lambda: own.signed_distance(points), QUERIES)
        line(f"{name}, first hits of rays {place}", lambda: scene.cast_rays(rays, nthreads=1), lambda: own.rays(points, ways), QUERIES)


def main():
    geograd.set_num_threads(1)
    print("| what | Open3D, µs | geograd, µs | ratio |\n| --- | ---: | ---: | ---: |")
    each(of_mesh)


if __name__ == "__main__":
    main()
