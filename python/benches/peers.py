"""Times of polygons, paths and matching, and of shapely, scipy and torchvision, on one thread.

    taskset -c 1 python peers.py contains lengths distances separations matching conversions boxes

A column is the least of several times of the processor, taken in turns; above 1 in the last geograd is faster.
"""

import sys

import numpy as np
from drop_ins import line, rows

import geograd
from geograd import assignment


def star(vertices, seed=0, at=(0.0, 0.0), size=1.0):
    """A ring around a place, without crossings."""
    draw = np.random.default_rng(seed)
    angle = np.arange(vertices) * (2 * np.pi / vertices)
    radius = size * draw.uniform(0.5, 1.0, vertices)
    return np.c_[at[0] + radius * np.cos(angle), at[1] + radius * np.sin(angle)]


def walks(count, vertices, seed=0):
    """Polylines of random steps."""
    draw = np.random.default_rng(seed)
    return draw.normal(0, 1, (count, vertices, 2)).cumsum(1) + draw.uniform(0, 100, (count, 1, 2))


def contains():
    import shapely

    draw = np.random.default_rng(1)
    for vertices, count in ((8, 100_000), (64, 100_000), (1000, 100_000), (1000, 1000), (100_000, 100_000)):
        ring = star(vertices)
        points = draw.uniform(-1, 1, (count, 2))
        plain, prepared = shapely.polygons(ring), shapely.polygons(ring)
        shapely.prepare(prepared)
        place, rings = geograd.Vec2(points), geograd.Rings(ring, [0, vertices])
        polygons = geograd.Polygons(ring, ([0, vertices],))
        of_shapely = lambda own: lambda: shapely.contains_xy(own, points[:, 0], points[:, 1])
        name = f"one polygon of {vertices}"
        if vertices <= 1000:
            line(name + ", winding, plain", count, of_shapely(plain), lambda: geograd.winding(place, rings))
        line(name + ", winding, prepared", count, of_shapely(prepared), lambda: geograd.winding(place, rings))
        line(name + ", contains, prepared", count, of_shapely(prepared), lambda: geograd.contains(polygons, place))
    for vertices, count in ((8, 100_000), (64, 10_000), (1000, 1000)):
        rings = [star(vertices, k, at) for k, at in enumerate(draw.uniform(0, 100, (count, 2)))]
        flat, offsets = np.concatenate(rings), np.arange(count + 1) * vertices
        points = flat[offsets[:-1]] * 0.5 + flat[offsets[:-1] + vertices // 2] * 0.5
        plain = shapely.polygons(flat.reshape(count, vertices, 2))
        place, rings, polygons = geograd.Vec2(points), geograd.Rings(flat, offsets), geograd.Polygons(flat, (offsets,))
        theirs = lambda: shapely.contains_xy(plain, points[:, 0], points[:, 1])
        line(f"a polygon of {vertices} a point, winding", count, theirs, lambda: geograd.winding(place, rings))
        line(f"a polygon of {vertices} a point, contains", count, theirs, lambda: geograd.contains(polygons, place))


def lengths():
    import shapely

    for vertices, count in ((2, 100_000), (8, 100_000), (10, 100), (100, 10_000), (10_000, 100)):
        paths = walks(count, vertices)
        theirs = shapely.linestrings(paths)
        ours = geograd.Polylines(paths.reshape(-1, 2), np.arange(count + 1) * vertices)
        line(f"lengths of {vertices}", count, lambda: shapely.length(theirs), lambda: geograd.length(ours))
        if vertices >= 8:
            theirs, rings = shapely.polygons(paths), geograd.Rings(ours.vertices, ours.offsets)
            line(f"perimeters of {vertices}", count, lambda: shapely.length(theirs), lambda: geograd.perimeter(rings))
            line(f"areas of {vertices}", count, lambda: shapely.area(theirs), lambda: geograd.area(rings))


def distances():
    import shapely

    draw = np.random.default_rng(1)
    for vertices, count in ((8, 100_000), (100, 10_000), (1000, 1000)):
        paths = walks(count, vertices)
        points = draw.uniform(0, 100, (count, 2))
        dots, lines = shapely.points(points), shapely.linestrings(paths)
        place, ours = geograd.Vec2(points), geograd.Polylines(paths.reshape(-1, 2), np.arange(count + 1) * vertices)
        theirs = lambda: shapely.distance(dots, lines)
        line(f"point to a polyline of {vertices} each", count, theirs, lambda: geograd.distance(place, ours))
    for vertices, count in ((8, 100_000), (100, 100_000), (1000, 10_000), (100_000, 1000)):
        path = walks(1, vertices)[0]
        points = draw.uniform(-50, 150, (count, 2))
        dots, plain, prepared = shapely.points(points), shapely.linestrings(path), shapely.linestrings(path)
        shapely.prepare(prepared)
        place, ours = geograd.Vec2(points), geograd.Polylines(path, [0, vertices])
        for name, own in (("plain", plain), ("prepared", prepared)):
            if vertices <= 1000 or name == "prepared":
                theirs = lambda: shapely.distance(own, dots)
                line(f"points to one of {vertices}, {name}", count, theirs, lambda: geograd.distance(place, ours))


def separations():
    import shapely

    draw = np.random.default_rng(1)
    for vertices, count in ((4, 10_000), (12, 10_000), (100, 1000), (1000, 100)):
        # Two of a pair are as far apart as they are large.
        places = draw.uniform(0, 100, (count, 2))
        columns = [np.stack([star(vertices, 2 * k + side, at + [3.0 * side, 0]) for k, at in enumerate(places)]) for side in (0, 1)]
        theirs = [shapely.polygons(rings) for rings in columns]
        offsets = np.arange(count + 1) * vertices
        ours = [geograd.Polygons(rings.reshape(-1, 2), (offsets,)) for rings in columns]
        np.testing.assert_allclose(geograd.distance(*ours), shapely.distance(*theirs))
        line(f"polygons of {vertices} apart", count, lambda: shapely.distance(*theirs), lambda: geograd.distance(*ours))


def matching():
    import torch
    from scipy.optimize import linear_sum_assignment
    from torchvision import ops

    torch.set_num_threads(1)
    for count in (20, 100, 500, 1500):
        a = rows(count, 1, False)
        b = a + np.random.default_rng(2).normal(0, 4, a.shape)
        b = np.c_[np.minimum(b[:, :2], b[:, 2:]), np.maximum(b[:, :2], b[:, 2:])]
        p, q = torch.tensor(a), torch.tensor(b)
        theirs = lambda: linear_sum_assignment(ops.box_iou(p, q).numpy(), maximize=True)
        x, y = geograd.Aabb2(a), geograd.Aabb2(b)
        ours = lambda: assignment.largest(geograd.iou.above(x, y, 0.0))
        line("matching, torchvision and scipy", count, theirs, ours)
        mixed = lambda: linear_sum_assignment(geograd.iou.all_pairs(x, y), maximize=True)
        line("matching, all_pairs and scipy", count, mixed, ours)
        matrix = geograd.iou.all_pairs(x, y)
        alone = lambda: linear_sum_assignment(matrix, maximize=True)
        line("of a matrix, scipy", count, alone, lambda: assignment.optimal(matrix))


def conversions():
    import shapely

    for count in (100, 10_000):
        circles = shapely.buffer(shapely.points(rows(count, 1, False)[:, :2]), 5)
        ragged = lambda: shapely.to_ragged_array(circles)
        lines = np.array([shapely.LineString(own.exterior.coords) for own in circles])
        ragged_lines = lambda: shapely.to_ragged_array(lines)
        line("Polygons of geometries, ragged", count, ragged, lambda: geograd.Polygons.of(circles))
        line("Rings of geometries, ragged", count, ragged, lambda: geograd.Rings.of(circles))
        line("Polylines of geometries, ragged", count, ragged_lines, lambda: geograd.Polylines.of(lines))
        polygons, rings = geograd.Polygons.of(circles), geograd.Rings.of(circles)
        back = shapely.to_ragged_array(circles)
        made = lambda: shapely.from_ragged_array(*back)
        line("geometries of Polygons, ragged", count, made, lambda: polygons.to_shapely())


def boxes():
    import torch
    from torchvision import ops

    torch.set_num_threads(1)
    for count in (16, 100):
        a, b = (rows(count, seed, False).astype(np.float32) for seed in (1, 2))
        p, q, x, y = torch.tensor(a), torch.tensor(b), geograd.Aabb2(a), geograd.Aabb2(b)
        scores = np.random.default_rng(3).random(count).astype(np.float32)
        s = torch.tensor(scores)
        line("box_iou, NumPy", count, lambda: ops.box_iou(p, q), lambda: geograd.iou.all_pairs(x, y))
        of_arrays = lambda: geograd.iou.all_pairs(a, b, kind="Aabb2")
        line("box_iou, NumPy, of arrays", count, lambda: ops.box_iou(p, q), of_arrays)
        line("nms, NumPy", count, lambda: ops.nms(p, s, 0.5), lambda: geograd.iou.suppress(x, scores, 0.5))


def main(wanted):
    geograd.set_num_threads(1)
    known = {f.__name__: f for f in (contains, lengths, distances, separations, matching, conversions, boxes)}
    print(f"{'':36}{'items':>6}{'theirs, us':>12}{'ours, us':>12}{'ratio':>9}")
    for name in wanted or known:
        known[name]()


if __name__ == "__main__":
    main(sys.argv[1:])
