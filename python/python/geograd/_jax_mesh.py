"""Queries of a mesh on JAX's arrays, with gradients for points, rays, solids, poses and vertices."""

from __future__ import annotations

from typing import Any, Optional, Tuple

import jax
import jax.numpy as jnp
import numpy as np

import geograd
from geograd import _core
from geograd import _record_formulas as formulas
from geograd._jax_host import floats, hosted
from geograd._jax_verbs import _VERBS
from geograd._mesh import SOLIDS, energy_columns
from geograd._shapes import CLASSES

Array = Any


class _Tree:
    """The faces of a mesh, and a tree over them that follows the vertices of the last call."""

    def __init__(self, faces: Any, mesh: Optional[geograd.Mesh] = None) -> None:
        self.faces, self._mesh = faces, mesh

    def at(self, vertices: Any) -> Any:
        """The mesh in memory with vertices at some places."""
        mesh = self._mesh
        if mesh is None:
            mesh = geograd.Mesh(vertices, self.faces)
        elif not np.array_equal(mesh.vertices, vertices):
            mesh = mesh.moved(vertices)
        self._mesh = mesh
        return mesh._core


def _columns(name: str, array: Array, width: int) -> None:
    if np.ndim(array) == 0 or np.shape(array)[-1] != width:
        raise ValueError(f"{name}: an array of shape (..., {width}) is needed, not {np.shape(array)}")


def _rows(x: Any, width: int = 3) -> Any:
    return x.reshape(-1, width)


def _count(shape: Tuple[int, ...]) -> int:
    return int(np.prod(shape, dtype=np.int64))


