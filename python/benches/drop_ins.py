"""Times of the stand-ins and of the originals on one thread, at 16, 100 and 1000 boxes.

    taskset -c 1 python drop_ins.py torchvision ultralytics supervision shapely

A column is the least of several times of the processor, taken in turns; above 1 in the last the stand-in is faster.
"""

import importlib
import sys
import time

import numpy as np

import geograd

SIZES = (16, 100, 1000)


def least(*calls, rounds=15):
    """The least time of the processor for every call in microseconds."""
    repeats = []
    for call in calls:
        call()
        start = time.process_time()
        call()
        repeats.append(max(1, int(0.01 / max(time.process_time() - start, 1e-7))))
    best = [float("inf")] * len(calls)
    for _ in range(rounds):
        for k, (call, repeat) in enumerate(zip(calls, repeats)):
            start = time.process_time()
            for _ in range(repeat):
                call()
            best[k] = min(best[k], (time.process_time() - start) / repeat * 1e6)
    return best


def line(name, count, original, own):
    rounds = 15 if count < 1000 else 4
    theirs, ours = least(original, own, rounds=rounds)
    print(f"{name:36}{count:6}{theirs:12.0f}{ours:12.0f}{theirs / ours:9.2f}", flush=True)


def rows(count, seed, turned):
    draw = np.random.default_rng(seed)
    at, size = draw.uniform(0, 200, (count, 2)), draw.uniform(5, 50, (count, 2))
    return np.c_[at, size, draw.uniform(-3, 3, count)] if turned else np.c_[at, at + size]


def tensors(count, turned):
    import torch

    torch.set_num_threads(1)
    return [torch.tensor(rows(count, seed, turned), dtype=torch.float32) for seed in (1, 2)]


def both_passes(call, a, *more, **options):
    a = a.clone().requires_grad_()

    def run():
        a.grad = None
        call(a, *more, **options).sum().backward()

    return run


def torchvision(count):
    import torch
    from torchvision import ops

    import geograd.torchvision as own

    a, b = tensors(count, False)
    p, q = tensors(count, True)
    scores, classes = torch.rand(count), torch.arange(count) % 5
    matrices = ["box_iou", "generalized_box_iou", "distance_box_iou", "complete_box_iou"]
    for name in matrices:
        line(name, count, lambda: getattr(ops, name)(a, b), lambda: getattr(own, name)(a, b))
    line("box_iou cxcywhr", count, lambda: ops.box_iou(p, q, fmt="cxcywhr"), lambda: own.box_iou(p, q, fmt="cxcywhr"))
    for name in (*matrices, "generalized_box_iou_loss", "distance_box_iou_loss", "complete_box_iou_loss"):
        line(f"{name}, both passes", count, *[both_passes(getattr(m, name), a, b) for m in (ops, own)])
    line("nms", count, lambda: ops.nms(a, scores, 0.5), lambda: own.nms(a, scores, 0.5))
    line("batched_nms", count, *[lambda m=m: m.batched_nms(a, scores, classes, 0.5) for m in (ops, own)])


def ultralytics(count):
    import torch
    from ultralytics.utils import metrics
    from ultralytics.utils.nms import TorchNMS

    import geograd.ultralytics as own

    a, b = tensors(count, True)
    scores = torch.rand(count)
    line("batch_probiou", count, *[lambda m=m: m.batch_probiou(a, b) for m in (metrics, own)])
    line("batch_iou against batch_probiou", count, lambda: metrics.batch_probiou(a, b), lambda: own.batch_iou(a, b))
    line("probiou, both passes", count, *[both_passes(m.probiou, a, b) for m in (metrics, own)])
    fast = lambda: TorchNMS.fast_nms(a, scores, 0.5, iou_func=metrics.batch_probiou)
    line("nms against fast_nms", count, fast, lambda: own.nms(a, scores, 0.5))


def supervision(count):
    import supervision as sv
    from supervision.detection.utils import iou_and_nms as original

    import geograd.supervision as own

    a, b = rows(count, 1, False), rows(count, 2, False)
    p, q = [geograd.corners(geograd.Obb2(rows(count, s, True))).array.reshape(-1, 4, 2) for s in (1, 2)]
    scored = np.c_[a, np.random.default_rng(3).random(count), np.arange(count) % 5]
    line("box_iou_batch", count, lambda: sv.box_iou_batch(a, b), lambda: own.box_iou_batch(a, b))
    line("oriented_box_iou_batch", count, *[lambda m=m: m.oriented_box_iou_batch(p, q) for m in (original, own)])
    line("box_non_max_suppression", count, *[lambda m=m: m.box_non_max_suppression(scored) for m in (original, own)])
    oriented = [lambda m=m: m.oriented_box_non_max_suppression(scored, p) for m in (original, own)]
    line("oriented_box_non_max_suppression", count, *oriented)


def shapely(count):
    import shapely as original

    import geograd.shapely as own

    boxes = geograd.Obb2(rows(count, 1, True))
    circles = original.buffer(original.points(rows(count, 1, False)[:, :2]), 5)
    ragged = lambda: original.to_ragged_array(circles)
    line("rings against to_ragged_array", count, ragged, lambda: own.rings(circles))
    line("rings against Rings.of", count, lambda: geograd.Rings.of(circles), lambda: own.rings(circles))
    corners = geograd.corners(boxes).array.reshape(-1, 4, 2)
    line("geometries against polygons", count, lambda: original.polygons(corners), lambda: own.geometries(boxes))


def main(libraries):
    geograd.set_num_threads(1)
    known = {f.__name__: f for f in (torchvision, ultralytics, supervision, shapely)}
    for name in libraries or known:
        try:
            version = importlib.import_module(name).__version__
        except ImportError:
            print(f"{name} is not installed")
            continue
        print(f"{name + ' ' + version:36}{'boxes':>6}{'theirs, us':>12}{'ours, us':>12}{'ratio':>9}")
        for count in SIZES:
            known[name](count)


if __name__ == "__main__":
    main(sys.argv[1:])
