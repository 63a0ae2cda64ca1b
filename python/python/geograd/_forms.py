"""The forms of a function: item by item, and of all pairs of two lists."""

import numpy as np


def _number(x, name):
    """A number, or an error that names the argument."""
    try:
        if not isinstance(x, (str, bytes)):
            return float(x)
    except (TypeError, ValueError):
        pass
    raise TypeError(f"{name}: a number is needed, not {x!r}")


def _count(x, name):
    """A whole number from 0 on, or None."""
    if x is None:
        return None
    if isinstance(x, bool) or not hasattr(x, "__index__"):
        raise TypeError(f"{name}: a whole number is needed, not {x!r}")
    if x.__index__() < 0:
        raise ValueError(f"{name}: a whole number from 0 on is needed, not {x}")
    return x.__index__()


def _classes(x):
    """Whole numbers from 0 on, one for each shape, or None."""
    if x is None:
        return None
    array = np.asarray(x)
    if array.size and (array.dtype.kind not in "iu" or array.ndim != 1):
        raise TypeError(f"classes: a list of whole numbers is needed, not an array of {array.dtype} of shape {array.shape}")
    if array.size and (array.min() < 0 or array.max() >= 2**32):
        raise ValueError(f"classes: whole numbers from 0 to 2**32 - 1 are needed, not {array.min()} to {array.max()}")
    return array.tolist()


class Forms:
    """The forms that verbs and traced functions have: `_run` and `_of_pairs` have each by its name."""

    def aligned(self, *arguments, kind=None, to=None, out=None, backend=None, **named):
        """Item i of every argument: the plain call under its name."""
        return self._run("value", self._given(arguments, named), kind, to, out, backend)

    def value_grad(self, *arguments, kind=None, to=None, out=None, backend=None, **named):
        """The value of every item, one number, and its gradient by every argument: of every item, also by one row that
        stands for all; sum over items for its gradient of the sum."""
        return self._run("value_grad", self._given(arguments, named), kind, to, out, backend)

    def vjp(self, *arguments, kind=None, to=None, out=None, backend=None):
        """Cotangents of the arguments; those of the result come last."""
        return self._run("vjp", arguments, kind, to, out, backend)

    def jvp(self, *arguments, kind=None, to=None, out=None, backend=None):
        """The value and its derivative along directions, which come after the arguments."""
        return self._run("jvp", arguments, kind, to, out, backend)

    def hvp(self, *arguments, kind=None, to=None, out=None, backend=None):
        """The derivative of the gradient along directions, which come after the arguments."""
        return self._run("hvp", arguments, kind, to, out, backend)

    def jacobian(self, *arguments, kind=None, to=None, out=None, backend=None, **named):
        """The derivatives of every number of the result by every number of the arguments."""
        return self._run("jacobian", self._given(arguments, named), kind, to, out, backend)

    def hessian(self, *arguments, kind=None, to=None, out=None, backend=None, **named):
        """The second derivatives by all numbers of the arguments."""
        return self._run("hessian", self._given(arguments, named), kind, to, out, backend)

    def all_pairs(self, a, b, *, kind=None, out=None, backend=None):
        """Every row of `a` with every row of `b`: a matrix."""
        return self._of_pairs("all_pairs", a, b, None, kind, out, backend)

    def row_max(self, a, b, *, groups=None, kind=None, backend=None):
        """The largest result of every row of `a`, and its row of `b`; -inf and -1 where `b`, or a group, has no rows of `b`."""
        return self._of_pairs("row_max", a, b, None, kind, None, backend, groups)

    def column_max(self, a, b, *, groups=None, kind=None, backend=None):
        """The largest result of every row of `b`, and its row of `a`; -inf and -1 where `a`, or a group, has no rows of `a`."""
        return self._of_pairs("column_max", a, b, None, kind, None, backend, groups)

    def above(self, a, b, threshold, *, groups=None, kind=None, backend=None):
        """Every pair, with groups every pair of a group, whose result is above a threshold: rows of `a`, rows of `b`, results."""
        return self._of_pairs("above", a, b, _number(threshold, "threshold"), kind, None, backend, groups)

    def count_above(self, a, b, threshold, *, kind=None, backend=None):
        """How many pairs have a result above a threshold."""
        return self._of_pairs("count_above", a, b, _number(threshold, "threshold"), kind, None, backend)

    def sum(self, a, b, *, kind=None, backend=None):
        """The sum of the results of all pairs."""
        return self._of_pairs("sum", a, b, None, kind, None, backend)

    def mean(self, a, b, *, kind=None, backend=None):
        """The mean of the results of all pairs; zero where there are none."""
        return self._of_pairs("mean", a, b, None, kind, None, backend)

    def sum_grad(self, a, b, *, kind=None, backend=None):
        """The sum of the results of all pairs, and its gradients by both lists."""
        return self._of_pairs("sum_grad", a, b, None, kind, None, backend)

    def mean_grad(self, a, b, *, kind=None, backend=None):
        """The mean of the results of all pairs, and its gradients by both lists."""
        return self._of_pairs("mean_grad", a, b, None, kind, None, backend)

    def all_pairs_vjp(self, a, b, upstream, *, kind=None, backend=None):
        """Cotangents of both lists, for a matrix of those of all pairs."""
        return self._of_pairs("all_pairs_vjp", a, b, upstream, kind, None, backend)

    def suppress(self, shapes, scores, overlap, *, classes=None, score=None, most=None, groups=None, kind=None):
        """The places of the shapes that no better one, kept itself, overlaps by more than a threshold, the best first; with
        groups group by group."""
        overlap, score = _number(overlap, "overlap"), None if score is None else _number(score, "score")
        return self._suppress(shapes, scores, overlap, _classes(classes), score, _count(most, "most"), groups, kind)
