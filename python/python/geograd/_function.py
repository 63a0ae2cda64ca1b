"""Functions of one's own, recorded once."""

import dataclasses
import functools
import inspect
import operator
import sys
import threading
import types
import typing
import weakref

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
    if annotation is inspect.Parameter.empty or annotation in (float, int, Symbol):
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
    if isinstance(annotation, type) and issubclass(annotation, tuple) and hasattr(annotation, "_fields"):
        hints = typing.get_type_hints(annotation, include_extras=True)
        parts = [(f".{field}", _kind(hints.get(field, float), name)) for field in annotation._fields]
        return _Parts(lambda made, cls=annotation: cls(*made), parts)
    origin, arguments = typing.get_origin(annotation), typing.get_args(annotation)
    if origin is tuple and arguments and arguments[-1] is not Ellipsis:
        return _Parts(tuple, [(f"[{i}]", _kind(part, name)) for i, part in enumerate(arguments)])
    if origin is typing.Annotated and typing.get_origin(arguments[0]) is list and isinstance(arguments[1], int):
        (item,) = typing.get_args(arguments[0])
        return _Parts(list, [(f"[{i}]", _kind(item, name)) for i in range(arguments[1])])
    raise TypeError(
        f"argument {name}: {annotation!r} does not say how many numbers it has; annotate it with float, a shape, a "
        "dataclass or NamedTuple of such, tuple[A, B], Annotated[list[A], 3], or the number of its numbers; an argument "
        "with a default that is no number, such as None or True, stays as it is"
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

    __slots__ = ("function", "kinds", "named")

    def __init__(self, function, kinds, named):
        self.function, self.kinds, self.named = function, kinds, named

    def __call__(self, lists):
        lists = iter(lists)
        made = [kind.build(lists) for kind in self.kinds]
        count = len(made) - len(self.named)
        result = self.function(*made[:count], **dict(zip(self.named, made[count:])))
        is_tuple = isinstance(result, tuple)
        parts = list(result) if is_tuple else [result]
        return is_tuple, [_part(part) for part in parts]


class _Weakly:
    """A method of an object that it does not keep."""

    def __init__(self, method, instance):
        self.method, self.instance = method, weakref.ref(instance)
        functools.update_wrapper(self, method)
        parameters = list(inspect.signature(method).parameters.values())
        self.__signature__ = inspect.Signature(parameters[1:])

    def __call__(self, *arguments, **named):
        return self.method(self.instance(), *arguments, **named)


def _hints(function):
    """The annotations of a function, of what a partial or a class's call calls."""
    while isinstance(function, functools.partial):
        function = function.func
    function = function.method if isinstance(function, _Weakly) else function
    if not inspect.isroutine(function):
        function = type(function).__call__
    return typing.get_type_hints(function, include_extras=True)


def _is_constant(default):
    """Whether a default is no number and no shape: such an argument stays as it is."""
    if default is inspect.Parameter.empty or isinstance(default, _core.Shape) or dataclasses.is_dataclass(default):
        return False
    if isinstance(default, (bool, str, bytes, type(None))) or callable(default):
        return True
    try:
        return np.asarray(default).dtype.kind not in "iuf"
    except ValueError:
        return not isinstance(default, (tuple, list))


class Function(Forms):
    """A function that is recorded once, at its first call, and then runs on arrays: a row of them at a time, on all lanes
    and threads.

    Arguments are arrays, or shapes of arrays, or what their annotations say, of arrays; an array of a dataclass, a tuple or
    a list has all its numbers in the last axis. Gradients are arrays like the arguments, or of all numbers in the last axis.
    An argument that is left out has its default, and a gradient. Of a method the numbers of its object are constants:
    it is recorded anew after an attribute was set. Functions are pickled by name, and by value by cloudpickle.
    """

    def __init__(self, function):
        if isinstance(function, Function):
            raise TypeError(f"{function.__name__} is a geograd.function already")
        functools.update_wrapper(self, function)
        if not hasattr(self, "__name__"):
            inner = function
            while isinstance(inner, functools.partial):
                inner = inner.func
            self.__name__ = self.__qualname__ = getattr(inner, "__name__", type(inner).__name__)
        hints = _hints(function)
        self._kinds, self._names, self._defaults, leaves, named = [], [], [], [], []
        for name, parameter in inspect.signature(function).parameters.items():
            if parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD):
                raise TypeError(f"argument {name}: a traced function has a fixed list of arguments")
            if _is_constant(parameter.default):
                continue
            kind = _kind(hints.get(name, parameter.annotation), name)
            self._kinds.append(kind)
            self._names.append(name)
            self._defaults.append(parameter.default)
            leaves.append(kind.leaves(name))
            # After one that stays as it is, places differ from those of the function.
            if parameter.kind == parameter.KEYWORD_ONLY or named or self._skips(function, name):
                named.append(name)
        self._leaves = leaves
        self._is_plain = all(not isinstance(kind, _Parts) for kind in self._kinds)
        self._named = named
        self._methods = {}
        recipe = _Recipe(function, self._kinds, named)
        self._core = _core.Recorded(self.__name__, recipe, [leaf for own in leaves for leaf in own])

    @staticmethod
    def _skips(function, name):
        """Whether an argument that stays as it is comes before another one."""
        for own, parameter in inspect.signature(function).parameters.items():
            if own == name:
                return False
            if _is_constant(parameter.default):
                return True
        return False

    def __get__(self, instance, owner=None):
        """The function of an object's method."""
        if instance is None:
            return self
        numbers = dict(getattr(instance, "__dict__", {}))
        known, before, made = self._methods.get(id(instance), (None, {}, None))
        is_known = known is not None and known() is instance and before.keys() == numbers.keys()
        if not is_known or any(before[key] is not numbers[key] for key in numbers):
            try:
                known = weakref.ref(instance, lambda _, key=id(instance): self._methods.pop(key, None))
            except TypeError:
                return Function(types.MethodType(self.__wrapped__, instance))
            made = Function(_Weakly(self.__wrapped__, instance))
            self._methods[id(instance)] = known, numbers, made
        bound = object.__new__(Function)
        bound.__dict__.update(made.__dict__)
        bound.__self__ = instance
        return bound

    def __reduce__(self):
        if "__self__" in self.__dict__:
            return getattr, (self.__self__, self.__name__)
        return reduced(self, Function, self.__wrapped__, ".__wrapped__")

    def __copy__(self):
        return self

    def __deepcopy__(self, memo):
        # As Python's own functions are, but for a method's object.
        import copy

        return getattr(copy.deepcopy(self.__self__, memo), self.__name__) if "__self__" in self.__dict__ else self

    def _given(self, arguments, named):
        """All arguments in order, with those by name and defaults."""
        if len(arguments) >= len(self._names) and not named:
            return arguments
        made = dict(zip(self._names, arguments))
        for name, x in named.items():
            if name not in self._names:
                raise TypeError(f"{self.__name__} takes {', '.join(self._names)}, not {name}")
            if name in made:
                raise TypeError(f"{self.__name__}: argument {name} is given twice")
            made[name] = x
        for name, default in zip(self._names, self._defaults):
            if name not in made:
                if default is inspect.Parameter.empty:
                    raise TypeError(f"{self.__name__} takes {', '.join(self._names)}: {name} is missing")
                made[name] = default
        return tuple(made[name] for name in self._names) + tuple(arguments[len(self._names) :])

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

    def __call__(self, *arguments, out=None, backend=None, **named):
        """The results of every item."""
        return self._run("value", self._given(arguments, named), None, None, out, backend)

    def _run(self, form, arguments, kind, to, out, backend):
        _no_row_is_chosen(kind, to)
        if any(map(_has_symbol, arguments)):
            return self._on_symbols(form, arguments, out)
        results = self._core.run(form, self._split(arguments, 2 if form in ("jvp", "hvp") else 1), out, backend)
        if form == "value_grad":
            return results[0], self._joined(results[1])
        return self._joined(results) if form in ("vjp", "hvp") else results

    def _on_symbols(self, form, arguments, out):
        """The form as a part of the function that is being recorded."""
        if out is not None:
            raise TypeError("out is for arrays, not for symbols")
        if form == "value":
            count = len(self._kinds) - len(self._named)
            return self.__wrapped__(*arguments[:count], **dict(zip(self._named, arguments[count:])))
        columns = []
        for k, argument in enumerate(arguments):
            own, numbers = self._leaves[k % len(self._leaves)], _flat(argument)
            for _, _, size in own if k < len(self._leaves) or form in ("jvp", "hvp") else [(None, None, len(numbers))]:
                columns.append([numbers.pop(0) for _ in range(max(size, 1)) if numbers])
        is_double = next(x for own in columns for x in own if isinstance(x, Symbol)).dtype == "float64"
        core = self._core
        # A thread has one recording at a time, and this one's is open.
        program = _elsewhere(lambda: core.program(form, is_double))
        symbols = program.on_symbols(columns)
        widths = [max(width, 1) * bool(width) for _, width in _elsewhere(core.gives)]
        takes = [size for own in self._leaves for _, _, size in own]

        def parts(sizes):
            made = []
            for size in sizes:
                own = [symbols.pop(0) for _ in range(max(size, 1))]
                made.append(np.array(own, object) if size else own[0])
            return made

        def one(made):
            return made[0] if len(made) == 1 else tuple(made)

        if form == "value_grad":
            value = parts(widths)
            return one(value), self._joined(one(parts(takes)))
        if form in ("vjp", "hvp"):
            return self._joined(one(parts(takes)))
        if form == "jvp":
            return one(parts(widths)), one(parts(widths))
        inputs = sum(max(size, 1) for size in takes)
        rows = len(symbols) // inputs
        is_lone = form == "jacobian" and widths == [0]
        return np.array(symbols, object).reshape((inputs,) if is_lone else (rows, inputs))

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
        """A module of JavaScript that exports a form of the function, in float64 with the same bits; `program_of` has float32."""
        return self.program_of(form).javascript(name or self.__name__)

    def __repr__(self):
        return f"<geograd.Function {self.__name__}({', '.join(self._names)})>"


