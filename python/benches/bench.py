"""Figures of BENCHMARKS.md on Python: one thread, float32, medians of the processor time of a call.

    python python/benches/bench.py iou          10^5 pairs of rotated boxes forward and backward, beside plain torch
    python python/benches/bench.py overhead     the binding's share of a call
    python python/benches/bench.py functions    own functions with gradients, beside torch and jax
"""

import argparse
import os

for name in ("OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"
os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
if hasattr(os, "sched_setaffinity"):
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})

import statistics
import sys
import time

import numpy as np

import geograd

geograd.set_num_threads(1)


def timed(call, runs=15, seconds=20.0):
    """The median processor time of a call in seconds."""
    call()
    times = []
    start = time.perf_counter()
    for _ in range(runs):
        before = time.process_time()
        call()
        times.append(time.process_time() - before)
        if time.perf_counter() - start > seconds and len(times) >= 3:
            break
    return statistics.median(times)


def boxes(count, rng):
    """Pairs of rotated boxes, most of which overlap."""
    a = np.c_[rng.normal(0, 1, (count, 2)), rng.uniform(0.5, 3, (count, 2)), rng.uniform(-np.pi, np.pi, count)]
    b = a + rng.normal(0, 0.3, a.shape)
    b[:, 2:4] = np.abs(b[:, 2:4]) + 0.1
    return a.astype(np.float32), b.astype(np.float32)


def iou(count):
    import torch

    import geograd.torch
    import rotated_iou

    torch.set_num_threads(1)
    a, b = boxes(count, np.random.default_rng(1))
    a, b = torch.from_numpy(a), torch.from_numpy(b)

    def both(score):
        x, y = a.clone().requires_grad_(), b.clone().requires_grad_()
        (1 - score(x, y)).mean().backward()
        return x.grad

    ours = lambda x, y: geograd.torch.iou(x, y, kind="Obb2")
    differs = (ours(a, b) - rotated_iou.iou(a, b)).abs()
    print(f"values differ by {differs.max():.1e} at most, {differs.median():.1e} in the median")
    rows = [("geograd.torch", ours), ("plain torch, eager", rotated_iou.iou)]
    print(f"\n| {count} pairs | forward, ms | forward and backward, ms |\n| --- | ---: | ---: |")
    found = []
    for name, score in rows:
        with torch.no_grad():
            forward = timed(lambda: score(a, b))
        whole = timed(lambda: both(score))
        found.append(whole)
        print(f"| {name} | {forward * 1e3:.1f} | {whole * 1e3:.1f} |", flush=True)
    print(f"\nforward and backward: {found[1] / found[0]:.0f} times plain torch")


def overhead(count):
    a, b = boxes(count, np.random.default_rng(1))
    x, y = geograd.Obb2(a), geograd.Obb2(b)
    value, by_a, by_b = np.empty(count, np.float32), np.empty_like(a), np.empty_like(b)
    print(f"value, out=          {timed(lambda: geograd.iou(x, y, out=value)) * 1e3:8.2f} ms")
    print(f"value                {timed(lambda: geograd.iou(x, y)) * 1e3:8.2f} ms")
    out = (value, (by_a, by_b))
    print(f"value_grad, out=     {timed(lambda: geograd.iou.value_grad(x, y, out=out)) * 1e3:8.2f} ms")
    print(f"value_grad           {timed(lambda: geograd.iou.value_grad(x, y)) * 1e3:8.2f} ms")
    one, other = geograd.Obb2(a[0]), geograd.Obb2(b[0])
    calls = 20000
    print(f"one pair             {timed(lambda: [geograd.iou(one, other) for _ in range(calls)]) / calls * 1e6:8.2f} us")


class Of:
    """The functions that an engine has."""

    def __init__(self, module):
        for name in ("sqrt", "sin", "cos", "exp", "log", "where", "minimum", "maximum"):
            setattr(self, name, getattr(module, name))


def arm(m, x):
    """The distance from the hand of a two-link arm to a target."""
    shoulder, elbow, upper, lower, u, v = x
    dx = upper * m.cos(shoulder) + lower * m.cos(shoulder + elbow) - u
    dy = upper * m.sin(shoulder) + lower * m.sin(shoulder + elbow) - v
    return m.sqrt(dx * dx + dy * dy)


