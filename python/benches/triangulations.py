"""Times of Delaunay triangulations beside scipy's (Qhull), one thread: medians of processor time, in turns.

    python python/benches/triangulations.py [points]

Both have triangles and neighbours. Ours decides by exact signs; both give the same triangles here.
"""

import statistics
import sys
import time

import numpy as np
import scipy.spatial

import geograd


def timed(run):
    start = time.process_time()
    run()
    return time.process_time() - start


def main(count):
    draw = np.random.default_rng(0)
    side = int(count**0.5)
    grid = np.stack(np.meshgrid(np.arange(side), np.arange(side)), -1).reshape(-1, 2).astype(float)
    angles = draw.uniform(0, 2 * np.pi, count)
    for name, points in (
        ("in a square, at random", draw.uniform(size=(count, 2))),
        ("in clusters", draw.normal(size=(count // 100, 1, 2)) + 0.01 * draw.normal(size=(count // 100, 100, 2))),
        ("of a grid", grid),
        ("near a circle", np.stack([np.cos(angles), np.sin(angles)], -1) * (1 + 1e-6 * draw.normal(size=(count, 1)))),
    ):
        points = points.reshape(-1, 2)
        runs = [lambda: scipy.spatial.Delaunay(points), lambda: geograd.Delaunay(points)]
        theirs, ours = runs[0](), runs[1]()
        taken = [[timed(run) for run in runs] for _ in range(5)]
        of_scipy, own = (statistics.median(times) for times in zip(*taken))
        counts = f"{len(ours.triangles)}, {len(theirs.simplices)}"
        print(f"| {len(points)} points {name} | {1e3 * of_scipy:.0f} | {1e3 * own:.0f} | {of_scipy / own:.1f} | {counts} |", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100_000)
