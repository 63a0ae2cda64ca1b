"""Queries of a mesh on tensors, with gradients for points, rays and vertices."""

from __future__ import annotations

from functools import partial
from typing import Any, Optional, Union

import numpy as np
import torch

import geograd
from geograd import _core
from geograd import _record_formulas as formulas
from geograd._mesh import SOLIDS, energy_columns
from geograd._shapes import CLASSES
from geograd._torch_host import checked, differentiated, last
from geograd._torch_verbs import _VERBS


def _columns(name: str, tensor: Any, width: int) -> torch.Tensor:
    """Refuses what is no tensor of shape (..., width) on the CPU."""
    tensor = checked(name, tensor, "meshes")
    if tensor.dim() == 0 or tensor.shape[-1] != width:
        raise ValueError(f"{name}: a tensor of shape (..., {width}) is needed, not {tuple(tensor.shape)}")
    return tensor


def _array(name: str, tensor: Any) -> Any:
    """The array of a tensor of shape (..., 3), as rows of float64."""
    return np.ascontiguousarray(_columns(name, tensor, 3).detach().numpy().reshape(-1, 3), np.float64)


def _like(array: Any, tensor: torch.Tensor) -> torch.Tensor:
    return torch.from_numpy(array).to(tensor.dtype).reshape(tensor.shape)


class _Nearest(torch.autograd.Function):
    """A distance of points, or their closest points."""

    @staticmethod
    def forward(ctx: Any, core: Any, kind: str, points: torch.Tensor, vertices: torch.Tensor) -> torch.Tensor:
        rows = _array("points", points)
        found = core.search(rows)
        ctx.core, ctx.kind, ctx.found, ctx.rows, ctx.values = core, kind, found, rows, None
        ctx.save_for_backward(points, vertices)
        if kind == "closest":
            return _like(core.closest(rows, found), points)
        values = torch.from_numpy(core.distances(kind, rows, found))
        ctx.values = values
        return values.to(points.dtype).reshape(points.shape[:-1])

    @staticmethod
    def backward(ctx: Any, upstream: torch.Tensor) -> Any:
        points, vertices = ctx.saved_tensors
        if torch.is_grad_enabled():
            faces, code = (torch.from_numpy(own) for own in (ctx.core.faces[ctx.found[:, 0]], ctx.found[:, 1]))
            again = partial(formulas.nearest, torch, torch.Tensor.detach, ctx.kind, faces, code, ctx.values)
            return None, None, *differentiated(again, (points, vertices), upstream)
        bars = np.ascontiguousarray(upstream.detach().numpy(), np.float64)
        if ctx.kind == "closest":
            by_points, by_vertices = ctx.core.closest(ctx.rows, ctx.found, bars.reshape(-1, 3))
        else:
            by_points, by_vertices = ctx.core.distances(ctx.kind, ctx.rows, ctx.found, bars.reshape(-1))
        return None, None, _like(by_points, points), _like(by_vertices, vertices)


class _Rays(torch.autograd.Function):
    """The parameters of hits, and the faces."""

    @staticmethod
    def forward(
        ctx: Any, core: Any, starts: torch.Tensor, directions: torch.Tensor, vertices: torch.Tensor, faces: Any = None
    ) -> Any:
        rows = _array("starts", starts), _array("directions", directions)
        parameters, faces = core.first_hits(*rows) if faces is None else (core.parameters(*rows, faces), faces)
        ctx.core, ctx.rows, ctx.faces = core, rows, faces
        ctx.save_for_backward(starts, directions, vertices)
        values = torch.from_numpy(parameters).to(starts.dtype).reshape(starts.shape[:-1])
        indices = torch.from_numpy(faces).reshape(starts.shape[:-1])
        ctx.mark_non_differentiable(indices)
        return values, indices

    @staticmethod
    def backward(ctx: Any, upstream: torch.Tensor, _: Any) -> Any:
        if torch.is_grad_enabled():
            # A miss is infinitely far whatever moves; a loss may divide by that.
            hit = torch.from_numpy(ctx.faces >= 0).reshape(upstream.shape)
            upstream = torch.where(hit, upstream, torch.zeros_like(upstream))
            faces = torch.from_numpy(ctx.core.faces[np.maximum(ctx.faces, 0)])
            again = partial(formulas.parameters, torch, faces, ~hit.reshape(-1))
            return None, *differentiated(again, ctx.saved_tensors, upstream), None
        bars = np.ascontiguousarray(upstream.detach().numpy().reshape(-1), np.float64)
        # A miss is infinitely far whatever moves; a loss may divide by that.
        bars = np.where(ctx.faces < 0, 0.0, bars)
        parts = ctx.core.parameters(*ctx.rows, ctx.faces, bars)
        return None, *(_like(part, own) for part, own in zip(parts, ctx.saved_tensors)), None


