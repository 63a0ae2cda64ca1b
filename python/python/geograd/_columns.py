"""Verbs of polygons and paths as functions of arrays, with the layouts of their columns: what torch and JAX run."""

import functools

import numpy as np

import geograd
from geograd import _core, _formulas, _polygons, _separation

#: Verbs of one column alone; others are of two, or of a column and rows.
ALONE = (*_polygons.MEASURES, "signed_area", "second_moments")


class Layout:
    """Where the items of a column are among its vertices: a column without their numbers."""

    #: The axes of the array that has the numbers.
    rank = 2

    def __init__(self, cls, offsets, width=2, template=None):
        self.cls, self.width = cls, width
        self.offsets = tuple(np.array(own, np.int64) for own in offsets)
        if issubclass(cls, _core.Polygons):
            if template is None:
                # Vertices of some polygons of these rings: no three lie on a line.
                places = np.arange(self.offsets[0][-1] if len(self.offsets[0]) else 0, dtype=float)
                template = geograd.Polygons(np.stack([places, places**2], 1), self.offsets)
            self.template, self.offsets = template, template.offsets
            rings, parts, polygons = self.offsets
            self.ends = rings[parts[polygons]]
        else:
            (self.ends,) = self.offsets
            sizes = np.diff(self.ends)
            if self.ends[:1].tolist() != [0] or (sizes < 0).any():
                raise ValueError(f"offsets: the first one is 0 and none is less than the one before, not {self.ends.tolist()[:9]}")

    @classmethod
    def of(cls, column):
        """The layout of a column of NumPy."""
        if isinstance(column, _core.Polygons):
            return cls(geograd.Polygons, column.offsets, 2, column)
        return cls(type(column), (column.offsets,), column.vertices.shape[1])

    @property
    def _key(self):
        return self.cls, self.width, *[own.tobytes() for own in self.offsets]

    def __eq__(self, other):
        return isinstance(other, Layout) and self._key == other._key

    def __hash__(self):
        return hash(self._key)

    @property
    def count(self):
        return len(self.ends) - 1

    def dressed(self, vertices):
        """The column of some vertices."""
        if issubclass(self.cls, _core.Polygons):
            return geograd.Polygons(self.template._with_vertices(np.ascontiguousarray(vertices)))
        return self.cls(vertices, self.offsets[0])

    def repeated(self, count):
        """The layout of one item so many times."""
        sizes = [np.diff(own) for own in self.offsets]
        return Layout(self.cls, [np.concatenate([[0], np.cumsum(np.tile(own, count))]) for own in sizes], self.width)

    def checked(self, shape):
        """Raises an error unless vertices have a shape."""
        wanted = int(self.ends[-1]), self.width
        if tuple(shape[-2:]) != wanted:
            raise ValueError(f"vertices: {wanted} is the shape that the offsets ask for, not {tuple(shape)}")

    def chosen(self, items):
        """The layout of some items, and the places of their vertices."""
        places, made = np.asarray(items, np.int64), []
        for own in self.offsets[::-1]:
            sizes = np.diff(own)[places]
            made.append(np.concatenate([[0], np.cumsum(sizes)]))
            places = _formulas.ranges(own[:-1][places], sizes)
        return Layout(self.cls, made[::-1], self.width), places

    def sums(self, of_vertices):
        """The sums of what the vertices of each item have."""
        made = np.concatenate([np.zeros((1, *of_vertices.shape[1:]), of_vertices.dtype), np.cumsum(of_vertices, 0)])
        return made[self.ends[1:]] - made[self.ends[:-1]]


class Rows:
    """Rows of numbers of one shape: points, or the boxes that polygons have a distance from."""

    rank = 2

    def __init__(self, kind, count):
        self.kind, self.count = kind, count
        self.width = len(getattr(geograd, kind)._fields)

    def __eq__(self, other):
        return isinstance(other, Rows) and (self.kind, self.count) == (other.kind, other.count)

    def __hash__(self):
        return hash((self.kind, self.count))

    def dressed(self, rows):
        return getattr(geograd, self.kind)(rows)

    def repeated(self, count):
        return Rows(self.kind, count)

    def checked(self, shape):
        if shape[-1] != self.width:
            raise ValueError(f"a {self.kind} has {self.width} numbers, not {shape[-1]}")

    def chosen(self, items):
        return Rows(self.kind, len(items)), np.asarray(items, np.int64)

    def sums(self, of_rows):
        return of_rows


