"""Polygons whose vertices are tensors, and their operations with derivatives."""

from __future__ import annotations

import numpy as np
import torch

import geograd
from geograd import _buffer, _columns, _core, _formulas, _polygons
from geograd._torch_host import last


def _checked(cls, vertices):
    """The array of a tensor of vertices."""
    name = f"geograd.torch.{cls.__name__}"
    if not isinstance(vertices, torch.Tensor) or not vertices.is_floating_point():
        raise TypeError("vertices: a tensor of float32 or float64 is needed")
    if vertices.device.type != "cpu":
        raise TypeError(f"{name} computes on the CPU, and a tensor is on {vertices.device}: move it with .cpu()")
    if vertices.dtype not in (torch.float32, torch.float64):
        raise TypeError(f"{name} takes float32 and float64, not {vertices.dtype}: convert with .float()")
    return vertices.detach().contiguous().numpy()


class Column:
    """What columns of tensors have in common: a column of arrays beside the tensor."""

    @property
    def layout(self):
        """Where its items are among the vertices."""
        return _columns.Layout.of(self.column)

    @property
    def offsets(self):
        """Where each item starts: of polygons the rings, the parts and the polygons."""
        return self.column.offsets

    def detach(self):
        """The column without derivatives, of arrays."""
        return self.column

    def __len__(self):
        return len(self.column)

    def __repr__(self):
        return f"<geograd.torch.{repr(self.column)[1:]}"


class Polygons(Column):
    """A column of polygons whose vertices are a tensor, of shape (V, 2): :class:`geograd.Polygons` in torch.

    ``offsets`` are those of :class:`geograd.Polygons`, or such a column, of which the rings, parts and polygons are taken.
    Numbers of polygons (areas, overlaps, distances) have derivatives of any order by the vertices; the vertices of a boolean
    operation have first ones. They run on the CPU.

    >>> squares = geograd.torch.Polygons.rings(torch.rand(8, 5, 2, requires_grad=True))
    >>> geograd.torch.area(squares).sum().backward()
    """

    def __init__(self, vertices, offsets):
        array = _checked(type(self), vertices)
        if isinstance(offsets, _core.Polygons):
            if vertices.dim() != 2 or vertices.shape[1] != 2:
                raise ValueError(f"vertices: a tensor of shape (V, 2) is needed, not {tuple(vertices.shape)}")
            self.column = geograd.Polygons(offsets._with_vertices(array))
        else:
            self.column = geograd.Polygons(array, offsets)
        self.vertices = vertices

    @classmethod
    def of(cls, polygons, dtype=torch.float64, requires_grad=False):
        """Polygons of whatever :meth:`geograd.Polygons.of` takes: lists, geometries, rings, boxes."""
        column = geograd.Polygons.of(polygons)
        return cls(torch.tensor(column.vertices, dtype=dtype, requires_grad=requires_grad), column)

    @classmethod
    def rings(cls, vertices):
        """Polygons of one ring of V vertices each, from a tensor of shape (N, V, 2)."""
        if vertices.dim() != 3 or vertices.shape[2] != 2:
            raise ValueError(f"vertices: a tensor of shape (N, V, 2) is needed, not {tuple(vertices.shape)}")
        count, size, _ = vertices.shape
        return cls(vertices.reshape(-1, 2), (np.arange(count + 1) * size,))


class Paths(Column):
    """Paths whose vertices are a tensor, of shape (V, 2) or, for those of space, (V, 3): :class:`geograd.Paths` in torch.

    ``offsets`` say where each path starts among the vertices; the last one is the number of vertices, or they are a column of
    :mod:`geograd`, whose paths are taken.

    >>> rings = geograd.torch.Rings(torch.rand(7, 2, requires_grad=True), [0, 3, 7])
    >>> geograd.torch.signed_distance(torch.zeros(2, 2), rings).sum().backward()
    """

    _column = geograd.Paths

    def __init__(self, vertices, offsets):
        array = _checked(type(self), vertices)
        offsets = offsets.offsets if isinstance(offsets, _core.Paths) else offsets
        self.column = self._column(array, np.asarray(offsets, np.int64))
        self.vertices = vertices

    @classmethod
    def of(cls, paths, dtype=torch.float64, requires_grad=False):
        """Paths of what the class of the same name in :mod:`geograd` takes: lists of vertices, or geometries."""
        column = paths if isinstance(paths, _core.Paths) else cls._column.of(paths)
        return cls(torch.tensor(column.vertices, dtype=dtype, requires_grad=requires_grad), column)


