"""Nodes as kernels of Pallas, of which JAX makes machine code for a card of CUDA: what :mod:`geograd.jax` runs there.

A kernel is a program, operation by operation. Products, quotients and roots are instructions that are rounded by themselves, so
that no compiler contracts them with sums; sines, exponentials and angles of float32 are computed in 64 bits and rounded. So
float32 has the library's bits but for few last digits, float64 those of JAX's elementary functions. Kernels check no shape.

The variable of the environment ``GEOGRAD_JAX_PALLAS`` chooses another way: with ``interpret`` the CPU runs kernels, too, in
Pallas' interpreter; with ``off`` a card runs none, and its arrays are computed on the host.
"""

from __future__ import annotations

import functools
import math
import os

import jax
import jax.numpy as jnp
import numpy as np
from jax import lax
from jax.experimental import pallas as pl

from . import _nodes

try:
    from jax import enable_x64 as _in_64_bits
except ImportError:
    from jax.experimental import enable_x64 as _in_64_bits

#: Items that a block of threads computes, and its warps: an item a thread.
_BLOCK, _WARPS = 128, 4
#: Places of numbers are of 32 bits.
_REACH = 1 << 31
#: More operations are computed on the host: Triton compiles 1,000 in 4 seconds, 5,500 in 40, 10,000 in six minutes.
LONGEST = 6_000


def setting():
    """What the environment asks for: "", "interpret" or "off"."""
    found = os.environ.get("GEOGRAD_JAX_PALLAS", "")
    if found not in ("", "interpret", "off"):
        raise ValueError(f"GEOGRAD_JAX_PALLAS is 'interpret' or 'off', not {found!r}")
    return found


class _Unrounded:
    """Operations of lax, of which a compiler may contract products and sums."""

    mul, div, sqrt = staticmethod(lax.mul), staticmethod(lax.div), staticmethod(lax.sqrt)


class _Rounded:
    """Instructions of a card that are rounded by themselves."""

    @staticmethod
    def _run(name, *xs):
        from jax.experimental.pallas import triton

        (x, *_), kind = xs, {4: "f", 8: "d"}[xs[0].dtype.itemsize]
        places = ", ".join(f"${k}" for k in range(len(xs) + 1))
        (result,) = triton.elementwise_inline_asm(
            f"{name}.rn.f{8 * x.dtype.itemsize} {places};", args=xs, constraints=",".join([f"={kind}", *[kind] * len(xs)]), pack=1,
            result_shape_dtypes=[jax.ShapeDtypeStruct(x.shape, x.dtype)],
        )
        return result

    mul = staticmethod(functools.partial(_run, "mul"))
    div = staticmethod(functools.partial(_run, "div"))
    sqrt = staticmethod(functools.partial(_run, "sqrt"))


class _Evaluation:
    """Operations of programs on blocks of numbers of one format."""

    def __init__(self, dtype, exact):
        self.dtype = np.dtype(dtype)
        self.mul, self.div, self.sqrt = exact.mul, exact.div, exact.sqrt
        self.is_double = self.dtype == np.float64
        self.whole = np.int64 if self.is_double else np.int32
        # All but the low half of the significand; the exponent. Whole numbers have signs, since Pallas reads constants so.
        self.mask = -(1 << 27) if self.is_double else -(1 << 12)
        self.exponent = 0x7FF0000000000000 if self.is_double else 0x7F800000

    def constant(self, number):
        return lax.full((_BLOCK,), number, self.dtype)

    def _bits(self, change, x, dtype=None):
        whole, dtype = (self.whole, self.dtype) if dtype is None else (np.int64, dtype)
        return lax.bitcast_convert_type(change(lax.bitcast_convert_type(x, whole), whole), dtype)

    def high(self, x):
        return self._bits(lambda bits, whole: lax.bitwise_and(bits, lax.full(bits.shape, self.mask, whole)), x)

    def binade(self, x):
        least = self.constant(np.finfo(self.dtype).tiny)

        def change(bits, whole):
            exponent = lax.full(bits.shape, self.exponent, whole)
            return lax.sub(exponent, lax.bitwise_and(bits, exponent))

        return self._bits(change, lax.select(lax.lt(x, least), least, x))

    def root(self, x):
        # The root of a negative number is NaN, which no one takes.
        return lax.select(lax.le(x, self.constant(0)), self.constant(0), self.sqrt(x))

    def _wide(self, function, *xs):
        """A function of 64 bits, rounded."""
        if self.is_double:
            return function(*xs)
        return lax.convert_element_type(function(*(lax.convert_element_type(x, np.float64) for x in xs)), self.dtype)

    def _part(self, function, is_high):
        """The high half of a function, or what is left: of float32 a number of twelve bits, and the rest of 64 bits."""

        def parts(x):
            mask = self.mask if self.is_double else -(1 << 41)
            y = function(x)
            high = self._bits(lambda bits, whole: lax.bitwise_and(bits, lax.full(bits.shape, mask, whole)), y, np.float64)
            return high if is_high else lax.sub(y, high)

        return lambda x: self._wide(parts, x)

    def _angle(self, y, x):
        # Of the zero vector zero, whatever the signs.
        return self._wide(lambda y, x: lax.atan2(lax.add(y, lax.full_like(y, 0)), lax.add(x, lax.full_like(x, 0))), y, x)

    def _shared(self, first, tied, last):
        def share(a, b, bar):
            parts = [self.mul(bar, self.constant(part)) if part == 0.5 else bar if part else self.constant(0) for part in (first, tied, last)]
            return lax.select(lax.lt(a, b), parts[0], lax.select(lax.eq(a, b), parts[1], parts[2]))

        return share

    def operations(self):
        """The operations of programs by their names."""
        wide = lambda function: functools.partial(self._wide, function)
        return {
            "neg": lax.neg, "canonical": lambda x: lax.add(x, self.constant(0)), "add": lax.add, "sub": lax.sub, "mul": self.mul,
            "div": self.div, "least": lambda a, b: lax.select(lax.lt(a, b), a, b),
            "most": lambda a, b: lax.select(lax.gt(a, b), a, b), "magnitude": lax.abs, "root": self.root, "sin": wide(lax.sin),
            "cos": wide(lax.cos), "sin_high": self._part(lax.sin, True), "sin_low": self._part(lax.sin, False),
            "cos_high": self._part(lax.cos, True), "cos_low": self._part(lax.cos, False), "atan2": self._angle, "exp": wide(lax.exp),
            "ln": wide(lax.log), "binade": self.binade, "high": self.high, "split": self._shared(1, 0.5, 0),
            "rest": self._shared(0, 0.5, 1), "lt": lax.lt, "le": lax.le, "eq": lax.eq, "and": lax.bitwise_and,
            "or": lax.bitwise_or, "not": lax.bitwise_not, "select": lax.select,
        }

    def results(self, program, xs, wanted):
        """The results of a program at some places, of blocks of its numbers."""
        nodes, outputs = program
        needed, left = set(), [outputs[k] for k in wanted]
        while left:
            place = left.pop()
            if place not in needed:
                needed.add(place)
                left.extend(nodes[place][1])
        known, operations = {}, self.operations()
        for place in sorted(needed):
            name, operands, number = nodes[place]
            if name == "constant":
                known[place] = self.constant(number)
            elif name == "bool":
                known[place] = lax.full((_BLOCK,), bool(number), np.bool_)
            elif name == "input":
                known[place] = xs[int(number)]
            else:
                known[place] = operations[name](*[known[x] for x in operands])
        # NaN in, NaN out, by the sum that all machines have.
        total = functools.reduce(lax.add, xs) if xs else self.constant(0)
        is_number = lax.eq(total, total)
        return [lax.select(is_number, known[outputs[k]], total) for k in wanted]