class Operation:
    """A verb of columns and rows, each given by an array: value, cotangents, derivatives along directions."""

    def __init__(self, verb, layouts):
        self.verb, self.layouts = verb, tuple(layouts)
        counts = {own.count for own in self.layouts}
        if len(counts - {1}) > 1:
            raise ValueError(f"geograd.{verb}: columns have {' and '.join(map(str, sorted(counts)))} rows, not one number of them")
        self.count = next(iter(counts - {1}), 1)
        self.gives = self._width()

    def __eq__(self, other):
        # Compiled functions are kept by it: that of all pairs is another one.
        return type(self) is type(other) and (self.verb, self.layouts) == (other.verb, other.layouts)

    def __hash__(self):
        return hash((type(self), self.verb, self.layouts))

    @property
    def size(self):
        """The shape of the result."""
        return (self.count, self.gives) if self.gives else (self.count,)

    def _width(self):
        """How many numbers each result has; 0 for one lone number."""
        if any(isinstance(own, Layout) and own.cls is geograd.Polygons for own in self.layouts):
            return 2 if self.verb == "centroid" else 0
        wide = next(own.width for own in self.layouts if isinstance(own, Layout))
        return {"centroid": wide, "second_moments": 3 * wide - 3}.get(self.verb, 0)

    def _dressed(self, xs):
        return [own.dressed(x) for own, x in zip(self.layouts, xs)]

    def value(self, xs):
        """The results, an array."""
        if not self.count:
            return np.zeros(self.size, xs[0].dtype)
        found = getattr(geograd, self.verb)(*self._dressed(xs))
        return np.asarray(found.array if isinstance(found, _core.Shape) else found).reshape(self.size)

    def vjp(self, xs, bar):
        """Cotangents of the arrays, from those of the results."""
        if not self.count:
            return [np.zeros_like(x) for x in xs]
        found = getattr(geograd, self.verb).vjp(*self._dressed(xs), np.ascontiguousarray(bar))
        found = found if isinstance(found, tuple) else (found,)
        # A row of points that stands for all has a cotangent of each item.
        is_spread = [own.shape != x.shape and len(x) == 1 for own, x in zip(found, xs)]
        summed = [own.sum(0) if spread else own for own, spread in zip(found, is_spread)]
        return [own.reshape(x.shape) for own, x in zip(summed, xs)]

    def jvp(self, xs, directions):
        """The derivatives of the results along directions of the arrays, of which some may be None."""
        if self.count != 1 and any(own.count == 1 for own in self.layouts):
            alone = [own.count == 1 for own in self.layouts]
            whole = Operation(self.verb, [own.repeated(self.count) if one else own for own, one in zip(self.layouts, alone)])
            spread = lambda x, one: np.tile(x, (self.count, 1)) if one and x is not None else x
            return whole.jvp(*[[spread(x, one) for x, one in zip(given, alone)] for given in (xs, directions)])
        made = np.zeros((self.count, max(self.gives, 1)), xs[0].dtype)
        for place in range(made.shape[1]):
            bar = np.zeros_like(made)
            bar[:, place] = 1
            for own, by, along in zip(self.layouts, self.vjp(xs, bar.reshape(self.size)), directions):
                if along is not None:
                    made[:, place] += own.sums((by * along).sum(1))
        return made.reshape(self.size)

    @property
    def whole(self):
        """The operation item by item: itself."""
        return self

    def spread(self, xs):
        """The arrays of its items: those that it takes."""
        return xs

    def choices(self, xs):
        """What a formula takes as given: which edges are nearest, how rings turn."""
        return _formulas.choices(self.whole, self.whole._dressed(self.spread(xs)))

    @property
    def has_formula(self):
        return _formulas.kind_of(self) is not None

    def lacks_second(self):
        """The error of second derivatives that are not there."""
        return TypeError(f"geograd.{self.verb} of {self.layouts[-1].cls.__name__} has no second derivatives, only first ones")