class _Solids(torch.autograd.Function):
    """The distances of solids."""

    @staticmethod
    def forward(ctx: Any, core: Any, kind: str, solids: torch.Tensor, vertices: torch.Tensor) -> torch.Tensor:
        rows = np.ascontiguousarray(solids.detach().numpy().reshape(-1, solids.shape[-1]), np.float64)
        faces = _core.mesh_solid_search(core, kind, rows)
        ctx.given, ctx.faces = (core, kind, rows), faces
        ctx.save_for_backward(solids, vertices)
        values = _core.mesh_solid_distances(core, kind, rows, faces)
        return torch.from_numpy(values).to(solids.dtype).reshape(solids.shape[:-1])

    @staticmethod
    def backward(ctx: Any, upstream: torch.Tensor) -> Any:
        core, kind, _ = ctx.given
        if torch.is_grad_enabled() and kind != "Hull3_8":
            corners = torch.from_numpy(core.faces[ctx.faces])

            def again(solids: torch.Tensor, vertices: torch.Tensor) -> Any:
                return formulas.solids(torch, _VERBS["distance"], kind, solids.reshape(-1, solids.shape[-1]), vertices[corners])

            return None, None, *differentiated(again, ctx.saved_tensors, upstream)
        bars = np.ascontiguousarray(upstream.detach().numpy().reshape(-1), np.float64)
        parts = _core.mesh_solid_distances(*ctx.given, ctx.faces, bars)
        found = (_like(part, own) for part, own in zip(parts, ctx.saved_tensors))
        return None, None, *(last(kind, part, upstream, *ctx.saved_tensors) for part in found)


class _Between(torch.autograd.Function):
    """The distances of two meshes."""

    @staticmethod
    def forward(ctx: Any, cores: Any, poses: torch.Tensor, vertices: torch.Tensor, others: torch.Tensor) -> torch.Tensor:
        rows = np.ascontiguousarray(poses.detach().numpy().reshape(-1, 7), np.float64)
        found = _core.mesh_pair_search(*cores, rows)
        ctx.given = (*cores, rows, found)
        ctx.save_for_backward(poses, vertices, others)
        values = _core.mesh_pair_distances(*ctx.given)
        return torch.from_numpy(values).to(poses.dtype).reshape(poses.shape[:-1])

    @staticmethod
    def backward(ctx: Any, upstream: torch.Tensor) -> Any:
        if torch.is_grad_enabled():
            *cores, _, found = ctx.given
            own, far = (torch.from_numpy(core.faces[found[:, k]]) for k, core in enumerate(cores))

            def again(poses: torch.Tensor, vertices: torch.Tensor, others: torch.Tensor) -> Any:
                return formulas.bodies(_VERBS["distance"], _VERBS["move"], poses, vertices[own], others[far])

            return None, *differentiated(again, ctx.saved_tensors, upstream)
        bars = np.ascontiguousarray(upstream.detach().numpy().reshape(-1), np.float64)
        parts = _core.mesh_pair_distances(*ctx.given, bars)
        return None, *(_like(part, own) for part, own in zip(parts, ctx.saved_tensors))


class _Winding(torch.autograd.Function):
    """The winding numbers around points."""

    @staticmethod
    def forward(ctx: Any, core: Any, points: torch.Tensor, vertices: torch.Tensor) -> torch.Tensor:
        rows = _array("points", points)
        ctx.core, ctx.rows = core, rows
        ctx.save_for_backward(points, vertices)
        return torch.from_numpy(core.winding(rows)).to(points.dtype).reshape(points.shape[:-1])

    @staticmethod
    def backward(ctx: Any, upstream: torch.Tensor) -> Any:
        if torch.is_grad_enabled():
            given = upstream, *ctx.saved_tensors
            by_points, by_vertices = formulas.swept(
                torch, torch.from_numpy, lambda zero, *at: zero.index_add(0, *at), ctx.core.faces, *(own.double() for own in given)
            )
            points, vertices = ctx.saved_tensors
            return None, by_points.to(points.dtype), by_vertices.to(vertices.dtype)
        bars = np.ascontiguousarray(upstream.detach().numpy().reshape(-1), np.float64)
        parts = ctx.core.winding(ctx.rows, bars)
        return None, *(_like(part, own) for part, own in zip(parts, ctx.saved_tensors)), None


