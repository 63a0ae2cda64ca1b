"""Columns of polygons, paths and geometries beside shapely on one thread: medians of processor time, in turns.

    python python/benches/columns.py

The last column is shapely's time over geograd's. Values are compared before they are timed.
"""

import os

os.environ["OMP_NUM_THREADS"] = "1"

import statistics
import time

import numpy as np
import shapely

import geograd
import geograd.shapely

RUNS = 9


def timed(both):
    """The median seconds of two calls, each repeated for about a hundredth of a second, in turns."""
    repeats = []
    for run in both:
        run()
        start = time.process_time()
        run()
        repeats.append(max(1, int(0.01 / max(time.process_time() - start, 1e-7))))
    taken = [[], []]
    for _ in range(RUNS):
        for place, run in enumerate(both):
            start = time.process_time()
            for _ in range(repeats[place]):
                run()
            taken[place].append((time.process_time() - start) / repeats[place])
    return [statistics.median(own) for own in taken]


def line(name, theirs, ours, tolerance=1e-12):
    if tolerance is not None:
        np.testing.assert_allclose(ours(), theirs(), rtol=tolerance, atol=1e-13)
    a, b = timed((theirs, ours))
    print(f"| {name} | {1e6 * a:.1f} | {1e6 * b:.1f} | {a / b:.2f} |", flush=True)


def stars(draw, vertices, count):
    """Rings around the origin, of radii from one half to one."""
    angles = np.sort(draw.uniform(0, 2 * np.pi, (count, vertices)), 1)
    radii = draw.uniform(0.5, 1, (count, vertices))
    return np.stack([radii * np.cos(angles), radii * np.sin(angles)], -1)


def distances(count, vertices, way=2.1):
    """Stars whose centres are so far from each other: from 2 on they are apart."""
    draw = np.random.default_rng(1)
    a, b = stars(draw, vertices, count), stars(draw, vertices, count)
    turn = draw.uniform(0, 2 * np.pi, count)
    b = b + way * np.stack([np.cos(turn), np.sin(turn)], -1)[:, None]
    at = draw.uniform(0, 100, (count, 1, 2))
    theirs = [shapely.polygons(own + at) for own in (a, b)]
    ours = [geograd.Polygons.of(own) for own in theirs]
    name = "" if way > 2 else f", centres {way} apart"
    line(f"distances of {count} polygons of {vertices}{name}", lambda: shapely.distance(*theirs), lambda: geograd.distance(*ours))


def measures(count):
    vertices = np.random.default_rng(2).normal(size=(count, 8, 2)).cumsum(1)
    offsets = np.arange(count + 1) * 8
    lines, paths = shapely.linestrings(vertices), geograd.Polylines(vertices.reshape(-1, 2), offsets)
    line(f"lengths of {count} paths of 8", lambda: shapely.length(lines), lambda: geograd.length(paths))
    stars_ = stars(np.random.default_rng(3), 8, count)
    areas, rings = shapely.polygons(stars_), geograd.Rings(stars_.reshape(-1, 2), offsets)
    line(f"areas of {count} rings of 8", lambda: shapely.area(areas), lambda: geograd.area(rings))


def leashes(count, vertices):
    draw = np.random.default_rng(4)
    a = draw.normal(size=(count, vertices, 2)).cumsum(1)
    both = a, a + 0.3 * draw.normal(size=a.shape)
    theirs = [shapely.linestrings(own) for own in both]
    ours = [geograd.Polylines(own.reshape(-1, 2), np.arange(count + 1) * vertices) for own in both]
    line(f"Hausdorff's of {count} paths of {vertices}", lambda: shapely.hausdorff_distance(*theirs), lambda: geograd.hausdorff(*ours))
    # GEOS prunes walks, and some of its leashes are too long.
    line(f"Fréchet's of {count} paths of {vertices}", lambda: shapely.frechet_distance(*theirs), lambda: geograd.frechet(*ours), None)


def geometries(count):
    draw = np.random.default_rng(5)
    boxes = np.c_[draw.uniform(0, 100, (count, 2)), draw.uniform(1, 9, (count, 2)), draw.uniform(-3, 3, count)]
    boxes = geograd.Obb2(boxes)
    corners = geograd.corners(boxes).array.reshape(-1, 4, 2)
    line(f"geometries of {count} boxes", lambda: shapely.polygons(corners), lambda: geograd.shapely.geometries(boxes), None)


def main():
    geograd.set_num_threads(1)
    print(f"shapely {shapely.__version__}, GEOS {shapely.geos_version_string}\n")
    print("| what | shapely, µs | geograd, µs | ratio |\n| --- | ---: | ---: | ---: |")
    for count in (100, 1000, 10_000):
        for vertices in (4, 12, 100):
            if count * vertices <= 120_000:
                distances(count, vertices)
    for way in (1.2, 0.3):
        for vertices in (4, 12, 100):
            distances(1000, vertices, way)
    for count in (100, 1000, 10_000):
        measures(count)
    for count, vertices in ((1000, 8), (1000, 50), (20, 1000)):
        leashes(count, vertices)
    for count in (16, 100, 1000, 10_000):
        geometries(count)


if __name__ == "__main__":
    main()