def _no_row_is_chosen(kind, to):
    if kind is not None or to is not None:
        raise TypeError("kind= and to= choose a row of a verb; a traced function has the shapes of its annotations")


def _elsewhere(compute):
    """The result of a function on a thread of its own."""
    done = []

    def run():
        try:
            done.append((compute(), None))
        except BaseException as error:
            done.append((None, error))

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    result, error = done[0]
    if error is not None:
        raise error
    return result


def reduced(made, make, function, inner):
    """What `__reduce__` of a decorated function gives: `inner` leads from its name to the plain function."""
    module, name = getattr(made, "__module__", None), getattr(made, "__qualname__", "")
    try:
        found = operator.attrgetter(name)(sys.modules[module])
    except (AttributeError, KeyError):
        found = None
    if found is not made:
        return make, (function,)
    if module != "__main__":
        return name
    # Another process has another __main__: pickle then finds the plain function by this name, and cloudpickle takes it
    # by value.
    function.__qualname__ = name + inner
    return make, (function,)


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

    Annotations are shapes, ``float``, how many numbers an argument has (``q: 6``), or dataclasses, NamedTuples, tuples
    and lists of such. A constant path stands in it as ``geograd.Rings.of([vertices])``, a path of points as
    ``geograd.distance(p, [a, b, c], kind=("Vec2", "ring"))``. NumPy's elementary functions are recorded; ``np.where``
    chooses.
    """
    return Function(f)
