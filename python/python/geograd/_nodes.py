"""Functions of arrays with derivatives of any order, by name: what :mod:`geograd.torch` and :mod:`geograd.jax` call."""

from __future__ import annotations

import difflib
import functools
import itertools
import threading
import weakref

import numpy as np

import geograd
from geograd import _core

#: Losses, and the scores that they are made of.
LOSSES = {
    "IoULoss": "iou",
    "GIoULoss": "giou",
    "DIoULoss": "diou",
    "CIoULoss": "ciou",
    "EIoULoss": "eiou",
    "ProbIoULoss": "probiou",
    "KFIoULoss": "kfiou",
}

_NODES = {}
#: Those of recorded functions, which live as long as their functions, what is derived of these, and what calls them.
_OWN = weakref.WeakValueDictionary()
_COUNT = itertools.count()
_LOCK = threading.RLock()


def _store(name):
    """Where the node of a name is kept: recorded functions are numbered."""
    return _OWN if "#" in name else _NODES


# A description of all rows of a verb takes longer than a call.
_rows = functools.lru_cache(maxsize=None)(_core.rows)


def size(lead, width):
    """The shape of an argument or result of so many numbers, or of a lone number, over leading axes."""
    return (*lead, width) if width else tuple(lead)


def _flat(results):
    """Results in order, as arrays."""
    if type(results) is np.ndarray:
        return [results]
    if isinstance(results, tuple):
        return [array for part in results for array in _flat(part)]
    return [np.asarray(results)]


class _Row:
    """A row of a verb."""

    def __init__(self, verb, row, to):
        self.verb, self.kinds, self.to = getattr(geograd, verb), tuple(row["kinds"]), to
        self.takes = [(name, shape, width) for name, shape, width in row["takes"]]
        self.gives = [width for _, _, width in row["gives"]]
        self.is_search = row["sort"] == "search"
        self.is_tuple = len(self.gives) > 1

    def run(self, form, arrays):
        return _flat(self.verb._run(form, tuple(arrays), self.kinds, self.to))

    def program(self, form, double):
        return self.verb.program(kind=self.kinds, to=self.to, form=form, double=double)


class _Own:
    """A recorded function."""

    def __init__(self, recorded, takes, gives, is_tuple):
        self.recorded, self.takes, self.gives, self.is_tuple = recorded, takes, gives, is_tuple

    def run(self, form, arrays):
        return _flat(self.recorded.run(form, arrays))

    def program(self, form, double):
        return self.recorded.program(form, double)


class Node:
    """A form of a row or of a recorded function: what it takes and gives, and its derivatives as further nodes."""

    def __init__(self, name, base, form, takes, gives):
        self.name, self.base, self.form, self.takes, self.gives = name, base, form, takes, gives
        self.is_tuple = form != "value" or base.is_tuple
        self.derived = {}
        #: What a library keeps of the node: one object for all calls, by which its own caches find what they compiled.
        self.kept = {}

    def run(self, arrays):
        return self.base.run(self.form, arrays)

    def vjp(self):
        """The node of the cotangents of the arguments."""
        bars = [(f"upstream{k}", None, width) for k, width in enumerate(self.gives)]
        return self._derived("vjp", bars, [width for _, _, width in self.takes])

    def jvp(self):
        """The node of the results, and of their derivatives along directions of the arguments."""
        directions = [(f"along_{name}", None, width) for name, _, width in self.takes]
        return self._derived("jvp", directions, [*self.gives, *self.gives])

    def _derived(self, form, further, gives):
        name = f"{self.name}|{form}"
        with _LOCK:
            if form not in self.derived:
                base = self.base if self.form == "value" else self._recorded()
                node = Node(name, base, form, [*self.takes, *further], list(gives))
                self.derived[form] = _store(name)[name] = node
            return self.derived[form]

    def _recorded(self):
        """The form as a function of its own, of which forms can be made again."""

        def function(lists):
            program = self.base.program(self.form, lists[0][0].dtype == "float64")
            symbols = program.on_symbols(lists)
            parts, at = [], 0
            for width in self.gives:
                parts.append((None, symbols[at : at + max(width, 1)], width > 0))
                at += max(width, 1)
            return True, parts

        takes = [(name, shape if shape in geograd._CLASSES else None, width) for name, shape, width in self.takes]
        recorded = _core.Recorded(self.name, function, takes)
        return _Own(recorded, self.takes, self.gives, True)


def named(name):
    """The node of a name: made where it was not asked for before, as in another process."""
    with _LOCK:
        node = _store(name).get(name)
    if node is not None:
        return node
    base, *forms = name.split("|")
    with _LOCK:
        node = _store(base).get(base)
    if node is None:
        if "#" in base:
            raise RuntimeError(f"{base.partition('#')[0]}: the recorded function is gone; keep it while its results are used")
        verb, _, rest = base.partition("(")
        kinds, _, to = rest.partition(")")
        node = of_verb(verb, tuple(kinds.split(",")), None, to[1:] or None)
    for form in forms:
        node = getattr(node, form)()
    return node