@jax.tree_util.register_pytree_node_class
class Mesh:
    """A mesh whose vertices are an array of shape (V, 3): :class:`geograd.Mesh` in JAX.

    Results have first and second derivatives backwards by the points, rays, solids or poses, and by the vertices; those of ``Hull3_8``
    have first ones. It is a tree with one leaf, the vertices, so ``jax.grad`` of a function of a mesh gives a mesh of cotangents. The
    library runs in a callback on the host, also under ``jit``; the tree over the faces follows the vertices from call to call. ``like``
    is a mesh with the same faces whose tree is used.

    >>> mesh = geograd.jax.Mesh([[0.0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
    >>> jax.grad(lambda mesh: mesh.distance(jnp.array([1.0, 1, 2])))(mesh).vertices
    """

    __module__ = "geograd.jax"

    def __init__(self, vertices: Array, faces: Any = None, *, like: Any = None) -> None:
        if isinstance(vertices, geograd.Mesh) and faces is None and like is None:
            vertices, like = vertices.vertices, vertices
        if (faces is None) == (like is None):
            raise TypeError("Mesh: faces are needed, or like, a mesh that has them")
        (self.vertices,) = floats(vertices)
        _columns("vertices", self.vertices, 3)
        if like is None and isinstance(self.vertices, jax.core.Tracer):
            # Places are known in the callback alone.
            self._tree = _Tree(np.asarray(faces))
        elif like is None:
            mesh = geograd.Mesh(np.asarray(self.vertices), np.asarray(faces))
            self._tree = _Tree(mesh.faces, mesh)
        elif isinstance(like, Mesh):
            self._tree = _Tree(like._tree.faces, like._tree._mesh)
        else:
            self._tree = _Tree(like.faces, like)

    @property
    def faces(self) -> Any:
        """The faces, of shape (F, 3)."""
        return self._tree.faces

    def __len__(self) -> int:
        return len(self.faces)

    def __repr__(self) -> str:
        return f"<geograd.jax.Mesh of {jnp.shape(self.vertices)[0]} vertices and {len(self)} faces>"

    def tree_flatten(self) -> Tuple[Tuple[Array], _Tree]:
        return (self.vertices,), self._tree

    @classmethod
    def tree_unflatten(cls, tree: _Tree, children: Any) -> Mesh:
        mesh = object.__new__(cls)
        mesh._tree, (mesh.vertices,) = tree, children
        return mesh

    def distance(self, points: Array) -> Array:
        """The distance of each point, at least 0; derivative zero on the mesh."""
        return self._nearest("distance", points)

    def squared_distance(self, points: Array) -> Array:
        """The squared distance of each point, smooth also on the mesh."""
        return self._nearest("squared_distance", points)

    def signed_distance(self, points: Array, *, winding: bool = False) -> Array:
        """The distance of each point, negative inside, smooth through faces. The mesh must be closed.

        With ``winding`` any mesh will do: inside is where its winding number is above ½. The derivative is zero on the mesh.
        """
        return self._nearest("wound_distance" if winding else "signed_distance", points)

    def closest(self, points: Array) -> Array:
        """The nearest point of the mesh for each point."""
        return self._nearest("closest", points)

    def _nearest(self, kind: str, points: Array) -> Array:
        _columns("points", points, 3)
        xs, tree = floats(points, self.vertices), self._tree
        shape = xs[0].shape if kind == "closest" else xs[0].shape[:-1]

        def value(points: Any, vertices: Any, record: Any, bars: Any) -> Any:
            core, points = tree.at(vertices), _rows(points)
            if bars is not None:
                (bar,) = bars
                return core.closest(points, record, _rows(bar)) if kind == "closest" else core.distances(kind, points, record, bar.reshape(-1))
            return [core.closest(points, record) if kind == "closest" else core.distances(kind, points, record)]

        def again(record: Any, made: Any, points: Any, vertices: Any) -> Any:
            faces = jnp.asarray(tree.faces)[record[:, 0]]
            return formulas.nearest(jnp, jax.lax.stop_gradient, kind, faces, record[:, 1], made, points, vertices).reshape(shape)

        search = lambda points, vertices: tree.at(vertices).search(_rows(points))
        return hosted(xs, [shape], value, records=(_count(xs[0].shape[:-1]), 2), search=search, again=again)[0]

    def winding_number(self, points: Array) -> Array:
        """How often the mesh goes around each point. Derivatives are those of the border: zero for a closed mesh."""
        _columns("points", points, 3)
        xs, tree = floats(points, self.vertices), self._tree

        def value(points: Any, vertices: Any, _: Any, bars: Any) -> Any:
            core, points = tree.at(vertices), _rows(points)
            return [core.winding(points)] if bars is None else core.winding(points, bars[0].reshape(-1))

        @jax.custom_vjp
        def again(_: Any, made: Any, points: Any, vertices: Any) -> Any:
            return made

        def by(kept: Any, bars: Any) -> Any:
            add = lambda zero, at, rows: zero.at[at].add(rows)
            return None, None, *formulas.swept(jnp, jnp.asarray, add, tree.faces, bars, *kept)

        again.defvjp(lambda _, made, *xs: (made, xs), by)
        return hosted(xs, [xs[0].shape[:-1]], value, again=again)[0]

    def rays(self, starts: Array, directions: Array) -> Tuple[Array, Array]:
        """The parameter at which each ray meets the mesh first, and the index of the face; inf and -1 for a miss."""
        _columns("starts", starts, 3)
        _columns("directions", directions, 3)
        xs, tree = floats(*jnp.broadcast_arrays(starts, directions), self.vertices), self._tree
        shape = xs[0].shape[:-1]

        def value(starts: Any, directions: Any, vertices: Any, faces: Any, bars: Any) -> Any:
            rays = _rows(starts), _rows(directions)
            if bars is None:
                return [tree.at(vertices).parameters(*rays, faces)]
            # A miss is infinitely far whatever moves; a loss may divide by that.
            return tree.at(vertices).parameters(*rays, faces, np.where(faces < 0, 0.0, bars[0].reshape(-1)))

        def again(faces: Any, _: Any, starts: Any, directions: Any, vertices: Any) -> Any:
            corners = jnp.asarray(tree.faces)[jnp.maximum(faces, 0)]
            return formulas.parameters(jnp, corners, faces < 0, starts, directions, vertices).reshape(shape)

        search = lambda starts, directions, vertices: tree.at(vertices).hit_faces(_rows(starts), _rows(directions))
        values, faces = hosted(xs, [shape], value, records=(_count(shape),), search=search, again=again)
        return values, faces.reshape(shape)

    def distance_to(self, kind: str, solids: Array) -> Array:
        """The distance of each solid from the faces, 0 with derivative zero where one meets it.

        ``kind`` is the name of a shape that :meth:`geograd.Mesh.distance_to` takes, and ``solids`` its numbers, of shape (..., F):
        ``mesh.distance_to("Capsule3", array)``.
        """
        if kind not in SOLIDS:
            raise ValueError(f"kind: one of {', '.join(SOLIDS)} is needed, not {kind!r}")
        width = len(CLASSES[kind]._fields)
        _columns("solids", solids, width)
        xs, tree = floats(solids, self.vertices), self._tree
        shape = xs[0].shape[:-1]

        def value(solids: Any, vertices: Any, faces: Any, bars: Any) -> Any:
            given = tree.at(vertices), kind, _rows(solids, width), faces
            if bars is None:
                return [_core.mesh_solid_distances(*given)]
            return _core.mesh_solid_distances(*given, bars[0].reshape(-1))

        def again(faces: Any, _: Any, solids: Any, vertices: Any) -> Any:
            corners = vertices[jnp.asarray(tree.faces)[faces]]
            return formulas.solids(jnp, _VERBS["distance"], kind, _rows(solids, width), corners).reshape(shape)

        search = lambda solids, vertices: _core.mesh_solid_search(tree.at(vertices), kind, _rows(solids, width))
        of = None if kind == "Hull3_8" else again
        return hosted(xs, [shape], value, records=(_count(shape),), search=search, again=of)[0]

    def distance_between(self, other: Mesh, poses: Array) -> Array:
        """The distance of another mesh from this one at each pose, 0 with derivative zero where faces meet.

        ``poses`` are the numbers of ``Pose3``, of shape (..., 7). Derivatives are by poses and by the vertices of both meshes.
        """
        if not isinstance(other, Mesh):
            raise TypeError(f"other: a geograd.jax.Mesh is needed, not {type(other).__name__}")
        _columns("poses", poses, 7)
        xs, trees = floats(poses, self.vertices, other.vertices), (self._tree, other._tree)
        shape = xs[0].shape[:-1]

        def given(poses: Any, *vertices: Any) -> Any:
            return *(tree.at(own) for tree, own in zip(trees, vertices)), _rows(poses, 7)

        def value(poses: Any, own: Any, far: Any, record: Any, bars: Any) -> Any:
            if bars is None:
                return [_core.mesh_pair_distances(*given(poses, own, far), record)]
            return _core.mesh_pair_distances(*given(poses, own, far), record, bars[0].reshape(-1))

        def again(record: Any, _: Any, poses: Any, *vertices: Any) -> Any:
            corners = (own[jnp.asarray(tree.faces)[record[:, k]]] for k, (tree, own) in enumerate(zip(trees, vertices)))
            return formulas.bodies(_VERBS["distance"], _VERBS["move"], poses, *corners).reshape(shape)

        search = lambda *xs: _core.mesh_pair_search(*given(*xs))
        return hosted(xs, [shape], value, records=(_count(shape), 2), search=search, again=again)[0]

    def area(self) -> Array:
        """The area of all faces."""
        return self.energy("area")

    def volume(self) -> Array:
        """The volume inside a closed mesh, negative where faces look inward."""
        return self.energy("volume")

    def centroid(self) -> Array:
        """The centroid of the volume inside a closed mesh."""
        tree = self._tree

        def value(vertices: Any, _: Any, bars: Any) -> Any:
            core = tree.at(vertices)
            return [core.centroid() if bars is None else core.centroid(bars[0].reshape(1, 3))]

        def again(_: Any, __: Any, vertices: Any) -> Any:
            return formulas.centroid(jnp, jax.lax.stop_gradient, jnp.asarray(tree.faces), vertices)

        return hosted((self.vertices,), [(3,)], value, again=again)[0]

    def energy(self, kind: str, constants: Any = None, elements: Any = None) -> Array:
        """A measure or an energy, as :meth:`geograd.Mesh.energy` has it, with first and second derivatives by the vertices.

        Constants are known numbers and have no derivatives. Second derivatives are backwards: ``jax.jacrev(jax.grad(f))``.
        """
        tree, dtype, shape = self._tree, self.vertices.dtype, self.vertices.shape
        one, same = jax.ShapeDtypeStruct((), dtype), jax.ShapeDtypeStruct(shape, dtype)

        def of(vertices: Any, order: int) -> Any:
            core = tree.at(np.asarray(vertices, np.float64))
            return core.energy(kind, *energy_columns(core, kind, constants, elements), order)

        def turned(vertices: Any, bars: Any) -> Any:
            rows, columns, values = of(vertices, 2)
            bars = np.asarray(bars, np.float64).reshape(-1)
            # In the order of entries: the same bits every time.
            return np.bincount(rows, weights=values * bars[columns], minlength=bars.size).reshape(shape).astype(dtype)

        def host(run: Any, out: Any, *xs: Array) -> Array:
            return jax.pure_callback(run, out, *xs, vmap_method="sequential")

        slopes = jax.custom_vjp(lambda x: host(lambda x: np.asarray(of(x, 1), dtype), same, x))
        slopes.defvjp(lambda x: (slopes(x), x), lambda x, bars: (host(turned, same, x, bars),))
        value = jax.custom_vjp(lambda x: host(lambda x: np.asarray(of(x, 0), dtype), one, x))
        value.defvjp(lambda x: (value(x), x), lambda x, bar: (bar * slopes(x),))
        return value(self.vertices)