def segment(m, x):
    """The distance from a point to a segment."""
    px, py, ax, ay, bx, by = x
    dx, dy, wx, wy = bx - ax, by - ay, px - ax, py - ay
    t = (wx * dx + wy * dy) / (dx * dx + dy * dy)
    t = m.where(t < 0, t * 0, m.where(t > 1, t * 0 + 1, t))
    ex, ey = wx - t * dx, wy - t * dy
    return m.sqrt(ex * ex + ey * ey)


def reprojection(m, x):
    """The squared error of a point in a camera with radial distortion."""
    rx, ry, rz, tx, ty, tz, f, k, px, py, pz, u, v = x
    # The rotation to first order around the estimate, then the pinhole.
    qx, qy, qz = px + ry * pz - rz * py + tx, py + rz * px - rx * pz + ty, pz + rx * py - ry * px + tz
    a, b = qx / qz, qy / qz
    r = a * a + b * b
    scale = f * (1 + k * r)
    du, dv = scale * a - u, scale * b - v
    return du * du + dv * dv


def capsules(m, x):
    """The distance of two capsules in space."""
    ax, ay, az, bx, by, bz, r, cx, cy, cz, dx, dy, dz, s = x
    ux, uy, uz, vx, vy, vz = bx - ax, by - ay, bz - az, dx - cx, dy - cy, dz - cz
    wx, wy, wz = ax - cx, ay - cy, az - cz
    a, b, c = ux * ux + uy * uy + uz * uz, ux * vx + uy * vy + uz * vz, vx * vx + vy * vy + vz * vz
    d, e = ux * wx + uy * wy + uz * wz, vx * wx + vy * wy + vz * wz
    unit = lambda t: m.where(t < 0, t * 0, m.where(t > 1, t * 0 + 1, t))
    t = unit((b * e - c * d) / (a * c - b * b))
    q = unit((b * t + e) / c)
    t = unit((b * q - d) / a)
    ex, ey, ez = wx + t * ux - q * vx, wy + t * uy - q * vy, wz + t * uz - q * vz
    return m.sqrt(ex * ex + ey * ey + ez * ez) - r - s


def union(m, x):
    """The signed distance of a point to the smooth union of three discs."""
    px, py, k, *discs = x
    total = None
    for cx, cy, r in zip(discs[0::3], discs[1::3], discs[2::3]):
        dx, dy = px - cx, py - cy
        term = m.exp((r - m.sqrt(dx * dx + dy * dy)) / k)
        total = term if total is None else total + term
    return -k * m.log(total)


FUNCTIONS = [
    ("two-link arm", arm, [(-3, 3), (-3, 3), (0.5, 1.5), (0.5, 1.5), (2, 3), (2, 3)]),
    ("point to segment", segment, [(-2, 2)] * 6),
    ("reprojection", reprojection, [(-0.1, 0.1)] * 6 + [(0.8, 1.2), (-0.1, 0.1), (-1, 1), (-1, 1), (3, 6), (-1, 1), (-1, 1)]),
    ("capsules in space", capsules, [(-2, 2)] * 6 + [(0.1, 0.3)] + [(-2, 2)] * 6 + [(0.1, 0.3)]),
    ("smooth union", union, [(-2, 2), (-2, 2), (0.2, 0.5)] + [(-2, 2), (-2, 2), (0.3, 0.6)] * 3),
]


def functions(count, engines):
    rng = np.random.default_rng(1)
    print(f"| {count} rows, value and gradient | " + " | ".join(f"{name}, ms" for name in engines) + " |")
    print("| --- |" + " ---: |" * len(engines))
    for name, function, ranges in FUNCTIONS:
        rows = np.stack([rng.uniform(low, high, count) for low, high in ranges], -1).astype(np.float32)
        columns = [np.ascontiguousarray(rows[:, k]) for k in range(len(ranges))]
        expected, cells = None, []
        for engine in engines:
            call = ENGINES[engine](function, rows, columns)
            value, gradient = call()
            value, gradient = np.asarray(value), np.asarray(gradient)
            if expected is None:
                expected = value, gradient
            else:
                np.testing.assert_allclose(value, expected[0], rtol=2e-2, atol=2e-3)
                off = np.abs(gradient - expected[1]) > 1e-2 * (1 + np.abs(expected[1]))
                assert off.mean() < 1e-3, (name, engine, off.mean())
            cells.append(f"{timed(call, 9) * 1e3:.1f}")
        print(f"| {name} ({len(ranges)} numbers) | " + " | ".join(cells) + " |", flush=True)


