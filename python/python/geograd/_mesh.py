"""Meshes of triangles: closest points, distances, hits of rays, winding numbers, measures and energies."""

import numpy as np

from . import _core
from ._shapes import CLASSES


def _rows(name, array, dtype=np.float64):
    """An array of shape (..., 3) as rows, and the shape in front."""
    array = np.asarray(array)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise ValueError(f"{name}: an array of shape (..., 3) is needed, not {array.shape}")
    if dtype == np.int64 and array.dtype.kind not in "iu":
        raise TypeError(f"{name}: whole numbers are needed, not {array.dtype}")
    return np.ascontiguousarray(array, dtype).reshape(-1, 3), array.shape[:-1]


#: The shapes that a mesh has distances from.
SOLIDS = ("Sphere", "Capsule3", "Segment3", "Aabb3", "Obb3", "RoundBox3", "Triangle3", "Tetrahedron", "Hull3_8")


def solid_rows(solids):
    """The kind of solids, their numbers as rows, and the shape in front."""
    kind = type(solids).__name__
    if not isinstance(solids, _core.Shape) or kind not in SOLIDS:
        raise TypeError(f"solids: one of {', '.join(SOLIDS)} is needed, not {kind}")
    array = np.asarray(solids)
    return kind, np.ascontiguousarray(array, np.float64).reshape(-1, array.shape[-1]), array.shape[:-1]


def pose_rows(other, poses):
    """The numbers of poses as rows, and the shape in front."""
    if not isinstance(other, Mesh):
        raise TypeError(f"other: a Mesh is needed, not {type(other).__name__}")
    array = np.asarray(CLASSES["Pose3"](poses))
    return np.ascontiguousarray(array, np.float64).reshape(-1, 7), array.shape[:-1]


#: The energies that sum over elements of their own: what an element is, and how many vertices it has.
ELEMENTS = {"springs": ("edges", 2), "bending": ("hinges", 4)}


def energy_columns(core, kind, constants, elements):
    """The elements and the constants of an energy, as arrays."""
    if kind not in ("area", "volume", "dirichlet", *ELEMENTS):
        raise ValueError(f"kind: one of area, volume, springs, dirichlet and bending is needed, not {kind!r}")
    if kind not in ELEMENTS:
        if elements is not None:
            raise TypeError(f"elements: {kind} has none")
        elements = np.zeros(0, np.int64)
    else:
        name, width = ELEMENTS[kind]
        elements = core.elements(name) if elements is None else np.asarray(elements)
        if elements.ndim != 2 or elements.shape[1] != width or elements.dtype.kind not in "iu":
            raise ValueError(f"elements: whole numbers of shape (N, {width}) are needed")
    if (constants is None) != (kind in ("area", "volume")):
        raise TypeError(f"constants: {kind} has " + ("none" if kind in ("area", "volume") else "a number per vertex or element"))
    constants = np.zeros(0) if constants is None else np.asarray(constants, np.float64)
    if constants.ndim > 1:
        raise ValueError(f"constants: an array of shape (N,) is needed, not {constants.shape}")
    if constants.ndim == 0:
        count = len(core.vertices) if kind == "dirichlet" else len(elements)
        constants = np.full(count, float(constants))
    return np.ascontiguousarray(elements, np.int64), np.ascontiguousarray(constants)