def _name(kind):
    """A shape by its name; lone numbers have none."""
    return "number" if kind is None else kind if isinstance(kind, str) else kind.__name__


#: Nodes by what callers ask for: a search among rows takes longer than a call.
_ASKED = {}


def of_verb(verb, kind, count, to=None):
    """The node of a row: ``kind`` is a shape, or one for each argument; ``to`` is the shape of the result."""
    asked = (verb, tuple(kind) if isinstance(kind, list) else kind, count, to)
    node = _ASKED.get(asked)
    if node is None:
        node = _ASKED[asked] = _found(verb, kind, count, to)
    return node


def _found(verb, kind, count, to):
    if verb not in geograd._VERBS:
        raise ValueError(f"no verb is called {verb!r}; {alike(verb, geograd._VERBS)}")
    rows = [row for row in _rows(verb) if row["sort"] in ("straight", "search")]
    fits = rows
    if isinstance(kind, (tuple, list)):
        wanted = tuple(map(_name, kind))
        fits = [row for row in fits if tuple(row["kinds"]) == wanted]
    elif kind is not None:
        own = _name(kind)
        fits = [
            row
            for row in fits
            if set(row["kinds"]) <= {own, "number"}
            and own in row["kinds"]
            and (count is None or len(row["kinds"]) == count)
        ]
        # As many shapes of the kind as can be: lone numbers fit it, too.
        most = max((row["kinds"].count(own) for row in fits), default=0)
        fits = [row for row in fits if row["kinds"].count(own) == most]
    else:
        fits = [row for row in fits if all(k == "number" for k in row["kinds"])]
    given = lambda row: row["gives"][0][1] if row["gives"][0][2] else "number"
    # `to` chooses among several results; the name of a node has it then.
    chosen = ""
    if len(fits) > 1 and to is not None:
        chosen = f">{_name(to)}"
    if to is not None:
        fits = [row for row in fits if given(row) == _name(to)]
    if len(fits) != 1:
        raise TypeError(_unfound(verb, kind, to, fits, rows, given))
    base = _Row(verb, fits[0], to if chosen else None)
    name = f"{verb}({','.join(base.kinds)}){chosen}"
    with _LOCK:
        if name not in _NODES:
            _NODES[name] = Node(name, base, "value", base.takes, base.gives)
        return _NODES[name]


def _unfound(verb, kind, to, fits, rows, given):
    """Why no row was found, with those that are there."""
    if len(fits) > 1:
        return f"{verb}: several results are possible; say which by to=, one of {', '.join(map(given, fits))}"
    if isinstance(kind, str) and kind not in geograd._CLASSES and kind != "number":
        return f"{verb}: no shape is called {kind!r}; {alike(kind, geograd._CLASSES)}"
    known = ", ".join(dict.fromkeys("(" + ", ".join(row["kinds"]) + ")" for row in rows))
    asked = "kind= must name the shapes of the tensors" if kind is None else f"no row has kind={kind!r}"
    asked += f" and to={to!r}" if to is not None else ""
    return f"{verb}: {asked}. Shapes that go together: {known}"


def alike(name, names):
    """A hint of the names that are like one."""
    same = [own for own in names if own.lower() == str(name).lower()]
    near = same or difflib.get_close_matches(str(name), list(names))
    return f"is it {' or '.join(near)}?" if near else f"there are {', '.join(names)}"


def of_function(f):
    """The node of a :class:`geograd.Function`."""
    with _LOCK:
        node = getattr(f, "_node", None)
        if node is None:
            takes = [leaf for own in f._leaves for leaf in own]
            gives = [width for _, width in f._core.gives()]
            name = f"{f.__name__}#{next(_COUNT)}"
            node = Node(name, _Own(f._core, takes, gives, f._core.is_tuple()), "value", takes, gives)
            _OWN[name] = f._node = node
        return node


def split(function, leaves, names, arguments):
    """The columns of the arguments of a function: an argument of several parts has all their numbers in its last axis."""
    if len(arguments) != len(leaves):
        raise TypeError(f"{function} takes {', '.join(names)}, not {len(arguments)} arguments")
    columns = []
    for argument, own, name in zip(arguments, leaves, names):
        if len(own) == 1:
            columns.append(argument)
            continue
        total = sum(max(width, 1) for _, _, width in own)
        if argument.ndim == 0 or argument.shape[-1] != total:
            raise ValueError(f"`{name}`: shape (..., {total}) is needed, not {tuple(argument.shape)}")
        start = 0
        for _, _, width in own:
            columns.append(argument[..., start : start + width] if width else argument[..., start])
            start += max(width, 1)
    return columns
