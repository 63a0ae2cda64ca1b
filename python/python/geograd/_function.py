"""Functions of one's own, recorded once."""

import dataclasses
import functools
import inspect
import typing

import numpy as np

from . import _core
from ._core import Symbol
from ._forms import Forms


class _Number:
    """A lone number."""

    def leaves(self, name):
        return [(name, None, 0)]

    def build(self, lists):
        return next(lists)[0]


class _List:
    """So many numbers."""

    def __init__(self, size):
        self.size = size

    def leaves(self, name):
        return [(name, None, self.size)]

    def build(self, lists):
        return list(next(lists))


class _Shape:
    """A shape of the table."""

    def __init__(self, cls):
        self.cls = cls

    def leaves(self, name):
        return [(name, self.cls.__name__, len(self.cls._fields))]

    def build(self, lists):
        return self.cls(*next(lists))


class _Parts:
    """A dataclass, a tuple or a list of things."""

    def __init__(self, make, parts):
        self.make, self.parts = make, parts

    def leaves(self, name):
        return [leaf for part, kind in self.parts for leaf in kind.leaves(f"{name}{part}")]

    def build(self, lists):
        return self.make([kind.build(lists) for _, kind in self.parts])


def _kind(annotation, name):
    """What an annotation says of an argument."""
    if annotation is inspect.Parameter.empty or annotation is float:
        return _Number()
    if isinstance(annotation, int) and not isinstance(annotation, bool) and annotation > 0:
        return _List(annotation)
    if isinstance(annotation, type) and issubclass(annotation, _core.Shape) and hasattr(annotation, "_fields"):
        return _Shape(annotation)
    if dataclasses.is_dataclass(annotation):
        hints = typing.get_type_hints(annotation, include_extras=True)
        fields = [field.name for field in dataclasses.fields(annotation)]
        parts = [(f".{field}", _kind(hints[field], name)) for field in fields]
        return _Parts(lambda made, cls=annotation, fields=fields: cls(**dict(zip(fields, made))), parts)
    origin, arguments = typing.get_origin(annotation), typing.get_args(annotation)
    if origin is tuple and arguments and arguments[-1] is not Ellipsis:
        return _Parts(tuple, [(f"[{i}]", _kind(part, name)) for i, part in enumerate(arguments)])
    if origin is typing.Annotated and typing.get_origin(arguments[0]) is list and isinstance(arguments[1], int):
        (item,) = typing.get_args(arguments[0])
        return _Parts(list, [(f"[{i}]", _kind(item, name)) for i in range(arguments[1])])
    raise TypeError(
        f"argument {name}: {annotation!r} does not say how many numbers it has; annotate it with float, a shape, a "
        "dataclass of such, tuple[A, B], Annotated[list[A], 3], or the number of its numbers"
    )


def _flat(x):
    """The numbers of a result."""
    if isinstance(x, _core.Shape):
        return list(x.numbers)
    if dataclasses.is_dataclass(x) and not isinstance(x, type):
        return [n for field in dataclasses.fields(x) for n in _flat(getattr(x, field.name))]
    if isinstance(x, (tuple, list)):
        return [n for item in x for n in _flat(item)]
    if isinstance(x, np.ndarray) and x.ndim:
        return [n for item in x for n in _flat(item)]
    return [x]


def _part(x):
    """A part of a result: the name of its shape, its numbers, and whether they have an axis."""
    if isinstance(x, _core.Shape):
        return type(x).__name__, _flat(x), True
    if isinstance(x, (int, float, np.number, Symbol)) or (isinstance(x, np.ndarray) and x.ndim == 0):
        return None, [x[()] if isinstance(x, np.ndarray) else x], False
    if x is None or isinstance(x, (str, bytes)):
        raise TypeError(f"a traced function gives symbols and numbers, shapes, tuples and lists of them, not {x!r}")
    return None, _flat(x), True


def _has_symbol(x):
    if isinstance(x, Symbol):
        return True
    if isinstance(x, _core.Shape):
        return x._is_symbolic
    if isinstance(x, (tuple, list)):
        return any(map(_has_symbol, x))
    if dataclasses.is_dataclass(x) and not isinstance(x, type):
        return any(_has_symbol(getattr(x, field.name)) for field in dataclasses.fields(x))
    return isinstance(x, np.ndarray) and x.dtype == object and any(map(_has_symbol, x.flat))


class _Recipe:
    """What a recording calls: without the `Function` that holds the recording, so that both end with their last use."""

    __slots__ = ("function", "kinds")

    def __init__(self, function, kinds):
        self.function, self.kinds = function, kinds

    def __call__(self, lists):
        lists = iter(lists)
        result = self.function(*[kind.build(lists) for kind in self.kinds])
        is_tuple = isinstance(result, tuple)
        parts = list(result) if is_tuple else [result]
        return is_tuple, [_part(part) for part in parts]


