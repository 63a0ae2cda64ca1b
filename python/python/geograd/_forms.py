"""The forms of a function: item by item, and of all pairs of two lists."""


class Forms:
    """The forms that verbs and traced functions have: `_run` and `_of_pairs` have each by its name."""

    def aligned(self, *arguments, kind=None, to=None, out=None, backend=None):
        """Item i of every argument: the plain call under its name."""
        return self._run("value", arguments, kind, to, out, backend)

    def value_grad(self, *arguments, kind=None, to=None, out=None, backend=None):
        """The value of every item, one number, and its gradient by every argument."""
        return self._run("value_grad", arguments, kind, to, out, backend)

    def vjp(self, *arguments, kind=None, to=None, out=None, backend=None):
        """Cotangents of the arguments; those of the result come last."""
        return self._run("vjp", arguments, kind, to, out, backend)

    def jvp(self, *arguments, kind=None, to=None, out=None, backend=None):
        """The value and its derivative along directions, which come after the arguments."""
        return self._run("jvp", arguments, kind, to, out, backend)

    def hvp(self, *arguments, kind=None, to=None, out=None, backend=None):
        """The derivative of the gradient along directions, which come after the arguments."""
        return self._run("hvp", arguments, kind, to, out, backend)

    def jacobian(self, *arguments, kind=None, to=None, out=None, backend=None):
        """The derivatives of every number of the result by every number of the arguments."""
        return self._run("jacobian", arguments, kind, to, out, backend)

    def hessian(self, *arguments, kind=None, to=None, out=None, backend=None):
        """The second derivatives by all numbers of the arguments."""
        return self._run("hessian", arguments, kind, to, out, backend)

    def all_pairs(self, a, b, *, kind=None, out=None, backend=None):
        """Every row of `a` with every row of `b`: a matrix."""
        return self._of_pairs("all_pairs", a, b, None, kind, out, backend)

    def row_max(self, a, b, *, groups=None, kind=None, backend=None):
        """The largest result of every row of `a`, and its row of `b`; -inf and -1 in a group without rows of `b`."""
        return self._of_pairs("row_max", a, b, None, kind, None, backend, groups)

    def column_max(self, a, b, *, groups=None, kind=None, backend=None):
        """The largest result of every row of `b`, and its row of `a`; -inf and -1 in a group without rows of `a`."""
        return self._of_pairs("column_max", a, b, None, kind, None, backend, groups)

    def above(self, a, b, threshold, *, groups=None, kind=None, backend=None):
        """Every pair, with groups every pair of a group, whose result is above a threshold: rows of `a`, rows of `b`, results."""
        return self._of_pairs("above", a, b, threshold, kind, None, backend, groups)

    def count_above(self, a, b, threshold, *, kind=None, backend=None):
        """How many pairs have a result above a threshold."""
        return self._of_pairs("count_above", a, b, threshold, kind, None, backend)

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
        return self._suppress(shapes, scores, overlap, classes, score, most, groups, kind)