class Rings(Paths):
    """Closed paths: the last vertex of each is joined with its first one. See :class:`Paths`."""

    _column = geograd.Rings


class Polylines(Paths):
    """Open paths, of the plane or of space. See :class:`Paths`."""

    _column = geograd.Polylines


class Clouds(Paths):
    """Clouds of points of space, in any order. See :class:`Paths`."""

    _column = geograd.Clouds


#: Columns, of tensors and of arrays.
ANY = (Polygons, Paths, _core.Polygons, _core.Paths)


def _as_polygons(x, dtype=None):
    """An argument as polygons of tensors."""
    if not isinstance(x, Polygons):
        x = Polygons.of(x, dtype=dtype or torch.float64)
    if dtype is not None and x.vertices.dtype != dtype:
        x = Polygons(x.vertices.to(dtype), x.column)
    return x


def _pair(a, b):
    """Two columns in one format."""
    found = [x.vertices.dtype for x in (a, b) if isinstance(x, Polygons)]
    dtype = torch.float32 if found and all(d == torch.float32 for d in found) else torch.float64
    return _as_polygons(a, dtype), _as_polygons(b, dtype)


def _tensor(array):
    return torch.from_numpy(np.require(array, requirements=["C", "W"]))


def _array(bar):
    return np.ascontiguousarray(bar.detach().numpy())


class _Space:
    """The functions of torch by which formulas are written."""

    where, sqrt, cos, sin, stack = torch.where, torch.sqrt, torch.cos, torch.sin, torch.stack

    @staticmethod
    def constant(x, like):
        return torch.as_tensor(x, dtype=like.dtype)

    @staticmethod
    def whole(x):
        return torch.as_tensor(x)

    @staticmethod
    def sums(values, places, count):
        return values.new_zeros(count, *values.shape[1:]).index_add(0, torch.as_tensor(places), values)


class _Called(torch.autograd.Function):
    """A verb of columns and rows."""

    @staticmethod
    def forward(ctx, of, *xs):
        ctx.of = of
        ctx.save_for_backward(*xs)
        return _tensor(of.value([_array(x) for x in xs]))

    @staticmethod
    def backward(ctx, bar):
        return None, *_Slope.apply(ctx.of, bar, *ctx.saved_tensors)


class _Slope(torch.autograd.Function):
    """Its cotangents, which the library has, with their derivatives, which a formula has."""

    @staticmethod
    def forward(ctx, of, bar, *xs):
        ctx.of = of
        ctx.save_for_backward(bar, *xs)
        return tuple(map(_tensor, of.vjp([_array(x) for x in xs], _array(bar))))

    @staticmethod
    def backward(ctx, *ups):
        of = ctx.of
        if not of.has_formula:
            raise of.lacks_second()
        has_graph = torch.is_grad_enabled()
        bar, *xs = [x if has_graph and x.requires_grad else x.detach().requires_grad_() for x in ctx.saved_tensors]
        given = [torch.as_tensor(own) for own in of.choices([_array(x) for x in xs])]
        with torch.enable_grad():
            value = _formulas.value(_Space, of, given, xs)
            grads = torch.autograd.grad(value, xs, bar, create_graph=True, materialize_grads=True)
            total = sum((grad * up).sum() for grad, up in zip(grads, ups))
        return None, *torch.autograd.grad(total, [bar, *xs], create_graph=has_graph, materialize_grads=True)


class _Overlay(torch.autograd.Function):
    @staticmethod
    def forward(ctx, record, made, *vertices):
        ctx.record = record
        ctx.save_for_backward(*vertices)
        return torch.from_numpy(np.array(made.vertices))

    @staticmethod
    def backward(ctx, bar):
        return None, None, *_OverlaySlope.apply(ctx.record, bar, *ctx.saved_tensors)


