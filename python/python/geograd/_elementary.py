"""Functions of numbers, arrays and symbols alike, under NumPy's names."""

import numpy as np

from . import _core
from ._core import Symbol, Truth


def _made(name, count, doc):
    ufunc = getattr(np, name)

    def one(x):
        made = _core.elementary(name, x)
        return ufunc(x) if made is None else made

    def two(a, b):
        made = _core.elementary(name, a, b)
        return ufunc(a, b) if made is None else made

    made = one if count == 1 else two
    made.__name__ = made.__qualname__ = name
    made.__module__ = "geograd"
    made.__doc__ = doc
    return made


sqrt = _made("sqrt", 1, "The square root; NaN below zero. Of symbols with derivative zero at zero.")
square = _made("square", 1, "The square.")
sin = _made("sin", 1, "The sine of an angle in radians.")
cos = _made("cos", 1, "The cosine of an angle in radians.")
tan = _made("tan", 1, "The tangent of an angle in radians.")
exp = _made("exp", 1, "The exponential.")
log = _made("log", 1, "The natural logarithm.")
arctan2 = _made("arctan2", 2, "The angle of the vector (b, a) in radians, from -pi to pi.")
hypot = _made("hypot", 2, "The length of the vector (a, b), with derivative zero at the origin.")
copysign = _made("copysign", 2, "The magnitude of a with the sign of b.")
minimum = _made("minimum", 2, "The smaller one; of symbols an exact tie shares the derivative.")
maximum = _made("maximum", 2, "The larger one; of symbols an exact tie shares the derivative.")


def where(condition, a, b):
    """``a`` where the condition holds, else ``b``."""
    if isinstance(condition, Truth) or isinstance(a, Symbol) or isinstance(b, Symbol):
        return _core.where(condition, a, b)
    return np.where(condition, a, b)


def clip(x, low, high):
    """The nearest value between two bounds; of symbols the derivative is shared at either."""
    if isinstance(x, Symbol):
        return x.clip(low, high)
    return minimum(maximum(x, low), high)
