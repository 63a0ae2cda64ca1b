"""Checks and measures kernels on a card of CUDA in one command, and writes a table.

    python python/benches/card.py                 # on a card: sizes up to 10^7, a table in python/benches/card.md
    python python/benches/card.py --processor     # without one: tiny sizes, kernels run on the processor, nothing is written

Every result is compared with the library's on the CPU: values and derivatives item by item, rows' maxima, pairs above a
threshold, sums with gradients. Beside the kernels are torch's formula of the IoU (rotated_iou.py), eager and compiled, and
PyTorch3D's volumes of boxes where it is installed. Times are the median of several runs, between events of the stream.
"""

import argparse
import contextlib
import os
import pathlib
import statistics
import sys
import tempfile
import time

import numpy as np
import torch

import geograd
import geograd.torch as gt
import rotated_iou
from geograd import _cuda, _cuda_kernels

HERE = pathlib.Path(__file__).parent
RUNS = 11


class Processor:
    """What torch would say of a card, of tensors in the memory of the processor."""

    is_there = staticmethod(lambda x: True)
    entered = staticmethod(lambda device: contextlib.nullcontext())
    architecture = staticmethod(lambda device: "sm_90")
    stream = staticmethod(lambda device: 0)
    keep = staticmethod(lambda x, device: None)


def without_a_card():
    """Puts a card of one processor in the place of NVIDIA's."""
    sys.path.insert(0, str(HERE.parent / "tests"))
    from cuda_grid import Compiler, Driver

    driver, compiler = Driver(), Compiler()
    _cuda_kernels.bindings = lambda: (driver, compiler)
    _cuda.card = Processor()


def boxes(count, seed, device, dtype):
    """Rotated boxes, of which neighbours in both lists overlap."""
    rng = np.random.default_rng(seed)
    rows = np.concatenate(
        [rng.uniform(-2, 2, (count, 2)), rng.uniform(0.5, 3, (count, 2)), rng.uniform(-3, 3, (count, 1))], axis=1
    )
    return torch.tensor(rows, dtype=dtype, device=device)


def solids(count, seed, device, dtype):
    """Boxes of space: centre, size, rotation as a quaternion."""
    rng = np.random.default_rng(seed)
    quaternion = rng.normal(size=(count, 4))
    quaternion /= np.linalg.norm(quaternion, axis=1, keepdims=True)
    rows = np.concatenate([rng.uniform(-1, 1, (count, 3)), rng.uniform(1, 3, (count, 3)), quaternion], axis=1)
    return torch.tensor(rows, dtype=dtype, device=device)


def timed(run, device):
    """Milliseconds of a run: the median."""
    run()
    times = []
    for _ in range(RUNS if device.type == "cuda" else 1):
        if device.type == "cuda":
            start, end = torch.cuda.Event(enable_timing=True), torch.cuda.Event(enable_timing=True)
            start.record()
            run()
            end.record()
            end.synchronize()
            times.append(start.elapsed_time(end))
        else:
            start = time.perf_counter()
            run()
            times.append(1e3 * (time.perf_counter() - start))
    return statistics.median(times)


def of_kernels(run, device):
    """Milliseconds of the kernels of a run, without what launches them: those of a recorded graph, the median."""
    if device.type != "cuda":
        return None
    aside, graph = torch.cuda.Stream(), torch.cuda.CUDAGraph()
    aside.wait_stream(torch.cuda.current_stream())
    with torch.cuda.stream(aside):
        run()
    torch.cuda.current_stream().wait_stream(aside)
    try:
        with torch.cuda.graph(graph):
            kept = run()
    except RuntimeError:
        # A formula that waits for the host, or copies from it, has no graph.
        torch.cuda.synchronize()
        return None
    time_ = timed(graph.replay, device)
    del kept
    return time_


def numpy(x):
    return x.detach().cpu().numpy()


