"""Polygons whose vertices are tensors, and their operations with derivatives."""

from __future__ import annotations

import numpy as np
import torch
from torch.autograd.function import once_differentiable

import geograd
from geograd import _core, _polygons


class Polygons:
    """A column of polygons whose vertices are a tensor, of shape (V, 2): :class:`geograd.Polygons` in torch.

    ``offsets`` are those of :class:`geograd.Polygons`, or such a column, of which the rings, parts and polygons are taken.
    Operations are differentiable by the vertices, once. They run on the CPU.

    >>> squares = geograd.torch.Polygons.rings(torch.rand(8, 5, 2, requires_grad=True))
    >>> geograd.torch.area(squares).sum().backward()
    """

    def __init__(self, vertices, offsets):
        if not isinstance(vertices, torch.Tensor) or not vertices.is_floating_point():
            raise TypeError("vertices: a tensor of float32 or float64 is needed")
        if vertices.device.type != "cpu":
            raise TypeError(f"geograd.torch.Polygons computes on the CPU, and a tensor is on {vertices.device}: move it with .cpu()")
        if vertices.dtype not in (torch.float32, torch.float64):
            raise TypeError(f"geograd.torch.Polygons takes float32 and float64, not {vertices.dtype}: convert with .float()")
        array = vertices.detach().contiguous().numpy()
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

    @property
    def offsets(self):
        """Where each ring starts among the vertices, each part among the rings, each polygon among the parts."""
        return self.column.offsets

    def detach(self):
        """The column without derivatives, a :class:`geograd.Polygons`."""
        return self.column

    def __len__(self):
        return len(self.column)

    def __repr__(self):
        return f"<geograd.torch.{repr(self.column)[1:]}"


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


class _Measure(torch.autograd.Function):
    @staticmethod
    def forward(ctx, name, column, vertices):
        ctx.name, ctx.column = name, column
        return _tensor(_core.polygon_measure(name, column))

    @staticmethod
    @once_differentiable
    def backward(ctx, bar):
        return None, None, _tensor(_core.polygon_measure(ctx.name, ctx.column, _array(bar)))


class _Overlap(torch.autograd.Function):
    @staticmethod
    def forward(ctx, name, a, b, *vertices):
        ctx.name, ctx.pair = name, (a, b)
        return _tensor(_core.polygon_overlap(name, a, b))

    @staticmethod
    @once_differentiable
    def backward(ctx, bar):
        _, (by_a, by_b) = _core.polygon_overlap(ctx.name, *ctx.pair, _array(bar))
        return None, None, None, _tensor(by_a), _tensor(by_b)


class _Distance(torch.autograd.Function):
    @staticmethod
    def forward(ctx, is_of_area, column, fill, points, vertices):
        ctx.arguments = np.ascontiguousarray(points.detach().numpy()), column, fill, is_of_area
        ctx.size = points.shape
        return _tensor(_core.polygon_distance(*ctx.arguments))

    @staticmethod
    @once_differentiable
    def backward(ctx, bar):
        _, (by_points, by_vertices) = _core.polygon_distance(*ctx.arguments, _array(bar))
        return None, None, None, _tensor(by_points).reshape(ctx.size), _tensor(by_vertices)


class _Overlay(torch.autograd.Function):
    @staticmethod
    def forward(ctx, record, made, *vertices):
        ctx.record = record
        return torch.from_numpy(np.array(made.vertices))

    @staticmethod
    @once_differentiable
    def backward(ctx, bar):
        by_a, by_b = ctx.record.vjp(_array(bar))
        return None, None, _tensor(by_a), _tensor(by_b)


@torch.compiler.disable
def run(verb, arguments):
    """A verb of polygons on tensors."""
    wanted = 1 if verb in _polygons.MEASURES else 2
    if verb not in _polygons.VERBS and verb != "union_area":
        raise TypeError(f"geograd.torch.{verb} takes no Polygons; they have {', '.join(_polygons.VERBS)}")
    if len(arguments) != wanted:
        raise TypeError(f"geograd.torch.{verb} of Polygons takes {wanted} arguments, not {len(arguments)}")
    if verb in _polygons.MEASURES:
        own = _as_polygons(arguments[0])
        return _Measure.apply(verb, own.column, own.vertices)
    if verb in _polygons.DISTANCES:
        return _distance(verb, *arguments)
    a, b = _pair(*arguments)
    return _Overlap.apply(verb, a.column, b.column, a.vertices, b.vertices)


def _distance(verb, first, second):
    polygons, points = (first, second) if isinstance(first, (Polygons, _core.Polygons)) else (second, first)
    if not isinstance(points, torch.Tensor) or points.shape[-1:] != (2,) or points.dim() > 2:
        raise TypeError(f"geograd.torch.{verb} of Polygons takes a tensor of points of shape (N, 2)")
    is_single = points.dtype == torch.float32 and (
        not isinstance(polygons, Polygons) or polygons.vertices.dtype == torch.float32
    )
    dtype = torch.float32 if is_single else torch.float64
    own, points = _as_polygons(polygons, dtype), points.to(dtype).reshape(-1, 2)
    found = _Distance.apply(verb == "distance", own.column, "even_odd", points, own.vertices)
    return -found if verb == "depth" else found


class Overlay:
    """A boolean operation on polygons of tensors: see the one of :mod:`geograd`. The vertices of the result are a tensor,
    differentiable by those of both inputs."""

    def __init__(self, name):
        self.__name__ = self.__qualname__ = name
        self.__doc__ = _polygons.OVERLAYS[name].__doc__

    def __repr__(self):
        return f"<geograd.torch.{self.__name__}>"

    @torch.compiler.disable
    def __call__(self, a, b, *, fill="even_odd", valid=False):
        a, b = _pair(a, b)
        made, record = _core.polygon_overlay(self.__name__, a.column, b.column, fill, valid)
        vertices = _Overlay.apply(record, made, a.vertices, b.vertices)
        return Polygons(vertices, made)


OVERLAYS = {name: Overlay(name) for name in _polygons.OVERLAYS}


def union_area(a, b):
    """The area that two polygons cover together, item by item."""
    return run("union_area", (a, b))