class Function(Forms):
    """A function that is recorded once, at its first call, and then runs on arrays: a row of them at a time, on all lanes
    and threads.

    Arguments are arrays, or shapes of arrays, or what their annotations say, of arrays; an array of a dataclass, a tuple or
    a list has all its numbers in the last axis. Gradients are arrays like the arguments, or of all numbers in the last axis.
    """

    def __init__(self, function):
        functools.update_wrapper(self, function)
        signature = inspect.signature(function)
        hints = typing.get_type_hints(function, include_extras=True)
        self._kinds = []
        leaves = []
        for name, parameter in signature.parameters.items():
            if parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD, parameter.KEYWORD_ONLY):
                raise TypeError(f"argument {name}: a traced function has a fixed list of arguments")
            kind = _kind(hints.get(name, parameter.annotation), name)
            self._kinds.append(kind)
            leaves.append(kind.leaves(name))
        self._names = list(signature.parameters)
        self._leaves = leaves
        self._is_plain = all(not isinstance(kind, _Parts) for kind in self._kinds)
        recipe = _Recipe(function, self._kinds)
        self._core = _core.Recorded(function.__name__, recipe, [leaf for own in leaves for leaf in own])

    # Arguments of several parts: their arrays, and back.
    def _split(self, arguments, times=1):
        if self._is_plain:
            return list(arguments)
        wanted = len(self._kinds) * times
        if len(arguments) < wanted:
            raise TypeError(f"{self.__name__} takes {', '.join(self._names)}, not {len(arguments)} arguments")
        made = []
        for k, argument in enumerate(arguments):
            own = self._leaves[k % len(self._kinds)] if k < wanted else None
            made.extend([argument] if own is None or len(own) == 1 else _columns(argument, own))
        return made

    def _joined(self, derivatives):
        """Gradients of the arguments, of those of all their parts."""
        if self._is_plain:
            return derivatives
        derivatives = list(derivatives) if isinstance(derivatives, tuple) else [derivatives]
        made = []
        for own in self._leaves:
            parts, derivatives = derivatives[: len(own)], derivatives[len(own):]
            wide = [np.asarray(part)[..., None] if size == 0 else part for part, (_, _, size) in zip(parts, own)]
            made.append(parts[0] if len(parts) == 1 else np.concatenate(wide, -1))
        return made[0] if len(made) == 1 else tuple(made)

    def __call__(self, *arguments, out=None, backend=None):
        """The results of every item."""
        return self._run("value", arguments, None, None, out, backend)

    def _run(self, form, arguments, kind, to, out, backend):
        _no_row_is_chosen(kind, to)
        if form == "value" and any(map(_has_symbol, arguments)):
            return self.__wrapped__(*arguments)
        results = self._core.run(form, self._split(arguments, 2 if form in ("jvp", "hvp") else 1), out, backend)
        if form == "value_grad":
            return results[0], self._joined(results[1])
        return self._joined(results) if form in ("vjp", "hvp") else results

    def _of_pairs(self, form, a, b, more, kind, out, backend, groups=None):
        _no_row_is_chosen(kind, None)
        return self._core.of_pairs(form, [a, b], more, out, backend, groups)

    def _suppress(self, shapes, scores, overlap, classes, score, most, groups, kind):
        _no_row_is_chosen(kind, None)
        return self._core.suppress(shapes, scores, overlap, classes, score, most, groups)

    @property
    def program(self):
        """Its operations in float64, in the order in which they are carried out."""
        return self.program_of()

    def program_of(self, form="value", dtype=np.float64):
        """The operations of a form (value, value_grad, vjp, jacobian, jvp, hvp, hessian) in a format."""
        return self._core.program(form, np.dtype(dtype) == np.float64)

    def wgsl(self, name=None):
        """The function in WGSL, in float32. A shader with it needs `geograd.WGSL`, once."""
        return self.program_of(dtype=np.float32).wgsl(name or self.__name__)

    def javascript(self, name=None, form="value"):
        """A module of JavaScript that exports a form of the function, in float64 with the same bits."""
        return self.program_of(form).javascript(name or self.__name__)

    def __repr__(self):
        return f"<geograd.Function {self.__name__}({', '.join(self._names)})>"


def _no_row_is_chosen(kind, to):
    if kind is not None or to is not None:
        raise TypeError("kind= and to= choose a row of a verb; a traced function has the shapes of its annotations")


def _columns(argument, leaves):
    """The arrays of an argument of several parts."""
    if not isinstance(argument, np.ndarray):
        parts = _arrays(argument)
        if len(parts) == len(leaves):
            return parts
        argument = np.asarray(argument)
    total = sum(max(size, 1) for _, _, size in leaves)
    if argument.ndim == 0 or argument.shape[-1] != total:
        name = leaves[0][0].partition(".")[0].partition("[")[0]
        raise ValueError(f"`{name}`: an array of shape (..., {total}) is needed, or its parts, not {argument.shape}")
    made, start = [], 0
    for _, _, size in leaves:
        made.append(argument[..., start : start + size] if size else argument[..., start])
        start += max(size, 1)
    return made


def _arrays(x):
    """The arrays of the parts of a dataclass, a tuple or a list."""
    if dataclasses.is_dataclass(x) and not isinstance(x, type):
        return [part for field in dataclasses.fields(x) for part in _arrays(getattr(x, field.name))]
    if isinstance(x, (tuple, list)):
        return [part for item in x for part in _arrays(item)]
    return [x]


def function(f):
    """Records a function of annotated arguments once, and runs it on arrays, with all its derivatives.

    ::

        @geograd.function
        def loss(a: geograd.Obb2, b: geograd.Obb2):
            return 1 - geograd.iou(a, b) + 0.1 * abs(a.heading - b.heading)

        value, (by_a, by_b) = loss.value_grad(A, B)    # arrays of shape (N, 5)
    """
    return Function(f)