class _OverlaySlope(torch.autograd.Function):
    """Its cotangents, which depend on the vertices in a way that the library does not differentiate."""

    @staticmethod
    def forward(ctx, record, bar, *vertices):
        return tuple(map(_tensor, record.vjp(_array(bar))))

    @staticmethod
    def backward(ctx, *ups):
        raise TypeError(
            "the vertices of a boolean operation of polygons have no second derivatives, only first ones; "
            "geograd.torch.intersection_area, union_area and iou have them"
        )


@torch.compiler.disable
def run(verb, arguments, kind=None, operation=_columns.Operation):
    """A verb of polygons or paths on tensors, item by item or of all pairs."""
    columns = [x for x in arguments if isinstance(x, ANY)]
    is_of_paths = any(isinstance(x, (Paths, _core.Paths)) for x in columns)
    _columns.takes_columns(verb, is_of_paths)
    wanted = 1 if verb in _columns.ALONE else 2
    if len(arguments) != wanted:
        raise TypeError(f"geograd.torch.{verb} of {type(columns[0]).__name__} takes {wanted} arguments, not {len(arguments)}")
    if not is_of_paths and verb in _polygons.OVERLAPS:
        arguments = [x if isinstance(x, Polygons) else geograd.Polygons.of(x) for x in arguments]
    own = [x.vertices if isinstance(x, (Polygons, Paths)) else x for x in arguments]
    found = {x.dtype for x in own if isinstance(x, torch.Tensor)}
    dtype = torch.float32 if found == {torch.float32} else torch.float64
    layouts, xs = zip(*[_given(verb, x, dtype, kind) for x in arguments])
    return _Called.apply(operation(verb, layouts), *xs)


def _given(verb, x, dtype, kind):
    """The layout and the tensor of an argument."""
    if isinstance(x, (_core.Polygons, _core.Paths)):
        return _columns.Layout.of(x), torch.tensor(x.vertices, dtype=dtype)
    if isinstance(x, (Polygons, Paths)):
        return x.layout, x.vertices.to(dtype)
    if not isinstance(x, torch.Tensor) or x.dim() not in (1, 2):
        given = type(x).__name__
        raise TypeError(f"geograd.torch.{verb} of a column takes a tensor of points of shape (N, 2) beside it, not {given}")
    x = x.to(dtype).reshape(-1, x.shape[-1])
    return _columns.Rows(_columns.kind_of_rows(verb, kind, x.shape[1]), len(x)), x


class Overlay:
    """An operation on polygons of tensors: see the one of :mod:`geograd`. The vertices of the result are a tensor,
    differentiable by those of both inputs."""

    def __init__(self, name):
        self.__name__ = self.__qualname__ = name
        self.__doc__ = _polygons.OVERLAYS[name].__doc__

    def __repr__(self):
        return f"<geograd.torch.{self.__name__}>"

    @torch.compiler.disable
    def __call__(self, a, b, *, fill="even_odd", valid=False):
        a, b = _pair(a, b)
        made, record = _core.polygon_overlay(self.__name__, a.column, b.column, fill, valid, True)
        vertices = _Overlay.apply(record, made, a.vertices, b.vertices)
        return Polygons(vertices, made)


class _Buffer(torch.autograd.Function):
    @staticmethod
    def forward(ctx, record, made, vertices, distance):
        ctx.record = record
        ctx.save_for_backward(vertices, distance)
        return torch.from_numpy(np.array(made.vertices))

    @staticmethod
    def backward(ctx, bar):
        return None, None, *_BufferSlope.apply(ctx.record, bar, *ctx.saved_tensors)


class _BufferSlope(torch.autograd.Function):
    """Its cotangents, which depend on the vertices in a way that the library does not differentiate."""

    @staticmethod
    def forward(ctx, record, bar, vertices, distance):
        by_vertices, by_distance = _buffer.pulled(record, _array(bar), tuple(distance.shape))
        return _tensor(by_vertices).to(vertices.dtype), torch.as_tensor(by_distance).to(distance.dtype)

    @staticmethod
    def backward(ctx, *ups):
        raise TypeError("the vertices of an offset have no second derivatives, only first ones")


