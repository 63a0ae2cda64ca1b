"""Meshes of triangles: closest points, distances and hits of rays."""

import numpy as np

from . import _core


def _rows(name, array, dtype=np.float64):
    """An array of shape (..., 3) as rows, and the shape in front."""
    array = np.asarray(array)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise ValueError(f"{name}: an array of shape (..., 3) is needed, not {array.shape}")
    if dtype == np.int64 and array.dtype.kind not in "iu":
        raise TypeError(f"{name}: whole numbers are needed, not {array.dtype}")
    return np.ascontiguousarray(array, dtype).reshape(-1, 3), array.shape[:-1]


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

    def signed_distance(self, points):
        """The distance of each point, negative inside. The mesh must be closed: each edge has two faces, in opposite directions."""
        return self._distances("signed_distance", points)

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
        faces = self._core.hit_faces(starts, directions)
        return self._core.parameters(starts, directions, faces).reshape(shape), faces.reshape(shape)
