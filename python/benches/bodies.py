"""Signed distances of hulls and curved bodies of space next to coal (package ``coal`` of PyPI), in one run.

    OMP_NUM_THREADS=1 GEOGRAD_THREADS=1 taskset -c 1 python bodies.py

Columns: microseconds a pair of geograd's batch (values; values with all derivatives), of coal's calls in a loop of
Python, and of these less what a call for two balls costs, which coal computes in closed form: so little of it is
coal's iteration. Then the largest errors over the size of the bodies, of pairs that are apart and of those that
overlap, and how many of coal's are beyond 1e-6.

The reference is a maximum over directions of the gap between both bodies' supports. Every direction gives a lower
bound of the signed distance, so an error of a value below the bound is proved. The search begins with the normals of
both libraries and refines the better one.
"""

import time

import coal
import numpy as np

import geograd

COUNT = 2000


def least(run, rounds=5):
    """The least time of the processor in microseconds a pair."""
    best = float("inf")
    for _ in range(rounds):
        start = time.process_time()
        run()
        best = min(best, time.process_time() - start)
    return best / COUNT * 1e6


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def matrices(q):
    """Rotations of quaternions with the real part first."""
    w, x, y, z = np.moveaxis(unit(q), -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


def along_z(way):
    """Rotations that take the z axis to a direction."""
    z = unit(way)
    side = np.where(np.abs(z[:, :1]) < 0.7, [[1.0, 0, 0]], [[0, 1.0, 0]])
    x = unit(np.cross(side, z))
    return np.stack([x, np.cross(z, x), z], -1)


class Hulls:
    """Hulls of eight corners on balls of radius one."""

    def __init__(self, draw, centers):
        self.corners = centers[:, None] + unit(draw.normal(size=(COUNT, 8, 3)))
        rows = np.c_[self.corners.reshape(COUNT, 24), np.full(COUNT, 8.0)]
        self.ours = geograd.Hull3_8(rows)
        self.theirs = [(hull_of(own), coal.Transform3s.Identity()) for own in self.corners]

    def support(self, n):
        return np.einsum("ikj,ij->ik", self.corners, n).max(1)


def hull_of(corners):
    points = coal.StdVec_Vec3s()
    for corner in corners:
        points.append(corner)
    return coal.Convex.convexHull(points, True, "Qt")


class Boxes:
    def __init__(self, draw, centers):
        self.centers, self.half = centers, draw.uniform(0.3, 0.8, (COUNT, 3))
        turns = draw.normal(size=(COUNT, 4))
        self.axes = matrices(turns)
        self.ours = geograd.Obb3(np.c_[centers, 2 * self.half, turns])
        poses = [coal.Transform3s(*pair) for pair in zip(self.axes, centers)]
        self.theirs = list(zip([coal.Box(*(2 * own)) for own in self.half], poses))

    def support(self, n):
        local = np.einsum("ijk,ij->ik", self.axes, n)
        return (self.centers * n).sum(1) + (np.abs(local) * self.half).sum(1)


class Cylinders:
    def __init__(self, draw, centers):
        self.centers, self.arm = centers, unit(draw.normal(size=(COUNT, 3))) * draw.uniform(0.3, 1, (COUNT, 1))
        self.radius = draw.uniform(0.2, 0.8, COUNT)
        self.ours = geograd.Cylinder(np.c_[centers - self.arm, centers + self.arm, self.radius])
        poses = [coal.Transform3s(*pair) for pair in zip(along_z(self.arm), centers)]
        lengths = 2 * np.linalg.norm(self.arm, axis=1)
        self.theirs = list(zip(map(coal.Cylinder, self.radius.tolist(), lengths.tolist()), poses))

    def support(self, n):
        across = np.linalg.norm(np.cross(unit(self.arm), n), axis=1)
        return (self.centers * n).sum(1) + np.abs((self.arm * n).sum(1)) + self.radius * across


class Ellipsoids:
    def __init__(self, draw, centers):
        self.centers, self.half = centers, draw.uniform(0.3, 1.0, (COUNT, 3))
        turns = draw.normal(size=(COUNT, 4))
        self.axes = matrices(turns)
        self.ours = geograd.Ellipsoid(np.c_[centers, self.half, turns])
        poses = [coal.Transform3s(*pair) for pair in zip(self.axes, centers)]
        self.theirs = list(zip([coal.Ellipsoid(*own) for own in self.half], poses))

    def support(self, n):
        local = np.einsum("ijk,ij->ik", self.axes, n) * self.half
        return (self.centers * n).sum(1) + np.linalg.norm(local, axis=1)


class Balls:
    def __init__(self, centers):
        self.theirs = [(coal.Sphere(0.5), coal.Transform3s(np.eye(3), at)) for at in centers]


def by_coal(a, b):
    """coal's signed distances and normals, with its tolerances at 1e-9."""
    request = coal.DistanceRequest()
    request.enable_signed_distance = True
    request.gjk_tolerance = request.epa_tolerance = 1e-9
    values, normals = np.empty(COUNT), np.empty((COUNT, 3))

    def run():
        for i in range(COUNT):
            result = coal.DistanceResult()
            (p, at), (q, to) = a.theirs[i], b.theirs[i]
            values[i] = coal.distance(p, at, q, to, request, result)
            normals[i] = result.normal

    return values, normals, run


def reference(a, b, starts, draw):
    """Lower bounds of signed distances: gaps along the best directions that a search finds."""
    gap = lambda n: -b.support(-n) - a.support(n)
    best = unit(np.nan_to_num(starts[0]) + 1e-300)
    top = gap(best)
    for start in starts[1:]:
        n = unit(np.nan_to_num(start) + 1e-300)
        value = gap(n)
        better = value > top
        best[better], top[better] = n[better], value[better]
    for step in 0.3 ** np.arange(1, 20):
        for _ in range(12):
            n = unit(best + step * draw.normal(size=best.shape))
            value = gap(n)
            better = value > top
            best[better], top[better] = n[better], value[better]
    return top


def pair(name, make_a, make_b, draw, overhead):
    for apart in (True, False):
        centers = unit(draw.normal(size=(COUNT, 3))) * draw.uniform(*((2.5, 4) if apart else (0, 0.7)), (COUNT, 1))
        a, b = make_a(draw, np.zeros((COUNT, 3))), make_b(draw, centers)
        run = geograd.signed_distance
        ours, (_, by_b) = run.value_grad(a.ours, b.ours)
        values, normals, calls = by_coal(a, b)
        calls()
        # A shift of b changes the distance by the normal: the sum of the derivatives by its points, or by its centre.
        rows = np.asarray(by_b)
        shifts = {Hulls: lambda: rows[:, :24].reshape(-1, 8, 3).sum(1), Cylinders: lambda: rows[:, :3] + rows[:, 3:6]}
        normal = shifts.get(type(b), lambda: rows[:, :3])()
        truth = reference(a, b, [normal, normals], draw)
        columns = [least(lambda: run(a.ours, b.ours)), least(lambda: run.value_grad(a.ours, b.ours)), least(calls)]
        errors = [np.abs(np.asarray(ours) - truth), np.abs(values - truth)]
        where = f"{name}, {'apart' if apart else 'overlapping'}"
        times = " | ".join(f"{time:.2f}" for time in (*columns, columns[2] - overhead))
        wrong = int((~(errors[1] <= 1e-6)).sum())
        print(f"| {where} | {times} | {errors[0].max():.1e} | {errors[1].max():.1e} | {wrong} |", flush=True)


if __name__ == "__main__":
    draw = np.random.default_rng(1)
    balls = Balls(np.zeros((COUNT, 3))), Balls(draw.uniform(1, 2, (COUNT, 3)))
    overhead = least(by_coal(*balls)[2])
    print(f"coal {coal.__version__}, {COUNT} pairs; a call for two balls takes {overhead:.2f} us\n")
    print("| bodies | geograd | with slopes | coal, calls | coal less a call | error | coal's | beyond 1e-6 |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    pair("hulls of 8 corners", Hulls, Hulls, draw, overhead)
    pair("box and hull", Boxes, Hulls, draw, overhead)
    pair("box and cylinder", Boxes, Cylinders, draw, overhead)
    pair("cylinders", Cylinders, Cylinders, draw, overhead)
    pair("ellipsoids", Ellipsoids, Ellipsoids, draw, overhead)
    pair("hull and ellipsoid", Hulls, Ellipsoids, draw, overhead)
