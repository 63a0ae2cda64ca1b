"""Classes of shapes, made of the table: a class for each, with its fields as attributes."""

import keyword
import re

import numpy as np

from . import _convert, _core, _meaning


class Part:
    """A part of a shape, with its numbers as attributes."""

    def __init__(self, names, numbers):
        self.__dict__.update(zip(names, numbers))

    def __repr__(self):
        return f"Part({', '.join(self.__dict__)})"


def _number(place):
    return property(lambda self: self._number(place), doc=f"The number in place {place}.")


def _part(names, places):
    def get(self):
        numbers = [self._number(place) for place in places]
        vector = {("x", "y"): "Vec2", ("x", "y", "z"): "Vec3"}.get(tuple(names))
        if vector is not None:
            return CLASSES[vector](*numbers)
        return Part(names, numbers)

    return property(get, doc=f"Its numbers {', '.join(names)}.")


def _items(parts):
    return property(lambda self: [part.__get__(self) for part in parts])


def _attributes(fields):
    """Properties of the fields: of ``min.x`` a part ``min``, of ``links[0].x`` a list ``links``."""
    made, groups, lists = {}, {}, {}
    for place, field in enumerate(fields):
        head, _, rest = field.partition(".")
        head = head + "_" if keyword.iskeyword(head) else head
        match = re.fullmatch(r"(\w*)\[(\d+)\]", head)
        if match:
            lists.setdefault(match[1] or "items", {}).setdefault(int(match[2]), []).append((rest, place))
        elif rest:
            groups.setdefault(head, []).append((rest, place))
        else:
            made[head] = _number(place)
    for head, parts in groups.items():
        made[head] = _part([rest for rest, _ in parts], [place for _, place in parts])
    for head, items in lists.items():
        made[head] = _items(
            [
                _part([rest for rest, _ in parts], [place for _, place in parts]) if parts[0][0] else _number(parts[0][1])
                for _, parts in sorted(items.items())
            ]
        )
    return made


class _Vector:
    """Arithmetic of vectors: of arrays and of symbols."""

    __slots__ = ()
    __array_ufunc__ = None

    def __add__(self, other):
        return self._with(other, lambda a, b: a + b)

    def __sub__(self, other):
        return self._with(other, lambda a, b: a - b)

    def _with(self, other, of):
        if type(other) is not type(self):
            return NotImplemented
        return type(self)(*[of(a, b) for a, b in zip(self.numbers, other.numbers)])

    def __mul__(self, factor):
        if isinstance(factor, _core.Shape):
            return NotImplemented
        return type(self)(*[a * factor for a in self.numbers])

    __rmul__ = __mul__

    def __truediv__(self, factor):
        if isinstance(factor, _core.Shape):
            return NotImplemented
        return type(self)(*[a / factor for a in self.numbers])

    def __neg__(self):
        return type(self)(*[-a for a in self.numbers])

    def dot(self, other):
        """The scalar product."""
        products = [a * b for a, b in zip(self.numbers, other.numbers)]
        return sum(products[1:], products[0])

    def length(self):
        """The length: zero with derivative zero at the origin."""
        from ._elementary import hypot

        first, *rest = self.numbers
        for number in rest:
            first = hypot(first, number)
        return first


def _cross(self, other):
    """The third component of the cross product."""
    return self.x * other.y - self.y * other.x


def _classes():
    made = []
    for kind, (name, described, codes) in enumerate(_core.shapes()):
        if not described:
            made.append(None)
            continue
        fields = [field for field, _, _ in described]
        bases = (_Vector, _core.Shape) if name in ("Vec2", "Vec3") else (_core.Shape,)
        body = {
            "__slots__": (),
            "__module__": "geograd",
            "__doc__": _meaning.described(name, described),
            "_kind": kind,
            "_fields": tuple(fields),
            "_codes": codes,
            **_attributes(fields),
        }
        if name == "Vec2":
            body["cross"] = _cross
        made.append(type(name, bases, body))
    return made


class Paths(_core.Paths):
    """Paths: vertices one after another, and where each path starts; the last offset is the number of vertices.

    ``paths[i]`` is an array of the vertices of one, ``paths[i:j]``, and places or truths as an array, are paths.
    """

    __slots__ = ()

    def __getitem__(self, key):
        offsets = np.asarray(self.offsets)
        if isinstance(key, (int, np.integer)) and not isinstance(key, bool):
            place, count = key.__index__(), len(self)
            if not -count <= place < count:
                raise IndexError(f"{place}: there are {count} paths")
            place %= count
            return self.vertices[offsets[place] : offsets[place + 1]]
        places = np.arange(len(self))[key]
        sizes = np.diff(offsets)[places]
        ends = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)
        # The place of every vertex: that of its path's first one, and how far it is from there.
        rows = np.repeat(offsets[:-1][places] - ends[:-1], sizes) + np.arange(ends[-1])
        return type(self)(self.vertices[rows], ends)

    def __iter__(self):
        return (self[i] for i in range(len(self)))

    def __reduce__(self):
        return type(self), (self.vertices, self.offsets)


class Rings(Paths):
    """Closed paths: the last vertex of each is joined with its first one, which is not repeated.

    An area is positive for counter-clockwise vertices. A distance is that from the edges, also inside;
    ``np.maximum(geograd.signed_distance(points, rings), 0)`` is that of shapely from polygons.
    """

    __slots__ = ()
    _path = "ring"

    @classmethod
    def of(cls, paths):
        """Rings of lists of vertices, or of geometries."""
        return cls(*_convert.paths(paths, cls.__name__, closed=True))


class Polylines(Paths):
    """Open paths, of the plane or of space."""

    __slots__ = ()
    _path = "polyline"

    @classmethod
    def of(cls, paths):
        """Polylines of lists of vertices, or of geometries."""
        return cls(*_convert.paths(paths, cls.__name__, widths=(2, 3)))


class Clouds(Paths):
    """Clouds of points of space, in any order."""

    __slots__ = ()
    _path = "cloud"

    @classmethod
    def of(cls, clouds):
        """Clouds of lists of points."""
        return cls(*_convert.paths(clouds, cls.__name__, widths=(3,)))


_LIST = _classes()
CLASSES = {made.__name__: made for made in _LIST if made is not None}
_core.set_classes(_LIST, _convert.numbers)
