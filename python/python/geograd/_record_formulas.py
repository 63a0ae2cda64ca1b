"""Results of searches along their records, in operations of torch or of JAX: derivatives of any order.

``xp`` is ``torch`` or ``jax.numpy``, and ``fixed`` returns an array without its derivatives.
"""

from __future__ import annotations

from typing import Any, Callable

import numpy as np

Fixed = Callable[[Any], Any]


def dot(a: Any, b: Any) -> Any:
    return (a * b).sum(-1)[..., None]


def over(xp: Any, a: Any, b: Any) -> Any:
    """A quotient, zero where the divisor is."""
    none = b == 0.0
    return xp.where(none, xp.zeros_like(a), a / xp.where(none, xp.ones_like(b), b))


def length(xp: Any, v: Any) -> Any:
    """Lengths; of zero with derivative zero."""
    square = dot(v, v)
    none = square == 0.0
    return xp.where(none, xp.zeros_like(square), xp.sqrt(xp.where(none, xp.ones_like(square), square)))


def nearest(xp: Any, fixed: Fixed, kind: str, faces: Any, code: Any, values: Any, points: Any, vertices: Any) -> Any:
    """Distances of points from a mesh, or their closest points, given the corners of faces, their features, and the distances
    for their signs."""
    points = points.reshape(-1, 3)
    corners = vertices[faces]
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    each = xp.arange(len(code))
    edge = xp.where(code > 4, code - 4, 0)
    start, end = corners[each, edge // 3], corners[each, edge % 3]
    along = end - start
    on_edge = start + along * over(xp, dot(points - start, along), dot(along, along))
    at_corner = corners[each, xp.where((code > 1) & (code <= 3), code - 1, 0)]
    normal = xp.linalg.cross(b - a, c - a)
    inside, is_corner = (code == 0)[:, None], (code <= 3)[:, None]
    border = xp.where(is_corner, at_corner, on_edge)
    # The square of a small face's normal has no digits in single precision, that of one with length one has.
    normal = over(xp, normal, length(xp, normal))
    height = dot(points - a, normal)
    if kind == "closest":
        return xp.where(inside, points - normal * height, border)
    if kind == "squared_distance":
        return xp.where(inside, height * height, dot(points - border, points - border))[:, 0]
    far = length(xp, points - border)
    if kind == "distance":
        return xp.where(inside, height * xp.sign(fixed(height)), far)[:, 0]
    signs = xp.sign(fixed(values.reshape(-1, 1)))
    # On a face of a closed mesh the normal points outward.
    side = xp.ones_like(height) if kind == "signed_distance" else xp.sign(fixed(height) * signs)
    return xp.where(inside, height * side, far * signs)[:, 0]


def parameters(xp: Any, faces: Any, missed: Any, starts: Any, directions: Any, vertices: Any) -> Any:
    """The parameters at which rays meet faces, given their corners; zero, without derivatives, for a miss."""
    starts, directions, corners = starts.reshape(-1, 3), directions.reshape(-1, 3), vertices[faces]
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = xp.linalg.cross(b - a, c - a)
    # Quotients of misses may be infinite, and their derivatives no numbers.
    fall = dot(directions, normal)
    fall = xp.where(missed[:, None], xp.ones_like(fall), fall)
    step = over(xp, dot(a - starts, normal), fall)
    return xp.where(missed[:, None], xp.zeros_like(step), step)[:, 0]


def gaps(xp: Any, squared: bool, found: Any, queries: Any, points: Any) -> Any:
    """The distances of queries from points of given indices, or their squares; of a point itself with derivative zero."""
    apart = queries.reshape(-1, 3) - points[found]
    return (dot(apart, apart) if squared else length(xp, apart))[:, 0]


def solids(xp: Any, distance: Callable[..., Any], kind: str, numbers: Any, corners: Any) -> Any:
    """The distances of solids from a face each, given the corners of the faces, by the verb ``distance`` of two kinds."""
    face = corners.reshape(-1, 9)

    def of(solids: Any, kind: str) -> Any:
        return distance(solids, face, kind=(kind, "Triangle3"))

    def grown(cores: Any, kind: str) -> Any:
        gaps = of(cores, kind) - numbers[:, -1]
        return xp.where(gaps > 0.0, gaps, xp.zeros_like(gaps))

    if kind == "Sphere":
        return grown(numbers[:, :3], "Vec3")
    if kind == "Capsule3":
        return grown(numbers[:, :6], "Segment3")
    if kind == "Segment3":
        return of(numbers, kind)
    if kind == "Aabb3":
        low, high, zero = numbers[:, :3], numbers[:, 3:], xp.zeros_like(numbers[:, :3])
        numbers = xp.concatenate([(low + high) / 2.0, high - low, xp.ones_like(low[:, :1]), zero], -1)
        kind = "Obb3"
    return distance(face, numbers, kind=("Triangle3", kind))


def bodies(distance: Callable[..., Any], move: Callable[..., Any], poses: Any, own: Any, other: Any) -> Any:
    """The distances of a face each of two meshes, the second one moved, given the corners of both, by verbs of these names."""
    moved = move(poses.reshape(-1, 7), other.reshape(-1, 9), kind=("Pose3", "Triangle3"))
    return distance(own.reshape(-1, 9), moved, kind=("Triangle3", "Triangle3"))


def centroid(xp: Any, fixed: Fixed, faces: Any, vertices: Any) -> Any:
    """The centroid of the volume inside a closed mesh: cones over its faces, from a place amid the vertices."""
    middle = fixed(vertices.mean(0))
    corners = (vertices - middle)[faces]
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    volumes = dot(a, xp.linalg.cross(b, c))
    return over(xp, (volumes * (a + b + c)).sum(0), 4.0 * volumes.sum(0)) + middle


def border(faces: Any) -> tuple[Any, Any, Any]:
    """The edges that faces pass more often in one direction: starts, ends, and how often more."""
    ends = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    pairs, inverse = np.unique(np.sort(ends, axis=1), axis=0, return_inverse=True)
    times = np.bincount(inverse.reshape(-1), np.where(ends[:, 0] < ends[:, 1], 1, -1), len(pairs)).astype(np.int64)
    kept = (times != 0) & (pairs[:, 0] != pairs[:, 1])
    pairs, times = pairs[kept], times[kept]
    flipped = times < 0
    return np.where(flipped, pairs[:, 1], pairs[:, 0]), np.where(flipped, pairs[:, 0], pairs[:, 1]), np.abs(times)


def swept(
    xp: Any, whole: Callable[[Any], Any], add: Callable[..., Any], faces: Any, upstream: Any, points: Any, vertices: Any
) -> tuple[Any, Any]:
    """The cotangents of points and vertices from those of winding numbers: what the border sweeps.

    With an edge from a to b, seen from a point, and D = |a||b| + a·b, a moved start has b×a / (|a| D), a moved end b×a / (|b| D),
    over 4π. ``whole`` makes an array of whole numbers, ``add`` adds rows to an array at such places.
    """
    start, end, times = (whole(own) for own in border(faces))
    at = points.reshape(-1, 1, 3)
    a, b = (vertices[own] - at for own in (start, end))
    scale = upstream.reshape(-1, 1, 1) * times[None, :, None] / (4.0 * np.pi)
    normal = xp.linalg.cross(b, a) * scale
    x, y, cosine = length(xp, a), length(xp, b), dot(a, b)
    # Both are equal; one of them has no difference.
    crossed = xp.linalg.cross(a, b)
    divisor = xp.where(cosine < 0.0, over(xp, dot(crossed, crossed), x * y - cosine), x * y + cosine)
    by_start, by_end = over(xp, normal, x * divisor), over(xp, normal, y * divisor)
    by_points = -(by_start + by_end).sum(1).reshape(points.shape)
    zero = xp.zeros_like(vertices)
    return by_points, add(add(zero, start, by_start.sum(0)), end, by_end.sum(0))


def _cross(u: Any, v: Any) -> Any:
    return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]


def weights(xp: Any, corners: Any, inside: Any, points: Any, places: Any) -> Any:
    """The weights of the corners of triangles around places; zeros outside."""
    if len(points) == 0:
        return xp.stack([places[:, 0] * 0.0] * 3, -1)
    around = points[corners]
    a, b, c = around[:, 0], around[:, 1], around[:, 2]
    # Places outside need not be finite.
    places = xp.where(inside[:, None], places, a)
    whole = _cross(b - a, c - a)
    of_b, of_c = over(xp, _cross(places - a, c - a), whole), over(xp, _cross(b - a, places - a), whole)
    found = xp.stack([1.0 - of_b - of_c, of_b, of_c], -1)
    return xp.where(inside[:, None], found, xp.zeros_like(found))