def in_geograd(function, rows, columns):
    def own(x):
        return function(Of(geograd), x)

    own.__annotations__ = {"x": rows.shape[1]}
    recorded = geograd.function(own)
    return lambda: recorded.value_grad(rows)


def in_geograd_out(function, rows, columns):
    def own(x):
        return function(Of(geograd), x)

    own.__annotations__ = {"x": rows.shape[1]}
    recorded = geograd.function(own)
    out = (np.empty(len(rows), np.float32), np.empty_like(rows))

    def call():
        recorded.value_grad(rows, out=out)
        return out

    return call


def of_columns(function, columns):
    """The function of a number a column, as `def own(x0: float, x1: float, ...)` would be."""
    names = [f"x{k}" for k in range(len(columns))]
    scope = {"function": function, "m": Of(geograd)}
    exec(f"def own({', '.join(f'{name}: float' for name in names)}): return function(m, ({', '.join(names)},))", scope)
    return geograd.function(scope["own"])


class Columns:
    """A call whose gradients are stacked the first time, to be compared."""

    first = True

    def __init__(self, call):
        self.call = call

    def __call__(self):
        value, gradients = self.call()
        if self.first:
            self.first = False
            return value, np.stack(gradients, -1)
        return value, None


def in_geograd_columns(function, rows, columns):
    recorded = of_columns(function, columns)
    return Columns(lambda: recorded.value_grad(*columns))


def in_geograd_columns_out(function, rows, columns):
    recorded = of_columns(function, columns)
    out = tuple(np.empty(len(rows), np.float32) for _ in range(1 + len(columns)))

    def call():
        recorded.value_grad(*columns, out=out)
        return out[0], out[1:]

    return Columns(call)


def in_torch(function, rows, columns, compiled=False):
    import torch

    torch.set_num_threads(1)
    m = Of(torch)
    leaves = [torch.from_numpy(column).requires_grad_() for column in columns]
    value_of = lambda *x: function(m, x)
    if compiled:
        torch._dynamo.reset()
        value_of = torch.compile(value_of, fullgraph=True)
    ones = torch.ones(len(rows))

    def call():
        value = value_of(*leaves)
        grads = torch.autograd.grad(value, leaves, ones)
        call.last = value.detach(), grads
        return call.last[0], None

    def checked():
        call()
        return call.last[0], np.stack([g.numpy() for g in call.last[1]], -1)

    class Call:
        first = True

        def __call__(self):
            if self.first:
                self.first = False
                return checked()
            return call()

    return Call()


def in_jax(function, rows, columns):
    import jax
    import jax.numpy as jnp

    m = Of(jnp)

    def total(x):
        value = function(m, x)
        return value.sum(), value

    both = jax.jit(jax.grad(total, has_aux=True))
    held = tuple(jnp.asarray(column) for column in columns)

    class Call:
        first = True

        def __call__(self):
            grads, value = jax.block_until_ready(both(held))
            if self.first:
                self.first = False
                return value, np.stack([np.asarray(g) for g in grads], -1)
            return value, None

    return Call()


ENGINES = {
    "geograd": in_geograd,
    "geograd, out=": in_geograd_out,
    "geograd, columns": in_geograd_columns,
    "geograd, columns, out=": in_geograd_columns_out,
    "torch eager": in_torch,
    "torch.compile": lambda *x: in_torch(*x, compiled=True),
    "jax.jit": in_jax,
}

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["iou", "overhead", "functions"])
    parser.add_argument("--count", type=int, help="rows: 100000 for iou, 1000000 for the others")
    parser.add_argument("--engines", default=";".join(ENGINES), help="separated by semicolons")
    options = parser.parse_args()
    sys.path.insert(0, os.path.dirname(__file__))
    if options.what == "iou":
        iou(options.count or 100_000)
    elif options.what == "overhead":
        overhead(options.count or 1_000_000)
    else:
        engines = [name for name in ENGINES] if ";" not in options.engines else options.engines.split(";")
        functions(options.count or 1_000_000, engines)
