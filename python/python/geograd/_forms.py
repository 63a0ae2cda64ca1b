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

    def row_min(self, a, b, *, within=None, groups=None, lower=None, kind=None, backend=None):
        """The least result of every row of `a`, and its row of `b`; inf and -1 where none is at most `within`.

        Of equal results the first counts, and only finite ones do. Distances compute few of the pairs, by boxes around
        their shapes; a function of one's own with `lower="distance"` or "squared_distance" does so, too: its result is
        at least that of the boxes."""
        return self._nearest("row_min", a, b, within, lower, kind, backend, groups)

    def column_min(self, a, b, *, within=None, groups=None, lower=None, kind=None, backend=None):
        """The least result of every row of `b`, and its row of `a`; inf and -1 where none is at most `within`."""
        return self._nearest("column_min", a, b, within, lower, kind, backend, groups)

    def nearest(self, a, b, *, within=None, groups=None, lower=None, kind=None, backend=None):
        """The least result of all pairs, or of every group, and its rows of `a` and of `b`; inf and -1 where none is at most
        `within`."""
        return self._nearest("nearest", a, b, within, lower, kind, backend, groups)

    def below(self, a, b, limit, *, groups=None, lower=None, kind=None, backend=None):
        """Every pair, with groups every pair of a group, whose result is below a limit: rows of `a`, rows of `b`, results."""
        return self._nearest("below", a, b, _number(limit, "limit"), lower, kind, backend, groups)

    def count_below(self, a, b, limit, *, groups=None, lower=None, kind=None, backend=None):
        """How many pairs have a result below a limit."""
        return self._nearest("count_below", a, b, _number(limit, "limit"), lower, kind, backend, groups)

    def row_min_grad(self, a, b, *, within=None, groups=None, lower=None, kind=None, backend=None):
        """What `row_min` returns, and the gradients of the sum of its finite results by both lists: that of a row of `a` is
        the gradient of its own result. Equal results share theirs; on a GPU the first has all."""
        return self._nearest("row_min_grad", a, b, within, lower, kind, backend, groups)

    def column_min_grad(self, a, b, *, within=None, groups=None, lower=None, kind=None, backend=None):
        """What `column_min` returns, and the gradients of the sum of its finite results by both lists."""
        return self._nearest("column_min_grad", a, b, within, lower, kind, backend, groups)

    def nearest_grad(self, a, b, *, within=None, groups=None, lower=None, kind=None, backend=None):
        """What `nearest` returns, and the gradients of the sum of its finite results by both lists."""
        return self._nearest("nearest_grad", a, b, within, lower, kind, backend, groups)

    def _nearest(self, form, a, b, cap, lower, kind, backend, groups):
        if lower is not None and not isinstance(lower, str):
            raise TypeError(f"lower: a name is needed, not {lower!r}")
        more = None if cap is None else _number(cap, "within"), lower
        return self._of_pairs(form, a, b, more, kind, None, backend, groups)

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