def program_of(node, dtype):
    """The operations of a node and the places of its results; None where the node has no kernel, as of a search."""
    double = np.dtype(dtype) == np.float64
    key = ("pallas", double)
    if key not in node.kept:
        try:
            program = node.base.program(node.form, double).nodes()
        except (TypeError, ValueError):
            program = None
        node.kept[key] = program if program is None or len(program[0]) <= LONGEST else None
    return node.kept[key]


def computed(node, xs, active, first, interpret):
    """The results of a node from one on, as a kernel; None without one.

    ``active`` says of every argument whether ``xs`` has it: the others are zeros.
    """
    program = program_of(node, xs[0].dtype)
    widths = [max(width, 1) for _, _, width in node.takes]
    lead = xs[0].shape[:-1] if node.takes[0][2] else xs[0].shape
    gives, count = node.gives[first:], math.prod(lead)
    starts = np.cumsum([0, *(max(width, 1) for width in node.gives)])
    if program is None or count * max(*widths, *(max(width, 1) for width in gives)) >= _REACH:
        return None
    dtype, sizes = xs[0].dtype, [_nodes.size(lead, width) for width in gives]
    if count == 0:
        return [jnp.zeros(size, dtype) for size in sizes]
    evaluation = _Evaluation(dtype, _Unrounded if interpret else _Rounded)

    def kernel(*refs):
        given, outs = iter(refs[: len(xs)]), refs[len(xs) :]
        # Threads beyond the last item compute it once more.
        item = pl.program_id(0) * _BLOCK + lax.iota(np.int32, _BLOCK)
        item = lax.min(item, lax.full((_BLOCK,), count - 1, np.int32))
        numbers = []
        for width, is_active in zip(widths, active):
            ref = next(given) if is_active else None
            at = item * np.int32(width)
            numbers += [evaluation.constant(0) if ref is None else ref[at + np.int32(k)] for k in range(width)]
        results = evaluation.results(program, numbers, range(starts[first], starts[-1]))
        place = 0
        for out, width in zip(outs, gives):
            at = item * np.int32(max(width, 1))
            for k in range(max(width, 1)):
                out[at + np.int32(k)] = results[place]
                place += 1

    more = {}
    if not interpret:
        from jax.experimental.pallas import triton

        # Older versions have the longer name.
        parameters = getattr(triton, "CompilerParams", None) or triton.TritonCompilerParams
        more["compiler_params"] = parameters(num_warps=_WARPS, num_stages=1)
    made = pl.pallas_call(
        kernel, grid=(-(-count // _BLOCK),), interpret=interpret,
        out_shape=[jax.ShapeDtypeStruct((count * max(width, 1),), dtype) for width in gives], **more,
    )
    # Numbers of 64 bits inside of kernels need the setting that JAX has for all.
    with _in_64_bits(True):
        outs = made(*(jnp.reshape(x, (-1,)) for x in xs))
    return [jnp.reshape(out, size) for out, size in zip(outs, sizes)]