class _Centroid(torch.autograd.Function):
    """The centroid of the volume."""

    @staticmethod
    def forward(ctx: Any, core: Any, vertices: torch.Tensor) -> torch.Tensor:
        ctx.core = core
        ctx.save_for_backward(vertices)
        return torch.from_numpy(core.centroid()).to(vertices.dtype)

    @staticmethod
    def backward(ctx: Any, upstream: torch.Tensor) -> Any:
        (vertices,) = ctx.saved_tensors
        if torch.is_grad_enabled():
            again = partial(formulas.centroid, torch, torch.Tensor.detach, torch.from_numpy(ctx.core.faces))
            return None, *differentiated(again, (vertices,), upstream)
        bar = np.ascontiguousarray(upstream.detach().numpy(), np.float64).reshape(1, 3)
        return None, _like(ctx.core.centroid(bar), vertices)


class _Slopes(torch.autograd.Function):
    """The derivatives of an energy by the vertices."""

    @staticmethod
    def forward(ctx: Any, core: Any, given: Any, vertices: torch.Tensor) -> torch.Tensor:
        ctx.core, ctx.given = core, given
        ctx.save_for_backward(vertices)
        return _like(core.energy(*given, 1), vertices)

    @staticmethod
    def backward(ctx: Any, upstream: torch.Tensor) -> Any:
        (vertices,) = ctx.saved_tensors
        rows, columns, values = ctx.core.energy(*ctx.given, 2)
        bars = np.ascontiguousarray(upstream.detach().numpy().reshape(-1), np.float64)
        # In the order of entries: the same bits every time.
        product = np.bincount(rows, weights=values * bars[columns], minlength=len(bars))
        return None, None, last(ctx.given[0], _like(product, vertices), upstream, vertices)


class _Energy(torch.autograd.Function):
    """An energy of a mesh."""

    @staticmethod
    def forward(ctx: Any, core: Any, given: Any, vertices: torch.Tensor) -> torch.Tensor:
        ctx.core, ctx.given = core, given
        ctx.save_for_backward(vertices)
        return torch.tensor(core.energy(*given, 0), dtype=vertices.dtype)

    @staticmethod
    def backward(ctx: Any, upstream: torch.Tensor) -> Any:
        (vertices,) = ctx.saved_tensors
        return None, None, upstream * _Slopes.apply(ctx.core, ctx.given, vertices)


