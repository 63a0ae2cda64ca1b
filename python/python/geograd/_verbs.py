"""The verbs, made of the table."""

import inspect

import numpy as np

from . import _core, _points, _polygons, _replays
from ._forms import Forms
from ._headlines import HEADLINES


def _call(*arguments, kind=None, to=None, out=None, backend=None):
    pass


_SIGNATURE = inspect.signature(_call)


class Verb(_core.Verb, Forms):
    """A function of shapes, of which the shapes choose the row."""

    @property
    def __doc__(self):
        return describe(self.__name__)

    __module__ = "geograd"

    @property
    def __signature__(self):
        return _SIGNATURE

    def all_pairs(self, a, b, *, kind=None, out=None, backend=None):
        """Every row of `a` with every row of `b`, or with every path: a matrix."""
        if not isinstance(b, _core.Paths):
            return self._of_pairs("all_pairs", a, b, None, kind, out, backend)
        columns = [np.asarray(self._run("value", (a, b[i : i + 1]), kind, None, None, backend)) for i in range(len(b))]
        if not columns:
            columns = [np.empty((len(a), 0))]
        matrix = np.stack(columns, 1) if len(b) else columns[0]
        if out is None:
            return matrix
        out[...] = matrix
        return out

    def replayed(self, *item, kind=None, to=None):
        """A function of arrays by the decisions of a search for one item: its replay, which a card of CUDA runs, too.

        It takes the arguments of the search, and after them `hints`, where `Verb.hints` gives some: constants, by which
        derivatives are zero. Of items for which the search decides as for this one, it has the search's results and derivatives;
        for another its results have no meaning, which nothing checks.
        """
        return _replays.of_item(self, item, kind, to)

    def _given(self, arguments, named):
        if named:
            raise TypeError(f"geograd.{self.__name__} takes its shapes without names, not {', '.join(named)}=")
        return arguments


def _spelled(column):
    name, shape, size = column
    return shape if size else "number"


def ordered(verb):
    """The rows of a verb by the names of their shapes."""
    return sorted(_core.rows(verb), key=lambda row: (len(row["kinds"]), row["kinds"], row["gives"]))


def describe(verb):
    """The documentation of a verb: its rows, what they take and give."""
    rows = ordered(verb)
    head = HEADLINES.get(verb, rows[0]["summary"])
    lines = [head, "", "Rows:"]
    for row in rows:
        names = [name for name, _, _ in row["takes"]] + (["paths"] if row["sort"] == "fold" else [])
        takes = ", ".join(f"{name}: {kind}" for name, kind in zip(names, row["kinds"]))
        gives = ", ".join(_spelled(column) for column in row["gives"])
        lines.append(f"    {verb}({takes}) -> {gives}")
        if row["summary"] != head:
            lines.append(f"        {row['summary']}")
    if verb in _polygons.VERBS:
        takes, gives = _polygons.VERBS[verb]
        for takes, summary in [(takes, _polygons.SUMMARIES[verb]), *_polygons.FURTHER.get(verb, [])]:
            lines += [f"    {verb}({takes}) -> {gives}", f"        {summary}"]
    if verb in _points.VERBS:
        lines += [f"    {verb}(points: Paths or Polygons) -> {_points.VERBS[verb] or 'number'}", f"        {_points.SUMMARIES[verb]}"]
    return "\n".join(lines)


VERBS = {name: Verb(name) for name in _core.verbs()}