class Table:
    """The lines of the table: what was run, its time, and how far it is from the library on the CPU."""

    def __init__(self):
        self.lines, self.failed = [], 0

    def add(self, name, count, run, found=None, expected=None, tolerance=0.0, device=None, bytes_=0, has_graph=False):
        off = 0.0
        if expected is not None:
            for x, known in zip(found, expected):
                x, known = np.asarray(x, np.float64), np.asarray(known, np.float64)
                if x.shape != known.shape:
                    off = np.inf
                    break
                scale = max(1.0, float(np.abs(known).max(initial=0)))
                difference = np.abs(x - known)[~((x == known) | (np.isnan(x) & np.isnan(known)))]
                off = max(off, float(difference.max(initial=0)) / scale)
        wrong = "" if off <= tolerance else " **WRONG**"
        self.failed += bool(wrong)
        time_ = timed(run, device)
        alone = of_kernels(run, device) if has_graph else None
        kernels = f"{alone:.4f}" if alone else ""
        time_, of_call = alone or time_, time_
        rate = f"{count / time_ / 1e3:.0f}" if time_ else ""
        memory = f"{bytes_ / time_ / 1e6:.0f}" if bytes_ else ""
        text = "" if expected is None else f"{off:.1e}{wrong}"
        self.lines.append(f"| {name} | {count:.0e} | {of_call:.3f} | {kernels} | {rate} | {memory} | {text} |")
        print(self.lines[-1], flush=True)


def aligned(table, count, device, dtype):
    a, b = boxes(count, 1, device, dtype), boxes(count, 2, device, dtype)
    size = a.element_size()
    name = str(dtype)[6:]
    expected, (by_a, by_b) = geograd.iou.value_grad(numpy(a), numpy(b), kind="Obb2")
    run = lambda: gt.iou(a, b, kind="Obb2")
    table.add(f"iou of rotated boxes, {name}", count, run, [numpy(run())], [expected], 1e-12, device, 11 * size * count, True)
    x, y = a.clone().requires_grad_(), b.clone().requires_grad_()

    def slopes(of):
        return torch.autograd.grad(of(x, y).sum(), (x, y))

    run = lambda: slopes(lambda x, y: gt.iou(x, y, kind="Obb2"))
    found = [numpy(grad) for grad in run()]
    table.add(f"its value and gradient, {name}", count, run, found, [by_a, by_b], 1e-12, device, 32 * size * count, True)
    if dtype == torch.float32 and count <= 1_000_000:
        # Its corners decide by small distances, which single pairs may miss.
        table.add("torch's formula, eager", count, lambda: rotated_iou.iou(a, b), device=device)
        table.add("torch's formula, eager, and gradient", count, lambda: slopes(rotated_iou.iou), device=device)


def compiled(table, count, device):
    a, b = (boxes(count, seed, device, torch.float32).requires_grad_() for seed in (1, 2))
    formula = torch.compile(rotated_iou.iou)
    table.add("torch's formula, compiled", count, lambda: formula(a.detach(), b.detach()), device=device)
    run = lambda: torch.autograd.grad(formula(a, b).sum(), (a, b))
    table.add("torch's formula, compiled, and gradient", count, run, device=device)


def copied(table, count, device):
    """What the memory of the card gives: a copy, read and written."""
    a = torch.zeros(16 * count, device=device)
    b = torch.empty_like(a)
    table.add("a copy of 16 numbers an item", count, lambda: b.copy_(a), device=device, bytes_=2 * 64 * count, has_graph=True)


def second(table, count, device):
    a, b = boxes(count, 1, device, torch.float64).requires_grad_(), boxes(count, 2, device, torch.float64)

    def run():
        (first,) = torch.autograd.grad(gt.giou(a, b, kind="Obb2").sum(), a, create_graph=True)
        return torch.autograd.grad(first[:, 0].sum(), a)[0]

    hessian = geograd.giou.hessian(numpy(a), numpy(b), kind="Obb2")[:, 0, :5]
    table.add("second derivatives of giou, float64", count, run, [numpy(run())], [hessian], 1e-9, device)


