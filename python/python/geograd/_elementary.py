"""Functions of numbers, arrays and symbols alike, under NumPy's names."""

import numpy as np

from . import _core
from ._core import Symbol, Truth


#: The names of all functions of numbers, and how many each takes.
ELEMENTARY = {}


def _made(name, count, doc):
    ufunc = getattr(np, name)
    ELEMENTARY[name] = count

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
cbrt = _made("cbrt", 1, "The cube root; of symbols with derivative zero at zero.")
exp2 = _made("exp2", 1, "Two to a power; of symbols right to x roundings.")
expm1 = _made("expm1", 1, "The exponential less one, right near zero.")
log1p = _made("log1p", 1, "The natural logarithm of one more, right near zero.")
log2 = _made("log2", 1, "The logarithm to the base 2.")
log10 = _made("log10", 1, "The logarithm to the base 10.")
logaddexp = _made("logaddexp", 2, "The logarithm of the sum of two exponentials, without overflow.")
sinh = _made("sinh", 1, "The hyperbolic sine.")
cosh = _made("cosh", 1, "The hyperbolic cosine.")
tanh = _made("tanh", 1, "The hyperbolic tangent.")
arcsinh = _made("arcsinh", 1, "The inverse of the hyperbolic sine.")
arccosh = _made("arccosh", 1, "The inverse of the hyperbolic cosine; NaN below 1.")
arctanh = _made("arctanh", 1, "The inverse of the hyperbolic tangent; NaN beyond 1.")
arcsin = _made("arcsin", 1, "The angle in radians with a sine; NaN beyond 1, of symbols with derivative zero at 1 and -1.")
arccos = _made("arccos", 1, "The angle in radians with a cosine; NaN beyond 1, of symbols with derivative zero at 1 and -1.")
arctan = _made("arctan", 1, "The angle in radians with a tangent.")
power = _made("power", 2, "A power; of symbols with an exponent that is a symbol NaN below zero, and right to b log(a) roundings.")
floor = _made("floor", 1, "The largest whole number that is not above; of symbols with derivative zero.")
ceil = _made("ceil", 1, "The smallest whole number that is not below; of symbols with derivative zero.")
trunc = _made("trunc", 1, "The whole number without the digits after the point; of symbols with derivative zero.")
rint = _made("rint", 1, "The nearest whole number, of two the even one; of symbols with derivative zero.")
sign = _made("sign", 1, "1, -1 or 0; of symbols with derivative zero.")
mod = _made("mod", 2, "The rest of a division, zero or of the sign of b; of symbols right to the rounding of a.")
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
