"""Times of Voronoi cells beside scipy's and shapely's, one thread, medians of five runs in turn.

    python python/benches/cells.py [sites]

Ours are clipped to the square, with areas and their derivatives by sites and weights; scipy's are neither clipped nor measured, and
shapely's are polygons clipped by it, with areas.
"""

import statistics
import sys
import time

import numpy as np
import scipy.spatial
import shapely

import geograd

SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def ours(sites, weights):
    cells = geograd.Cells(sites, weights, domain=SQUARE)
    return cells.areas, cells.areas_vjp(cells.areas)


def shapelys(sites):
    regions = shapely.get_parts(shapely.voronoi_polygons(shapely.MultiPoint(sites), extend_to=shapely.box(0, 0, 1, 1)))
    return shapely.area(shapely.intersection(regions, shapely.box(0, 0, 1, 1)))


def main():
    geograd.set_num_threads(1)
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
    draw = np.random.default_rng(1)
    sites, weights = draw.random((count, 2)), draw.random(count) / count
    calls = {
        "geograd, Voronoi": lambda: ours(sites, None),
        "geograd, power": lambda: ours(sites, weights),
        "scipy.spatial.Voronoi": lambda: scipy.spatial.Voronoi(sites),
        "shapely.voronoi_polygons": lambda: shapelys(sites),
    }
    times = {name: [] for name in calls}
    for _ in range(5):
        for name, call in calls.items():
            begun = time.perf_counter()
            call()
            times[name].append(time.perf_counter() - begun)
    first = statistics.median(times["geograd, Voronoi"])
    for name, all_of in times.items():
        median = statistics.median(all_of)
        print(f"{name:28} {median * 1e3:8.0f} ms  {median / first:5.2f}")
    difference = abs(np.sort(ours(sites, None)[0]) - np.sort(shapelys(sites))).max()
    print(f"largest difference of sorted areas from shapely's: {difference * count:.1e} of the mean area")


if __name__ == "__main__":
    main()