class Mesh:
    """A mesh whose vertices are a tensor, of shape (V, 3): :class:`geograd.Mesh` in torch.

    Results have first and second derivatives by the points, rays, solids or poses and by the vertices; those of ``Hull3_8`` have first
    ones. Sums over many points have the same bits every time. Where a closest point jumps, the derivative is
    that of the lowest face. ``like`` is a mesh with the same faces, whose tree follows the vertices: it saves most of the time of a
    new one in a loop. It runs on the CPU.

    >>> vertices = torch.rand(8, 3, requires_grad=True)
    >>> mesh = geograd.torch.Mesh(vertices, [[0, 1, 2], [2, 1, 3]])
    >>> mesh.distance(torch.rand(100, 3)).mean().backward()
    """

    __module__ = "geograd.torch"

    def __init__(self, vertices: torch.Tensor, faces: Any = None, *, like: Optional[Union[geograd.Mesh, "Mesh"]] = None) -> None:
        rows = _array("vertices", vertices)
        if (faces is None) == (like is None):
            raise TypeError("Mesh: faces are needed, or like, a mesh that has them")
        if like is None:
            faces = faces.numpy() if isinstance(faces, torch.Tensor) else faces
            self.column = geograd.Mesh(rows, faces)
        else:
            self.column = (like.column if isinstance(like, Mesh) else like).moved(rows)
        self.vertices = vertices

    def __repr__(self) -> str:
        return f"<geograd.torch.{repr(self.column)[len('<geograd.'):]}"

    def distance(self, points: torch.Tensor) -> torch.Tensor:
        """The distance of each point, at least 0; derivative zero on the mesh."""
        return self._nearest("distance", points)

    def squared_distance(self, points: torch.Tensor) -> torch.Tensor:
        """The squared distance of each point, smooth also on the mesh."""
        return self._nearest("squared_distance", points)

    def signed_distance(self, points: torch.Tensor, *, winding: bool = False) -> torch.Tensor:
        """The distance of each point, negative inside, smooth through faces. The mesh must be closed.

        With ``winding`` any mesh will do: inside is where its winding number is above ½. The derivative is zero on the mesh.
        """
        return self._nearest("wound_distance" if winding else "signed_distance", points)

    def winding_number(self, points: torch.Tensor) -> torch.Tensor:
        """How often the mesh goes around each point. Derivatives are those of the border: zero for a closed mesh."""
        found: torch.Tensor = _Winding.apply(self.column._core, points, self.vertices)
        return found

    def area(self) -> torch.Tensor:
        """The area of all faces."""
        return self.energy("area")

    def volume(self) -> torch.Tensor:
        """The volume inside a closed mesh, negative where faces look inward."""
        return self.energy("volume")

    def centroid(self) -> torch.Tensor:
        """The centroid of the volume inside a closed mesh."""
        found: torch.Tensor = _Centroid.apply(self.column._core, self.vertices)
        return found

    def energy(self, kind: str, constants: Any = None, elements: Any = None) -> torch.Tensor:
        """A measure or an energy, as :meth:`geograd.Mesh.energy` has it, with first and second derivatives by the vertices.

        Constants have no derivatives.
        """
        if isinstance(constants, torch.Tensor):
            if constants.requires_grad:
                raise TypeError("constants: they have no derivatives; detach them")
            constants = constants.numpy()
        elements = elements.numpy() if isinstance(elements, torch.Tensor) else elements
        core = self.column._core
        found: torch.Tensor = _Energy.apply(core, (kind, *energy_columns(core, kind, constants, elements)), self.vertices)
        return found

    def closest(self, points: torch.Tensor) -> torch.Tensor:
        """The nearest point of the mesh for each point."""
        return self._nearest("closest", points)

    def rays(self, starts: torch.Tensor, directions: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        """The parameter at which each ray meets the mesh first, and the index of the face; inf and -1 for a miss."""
        starts, directions = torch.broadcast_tensors(starts, directions)
        values, faces = _Rays.apply(self.column._core, starts, directions, self.vertices)
        return values, faces

    def all_hits(self, starts: torch.Tensor, directions: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
        """Every face that each ray meets: parameters, indices of rays and of faces, ray by ray in the order of parameters."""
        starts, directions = (own.reshape(-1, 3) for own in torch.broadcast_tensors(starts, directions))
        core = self.column._core
        rays, faces = core.all_hit_faces(_array("starts", starts), _array("directions", directions))
        rays = torch.from_numpy(rays)
        values, indices = _Rays.apply(core, starts[rays], directions[rays], self.vertices, faces)
        return values, rays, indices

    def distance_to(self, kind: str, solids: torch.Tensor) -> torch.Tensor:
        """The distance of each solid from the faces, 0 with derivative zero where one meets it.

        ``kind`` is the name of a shape that :meth:`geograd.Mesh.distance_to` takes, and ``solids`` its numbers, of shape (..., F):
        ``mesh.distance_to("Capsule3", tensor)``. Derivatives are by these numbers and by the vertices.
        """
        if kind not in SOLIDS:
            raise ValueError(f"kind: one of {', '.join(SOLIDS)} is needed, not {kind!r}")
        _columns("solids", solids, len(CLASSES[kind]._fields))
        found: torch.Tensor = _Solids.apply(self.column._core, kind, solids, self.vertices)
        return found

    def distance_between(self, other: Mesh, poses: torch.Tensor) -> torch.Tensor:
        """The distance of another mesh from this one at each pose, 0 with derivative zero where faces meet.

        ``poses`` are the numbers of ``Pose3``, of shape (..., 7). Derivatives are by poses and by the vertices of both meshes.
        """
        if not isinstance(other, Mesh):
            raise TypeError(f"other: a geograd.torch.Mesh is needed, not {type(other).__name__}")
        _columns("poses", poses, 7)
        cores = self.column._core, other.column._core
        found: torch.Tensor = _Between.apply(cores, poses, self.vertices, other.vertices)
        return found

    def _nearest(self, kind: str, points: torch.Tensor) -> torch.Tensor:
        found: torch.Tensor = _Nearest.apply(self.column._core, kind, points, self.vertices)
        return found
