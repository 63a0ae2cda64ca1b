"""Results of searches along their records, in operations of torch or of JAX: derivatives of any order.

``xp`` is ``torch`` or ``jax.numpy``, and ``fixed`` returns an array without its derivatives.
"""

from __future__ import annotations

from typing import Any, Callable

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