def pairs(table, side, device):
    count = side * side
    a, b = boxes(side, 1, device, torch.float32), boxes(side, 2, device, torch.float32)
    wide = torch.cat([torch.zeros_like(a), a], 1)[:, 5:]
    x, y = numpy(a), numpy(b)
    of = dict(kind="Obb2")
    run = lambda: gt.iou.all_pairs(wide, b, **of)
    table.add("all pairs, strided rows", count, run, [numpy(run())], [geograd.iou.all_pairs(x, y, **of)], 1e-6, device, 4 * count)
    run = lambda: gt.iou.row_max(a, b, **of)
    table.add("maxima of rows", count, run, map(numpy, run()), geograd.iou.row_max(x, y, **of), 1e-6, device)
    half = side // 2
    groups = [0, half, side], [0, half // 2, side]
    run = lambda: gt.iou.row_max(a, b, groups=groups, **of)
    expected = geograd.iou.row_max(x, y, groups=tuple(map(np.array, groups)), **of)
    table.add("maxima of rows in two groups", count, run, map(numpy, run()), expected, 1e-6, device)
    run = lambda: gt.iou.above(a, b, 0.3, **of)
    table.add("pairs above 0.3", count, run, map(numpy, run()), geograd.iou.above(x, y, 0.3, **of), 1e-6, device)
    own, other = a.clone().requires_grad_(), b.clone().requires_grad_()
    run = lambda: torch.autograd.grad(gt.giou.mean(own, other, **of), (own, other))
    _, grads = geograd.giou.mean_grad(x, y, **of)
    table.add("mean of giou and its gradients", count, run, map(numpy, run()), grads, 1e-5, device)


def corners_of(x):
    """The corners of boxes of space, in the order of PyTorch3D."""
    unit = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
    w, i, j, k = x[:, 6:].unbind(1)
    turned = [
        [1 - 2 * (j * j + k * k), 2 * (i * j - w * k), 2 * (i * k + w * j)],
        [2 * (i * j + w * k), 1 - 2 * (i * i + k * k), 2 * (j * k - w * i)],
        [2 * (i * k - w * j), 2 * (j * k + w * i), 1 - 2 * (i * i + j * j)],
    ]
    rotation = torch.stack([torch.stack(row, 1) for row in turned], 1)
    local = (x.new_tensor(unit) - 0.5) * x[:, None, 3:6]
    return x[:, None, :3] + torch.einsum("nij,nkj->nki", rotation, local)


def volumes(table, count, device):
    a, b = solids(count, 1, device, torch.float32), solids(count, 2, device, torch.float32)
    expected = geograd.iou(numpy(a), numpy(b), kind="Obb3")
    run = lambda: gt.iou(a, b, kind="Obb3")
    table.add("iou of turned boxes of space", count, run, [numpy(run())], [expected], 1e-5, device)
    try:
        from pytorch3d.ops import box3d_overlap
    except ImportError:
        print("PyTorch3D is not installed: its volumes were not measured")
        return
    side = max(int(count**0.5), 1)
    corners = [corners_of(x[:side]) for x in (a, b)]
    table.add("PyTorch3D's box3d_overlap of pairs", side * side, lambda: box3d_overlap(*corners), device=device)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--processor", action="store_true")
    options = parser.parse_args()
    table = Table()
    if options.processor:
        cache = tempfile.TemporaryDirectory()
        os.environ["GEOGRAD_CACHE"] = cache.name
        without_a_card()
        device, counts, side, of_space = torch.device("cpu"), [50], 12, 6
        name = "no card: kernels on the processor"
    elif torch.cuda.is_available():
        device, counts, side, of_space = torch.device("cuda"), [10_000, 1_000_000, 10_000_000], 4000, 100_000
        name = torch.cuda.get_device_name(device)
    else:
        parser.error("torch finds no card; --processor runs kernels on the processor")
    head = [
        f"Kernels of CUDA on: {name}; torch {torch.__version__}.",
        "",
        "A call has the host's work, which kernels alone have not; rates are those of kernels where they were measured alone.",
        "",
        "| what | items or pairs | call, ms | kernels, ms | million a second | GB/s | off the CPU's |",
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: |",
    ]
    print("\n".join(head))
    for count in counts:
        aligned(table, count, device, torch.float32)
    copied(table, counts[-1], device)
    aligned(table, counts[0], device, torch.float64)
    second(table, counts[0], device)
    pairs(table, side, device)
    volumes(table, of_space, device)
    if not options.processor:
        compiled(table, counts[1], device)
    if not options.processor:
        (HERE / "card.md").write_text("\n".join([*head, *table.lines]) + "\n", encoding="utf-8")
    if table.failed:
        sys.exit(f"{table.failed} results differ from the library's")


if __name__ == "__main__":
    main()
