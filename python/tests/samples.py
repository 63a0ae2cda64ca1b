"""Rows, and inputs of theirs: hard and random ones of the harness."""

import numpy as np

import geograd
from geograd import _core


class Row:
    """A row of a verb."""

    def __init__(self, verb, place, row):
        self.verb, self.place = verb, place
        self.kinds, self.sort, self.takes = tuple(row["kinds"]), row["sort"], row["takes"]
        self.spelling = f"{verb}({','.join(row['kinds'])})"
        self.has_program = row["sort"] == "straight"

    def __str__(self):
        return self.spelling

    def value(self, arrays):
        """All results of every item, side by side."""
        return _flat(getattr(geograd, self.verb)(*arrays, kind=self.kinds), len(arrays[0]))

    def gradient(self, arrays, bars):
        """The cotangents of all arguments, side by side."""
        grads = getattr(geograd, self.verb).vjp(*arrays, *bars, kind=self.kinds)
        return _flat(grads, len(arrays[0]))

    def split(self, numbers):
        """Arrays of the arguments, of rows of all numbers."""
        arrays, at = [], 0
        for _, shape, size in self.takes:
            # The harness draws the vertices of a polygon; how many of them count is a whole number of its own.
            whole = getattr(getattr(geograd, shape, None), "_codes", 0)
            width = max(size - whole, 1)
            part = numbers[:, at : at + width]
            if whole:
                vertices = part.reshape(len(part), -1, 3 if shape.startswith("Hull3") else 2)
                part = np.concatenate([part, _counts(vertices)[:, None]], -1)
            arrays.append(np.ascontiguousarray(part if size else part[:, 0]))
            at += width
        return arrays


def _counts(vertices):
    """How many vertices count: zeros fill the rest."""
    used = (vertices != 0).any(-1)
    return vertices.shape[1] - used[:, ::-1].argmax(1)


def _flat(results, count):
    results = results if isinstance(results, tuple) else (results,)
    return np.concatenate([np.asarray(x, np.float64).reshape(count, -1) for x in results], -1)


# Several conversions take the same shape; they are apart by what they give.
ROWS = [
    Row(verb, place, row)
    for verb in _core.verbs()
    for place, row in enumerate(_core.rows(verb))
    if row["sort"] in ("straight", "search") and verb != "convert"
]


def _drawn(row, count, seed):
    """Random inputs of ordinary sizes whose results are finite and ordinary, too."""
    found = _valid(row, np.array(_core.samples(row.verb, row.place, count, seed)))
    sizes = np.abs(found)
    ordinary = (sizes.max(1) < 50) & (sizes.max(1) > 0.05)
    return found[ordinary]


def _valid(row, numbers):
    """The rows that the verb takes: the harness draws for rows of a fixed size, too, which validate less."""
    def is_valid(x):
        try:
            return bool(np.isfinite(row.value(row.split(x[None]))).all())
        except ValueError:
            return False
    try:
        row.value(row.split(numbers))
    except ValueError:
        return numbers[[is_valid(x) for x in numbers]]
    return numbers


def ordinary(row, count):
    return row.split(_drawn(row, 60, 3)[:count])


def hard(row, count=40):
    found = np.array(_core.hard_samples(row.verb, row.place))
    if not len(found):
        return None
    step = max(1, len(found) // count)
    return row.split(found[::step][:count])


def _agrees(f, x, scale):
    """Where differences of f from both sides agree, number by number, for two steps: neither kink nor jump is near."""
    good = np.ones(len(x), bool)
    for step in (1e-4 * scale, 1e-6 * scale):
        here = f(x)
        for k in range(x.shape[1]):
            up, down = x.copy(), x.copy()
            up[:, k] += step
            down[:, k] -= step
            try:
                with np.errstate(over="ignore"):
                    right, left = (f(up) - here) / step, (here - f(down)) / step
            except ValueError:
                # A step leads out of the shapes for one row at least.
                right, left = _one_by_one(f, here, up, down, step)
            size = 1 + np.abs(here).max(1, keepdims=True) / scale
            good &= (np.abs(right - left) < (100 * step + 1e-5) * (size + np.abs(left))).all(1)
    return good


def _one_by_one(f, here, up, down, step):
    right, left = np.full_like(here, np.inf), np.zeros_like(here)
    for i in range(len(here)):
        try:
            right[i] = (f(up[i : i + 1])[0] - here[i]) / step
            left[i] = (here[i] - f(down[i : i + 1])[0]) / step
        except ValueError:
            right[i] = np.inf
    return right, left


def smooth(row, count, order):
    """Inputs around which the function, or its gradient, is smooth, by differences of values alone."""
    for seed in range(5, 9):
        x = _drawn(row, 150, seed)
        if not len(x):
            continue
        good = _agrees(lambda x: row.value(row.split(x)), x, 1.0)
        x = x[good]
        if order == 2 and len(x):
            node_gives = _core.rows(row.verb)[row.place]["gives"]
            def grads(x):
                bars = [np.ones((len(x), size)) if size else np.ones(len(x)) for _, _, size in node_gives]
                return row.gradient(row.split(x), bars)
            # Shapes that share a number are a tie: first derivatives are shared there, and second ones of both sides do
            # not show it.
            apart = np.diff(np.sort(x, 1), axis=1).min(1, initial=1) > 1e-3
            x = x[apart]
            x = x[_agrees(grads, x, 1.0)] if len(x) else x
        if len(x):
            return row.split(x[:count])
    return None
