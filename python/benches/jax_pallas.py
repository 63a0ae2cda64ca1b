"""Functions of geograd.jax on a card of CUDA, as kernels of Pallas: results beside those of the library, and times.

    python python/benches/jax_pallas.py

Without a card it runs the kernels in Pallas' interpreter on few items, and lowers them for CUDA.
"""

import os
import statistics
import time

import jax

IS_CARD = jax.default_backend() == "gpu"
if not IS_CARD:
    os.environ["GEOGRAD_JAX_PALLAS"] = "interpret"
jax.config.update("jax_enable_x64", True)

import jax.numpy as jnp
import numpy as np

import geograd
import geograd.jax

RUNS = 11


def boxes(count, seed, dtype):
    rng = np.random.default_rng(seed)
    rows = [rng.uniform(-2, 2, (count, 2)), rng.uniform(0.5, 3, (count, 2)), rng.uniform(-3, 3, (count, 1))]
    return np.concatenate(rows, 1).astype(dtype)


def main():
    print(f"JAX {jax.__version__} on {jax.devices()[0].device_kind}\n")
    print("| what | items | first call, s | ms | bits of the library | off at most |")
    print("| --- | ---: | ---: | ---: | ---: | ---: |")
    for dtype in (np.float32, np.float64):
        a, b = boxes(1 << 20 if IS_CARD else 300, 1, dtype), boxes(1 << 20 if IS_CARD else 300, 2, dtype)
        for verb in (geograd.iou, geograd.giou):
            of = getattr(geograd.jax, verb.__name__)
            value = lambda a, b: of(a, b, kind="Obb2")
            gradients = jax.grad(lambda a, b: value(a, b).sum(), (0, 1))
            expected, known = verb.value_grad(a, b, kind="Obb2")
            for name, f, wanted in ((f"{verb.__name__}", lambda a, b: [value(a, b)], [expected]), (f"{verb.__name__}, gradient", gradients, known)):
                x, y = jnp.asarray(a), jnp.asarray(b)
                run = jax.jit(f)
                start = time.perf_counter()
                found = jax.block_until_ready(run(x, y))
                first, times = time.perf_counter() - start, []
                for _ in range(RUNS):
                    start = time.perf_counter()
                    jax.block_until_ready(run(x, y))
                    times.append(time.perf_counter() - start)
                same = np.concatenate([(np.asarray(one) == other).ravel() for one, other in zip(found, wanted)]).mean()
                off = max(np.abs(np.asarray(one) - other).max() for one, other in zip(found, wanted))
                if not IS_CARD:
                    text = jax.jit(f).trace(x, y).lower(lowering_platforms=("cuda",)).as_text()
                    assert "xla.gpu.triton" in text and "callback" not in text
                print(
                    f"| {name}, {np.dtype(dtype)} | {len(a)} | {first:.1f} | {1e3 * statistics.median(times):.3f} | "
                    f"{100 * same:.4f} % | {off:.1e} |",
                    flush=True,
                )


if __name__ == "__main__":
    main()
