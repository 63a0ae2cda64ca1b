"""Columns of polygons and paths whose vertices are JAX's arrays, and their verbs with derivatives."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
from jax.interpreters import ad

import geograd
from geograd import _columns, _core, _formulas, _polygons
from geograd._jax import Kind


class Column:
    """Columns of arrays: their layout is a constant of a compiled function, their vertices are a leaf of a tree."""

    def __init__(self, vertices, offsets):
        own = offsets if isinstance(offsets, (_core.Polygons, _core.Paths)) else None
        vertices = jnp.asarray(vertices)
        if vertices.ndim != 2:
            raise ValueError(f"vertices: an array of shape (V, 2) is needed, not {vertices.shape}")
        if vertices.dtype not in (jnp.float32, jnp.float64):
            name = f"geograd.jax.{type(self).__name__}"
            raise TypeError(f"{name} takes float32 and float64, not {vertices.dtype}: convert with .astype")
        self.layout = _columns.Layout.of(own) if own is not None else self._made(offsets, vertices.shape[1])
        self.layout.checked(vertices.shape)
        if not isinstance(vertices, jax.core.Tracer):
            # Numbers that are no polygons have their error here, and in a compiled function where it runs.
            self.layout.dressed(np.asarray(vertices))
        self.vertices = vertices

    @classmethod
    def _made(cls, offsets, width):
        return _columns.Layout(cls._column, (offsets,), width)

    @classmethod
    def of(cls, items, dtype=None):
        """A column of what the class of the same name in :mod:`geograd` takes: lists of vertices, geometries, shapes."""
        column = items if isinstance(items, (_core.Polygons, _core.Paths)) else cls._column.of(items)
        column = geograd.Polygons.of(column) if issubclass(cls, Polygons) else column
        return cls(jnp.asarray(column.vertices, dtype), column)

    @property
    def offsets(self):
        """Where each item starts: of polygons the rings, the parts and the polygons."""
        own = self.layout.offsets
        return own if isinstance(self, Polygons) else own[0]

    def __len__(self):
        return self.layout.count

    def __repr__(self):
        return f"<geograd.jax.{type(self).__name__} {len(self)} of {int(self.layout.ends[-1])} vertices>"

    def tree_flatten(self):
        return (self.vertices,), self.layout

    @classmethod
    def tree_unflatten(cls, layout, children):
        made = object.__new__(cls)
        made.layout, (made.vertices,) = layout, children
        return made


@jax.tree_util.register_pytree_node_class
class Polygons(Column):
    """A column of polygons whose vertices are an array, of shape (V, 2): :class:`geograd.Polygons` in JAX.

    ``offsets`` are those of :class:`geograd.Polygons`, or such a column, of which the rings, parts and polygons are taken. A
    column is a tree with one leaf, its vertices: it goes into ``jit``, ``grad`` and ``vmap``, and its gradient is such a column.

    >>> def loss(a, b): return (1 - geograd.jax.iou(a, b)).sum()
    >>> by_vertices = jax.grad(loss)(geograd.jax.Polygons.of(a), geograd.jax.Polygons.of(b)).vertices
    """

    _column = geograd.Polygons

    @classmethod
    def _made(cls, offsets, width):
        return _columns.Layout(geograd.Polygons, offsets)

    @classmethod
    def rings(cls, vertices):
        """Polygons of one ring of V vertices each, from an array of shape (N, V, 2)."""
        vertices = jnp.asarray(vertices)
        if vertices.ndim != 3 or vertices.shape[2] != 2:
            raise ValueError(f"vertices: an array of shape (N, V, 2) is needed, not {vertices.shape}")
        count, size, _ = vertices.shape
        return cls(vertices.reshape(-1, 2), (np.arange(count + 1) * size,))


class Paths(Column):
    """Paths whose vertices are an array, of shape (V, 2) or, for those of space, (V, 3), and where each path starts."""

    _column = geograd.Paths


@jax.tree_util.register_pytree_node_class
class Rings(Paths):
    """Closed paths: the last vertex of each is joined with its first one."""

    _column = geograd.Rings


@jax.tree_util.register_pytree_node_class
class Polylines(Paths):
    """Open paths, of the plane or of space."""

    _column = geograd.Polylines


@jax.tree_util.register_pytree_node_class
class Clouds(Paths):
    """Clouds of points of space, in any order."""

    _column = geograd.Clouds


#: Columns, of JAX's arrays and of NumPy's.
ANY = (Column, _core.Polygons, _core.Paths)


class _Space:
    """The functions of JAX by which formulas are written."""

    where, sqrt, cos, sin, stack = staticmethod(jnp.where), jnp.sqrt, jnp.cos, jnp.sin, staticmethod(jnp.stack)

    @staticmethod
    def constant(x, like):
        return jnp.asarray(x, like.dtype)

    @staticmethod
    def whole(x):
        return jnp.asarray(x)

    @staticmethod
    def sums(values, places, count):
        return jax.ops.segment_sum(values, jnp.asarray(places), count)


def _each(run, xs, ranks):
    """Results of a function of arrays, for every item of the axes that `vmap` has put in front."""
    xs = [np.asarray(x) for x in xs]
    lead = xs[0].shape[: xs[0].ndim - ranks[0]]
    if not lead:
        return run(xs)
    flat = [x.reshape(-1, *x.shape[x.ndim - rank :]) for x, rank in zip(xs, ranks)]
    found = [run([x[i] for x in flat]) for i in range(len(flat[0]))]
    return [np.stack(own).reshape(*lead, *own[0].shape) for own in zip(*found)] if found else None


def _lead(xs):
    return xs[0].shape[:-2]


def _struct(xs, size, dtype=None):
    return jax.ShapeDtypeStruct((*_lead(xs), *size), dtype or xs[0].dtype)


def _along(of, active, xs):
    """Arguments, and directions of those that are active: None for the others."""
    count = len(of.layouts)
    given = iter(xs[count:])
    return xs[:count], [next(given) if is_active else None for is_active in active]


def _valued(xs, of):
    return _each(lambda own: [of.value(own)], xs, [2] * len(xs))


def _pushed(xs, of, active):
    return _each(lambda own: [of.jvp(*_along(of, active, own))], xs, [2] * len(xs))


def _pulled(xs, of):
    return _each(lambda own: of.vjp(own[:-1], own[-1]), xs, [2] * (len(xs) - 1) + [len(of.size)])


#: The results of an operation, their derivatives along directions, and the cotangents of its arrays.
_VALUE = Kind("geograd_column", _valued, lambda xs, of: [_struct(xs, of.size)])
_PUSH = Kind("geograd_column_push", _pushed, lambda xs, of, active: [_struct(xs, of.size)])
_PULL = Kind("geograd_column_pull", _pulled, lambda xs, of: [_struct([x], x.shape[-2:]) for x in xs[:-1]])


def _by_formula(of, xs):
    """The operation as a function that JAX differentiates, at some arguments."""
    if not of.has_formula:
        raise of.lacks_second()
    lead = _lead(xs)
    kinds = [((*lead, count), xs[0].dtype if kind == "float" else jnp.int32) for kind, count in _formulas.sizes(of)]
    given = []
    if kinds:

        def host(*xs):
            def made(own):
                return [np.asarray(x, dtype) for x, (_, dtype) in zip(of.choices(own), kinds)]

            return tuple(_each(made, xs, [2] * len(xs)))

        fixed = [jax.lax.stop_gradient(x) for x in xs]
        given = jax.pure_callback(host, tuple(jax.ShapeDtypeStruct(*kind) for kind in kinds), *fixed, vmap_method="broadcast_all")
    f = lambda given, xs: _formulas.value(_Space, of, given, xs)
    # Derivatives of what `vmap` has spread already.
    for _ in lead:
        f = jax.vmap(f)
    return lambda *xs: f(given, xs)


def _is_zero(t):
    return isinstance(t, ad.Zero)


def _push_bound(of, xs, tangents):
    active = tuple(t is not None and not _is_zero(t) for t in tangents)
    return _PUSH.bind(*xs, *[ad.instantiate_zeros(t) for t, own in zip(tangents, active) if own], of=of, active=active)


def _value_jvp(xs, tangents, *, of):
    return _VALUE.bind(*xs, of=of), _push_bound(of, xs, tangents)


def _push_jvp(inputs, tangents, *, of, active):
    xs, directions = _along(of, active, inputs)
    found = _PUSH.bind(*inputs, of=of, active=active)
    _, of_directions = _along(of, active, tangents)
    of_xs = tangents[: len(xs)]
    if all(map(_is_zero, of_xs)):
        # Linear in directions.
        return found, _push_bound(of, xs, of_directions)
    f = _by_formula(of, xs)
    whole = [jnp.zeros_like(x) if d is None else d for x, d in zip(xs, directions)]
    of_whole = [jnp.zeros_like(x) if t is None else ad.instantiate_zeros(t) for x, t in zip(xs, of_directions)]
    along = lambda xs, ts: jax.jvp(f, tuple(xs), tuple(ts))[1]
    return found, [jax.jvp(along, (list(xs), whole), ([ad.instantiate_zeros(t) for t in of_xs], of_whole))[1]]


def _push_transpose(bars, *inputs, of, active):
    xs, directions = _along(of, active, inputs)
    grads = _PULL.bind(*xs, ad.instantiate_zeros(bars[0]), of=of)
    linear = [grad if ad.is_undefined_primal(d) else None for grad, d, own in zip(grads, directions, active) if own]
    return [None] * len(xs) + linear


def _pull_jvp(inputs, tangents, *, of):
    *xs, bar = inputs
    *of_xs, of_bar = tangents
    found = _PULL.bind(*inputs, of=of)
    if all(map(_is_zero, of_xs)):
        # Linear in cotangents.
        return found, _PULL.bind(*xs, ad.instantiate_zeros(of_bar), of=of)
    f = _by_formula(of, xs)
    back = lambda xs, bar: list(jax.vjp(f, *xs)[1](bar))
    return found, jax.jvp(back, (list(xs), bar), ([ad.instantiate_zeros(t) for t in of_xs], ad.instantiate_zeros(of_bar)))[1]


def _pull_transpose(bars, *inputs, of):
    *xs, bar = inputs
    (found,) = _PUSH.bind(*xs, *[ad.instantiate_zeros(own) for own in bars], of=of, active=(True,) * len(xs))
    return [None] * len(xs) + [found]


for _kind, _rule in ((_VALUE, _value_jvp), (_PUSH, _push_jvp), (_PULL, _pull_jvp)):
    ad.primitive_jvps[_kind.primitive] = _rule
ad.primitive_transposes[_PUSH.primitive] = _push_transpose
ad.primitive_transposes[_PULL.primitive] = _pull_transpose


def _given(verb, x, dtype, kind):
    """The layout and the array of an argument."""
    if isinstance(x, (_core.Polygons, _core.Paths)):
        return _columns.Layout.of(x), jnp.asarray(x.vertices, dtype)
    if isinstance(x, Column):
        return x.layout, x.vertices.astype(dtype)
    x = jnp.asarray(x).astype(dtype)
    if x.ndim not in (1, 2):
        raise ValueError(f"geograd.jax.{verb} of a column takes an array of points of shape (N, 2) beside it, not {x.shape}")
    x = x.reshape(-1, x.shape[-1])
    return _columns.Rows(_columns.kind_of_rows(verb, kind, x.shape[1]), len(x)), x


def run(verb, arguments, kind=None, operation=_columns.Operation):
    """A verb of polygons or paths on JAX's arrays, item by item or of all pairs."""
    is_of_paths = any(isinstance(x, (Paths, _core.Paths)) for x in arguments)
    _columns.takes_columns(verb, is_of_paths)
    wanted = 1 if verb in _columns.ALONE else 2
    if len(arguments) != wanted:
        raise TypeError(f"geograd.jax.{verb} of a column takes {wanted} arguments, not {len(arguments)}")
    if not is_of_paths and verb in _polygons.OVERLAPS:
        arguments = [x if isinstance(x, Polygons) else geograd.Polygons.of(x) for x in arguments]
    own = [x.vertices if isinstance(x, Column) else x for x in arguments if not isinstance(x, (_core.Polygons, _core.Paths))]
    dtype = jnp.result_type(*own, jnp.float32) if own else jnp.result_type(float)
    layouts, xs = zip(*[_given(verb, x, dtype, kind) for x in arguments])
    return _VALUE.bind(*xs, of=operation(verb, layouts))[0]


def union_area(a, b):
    """The area that two polygons cover together, item by item."""
    return run("union_area", (a, b))


def contains(polygons, points, *, fill="even_odd"):
    """Says whether polygons contain points, item by item, decided exactly: see :func:`geograd.contains`."""
    polygons = polygons if isinstance(polygons, Column) else Polygons.of(polygons)
    layout, points = polygons.layout, jnp.asarray(points, polygons.vertices.dtype)
    points = points.reshape(-1, 2) if points.ndim == 1 else points
    count = len(points) if layout.count == 1 else layout.count

    def host(vertices, points):
        def found(own):
            return [np.asarray(geograd.contains(layout.dressed(own[0]), own[1], fill=fill))]

        return _each(found, (vertices, points), [2, 2])[0]

    xs = map(jax.lax.stop_gradient, (polygons.vertices, points))
    return jax.pure_callback(host, jax.ShapeDtypeStruct((count,), bool), *xs, vmap_method="broadcast_all")
