"""The verbs, made of the table."""

from . import _core, _points, _polygons
from ._forms import Forms


class Verb(_core.Verb, Forms):
    """A function of shapes, of which the shapes choose the row."""

    @property
    def __doc__(self):
        return describe(self.__name__)

    __module__ = "geograd"


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
    if verb in _polygons.VERBS:
        takes, gives = _polygons.VERBS[verb]
        lines += [f"    {verb}({takes}) -> {gives}", f"        {_polygons.SUMMARIES[verb]}"]
    if verb in _points.VERBS:
        lines += [f"    {verb}(points: Paths or Polygons) -> {_points.VERBS[verb] or 'number'}", f"        {_points.SUMMARIES[verb]}"]
    return "\n".join(lines)


VERBS = {name: Verb(name) for name in _core.verbs()}