class Mesh:
    """A mesh of triangles, with a tree that is built once and serves all calls.

    ``vertices`` has the shape (V, 3) and ``faces`` the shape (F, 3): indices of vertices, counter-clockwise from outside. A
    ``trimesh.Trimesh``, or any object with ``vertices`` and ``faces``, stands for both. Numbers are computed in float64. Of faces
    at equal distances the one of lowest index counts.

    >>> mesh = geograd.Mesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
    >>> mesh.distance([[1, 1, 2], [1, -3, 0]])
    array([2., 3.])
    """

    __module__ = "geograd"

    def __init__(self, vertices, faces=None):
        if faces is None:
            if not hasattr(vertices, "vertices") or not hasattr(vertices, "faces"):
                raise TypeError("faces: indices of shape (F, 3) are needed, or one object with vertices and faces")
            vertices, faces = vertices.vertices, vertices.faces
        self._core = _core.MeshCore(_rows("vertices", vertices)[0], _rows("faces", faces, np.int64)[0])

    @property
    def vertices(self):
        """The vertices, of shape (V, 3)."""
        return self._core.vertices

    @property
    def faces(self):
        """The faces, of shape (F, 3)."""
        return self._core.faces

    def __len__(self):
        return len(self.faces)

    def __repr__(self):
        return f"<geograd.Mesh of {len(self.vertices)} vertices and {len(self)} faces>"

    def __reduce__(self):
        return Mesh, (self.vertices, self.faces)

    def moved(self, vertices):
        """The mesh with its vertices at other places. The tree follows them in a fraction of the time of a new one."""
        other = object.__new__(Mesh)
        other._core = self._core.moved(_rows("vertices", vertices)[0])
        return other

    def _distances(self, kind, points):
        rows, shape = _rows("points", points)
        return self._core.distances(kind, rows, self._core.search(rows)).reshape(shape)

    def distance(self, points):
        """The distance of each point, at least 0."""
        return self._distances("distance", points)

    def squared_distance(self, points):
        """The squared distance of each point."""
        return self._distances("squared_distance", points)

    def signed_distance(self, points, *, winding=False):
        """The distance of each point, negative inside. The mesh must be closed: each edge has two faces, in opposite directions.

        With ``winding`` any mesh will do: inside is where its winding number is above ½. The sign then jumps in holes.
        """
        return self._distances("wound_distance" if winding else "signed_distance", points)

    def winding_number(self, points):
        """How often the mesh goes around each point: 1 inside a closed mesh and 0 outside, the mean of both on a face.

        An open mesh has numbers between, which fall off around its holes; inner walls and repeated faces count as often as they
        are there.
        """
        rows, shape = _rows("points", points)
        return self._core.winding(rows).reshape(shape)

    @property
    def edges(self):
        """The edges of all faces, each once, of shape (E, 2)."""
        return self._core.elements("edges")

    @property
    def hinges(self):
        """The edges of two faces, of shape (H, 4): start, end, and the third corners of both faces."""
        return self._core.elements("hinges")

    def area(self):
        """The area of all faces."""
        return self.energy("area")

    def volume(self):
        """The volume inside a closed mesh, negative where faces look inward."""
        return self.energy("volume")

    def centroid(self):
        """The centroid of the volume inside a closed mesh."""
        return self._core.centroid()

    def energy(self, kind, constants=None, elements=None):
        """A measure or an energy: ``"area"``, ``"volume"``, ``"dirichlet"``, ``"springs"`` or ``"bending"``.

        ``constants`` are the values of a function at the vertices (dirichlet), the lengths of edges at rest (springs) or the angles
        of hinges at rest (bending); one number stands for all. ``elements`` are edges or hinges; by default all of the mesh.

        >>> mesh = geograd.Mesh([[0, 0, 0], [4, 0, 0], [0, 2, 0]], [[0, 1, 2]])
        >>> mesh.energy("area"), mesh.energy("dirichlet", [0, 4, 0])
        (4.0, 2.0)
        """
        return self._core.energy(kind, *energy_columns(self._core, kind, constants, elements), 0)

    def slopes(self, kind, constants=None, elements=None):
        """The derivatives of an energy by the vertices, of shape (V, 3)."""
        return self._core.energy(kind, *energy_columns(self._core, kind, constants, elements), 1)

    def hessian(self, kind, constants=None, elements=None):
        """The second derivatives of an energy by the 3 V numbers of the vertices: rows, columns and values of a sparse matrix.

        ``scipy.sparse.coo_array((values, (rows, columns)))`` takes them.
        """
        return self._core.energy(kind, *energy_columns(self._core, kind, constants, elements), 2)

    def laplacian(self):
        """The cotangent Laplacian, positive semidefinite: rows, columns and values of a sparse matrix with one row per vertex."""
        return self._core.laplacian()

    def closest(self, points):
        """The nearest point of the mesh for each point, and the index of its face."""
        rows, shape = _rows("points", points)
        found = self._core.search(rows)
        return self._core.closest(rows, found).reshape(*shape, 3), found[:, 0].reshape(shape)

    def rays(self, starts, directions):
        """Where each ray meets the mesh first: the parameter, by which its direction is multiplied, and the index of the face.

        A ray that misses has the parameter inf and the face -1.
        """
        starts, directions = np.broadcast_arrays(np.asarray(starts), np.asarray(directions))
        (starts, shape), (directions, _) = _rows("starts", starts), _rows("directions", directions)
        parameters, faces = self._core.first_hits(starts, directions)
        return parameters.reshape(shape), faces.reshape(shape)

    def all_hits(self, starts, directions):
        """Every face that each ray meets: parameters, indices of rays and indices of faces, ray by ray in the order of parameters.

        A ray through an edge or a vertex meets every face there that is not edge-on.
        """
        starts, directions = np.broadcast_arrays(np.asarray(starts), np.asarray(directions))
        (starts, _), (directions, _) = _rows("starts", starts), _rows("directions", directions)
        rays, faces = self._core.all_hit_faces(starts, directions)
        return self._core.parameters(starts[rays], directions[rays], faces), rays, faces

    def distance_to(self, solids):
        """The distance of each solid from the faces, 0 where one meets it.

        ``solids`` are a ``Sphere``, ``Capsule3``, ``Segment3``, ``Aabb3``, ``Obb3``, ``RoundBox3``, ``Triangle3``, ``Tetrahedron`` or
        ``Hull3_8``, of any leading shape. Inside of a closed mesh the distance is that from its faces, too.

        >>> mesh = geograd.Mesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> mesh.distance_to(geograd.Sphere([[1, 1, 3, 0.5], [1, 1, 0, 0.5]]))
        array([2.5, 0. ])
        """
        kind, rows, shape = solid_rows(solids)
        faces = _core.mesh_solid_search(self._core, kind, rows)
        return _core.mesh_solid_distances(self._core, kind, rows, faces).reshape(shape)

    def closest_to(self, solids):
        """The nearest points of the mesh and of each solid, and the index of the face; where they meet, of the lowest face."""
        kind, rows, shape = solid_rows(solids)
        faces = _core.mesh_solid_search(self._core, kind, rows)
        own, other = _core.mesh_solid_points(self._core, kind, rows, faces)
        return own.reshape(*shape, 3), other.reshape(*shape, 3), faces.reshape(shape)

    def touches(self, solids):
        """Whether a face meets each solid: whether its distance is 0, found without the others."""
        kind, rows, shape = solid_rows(solids)
        return _core.mesh_solid_touches(self._core, kind, rows).reshape(shape)

    def faces_within(self, solids, most):
        """The faces whose distance from each solid is at most ``most``: indices of solids and of faces, solid by solid."""
        kind, rows, _ = solid_rows(solids)
        of, faces = _core.mesh_solid_faces(self._core, kind, rows, float(most))
        return of, faces[:, 0]

    def distance_between(self, other, poses):
        """The distance of the faces of another mesh from those of this one at each pose, 0 where they meet.

        ``poses`` are a ``Pose3``, or an array of shape (..., 7), from the frame of the other mesh to that of this one. A mesh inside of
        another one that no face meets has a distance.
        """
        rows, shape = pose_rows(other, poses)
        found = _core.mesh_pair_search(self._core, other._core, rows)
        return _core.mesh_pair_distances(self._core, other._core, rows, found).reshape(shape)

    def closest_between(self, other, poses):
        """The nearest points of this mesh and of another one at each pose, in the frame of this one, and both faces, of shape (..., 2)."""
        rows, shape = pose_rows(other, poses)
        found = _core.mesh_pair_search(self._core, other._core, rows)
        own, far = _core.mesh_pair_points(self._core, other._core, rows, found)
        return own.reshape(*shape, 3), far.reshape(*shape, 3), found.reshape(*shape, 2)

    def meets(self, other, poses):
        """Whether faces of another mesh meet those of this one at each pose, found without the distance."""
        rows, shape = pose_rows(other, poses)
        return _core.mesh_pair_meets(self._core, other._core, rows).reshape(shape)

    def pairs_within(self, other, poses, most):
        """The faces of both meshes whose distance is at most ``most``: indices of poses, and pairs of shape (K, 2), pose by pose."""
        rows, _ = pose_rows(other, poses)
        return _core.mesh_pair_faces(self._core, other._core, rows, float(most))
