"""Functions of geograd.jax on a card of CUDA, as kernels of Pallas: results beside those of the library, and times.

    python python/benches/jax_pallas.py

Without a card it runs the kernels in Pallas' interpreter on few items, and lowers them for CUDA. JAX for a card need not be
installed where the card is: `--write FILE` compiles the kernels by Triton for compute capability 9.0, without a card, and
`--run FILE` runs them there by cuda-bindings, with arrays of torch.
"""

import argparse
import os
import pathlib
import statistics
import sys
import tempfile
import time

import numpy as np

import geograd

RUNS = 11
HEAD = "| what | items | ms | bits of the library | off at most |\n| --- | ---: | ---: | ---: | ---: |"


def boxes(count, seed, dtype):
    rng = np.random.default_rng(seed)
    rows = [rng.uniform(-2, 2, (count, 2)), rng.uniform(0.5, 3, (count, 2)), rng.uniform(-3, 3, (count, 1))]
    return np.concatenate(rows, 1).astype(dtype)


def cases(count):
    """Names, verbs, whether gradients are wanted, and two lists of boxes."""
    for dtype in (np.float32, np.float64):
        a, b = boxes(count, 1, dtype), boxes(count, 2, dtype)
        for verb in (geograd.iou, geograd.giou):
            yield f"{verb.__name__}, {np.dtype(dtype)}", verb, False, a, b
            yield f"{verb.__name__}, gradients, {np.dtype(dtype)}", verb, True, a, b


def function_of(verb, with_gradients):
    import jax
    import geograd.jax

    value = lambda a, b: getattr(geograd.jax, verb.__name__)(a, b, kind="Obb2")
    return jax.grad(lambda a, b: value(a, b).sum(), (0, 1)) if with_gradients else lambda a, b: [value(a, b)]


def wanted(verb, with_gradients, a, b):
    value, gradients = verb.value_grad(a, b, kind="Obb2")
    return gradients if with_gradients else [value]


def line(name, count, run, finish, expected):
    found = [np.asarray(x) for x in finish(run())]
    times = []
    for _ in range(RUNS):
        start = time.perf_counter()
        finish(run(), wait=True)
        times.append(time.perf_counter() - start)
    same = np.concatenate([(x == known).ravel() for x, known in zip(found, expected)]).mean()
    off = max(np.abs(x - known).max() for x, known in zip(found, expected))
    print(f"| {name} | {count} | {1e3 * statistics.median(times):.3f} | {100 * same:.4f} % | {off:.1e} |", flush=True)


def by_jax():
    import jax

    is_card = jax.default_backend() == "gpu"
    if not is_card:
        os.environ["GEOGRAD_JAX_PALLAS"] = "interpret"
    jax.config.update("jax_enable_x64", True)
    print(f"JAX {jax.__version__} on {jax.devices()[0].device_kind}\n\n{HEAD}")
    for name, verb, with_gradients, a, b in cases(1 << 20 if is_card else 300):
        f, (x, y) = function_of(verb, with_gradients), map(jax.numpy.asarray, (a, b))
        run = jax.jit(f)
        if not is_card:
            text = jax.jit(f).trace(x, y).lower(lowering_platforms=("cuda",)).as_text()
            assert "xla.gpu.triton" in text and "callback" not in text
        line(name, len(a), lambda: run(x, y), lambda outs, wait=False: jax.block_until_ready(outs), wanted(verb, with_gradients, a, b))


#: Items of kernels that are written: a kernel has their number in its text.
WRITTEN = 1 << 20


def write(path):
    import jax

    jax.config.update("jax_enable_x64", True)
    sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "tests"))
    from pallas_kernels import compiled, texts_of

    images = {}
    for name, verb, with_gradients, a, b in cases(WRITTEN):
        f = function_of(verb, with_gradients)
        lowered = jax.jit(f).trace(*map(jax.numpy.asarray, (a, b))).lower(lowering_platforms=("cuda",))
        # Of a function with gradients, the value that nobody takes has no kernel.
        (*_, text) = texts_of(lowered)
        with tempfile.TemporaryDirectory() as folder:
            made = compiled(text, pathlib.Path(folder))
        assert made.metadata.shared == 0, name
        further = made.asm["ptx"].partition(".entry")[2].partition(")")[0].count(".param")
        images[name] = np.frombuffer(made.asm["cubin"], np.uint8)
        images[f"{name} arguments"] = np.array(further)
        print(name, len(images[name]), "bytes,", further, "arguments", flush=True)
    np.savez_compressed(path, **images)


def run(path):
    import ctypes

    import torch
    from geograd import _cuda_kernels as kernels

    images, driver = np.load(path), kernels.bindings()[0]
    torch.zeros(1, device="cuda")
    print(f"Kernels of Pallas by Triton on: {torch.cuda.get_device_name()}\n\n{HEAD}")
    for name, verb, with_gradients, a, b in cases(WRITTEN):
        (module,) = kernels.checked(driver.cuModuleLoadData(images[name].tobytes()))
        (function,) = kernels.checked(driver.cuModuleGetFunction(module, b"kernel"))
        expected = wanted(verb, with_gradients, a, b)
        x, y = torch.tensor(a, device="cuda"), torch.tensor(b, device="cuda")
        bars = [torch.ones(len(a), dtype=x.dtype, device="cuda")] if with_gradients else []
        outs = [torch.empty(known.shape, dtype=x.dtype, device="cuda") for known in expected]
        arrays = [one.data_ptr() for one in (x, y, *bars, *outs)]
        # Triton adds places of memory that these kernels do not use.
        arrays += [0] * (int(images[f"{name} arguments"]) - len(arrays))
        kernel, arguments = kernels.Kernel(driver, function), [(place, ctypes.c_void_p) for place in arrays]

        def finish(outs, wait=False):
            torch.cuda.synchronize()
            return outs if wait else [out.cpu().numpy() for out in outs]

        def launched():
            kernel(len(a), torch.cuda.current_stream().cuda_stream, arguments)
            return outs

        line(name, len(a), launched, finish, expected)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", type=pathlib.Path)
    parser.add_argument("--run", type=pathlib.Path)
    options = parser.parse_args()
    if options.write:
        write(options.write)
    elif options.run:
        run(options.run)
    else:
        by_jax()


if __name__ == "__main__":
    main()
