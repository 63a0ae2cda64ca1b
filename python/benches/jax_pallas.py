"""A program of geograd as a kernel of Pallas: JAX on a card without compiled code of geograd. A prototype.

    python python/benches/jax_pallas.py

It evaluates the operations of a program as operations of jnp inside of `pallas_call`, compares the results with the library's in
interpret mode, and lowers the kernel for CUDA, which needs no card. On a card it runs the kernel and prints its time. Sines are
JAX's, so that results differ from the library's by their last digits.
"""

import statistics
import time

import jax
import jax.numpy as jnp
import numpy as np
from jax.experimental import pallas as pl

import geograd

#: Items that a block of threads computes.
BLOCK = 128


def bits(x, change):
    """A number by a change of its bits."""
    return jax.lax.bitcast_convert_type(change(jax.lax.bitcast_convert_type(x, jnp.uint32)), jnp.float32)


def high(x):
    return bits(x, lambda b: b & jnp.uint32(0xFFFFF000))


def binade(x):
    least = jnp.maximum(x, jnp.float32(1.17549435e-38))
    return bits(least, lambda b: jnp.uint32(0x7F800000) - (b & jnp.uint32(0x7F800000)))


def root(x):
    is_none = x <= 0
    return jnp.where(is_none, 0.0, jnp.sqrt(jnp.where(is_none, 1.0, x)))


def shared(less, tied, more):
    return lambda a, b, bar: jnp.where(a < b, less * bar, jnp.where(a == b, tied * bar, more * bar))


OPERATIONS = {
    "neg": lambda x: -x, "canonical": lambda x: x + 0.0, "add": lambda a, b: a + b, "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b, "div": lambda a, b: a / b, "least": lambda a, b: jnp.where(a < b, a, b),
    "most": lambda a, b: jnp.where(a > b, a, b), "magnitude": jnp.abs, "root": root, "sin": jnp.sin, "cos": jnp.cos,
    "sin_high": lambda x: high(jnp.sin(x)), "sin_low": lambda x: jnp.sin(x) - high(jnp.sin(x)),
    "cos_high": lambda x: high(jnp.cos(x)), "cos_low": lambda x: jnp.cos(x) - high(jnp.cos(x)), "atan2": jnp.arctan2,
    "exp": jnp.exp, "ln": jnp.log, "binade": binade, "high": high, "split": shared(1.0, 0.5, 0.0),
    "rest": shared(0.0, 0.5, 1.0), "lt": lambda a, b: a < b, "le": lambda a, b: a <= b, "eq": lambda a, b: a == b,
    "and": lambda a, b: a & b, "or": lambda a, b: a | b, "not": lambda x: ~x, "select": jnp.where,
}


def evaluated(program, xs):
    """The results of a program of float32 on arrays, one for every number of the input."""
    nodes, outputs = program.nodes()
    known = []
    for name, operands, number in nodes:
        if name == "constant":
            known.append(jnp.full_like(xs[0], number))
        elif name == "bool":
            known.append(jnp.full(xs[0].shape, bool(number)))
        elif name == "input":
            known.append(xs[int(number)])
        else:
            known.append(OPERATIONS[name](*[known[place] for place in operands]))
    return [known[place] for place in outputs]


def kernel_of(program, interpret=False):
    """A function of columns of float32, a multiple of `BLOCK` items each, to columns."""

    def call(*columns):
        count = columns[0].shape[0]
        takes, gives = len(columns), len(program.nodes()[1])
        spec = pl.BlockSpec((BLOCK,), lambda i: (i,))

        def kernel(*refs):
            xs = [ref[...] for ref in refs[:takes]]
            for ref, result in zip(refs[takes:], evaluated(program, xs)):
                ref[...] = result

        shape = jax.ShapeDtypeStruct((count,), jnp.float32)
        made = pl.pallas_call(
            kernel, grid=(count // BLOCK,), in_specs=[spec] * takes, out_specs=[spec] * gives, out_shape=[shape] * gives,
            interpret=interpret,
        )
        return made(*columns)

    return call


def boxes(count, seed):
    rng = np.random.default_rng(seed)
    rows = [rng.uniform(-2, 2, (count, 2)), rng.uniform(0.5, 3, (count, 2)), rng.uniform(-3, 3, (count, 1))]
    return np.concatenate(rows, 1).astype(np.float32)


def main():
    for verb in (geograd.iou, geograd.giou):
        program = verb.program(kind=("Obb2", "Obb2"), form="value_grad", double=False)
        a, b = boxes(2 * BLOCK, 1), boxes(2 * BLOCK, 2)
        columns = [jnp.asarray(column) for column in np.concatenate([a, b], 1).T]
        found = np.stack(jax.jit(kernel_of(program, interpret=True))(*columns), 1)
        value, gradients = verb.value_grad(a, b, kind="Obb2")
        off = np.abs(found - np.concatenate([value[:, None], *gradients], 1))
        assert np.median(off) < 1e-6 and np.quantile(off, 0.99) < 1e-3, f"{verb.__name__}: {off.max()}"
        start = time.perf_counter()
        lowered = jax.jit(kernel_of(program)).trace(*columns).lower(lowering_platforms=("cuda",)).as_text()
        seconds = time.perf_counter() - start
        assert "custom_call" in lowered and "callback" not in lowered
        print(
            f"{verb.__name__}: {program.cost} operations, value off by {off[:, 0].max():.0e}, all by {np.median(off):.0e} in the "
            f"median and {off.max():.0e} at most; lowered for CUDA in {seconds:.1f} s"
        )
        if jax.default_backend() == "gpu":
            columns = [jnp.asarray(column) for column in np.concatenate([boxes(1 << 20, 1), boxes(1 << 20, 2)], 1).T]
            run = jax.jit(kernel_of(program))
            jax.block_until_ready(run(*columns))
            times = []
            for _ in range(11):
                start = time.perf_counter()
                jax.block_until_ready(run(*columns))
                times.append(time.perf_counter() - start)
            print(f"    2^20 pairs in {1e3 * statistics.median(times):.3f} ms")


if __name__ == "__main__":
    main()