@torch.compiler.disable
def buffer(column, distance, **style):
    """Polygons grown or shrunk by a distance, or the surroundings of polylines: see :func:`geograd.buffer`. The vertices of
    the result are a tensor, differentiable by those of the column and by the distance."""
    if not isinstance(column, Column):
        column = (Polylines if isinstance(column, geograd.Polylines) else Polygons).of(column)
    distance = torch.as_tensor(distance, dtype=column.vertices.dtype)
    made, record = geograd.buffer._of(column.column, _array(distance.detach()), **style)
    return Polygons(_Buffer.apply(record, made, column.vertices, distance), made)


class _BufferMeasure(torch.autograd.Function):
    @staticmethod
    def forward(ctx, measure, column, fill, vertices, distance):
        ctx.of = measure, column, fill
        ctx.save_for_backward(vertices, distance)
        return torch.from_numpy(measure(column, _array(distance), fill=fill))

    @staticmethod
    def backward(ctx, bar):
        return None, None, None, *_BufferMeasureSlope.apply(ctx.of, bar, *ctx.saved_tensors)


class _BufferMeasureSlope(torch.autograd.Function):
    """Its cotangents, with their derivatives: second derivatives are symmetric, so those along a direction are enough."""

    @staticmethod
    def forward(ctx, of, bar, vertices, distance):
        ctx.of = of
        ctx.save_for_backward(bar, vertices, distance)
        measure, column, fill = of
        by_vertices, by_distance = measure.vjp(column, _array(distance), _array(bar), fill=fill)
        return _tensor(by_vertices).to(vertices.dtype), torch.as_tensor(by_distance).to(distance.dtype)

    @staticmethod
    def backward(ctx, by_vertices, by_distance):
        measure, column, fill = ctx.of
        bar, vertices, distance = ctx.saved_tensors
        along = _array(by_vertices), _array(by_distance)
        values, (turned, further) = measure._along(column, _array(distance), _array(bar), along, fill)
        parts = _tensor(values), _tensor(turned).to(vertices.dtype), torch.as_tensor(further).to(distance.dtype)
        return None, *(last(measure.__name__, part, by_vertices, by_distance, bar, vertices, distance) for part in parts)


@torch.compiler.disable
def _buffer_measure(measure, column, distance, fill):
    if not isinstance(column, Column):
        column = (Polylines if isinstance(column, geograd.Polylines) else Polygons).of(column)
    distance = torch.as_tensor(distance, dtype=column.vertices.dtype)
    return _BufferMeasure.apply(measure, column.column, fill, column.vertices, distance)


def buffer_area(column, distance, *, fill="even_odd"):
    """The area of polygons grown or shrunk by a distance, or of the surroundings of polylines, arcs exact: see
    :func:`geograd.buffer_area`. It has derivatives of both orders by the vertices of the column and by the
    distance."""
    return _buffer_measure(geograd.buffer_area, column, distance, fill)


def buffer_perimeter(column, distance, *, fill="even_odd"):
    """The perimeter of polygons grown or shrunk by a distance, or of the surroundings of polylines, arcs exact: see
    :func:`geograd.buffer_perimeter`. It has derivatives of both orders by the vertices of the column and by the
    distance."""
    return _buffer_measure(geograd.buffer_perimeter, column, distance, fill)


OVERLAYS = {name: Overlay(name) for name in _polygons.OVERLAYS}
globals().update(OVERLAYS)


def union_area(a, b):
    """The area that two polygons cover together, item by item."""
    return run("union_area", (a, b))


@torch.compiler.disable
def contains(polygons, points, *, fill="even_odd"):
    """Says whether polygons contain points, item by item, decided exactly: see :func:`geograd.contains`."""
    polygons = polygons.column if isinstance(polygons, (Polygons, Paths)) else polygons
    return torch.from_numpy(geograd.contains(polygons, _array(points) if isinstance(points, torch.Tensor) else points, fill=fill))