class Pairs(Operation):
    """A verb of every item of one column or rows with every item of another: a matrix."""

    def __init__(self, verb, layouts):
        self.verb, self.layouts = verb, tuple(layouts)
        if len(self.layouts) != 2 or self._width():
            raise TypeError(f"geograd.{verb} has no all_pairs: they are of two columns, and a number each")
        self.counts = tuple(own.count for own in self.layouts)
        self.gives, self.count = 0, self.counts[0] * self.counts[1]

    @property
    def size(self):
        return self.counts

    @functools.cached_property
    def _crossed(self):
        n, m = self.counts
        chosen = [np.repeat(np.arange(n), m), np.tile(np.arange(m), n)]
        return [own.chosen(items) for own, items in zip(self.layouts, chosen)]

    @property
    def whole(self):
        return Operation(self.verb, [own for own, _ in self._crossed])

    def spread(self, xs):
        return [x[places] for x, (_, places) in zip(xs, self._crossed)]

    def _each(self, *lists):
        """The operation of each item of the shorter column with all of the other one, and the arrays of both in some lists."""
        side = int(self.counts[1] <= self.counts[0])
        for item in range(self.counts[side] if self.count else 0):
            layouts = list(self.layouts)
            layouts[side], places = layouts[side].chosen([item])
            found = [[x if k != side or x is None else x[places] for k, x in enumerate(xs)] for xs in lists]
            yield (slice(None), item) if side else (item, slice(None)), side, places, Operation(self.verb, layouts), *found

    def value(self, xs):
        verb = getattr(geograd, self.verb)
        if self.count and not isinstance(self.layouts[0], Layout) or all(own.cls is geograd.Polygons for own in self.layouts):
            return np.asarray(verb.all_pairs(*self._dressed(xs)))
        made = np.zeros(self.size, xs[0].dtype)
        for at, _, _, of, own in self._each(xs):
            made[at] = of.value(own)
        return made

    def vjp(self, xs, bar):
        made = [np.zeros_like(x) for x in xs]
        for at, side, places, of, own in self._each(xs):
            found = of.vjp(own, np.asarray(bar)[at])
            made[side][places] += found[side]
            made[1 - side] += found[1 - side]
        return made

    def jvp(self, xs, directions):
        made = np.zeros(self.size, xs[0].dtype)
        for at, _, _, of, own, along in self._each(xs, directions):
            made[at] = of.jvp(own, along)
        return made


def takes_columns(verb, paths):
    """Raises an error unless a verb takes polygons, or paths."""
    if not paths:
        if verb not in _polygons.VERBS and verb != "union_area":
            raise TypeError(f"geograd.{verb} takes no Polygons; they have {', '.join([*_polygons.VERBS, 'union_area'])}")
        return
    rows = {name for name in geograd._VERBS if any(row["sort"] == "fold" for row in _core.rows(name))}
    if verb not in rows:
        raise TypeError(f"geograd.{verb} takes no paths; they have {', '.join(sorted(rows))}")


def kind_of_rows(verb, kind, width):
    """The shape of an argument that is no column: points, unless `kind` says another one."""
    names = [kind] if not isinstance(kind, (tuple, list)) else list(kind)
    names = [own if isinstance(own, str) or own is None else own.__name__ for own in names]
    names = [own for own in names if own not in (None, "Polygons", "Rings", "Polylines", "Clouds", "ring", "polyline", "polyline3")]
    if len(names) > 1 or (names and names[0] not in ("Vec2", "Vec3", *_separation.CORNERS)):
        raise TypeError(f"geograd.{verb}: kind= names the shape beside a column, one of Vec2, {', '.join(_separation.CORNERS)}")
    if names:
        return names[0]
    if width not in (2, 3):
        raise TypeError(f"geograd.{verb}: rows of {width} numbers are no points; say their shape by kind=")
    return f"Vec{width}"
