"""The verbs, made of the table."""

import inspect

from . import _core
from ._forms import Forms


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
    lines = [rows[0]["summary"], "", "Rows:"]
    for row in rows:
        names = [name for name, _, _ in row["takes"]] + (["paths"] if row["sort"] == "fold" else [])
        takes = ", ".join(f"{name}: {kind}" for name, kind in zip(names, row["kinds"]))
        gives = ", ".join(_spelled(column) for column in row["gives"])
        lines.append(f"    {verb}({takes}) -> {gives}")
        if row["summary"] != rows[0]["summary"]:
            lines.append(f"        {row['summary']}")
    return "\n".join(lines)


VERBS = {name: Verb(name) for name in _core.verbs()}
