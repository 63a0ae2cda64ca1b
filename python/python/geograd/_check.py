"""Checks of gradients by the library's harness."""

import inspect
import typing

import numpy as np

from . import _core
from ._function import Function, _kind

#: The seed of everything random, unless another one is given.
SEED = 0x67656F67726164


class Reports(tuple):
    """What the harness found out, a report for each format."""

    @property
    def passed(self):
        """Whether nothing was refused."""
        return all(report.passed for report in self)

    def __bool__(self):
        return self.passed

    def __str__(self):
        return "\n".join(map(str, self))


def _numbers(x):
    """The numbers of arrays, shapes, tuples and dataclasses, one after another."""
    if isinstance(x, _core.Shape):
        x = x.array
    if isinstance(x, dict):
        x = tuple(x.values())
    if hasattr(x, "__dataclass_fields__"):
        x = tuple(getattr(x, field) for field in x.__dataclass_fields__)
    if isinstance(x, (tuple, list)):
        return np.concatenate([_numbers(part) for part in x]) if x else np.zeros(0)
    return np.asarray(x).reshape(-1)


def _arguments(f, takes):
    """Names and kinds of the arguments of a function."""
    if takes is not None and not isinstance(takes, (tuple, list)):
        takes = [takes]
    try:
        parameters = [
            parameter for parameter in inspect.signature(f).parameters.values()
            if parameter.default is parameter.empty and parameter.kind <= parameter.POSITIONAL_OR_KEYWORD
        ]
    except (TypeError, ValueError):
        parameters = []
    if takes is not None:
        names = [parameter.name for parameter in parameters]
        if len(names) != len(takes):
            names = [f"x{i}" for i in range(len(takes))] if len(takes) > 1 else ["x"]
        return list(zip(names, takes))
    if not parameters:
        raise TypeError("takes= is needed: the number of numbers, or the shape, of every argument")
    hints = typing.get_type_hints(f, include_extras=True)
    for parameter in parameters:
        if parameter.name not in hints:
            raise TypeError(
                f"argument {parameter.name} is not annotated: annotate it with float or a shape, or pass takes=, the number "
                "of numbers, or the shape, of every argument"
            )
    return [(parameter.name, hints[parameter.name]) for parameter in parameters]


def check(
    f, gradient=None, *, vjp=None, takes=None, samples=200, seed=SEED, hard=True, inside=None, resolution=0.0,
    relative_resolution=0.0, jumps="never", points=(), dtype=np.float64, name=None, quiet=False,
):
    """Runs the harness on the derivatives of a function, prints its report and returns it; a report is true where nothing
    was refused.

    A traced function is checked in float64 and float32: backwards against forwards and against differences. Of any other
    callable ``f`` of one item ``gradient`` is checked, a function of the same arguments that gives their gradients; or
    ``vjp``, where ``f`` gives several numbers: it takes their cotangents as its last argument.

    takes: the shape of every argument, or its number of numbers, where annotations do not say it.
    samples: how many random inputs, beside the hard cases of shapes (unless hard is false) and beside points.
    inside: where the function is defined: a function of the same arguments. No step leads outside.
    resolution, relative_resolution: how far values may be off, beyond rounding, by the way they are computed.
    jumps: where the value may jump: "never", "from zero" (where it is zero, as an area does that vanishes) or "anywhere".
    """
    asked = {
        "samples": int(samples), "seed": int(seed), "hard": bool(hard), "inside": None,
        "resolution": [float(resolution), float(relative_resolution)],
        "points": [[float(x) for x in _numbers(point)] for point in points], "jumps": jumps,
    }
    if isinstance(f, Function):
        if gradient is not None or vjp is not None:
            raise TypeError("the gradient of a traced function is the library's; pass the function itself, f.__wrapped__")
        kinds = f._kinds
        leaves = [leaf for own in f._leaves for leaf in own]
    else:
        if (gradient is None) == (vjp is None):
            raise TypeError("a gradient is needed, or a vjp: f alone is checked when it is a geograd.function")
        arguments = _arguments(f, takes)
        kinds = [_kind(annotation, own) for own, annotation in arguments]
        leaves = [leaf for (own, _), kind in zip(arguments, kinds) for leaf in kind.leaves(own)]
    sizes = [max(size, 1) for _, _, size in leaves]
    ends = np.cumsum(sizes)

    def built(x):
        lists = iter(np.split(x, ends[:-1]))
        return [_array(kind, lists) for kind in kinds]

    if inside is not None:
        asked["inside"] = lambda x: bool(inside(*built(x)))
    if isinstance(f, Function):
        reports = Reports(_core.check_recorded(f._core, asked))
    else:
        value = lambda x: _numbers(f(*built(x)))
        if vjp is None:
            adjoint = lambda x, bar: bar[0] * _numbers(gradient(*built(x)))
        else:
            adjoint = lambda x, bar: _numbers(vjp(*built(x), bar if bar.size > 1 else bar[0]))
        name = name or getattr(f, "__name__", "function")
        double = np.dtype(dtype) == np.float64
        reports = Reports([_core.check_callables(name, value, adjoint, leaves, asked, double)])
    if not quiet:
        print(reports)
    return reports


def _array(kind, lists):
    """An argument of one item: an array where a traced function has a list."""
    made = kind.build(lists)
    return np.array(made) if isinstance(made, list) and all(np.isscalar(x) for x in made) else made
